//! Figures of point sets as SVG: maps, charts, and a page of all of them.

mod chart;
mod curves;
mod map;
mod page;
mod series;
mod svg;
mod waves;

use evenly::Image;

use crate::Error;
use crate::pixels::{bytes, colour, encode};
pub use chart::Axis;
use page::Page;
pub use page::Subject;
pub use series::{Curve, chart};
pub(crate) use svg::FONT;
use svg::drawing;

/// A picture of pixels as SVG, a pixel to a unit, for pages that hold several.
pub fn picture(image: &Image) -> String {
    let size = [image.width() as f64, image.height() as f64];
    let png = encode(&bytes(image), image.width() as u32, image.height() as u32, colour(image), "");
    let Ok(png) = png else { return String::new() };
    drawing(size, "", &svg::embedded(&png, size))
}

/// What a figure shows: layers of a map, which lie on each other in this order, charts, and a page of all.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Draw {
    /// Voronoi cells coloured by their number of neighbours: white for 6, blues below, oranges above; 5 bears a minus, 7 a plus.
    Valence,
    /// Voronoi cells coloured by their area: dark for half the mean, light for one and a half.
    Capacity,
    /// The edges of the Voronoi diagram.
    Voronoi,
    /// The edges of the Delaunay triangulation.
    Delaunay,
    /// The points.
    Points,
    /// The power of each frequency, in log grey.
    PowerSpectrum,
    /// The radial mean of the power spectrum.
    RadialPower,
    /// How much the power differs by direction.
    Anisotropy,
    /// How many points there are at a distance from a point.
    PairCorrelation,
    /// The angles of the Delaunay triangles.
    Angles,
    /// A page of all these, with the measures; of many points the maps show a corner.
    Report,
}

impl Draw {
    fn is_layer(self) -> bool {
        self <= Self::Points
    }
}

/// Draws a figure: a map of all layers together, as large as there is room; or panels, the map first and then each chart.
///
/// # Errors
/// [`Error::Points`] where the points are too few for what is asked for: a triangulation takes three that are not on one line, a spectrum some hundred.
pub fn figure(subject: &Subject, draw: &[Draw], recipe: &str) -> Result<String, Error> {
    let mut parts = draw.to_vec();
    parts.sort_unstable();
    parts.dedup();
    if let (Some(points), true) = (subject.sets.first(), parts.iter().all(|part| part.is_layer())) {
        let (body, size) = map::map(points, &parts, subject.most_points.unwrap_or(usize::MAX))?;
        return Ok(drawing(size, recipe, &body));
    }
    let (body, size) = Page::of(subject, &parts)?.finish();
    Ok(drawing(size, recipe, &body))
}
