//! Several curves in one chart, with a legend.

use std::fmt::Write as _;

use super::chart::{Axis, Chart};
use super::svg::{Anchor, drawing, text};

/// A curve by its name.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// What the legend says.
    pub name: String,
    /// From left to right.
    pub points: Vec<[f64; 2]>,
}

const SIZE: [f64; 2] = [420.0, 300.0];
const LEGEND: f64 = 230.0;
/// Colours that the colour-blind tell apart (Okabe and Ito), each with its dashes, for grey.
const STYLES: [(&str, &str); 8] = [
    ("#000000", "none"),
    ("#0072b2", "7 3"),
    ("#d55e00", "2 2"),
    ("#009e73", "9 2 2 2"),
    ("#cc79a7", "4 4"),
    ("#56b4e9", "12 3"),
    ("#e69f00", "6 2 2 2 2 2"),
    ("#777777", "1 3"),
];

/// Draws curves over two axes, and a legend beside them.
pub fn chart(x: Axis, y: Axis, curves: &[Curve], recipe: &str) -> String {
    let mut chart = Chart::new(SIZE, x, y);
    let mut svg = String::new();
    for (index, curve) in curves.iter().enumerate() {
        let (colour, dashes) = STYLES[index % STYLES.len()];
        chart.curve(curve.points.iter().map(|p| (p[0], p[1])), colour, 1.5, dashes);
        let at = 20.0 + 18.0 * index as f64;
        let _ = writeln!(
            svg,
            "<path fill=\"none\" stroke=\"{colour}\" stroke-width=\"1.5\" stroke-dasharray=\"{dashes}\" d=\"M{} {at}h28\"/>",
            SIZE[0] + 2.0
        );
        text(&mut svg, [SIZE[0] + 36.0, at + 4.0], 11.0, Anchor::Start, &curve.name);
    }
    chart.finish(&mut svg, [0.0, 0.0]);
    drawing([SIZE[0] + LEGEND, SIZE[1]], recipe, &svg)
}
