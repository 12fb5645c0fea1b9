//! Figures of point sets as SVG, with exact coordinates.

use std::fmt::{Display, Write as _};

use evenly::{PointSet, Tessellation, tessellate};

use crate::Error;

/// A layer of a figure; layers lie on each other in this order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Draw {
    /// Voronoi cells coloured by their number of neighbours: white for 6, blues below, oranges above; 5 bears a minus, 7 a plus.
    Valence,
    /// The edges of the Voronoi diagram.
    Voronoi,
    /// The edges of the Delaunay triangulation.
    Delaunay,
    /// The points.
    Points,
}

/// The longer side of the drawing, in its own units.
const SIDE: f64 = 800.0;
/// Blank space around a bounded domain, so that points on its border are seen whole. A torus has none: its picture tiles the plane.
const MARGIN: f64 = 8.0;
/// Colours of the valences up to 4, 5, 6, 7, and from 8, told apart by the colour-blind and in grey.
const COLOURS: [&str; 5] = ["#004c7f", "#56b4e9", "#ffffff", "#e69f00", "#9c3d00"];

/// Draws a figure of these layers.
///
/// # Errors
/// [`Error::Points`] where a layer needs a triangulation and the points have none: fewer than three, or all on one line.
pub fn figure(points: &PointSet, draw: &[Draw], recipe: &str) -> Result<String, Error> {
    let mut layers = draw.to_vec();
    layers.sort_unstable();
    layers.dedup();
    let canvas = Canvas::new(points);
    let mut svg = canvas.begin(recipe);
    let tessellation = if layers.iter().any(|&layer| layer != Draw::Points) { Some(tessellate(points)?) } else { None };
    for layer in layers {
        match (layer, &tessellation) {
            (Draw::Points, _) => canvas.points(&mut svg, points),
            (Draw::Delaunay, Some(tessellation)) => {
                let corners = tessellation.corners.iter().map(|c| c.as_slice());
                canvas.outlines(&mut svg, corners, "#444444");
            }
            (Draw::Voronoi, Some(tessellation)) => {
                canvas.outlines(&mut svg, tessellation.cells.iter().map(Vec::as_slice), "#888888");
            }
            (Draw::Valence, Some(tessellation)) => canvas.valences(&mut svg, points, tessellation),
            (_, None) => {}
        }
    }
    svg.push_str("</svg>\n");
    Ok(svg)
}

/// The way from input units to the drawing's, y upwards to y downwards.
struct Canvas {
    origin: [f64; 2],
    size: [f64; 2],
    scale: f64,
    margin: f64,
    /// Hexagonal spacing in drawing units.
    spacing: f64,
    is_periodic: bool,
}

impl Canvas {
    fn new(points: &PointSet) -> Self {
        let space = points.space();
        let size = space.size();
        let scale = SIDE / size[0].max(size[1]);
        let margin = if space.is_periodic() { 0.0 } else { MARGIN };
        let spacing = space.hex_spacing(points.n_points().max(1)) * scale;
        Self { origin: space.origin(), size, scale, margin, spacing, is_periodic: space.is_periodic() }
    }

    fn begin(&self, recipe: &str) -> String {
        let [width, height] = self.size.map(|side| Short(side * self.scale + 2.0 * self.margin));
        let recipe = recipe.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace(char::is_control, " ");
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\">\n\
             <desc>{recipe}</desc>\n<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n"
        )
    }

    fn place(&self, p: [f64; 2]) -> [f64; 2] {
        [self.margin + (p[0] - self.origin[0]) * self.scale, self.margin + (self.origin[1] + self.size[1] - p[1]) * self.scale]
    }

    /// Dots as circles of two arcs, a thousand to a path: a million single elements are too many for most programs.
    fn points(&self, svg: &mut String, points: &PointSet) {
        let radius = (0.16 * self.spacing).clamp(0.25, 4.0);
        let (r, d) = (Short(radius), Short(2.0 * radius));
        for group in points.positions().chunks(1000) {
            svg.push_str("<path fill=\"#000000\" d=\"");
            for &p in group {
                for shift in self.images(&[p], radius) {
                    let [x, y] = self.place(p);
                    let (left, y) = (Short(x + shift[0] - radius), Short(y + shift[1]));
                    let _ = write!(svg, "M{left} {y}a{r} {r} 0 1 0 {d} 0a{r} {r} 0 1 0 -{d} 0z");
                }
            }
            svg.push_str("\"/>\n");
        }
    }

    fn outlines<'a>(&self, svg: &mut String, polygons: impl Iterator<Item = &'a [[f64; 2]]>, colour: &str) {
        let width = Short((0.05 * self.spacing).clamp(0.1, 1.5));
        let _ = write!(svg, "<path fill=\"none\" stroke=\"{colour}\" stroke-width=\"{width}\" stroke-linejoin=\"round\" d=\"");
        for polygon in polygons {
            for shift in self.images(polygon, 0.0) {
                self.outline(svg, polygon, shift);
            }
        }
        svg.push_str("\"/>\n");
    }

    fn valences(&self, svg: &mut String, points: &PointSet, tessellation: &Tessellation) {
        let class = |valence: usize| valence.clamp(4, 8) - 4;
        for (index, colour) in COLOURS.iter().enumerate() {
            let _ = write!(svg, "<path fill=\"{colour}\" stroke=\"#888888\" stroke-width=\"0.2\" d=\"");
            let cells = tessellation.cells.iter().zip(&tessellation.valence);
            for (cell, _) in cells.filter(|(_, valence)| valence.is_some_and(|n| class(n) == index)) {
                for shift in self.images(cell, 0.0) {
                    self.outline(svg, cell, shift);
                }
            }
            svg.push_str("\"/>\n");
        }
        let half = 0.34 * self.spacing;
        let width = Short((0.08 * self.spacing).max(0.1));
        let _ = write!(svg, "<path fill=\"none\" stroke=\"#000000\" stroke-width=\"{width}\" d=\"");
        for (&p, valence) in points.positions().iter().zip(&tessellation.valence) {
            for shift in self.images(&[p], half) {
                let [x, y] = self.place(p);
                let [x, y] = [x + shift[0], y + shift[1]];
                if matches!(valence, Some(5 | 7)) {
                    let _ = write!(svg, "M{} {}h{}", Short(x - half), Short(y), Short(2.0 * half));
                }
                if *valence == Some(7) {
                    let _ = write!(svg, "M{} {}v{}", Short(x), Short(y - half), Short(2.0 * half));
                }
            }
        }
        svg.push_str("\"/>\n");
    }

    fn outline(&self, svg: &mut String, polygon: &[[f64; 2]], shift: [f64; 2]) {
        for (k, &corner) in polygon.iter().enumerate() {
            let [x, y] = self.place(corner);
            let _ = write!(svg, "{}{} {}", if k == 0 { 'M' } else { 'L' }, Short(x + shift[0]), Short(y + shift[1]));
        }
        if !polygon.is_empty() {
            svg.push('Z');
        }
    }

    /// The shifts at which a shape of the torus is seen in the drawing: its own place, and a period away where it crosses the seam.
    fn images(&self, shape: &[[f64; 2]], reach: f64) -> Vec<[f64; 2]> {
        if !self.is_periodic {
            return vec![[0.0; 2]];
        }
        let axis = |axis: usize| {
            let period = self.size[axis] * self.scale;
            let places = || shape.iter().map(|&p| self.place(p)[axis]);
            let (low, high) = (places().fold(f64::MAX, f64::min) - reach, places().fold(f64::MIN, f64::max) + reach);
            [-period, 0.0, period].into_iter().filter(move |shift| low + shift < period && high + shift > 0.0)
        };
        axis(0).flat_map(|x| axis(1).map(move |y| [x, y])).collect()
    }
}

/// Prints a length with four digits after the point at most: finer than any printer, and exact to a ten-thousandth of a unit.
struct Short(f64);

impl Display for Short {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}", (self.0 * 1e4).round() / 1e4)
    }
}
