//! Pictures in pixels, by crate `resvg`, and pages of PDF, from our own SVG.

use std::sync::Arc;

use resvg::tiny_skia::{Color, Pixmap, Transform};
use resvg::usvg::fontdb::{Database, Source};
use resvg::usvg::{Options, Tree};

use crate::Error;
use crate::figure::FONT;
use crate::pdf;
use crate::pixels::encode;

/// The only font there is, so that a figure looks the same everywhere.
const FONT_FILE: &[u8] = include_bytes!("../fonts/DejaVuSans-subset.ttf");
/// Pixels to a unit of the SVG.
const SCALE: f32 = 2.0;
/// An inch in millimetres, in SVG's own units and in PDF's points.
const MM_PER_INCH: f64 = 25.4;
const UNITS_PER_INCH: f64 = 96.0;
const POINTS_PER_INCH: f64 = 72.0;

/// A figure as PNG, two pixels to a unit, on white.
///
/// # Errors
/// [`Error::Content`] where it cannot be drawn.
pub fn rendered(svg: &str) -> Result<Vec<u8>, Error> {
    png(svg, "").map_err(|e| Error::content("the figure", e))
}

/// Renders an SVG as a PNG, two pixels to a unit, on white; the recipe becomes its comment.
pub(crate) fn png(svg: &str, recipe: &str) -> Result<Vec<u8>, String> {
    scaled_png(svg, SCALE, recipe)
}

/// Renders an SVG in millimetres as a PNG.
pub(crate) fn png_of_page(svg: &str, pixels_per_mm: f64, recipe: &str) -> Result<Vec<u8>, String> {
    scaled_png(svg, (pixels_per_mm * MM_PER_INCH / UNITS_PER_INCH) as f32, recipe)
}

fn scaled_png(svg: &str, scale: f32, recipe: &str) -> Result<Vec<u8>, String> {
    let tree = tree(svg)?;
    let pixels = |length: f32| (length * scale).round().max(1.0) as u32;
    let mut pixmap = Pixmap::new(pixels(tree.size().width()), pixels(tree.size().height())).ok_or("the picture has no size")?;
    pixmap.fill(Color::WHITE);
    resvg::render(&tree, Transform::from_scale(scale, scale), &mut pixmap.as_mut());
    // On opaque white, premultiplied colours are plain colours.
    encode(pixmap.data(), pixmap.width(), pixmap.height(), png::ColorType::Rgba, recipe).map_err(|e| e.to_string())
}

/// Renders an SVG as a page of PDF, a point to a unit; the recipe becomes its subject.
pub(crate) fn pdf(svg: &str, recipe: &str) -> Result<Vec<u8>, String> {
    pdf::document(&tree(svg)?, 1.0, recipe)
}

/// Renders an SVG in millimetres as a page of PDF of the same size.
pub(crate) fn pdf_of_page(svg: &str, recipe: &str) -> Result<Vec<u8>, String> {
    pdf::document(&tree(svg)?, (POINTS_PER_INCH / UNITS_PER_INCH) as f32, recipe)
}

fn tree(svg: &str) -> Result<Tree, String> {
    let mut fonts = Database::new();
    fonts.load_font_source(Source::Binary(Arc::new(FONT_FILE)));
    let options = Options { fontdb: Arc::new(fonts), font_family: FONT.into(), ..Options::default() };
    Tree::from_str(svg, &options).map_err(|e| e.to_string())
}
