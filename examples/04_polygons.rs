//! Writes two polygons for `evenly mesh`: a coast of some hundred corners, and a plate with a hole and slots:
//! `cargo run --release --package evenly-io --example 04_polygons folder`.

use std::f64::consts::TAU;
use std::fmt::Write as _;
use std::path::PathBuf;

use evenly_io::make_folder;

type Ring = Vec<[f64; 2]>;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = PathBuf::from(std::env::args().nth(1).unwrap_or("polygons".into()));
    make_folder(&folder)?;
    for (name, rings) in [("coast.txt", vec![coast(400)]), ("plate.txt", plate())] {
        let mut text = String::new();
        for ring in rings {
            for [x, y] in ring {
                writeln!(text, "{x} {y}")?;
            }
            text.push('\n');
        }
        std::fs::write(folder.join(name), text)?;
    }
    Ok(())
}

/// A hexagon whose sides have been halved, and their middles moved, again and again.
fn coast(n_corners: usize) -> Ring {
    let mut state = 3u64;
    let mut random = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as f64 / f64::from(1u32 << 30) - 1.0
    };
    let mut ring: Ring = (0..6).map(|k| (TAU * f64::from(k) / 6.0).sin_cos().into()).collect();
    ring.reverse();
    while ring.len() < n_corners {
        let next = ring.iter().cycle().skip(1);
        let halved = ring.iter().zip(next).flat_map(|(&[ax, ay], &[bx, by])| {
            let by_how_much = 0.16 * random();
            [[ax, ay], [0.5 * (ax + bx) + by_how_much * (by - ay), 0.5 * (ay + by) - by_how_much * (bx - ax)]]
        });
        ring = halved.collect();
    }
    ring
}

/// A plate with a round hole and two slots.
fn plate() -> Vec<Ring> {
    let arc = |centre: [f64; 2], radius: f64, from: f64, to: f64| {
        (0..=12).map(move |k| {
            let (sin, cos) = (from + (to - from) * f64::from(k) / 12.0).sin_cos();
            [centre[0] + radius * cos, centre[1] + radius * sin]
        })
    };
    let slot = |y: f64| arc([1.0, y], 0.06, 0.25 * TAU, 0.75 * TAU).chain(arc([1.6, y], 0.06, -0.25 * TAU, 0.25 * TAU)).collect();
    let outline = vec![[0.0, 0.0], [2.0, 0.0], [2.0, 0.6], [1.6, 1.0], [0.0, 1.0]];
    let hole = (0..36).map(|k| (TAU * f64::from(k) / 36.0).sin_cos()).map(|(sin, cos)| [0.45 + 0.22 * cos, 0.5 + 0.22 * sin]).collect();
    vec![outline, hole, slot(0.3), slot(0.62)]
}
