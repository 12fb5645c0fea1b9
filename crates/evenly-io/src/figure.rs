//! Figures of point sets as SVG: maps, charts, and a page of all of them.

mod chart;
mod curves;
mod draw;
mod map;
mod mesh;
mod page;
mod series;
mod shaded;
mod svg;
mod waves;

use evenly::Image;

use crate::Error;
use crate::pixels::{bytes, colour, encode};
pub use chart::Axis;
pub use draw::Draw;
pub(crate) use mesh::mesh_figure;
use page::Page;
pub use page::Subject;
pub use series::{Curve, chart};
pub use shaded::compared_svg;
pub(crate) use shaded::shaded_figure;
use svg::drawing;
pub(crate) use svg::{FONT, Short, sheet};

/// A picture of pixels as SVG, a pixel to a unit, for pages that hold several.
pub fn picture(image: &Image) -> String {
    let size = [image.width() as f64, image.height() as f64];
    let png = encode(&bytes(image), image.width() as u32, image.height() as u32, colour(image), "");
    let Ok(png) = png else { return String::new() };
    drawing(size, "", &svg::embedded(&png, size))
}

/// Draws a figure: a map of all layers together, as large as there is room; or panels, the map first and then each chart.
///
/// # Errors
/// [`Error::Points`] where the points are too few for what is asked for: a triangulation takes three that are not on one line, a spectrum 16 and more.
pub fn figure(subject: &Subject, draw: &[Draw], recipe: &str) -> Result<String, Error> {
    let mut parts = draw.to_vec();
    parts.sort_unstable();
    parts.dedup();
    if let (Some(points), true) = (subject.sets.first(), parts.iter().all(|part| part.is_layer())) {
        let (body, size) = map::map(points, &parts, subject.most_points.unwrap_or(usize::MAX), &map::Tessellated::default())?;
        return Ok(drawing(size, recipe, &body));
    }
    // What several panels show is computed once; what cannot be is said where it is asked for.
    let is_spectral = parts.iter().any(|part| part.is_spectral());
    let (radial, power) = if is_spectral { (subject.radial().ok(), subject.power().ok()) } else { (None, None) };
    let subject = Subject { radial: radial.as_deref(), power: power.as_deref(), ..*subject };
    let (body, size) = Page::of(&subject, &parts)?.finish();
    Ok(drawing(size, recipe, &body))
}
