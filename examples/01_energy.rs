//! Draws how the energy falls in Procrustes analysis: `cargo run --release --package evenly-io --example 01_energy energy.svg`.

use std::fmt::Write as _;

use evenly::{Mode, ProcrustesParams, RunContext, Torus, procrustes, warp, white};
use evenly_io::Target;

const WIDTH: f64 = 640.0;
const HEIGHT: f64 = 400.0;
const MARGIN: f64 = 60.0;
/// The axes' ends: iterations, and energies as a fraction of the domain's area above that of the hexagonal lattice.
const ITERATIONS: f64 = 150.0;
const ENERGIES: [f64; 2] = [0.02, 0.5];

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args().nth(1).unwrap_or("energy.svg".into());
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" font-family=\"sans-serif\" font-size=\"13\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n"
    );
    axes(&mut svg)?;
    let runs = [
        ("paper mode, white noise", Mode::Paper, false, "#000000", "none"),
        ("paper mode, warped", Mode::Paper, true, "#e69f00", "7 3"),
        ("fast mode, white noise", Mode::Fast, false, "#56b4e9", "2 3"),
        ("fast mode, warped", Mode::Fast, true, "#0072b2", "none"),
    ];
    for (row, (name, mode, is_warped, colour, dash)) in runs.into_iter().enumerate() {
        let mut points = white(Torus::new([0.0, 0.0], [1.0, 1.0])?, 10_000, 0)?;
        if is_warped {
            warp(&mut points);
        }
        let params = ProcrustesParams { mode, ..ProcrustesParams::default() };
        let report = procrustes(&mut points, &params, &mut RunContext::default())?;
        curve(&mut svg, &report.energy, colour, dash)?;
        let y = MARGIN + 22.0 * row as f64;
        writeln!(svg, "<path stroke=\"{colour}\" stroke-width=\"2\" stroke-dasharray=\"{dash}\" d=\"M320 {y}h40\"/>")?;
        writeln!(svg, "<text x=\"370\" y=\"{}\">{name}, {} iterations</text>", y + 4.0, report.iterations)?;
    }
    svg.push_str("</svg>\n");
    Target::any(path.as_ref(), true)?.write(svg.as_bytes())?;
    Ok(())
}

/// The energy of the hexagonal lattice, as a fraction of the area: no set has less.
fn hexagonal_energy(side: f64) -> f64 {
    4.0 * (side - 1.0).powi(2) / 3f64.sqrt()
}

fn place(iteration: f64, energy: f64) -> [f64; 2] {
    let share = (energy / ENERGIES[0]).ln() / (ENERGIES[1] / ENERGIES[0]).ln();
    let x = MARGIN + (WIDTH - 2.0 * MARGIN) * iteration / ITERATIONS;
    [x, HEIGHT - MARGIN - (HEIGHT - 2.0 * MARGIN) * share]
}

fn curve(svg: &mut String, energy: &[f64], colour: &str, dash: &str) -> std::fmt::Result {
    write!(svg, "<polyline fill=\"none\" stroke=\"{colour}\" stroke-width=\"2\" stroke-dasharray=\"{dash}\" points=\"")?;
    for (iteration, energy) in energy.iter().enumerate() {
        let [x, y] = place(iteration as f64, energy - hexagonal_energy(ProcrustesParams::default().side));
        if y >= MARGIN {
            write!(svg, "{x:.1},{y:.1} ")?;
        }
    }
    writeln!(svg, "\"/>")
}

fn axes(svg: &mut String) -> std::fmt::Result {
    let ([left, bottom], [right, top]) = (place(0.0, ENERGIES[0]), place(ITERATIONS, ENERGIES[1]));
    writeln!(svg, "<path fill=\"none\" stroke=\"#666666\" d=\"M{left} {top}V{bottom}H{right}\"/>")?;
    for iteration in [0.0, 50.0, 100.0, 150.0] {
        let [x, y] = place(iteration, ENERGIES[0]);
        writeln!(svg, "<text x=\"{x:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{iteration}</text>", y + 18.0)?;
    }
    for energy in [0.02, 0.05, 0.1, 0.2, 0.5] {
        let [x, y] = place(0.0, energy);
        writeln!(svg, "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{energy}</text>", x - 6.0, y + 4.0)?;
    }
    writeln!(svg, "<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">iterations</text>", 0.5 * WIDTH, HEIGHT - 14.0)?;
    writeln!(svg, "<text x=\"{left}\" y=\"{}\">energy above the hexagonal lattice, per area</text>", top - 16.0)
}
