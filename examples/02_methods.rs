//! Draws white noise, Push-Pull and Procrustes analysis side by side, with the number of each point's neighbours:
//! `cargo run --release --package evenly-io --example 02_methods methods.svg`.

use std::fmt::Write as _;

use evenly::{PointSet, ProcrustesParams, PushPullParams, RunContext, Torus, measure, procrustes, push_pull, warp, warp_isotropic, white};
use evenly_io::{Draw, Target, figure};

const N_POINTS: usize = 500;
/// The sides of a figure as it comes, and of a panel.
const FIGURE: f64 = 800.0;
const PANEL: f64 = 400.0;
const GAP: f64 = 16.0;
const CAPTION: f64 = 44.0;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args().nth(1).unwrap_or("methods.svg".into());
    let noise = white(Torus::new([0.0, 0.0], [1.0, 1.0])?, N_POINTS, 0)?;
    let mut pushed = noise.clone();
    warp_isotropic(&mut pushed);
    push_pull(&mut pushed, &PushPullParams::default(), &mut RunContext::default())?;
    let mut fitted = noise.clone();
    warp(&mut fitted);
    procrustes(&mut fitted, &ProcrustesParams::default(), &mut RunContext::default())?;

    let (width, height) = (3.0 * PANEL + 2.0 * GAP, PANEL + CAPTION);
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" font-family=\"sans-serif\" font-size=\"15\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n"
    );
    for (column, (name, points)) in [("white noise", noise), ("Push-Pull", pushed), ("Procrustes", fitted)].into_iter().enumerate() {
        panel(&mut svg, column as f64 * (PANEL + GAP), name, &points)?;
    }
    svg.push_str("</svg>\n");
    Target::any(path.as_ref(), true)?.write(svg.as_bytes())?;
    Ok(())
}

/// A set with its name and what it is worth.
fn panel(svg: &mut String, x: f64, name: &str, points: &PointSet) -> Result<(), Box<dyn std::error::Error>> {
    let m = measure(points)?;
    let six = m.valence.get(&6).map_or(0.0, |&n| 100.0 * n as f64 / N_POINTS as f64);
    writeln!(svg, "<text x=\"{x}\" y=\"16\" font-weight=\"bold\">{name}</text>")?;
    writeln!(
        svg,
        "<text x=\"{x}\" y=\"35\">distance {:.2}, coverage {:.2}, six neighbours {six:.0} %</text>",
        m.min_distance, m.coverage_radius
    )?;
    let scale = PANEL / FIGURE;
    writeln!(svg, "<g transform=\"translate({x} {CAPTION}) scale({scale})\">")?;
    svg.push_str(&figure(&points.into(), &[Draw::Valence, Draw::Points], name)?);
    svg.push_str("</g>\n");
    Ok(())
}
