//! Pieces of SVG.

use std::fmt::{Display, Write as _};

use base64::Engine as _;

/// The family of all text; without it, whatever the reader's program has.
pub(crate) const FONT: &str = "DejaVu Sans";

/// Prints a length with four digits after the point at most: finer than any printer, and exact to a ten-thousandth of a unit.
pub(crate) struct Short(pub f64);

impl Display for Short {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}", (self.0 * 1e4).round() / 1e4)
    }
}

/// Where text stands against its place.
#[derive(Clone, Copy)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

/// A whole drawing of this size, on white, with what is in it.
pub(super) fn drawing(size: [f64; 2], recipe: &str, body: &str) -> String {
    let [width, height] = size.map(Short);
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\" font-family=\"{FONT}, sans-serif\">\n\
         <desc>{}</desc>\n<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n{body}</svg>\n",
        escaped(recipe)
    )
}

/// A page of this size in millimetres, which are its units, with what is in it.
pub(crate) fn sheet(size_mm: [f64; 2], recipe: &str, body: &str) -> String {
    let [width, height] = size_mm.map(Short);
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\" \
         width=\"{width}mm\" height=\"{height}mm\" viewBox=\"0 0 {width} {height}\">\n<desc>{}</desc>\n{body}</svg>\n",
        escaped(recipe)
    )
}

/// A part of a drawing with units of its own, which ends at its boundary.
pub(super) fn inset(place: [f64; 2], size: [f64; 2], units: [f64; 2], body: &str) -> String {
    let ([x, y], [width, height], [w, h]) = (place.map(Short), size.map(Short), units.map(Short));
    format!("<svg x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {w} {h}\">\n{body}</svg>\n")
}

/// A PNG as large as this, its pixels sharp.
pub(super) fn embedded(png: &[u8], size: [f64; 2]) -> String {
    let data = base64::engine::general_purpose::STANDARD.encode(png);
    let [width, height] = size.map(Short);
    format!(
        "<image width=\"{width}\" height=\"{height}\" preserveAspectRatio=\"none\" image-rendering=\"optimizeSpeed\" href=\"data:image/png;base64,{data}\"/>\n"
    )
}

/// A line of text, if there are words.
pub(super) fn text(svg: &mut String, [x, y]: [f64; 2], size: f64, anchor: Anchor, words: &str) {
    if words.is_empty() {
        return;
    }
    let anchor = match anchor {
        Anchor::Start => "",
        Anchor::Middle => " text-anchor=\"middle\"",
        Anchor::End => " text-anchor=\"end\"",
    };
    let _ = writeln!(svg, "<text x=\"{}\" y=\"{}\" font-size=\"{size}\"{anchor}>{}</text>", Short(x), Short(y), escaped(words));
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace(char::is_control, " ")
}
