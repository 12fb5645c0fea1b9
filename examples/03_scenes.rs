//! Draws three scenes for `evenly stipple`, without a camera: balls in colour, a torus in soft light, and mountains in fog:
//! `cargo run --release --package evenly-io --example 03_scenes folder`.

use std::path::Path;

use evenly::Image;
use evenly_io::{Target, make_folder, write_image};

type Vector = [f64; 3];

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = std::env::args().nth(1).unwrap_or("scenes".into());
    make_folder(Path::new(&folder))?;
    let write = |name: &str, size: [usize; 2], colour: &dyn Fn(f64, f64) -> Vector| -> Result<(), Box<dyn std::error::Error>> {
        let [width, height] = size;
        let unit = 2.0 / height as f64;
        let place = |k: usize, n: usize| (k as f64 + 0.5 - 0.5 * n as f64) * unit;
        let values = (0..height).flat_map(|y| (0..width).flat_map(move |x| colour(place(x, width), -place(y, height)))).collect();
        let target = Target::picture(&Path::new(&folder).join(name), true)?;
        Ok(write_image(&Image::new(width, height, 3, values)?, "", &target)?)
    };
    write("balls.png", [1500, 1000], &balls)?;
    write("torus.png", [1000, 1000], &|x, y| [torus(x, y); 3])?;
    write("mountains.png", [1800, 1000], &|x, y| [mountains(x, y); 3])
}

fn dot(a: Vector, b: Vector) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// a + s b.
fn along(a: Vector, s: f64, b: Vector) -> Vector {
    [0, 1, 2].map(|k| a[k] + s * b[k])
}

fn unit(a: Vector) -> Vector {
    a.map(|x| x / dot(a, a).sqrt())
}

const LIGHT: Vector = [-0.55, 0.7, -0.45];

/// Balls on a floor, with their shadows: centres, radii, colours.
const BALLS: [(Vector, f64, Vector); 4] = [
    ([-0.75, -0.25, 3.0], 0.55, [0.9, 0.15, 0.1]),
    ([0.55, -0.2, 3.4], 0.6, [0.1, 0.45, 0.85]),
    ([-0.05, -0.55, 2.2], 0.25, [0.95, 0.8, 0.1]),
    ([1.15, -0.6, 2.5], 0.2, [0.2, 0.65, 0.25]),
];
const FLOOR: f64 = -0.8;

fn hit(from: Vector, way: Vector) -> Option<(f64, Vector, Vector)> {
    let ball = |&(centre, radius, colour): &(Vector, f64, Vector)| {
        let to = along(centre, -1.0, from);
        let (b, c) = (dot(to, way), dot(to, to) - radius * radius);
        let distance = b - (b * b - c).max(0.0).sqrt();
        (b * b > c && distance > 1e-6).then(|| (distance, along(along(from, distance, way), -1.0, centre).map(|x| x / radius), colour))
    };
    BALLS.iter().filter_map(ball).min_by(|a, b| a.0.total_cmp(&b.0))
}

fn balls(x: f64, y: f64) -> Vector {
    let (eye, way) = ([0.0, 0.1, 0.0], unit([x, y - 0.15, 2.2]));
    let to_floor = if way[1] < 0.0 { (FLOOR - eye[1]) / way[1] } else { f64::INFINITY };
    let (distance, normal, colour) = match hit(eye, way) {
        Some(found) if found.0 < to_floor => found,
        _ if to_floor < 40.0 => (to_floor, [0.0, 1.0, 0.0], [0.93, 0.9, 0.85]),
        _ => return [0.86, 0.93, 0.98].map(|sky| sky + 0.1 * y.min(0.5)),
    };
    let (place, light) = (along(eye, distance, way), unit(LIGHT));
    let is_shaded = hit(along(place, 1e-3, normal), light).is_some();
    let direct = if is_shaded { 0.0 } else { dot(normal, light).max(0.0) };
    let shine =
        if is_shaded || colour[0] == 0.93 { 0.0 } else { dot(along(way, -2.0 * dot(way, normal), normal), light).max(0.0).powi(40) };
    let haze = (distance / 25.0).min(0.8);
    colour.map(|c| (c * (0.3 + 0.75 * direct) + 0.6 * shine) * (1.0 - haze) + 0.95 * haze)
}

/// Dark where a torus turns away from the light; white paper around it.
fn torus(x: f64, y: f64) -> f64 {
    let turned = |p: Vector| {
        let (sin, cos) = (0.95f64.sin(), 0.95f64.cos());
        [p[0], cos * p[1] - sin * p[2], sin * p[1] + cos * p[2]]
    };
    let distance = |p: Vector| {
        let q = turned(p);
        ((q[0].hypot(q[1]) - 0.62).hypot(q[2])) - 0.27
    };
    let mut z = -1.5;
    for _ in 0..200 {
        let step = distance([x, y, z]);
        if step < 1e-4 {
            let at = |d: Vector| distance([x + d[0], y + d[1], z + d[2]]);
            let e = 1e-4;
            let normal = unit([at([e, 0.0, 0.0]) - step, at([0.0, e, 0.0]) - step, at([0.0, 0.0, e]) - step]);
            let light = dot(normal, unit([-0.5, 0.7, -0.6]));
            return (0.5 + 0.5 * light).powf(1.5).clamp(0.02, 0.98);
        }
        z += 0.7 * step;
        if z > 1.5 {
            break;
        }
    }
    1.0
}

/// Ridges behind each other, each paler than the one before it, under a low sun.
fn mountains(x: f64, y: f64) -> f64 {
    let hash = |k: i64, layer: u64| {
        let mixed = (k as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15).wrapping_add(layer.wrapping_mul(0xd1b5_4a32_d192_ed03));
        ((mixed ^ (mixed >> 31)).wrapping_mul(0x94d0_49bb_1331_11eb) >> 40) as f64 / (1u64 << 24) as f64
    };
    let noise = |x: f64, layer: u64| {
        let (k, t) = (x.floor(), x - x.floor());
        let smooth = t * t * (3.0 - 2.0 * t);
        hash(k as i64, layer) * (1.0 - smooth) + hash(k as i64 + 1, layer) * smooth
    };
    let ridge = |layer: u64| {
        let of =
            |octave: u32| noise((x + 7.0) * 1.3 * f64::from(1u32 << octave), 16 * layer + u64::from(octave)) * 0.55f64.powi(octave as i32);
        (0..8).map(of).sum::<f64>() * 0.62
    };
    for layer in 0..5u64 {
        let far = layer as f64 / 5.0;
        let top = -1.15 + 0.32 * layer as f64 + ridge(layer);
        if y < top {
            // Fog gathers in the valleys.
            let depth = ((top - y) / 0.7).min(1.0);
            return 0.05 + 0.75 * far + 0.35 * depth * (1.0 - 0.6 * far);
        }
    }
    let sun = (x - 0.75).hypot(y - 0.62);
    if sun < 0.13 { 1.0 } else { (0.86 + 0.1 * (-3.0 * (sun - 0.13)).exp() - 0.1 * y.max(0.0)).min(1.0) }
}
