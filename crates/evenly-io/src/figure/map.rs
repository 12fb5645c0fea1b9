//! Maps: the points themselves, and what lies between them, with exact coordinates.

use std::cell::OnceCell;
use std::fmt::Write as _;

use evenly::{PointSet, Tessellation, tessellate};

use super::draw::Draw;
use super::svg::Short;
use crate::Error;

/// The tessellation of the one set that is drawn, made where it is first needed.
#[derive(Default)]
pub(super) struct Tessellated(OnceCell<Tessellation>);

impl Tessellated {
    pub fn of(&self, points: &PointSet) -> Result<&Tessellation, Error> {
        Ok(match self.0.get() {
            Some(known) => known,
            None => {
                let made = tessellate(points)?;
                self.0.get_or_init(|| made)
            }
        })
    }
}

/// The longer side of the drawing, in its own units.
const SIDE: f64 = 800.0;
/// Blank space around a bounded domain, so that points on its boundary are seen whole. A torus has none: its picture tiles the plane.
const MARGIN: f64 = 8.0;
/// Colours of cells by area, from half the mean to one and a half: dark to light, blue to yellow, told apart by the colour-blind and in grey.
const AREAS: [&str; 9] = ["#00224e", "#123570", "#3b496c", "#575d6d", "#707173", "#8a8678", "#a59c74", "#c3b369", "#fee838"];
/// Colours of the valences up to 4, 5, 6, 7, and from 8, told apart by the colour-blind and in grey.
const COLOURS: [&str; 5] = ["#004c7f", "#56b4e9", "#ffffff", "#e69f00", "#9c3d00"];

/// Draws these layers, on each other in their order; the body of a drawing, and its size. Of more than `most` points a corner is drawn.
///
/// # Errors
/// [`Error::Points`] where a layer needs a triangulation and the points have none: fewer than three, or all on one line.
pub(super) fn map(points: &PointSet, layers: &[Draw], most: usize, known: &Tessellated) -> Result<(String, [f64; 2]), Error> {
    let canvas = Canvas::new(points, most);
    let mut svg = String::new();
    if let Some(region) = points.space().region() {
        canvas.boundary(&mut svg, region.rings());
    }
    let tessellation = if layers.iter().any(|&layer| layer != Draw::Points) { Some(known.of(points)?) } else { None };
    for layer in layers {
        match (layer, tessellation) {
            (Draw::Points, _) => canvas.points(&mut svg, points),
            (Draw::Delaunay, Some(tessellation)) => {
                let corners = tessellation.corners.iter().map(|c| c.as_slice());
                canvas.outlines(&mut svg, corners, "#444444");
            }
            (Draw::Voronoi, Some(tessellation)) => {
                canvas.outlines(&mut svg, tessellation.cells.iter().map(Vec::as_slice), "#888888");
            }
            (Draw::Valence, Some(tessellation)) => canvas.valences(&mut svg, points, tessellation),
            (Draw::Capacity, Some(tessellation)) => canvas.capacities(&mut svg, points, tessellation),
            _ => {}
        }
    }
    Ok((svg, canvas.size()))
}

/// The way from input units to the drawing's, y upwards to y downwards.
struct Canvas {
    origin: [f64; 2],
    /// Of what is seen, in input units.
    size: [f64; 2],
    /// Of the domain, in drawing units; 0 if it is no torus.
    period: [f64; 2],
    scale: f64,
    margin: f64,
    /// Hexagonal spacing in drawing units.
    spacing: f64,
}

impl Canvas {
    fn new(points: &PointSet, most: usize) -> Self {
        let space = points.space();
        // The corner of a polygon's frame may be empty.
        let share = if space.region().is_some() { 1.0 } else { most as f64 / points.n_points().max(1) as f64 };
        let size = seen(space.size(), share);
        let scale = SIDE / size[0].max(size[1]);
        let period = space.size().map(|side| if space.is_periodic() { side * scale } else { 0.0 });
        let margin = if space.is_periodic() || size != space.size() { 0.0 } else { MARGIN };
        let spacing = space.hex_spacing(points.n_points().max(1)) * scale;
        Self { origin: space.origin(), size, period, scale, margin, spacing }
    }

    /// Of the whole drawing.
    fn size(&self) -> [f64; 2] {
        self.size.map(|side| side * self.scale + 2.0 * self.margin)
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

    /// The boundary of a polygon.
    fn boundary(&self, svg: &mut String, rings: &[Vec<[f64; 2]>]) {
        svg.push_str("<path fill=\"none\" stroke=\"#888888\" stroke-width=\"0.5\" stroke-linejoin=\"round\" d=\"");
        rings.iter().for_each(|ring| self.outline(svg, ring, [0.0; 2]));
        svg.push_str("\"/>\n");
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

    /// Cells filled by the class that each has; a cell without a class stays blank.
    fn fill(&self, svg: &mut String, cells: &[Vec<[f64; 2]>], colours: &[&str], class: impl Fn(usize) -> Option<usize>) {
        for (index, colour) in colours.iter().enumerate() {
            let _ = write!(svg, "<path fill=\"{colour}\" stroke=\"#888888\" stroke-width=\"0.2\" d=\"");
            for (_, cell) in cells.iter().enumerate().filter(|&(cell, _)| class(cell) == Some(index)) {
                for shift in self.images(cell, 0.0) {
                    self.outline(svg, cell, shift);
                }
            }
            svg.push_str("\"/>\n");
        }
    }

    fn capacities(&self, svg: &mut String, points: &PointSet, tessellation: &Tessellation) {
        // Of the hexagonal lattice a cell has sqrt(3) / 2 squared spacings.
        let spacing = points.hex_spacing();
        let class = |cell: usize| {
            let capacity = area(&tessellation.cells[cell], spacing) / (0.5 * 3f64.sqrt());
            Some(((capacity - 0.5) * AREAS.len() as f64).clamp(0.0, AREAS.len() as f64 - 1.0) as usize)
        };
        self.fill(svg, &tessellation.cells, &AREAS, class);
    }

    fn valences(&self, svg: &mut String, points: &PointSet, tessellation: &Tessellation) {
        self.fill(svg, &tessellation.cells, &COLOURS, |cell| tessellation.valence[cell].map(|n| n.clamp(4, 8) - 4));
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

    /// The shifts at which a shape is seen in the drawing: its own place, and a period away where it crosses the seam of a torus.
    fn images(&self, shape: &[[f64; 2]], reach: f64) -> Vec<[f64; 2]> {
        let drawing = self.size();
        let axis = |axis: usize| {
            let period = self.period[axis];
            let places = || shape.iter().map(|&p| self.place(p)[axis]);
            let (low, high) = (places().fold(f64::MAX, f64::min) - reach, places().fold(f64::MIN, f64::max) + reach);
            let shifts = if period == 0.0 { &[0.0][..] } else { &[-1.0, 0.0, 1.0] };
            let is_seen = move |shift: &f64| low + shift < drawing[axis] && high + shift > 0.0;
            shifts.iter().map(move |shift| shift * period).filter(is_seen)
        };
        axis(0).flat_map(|x| axis(1).map(move |y| [x, y])).collect()
    }
}

/// The size of a corner with this share of a domain, as square as can be; or all of it.
fn seen([width, height]: [f64; 2], share: f64) -> [f64; 2] {
    if share >= 1.0 {
        return [width, height];
    }
    let side = (share * width).sqrt() * height.sqrt();
    if side > height {
        [share * width, height]
    } else if side > width {
        [width, share * height]
    } else {
        [side, side]
    }
}

/// The area of a polygon in squared units, relative to its first corner, so that neither a far origin nor a tiny domain costs digits.
fn area(polygon: &[[f64; 2]], unit: f64) -> f64 {
    let Some(&[x, y]) = polygon.first() else { return 0.0 };
    let cross = |pair: &[[f64; 2]]| {
        let [[a, b], [c, d]] = [pair[0], pair[1]].map(|p| [(p[0] - x) / unit, (p[1] - y) / unit]);
        a * d - c * b
    };
    0.5 * polygon.windows(2).map(cross).sum::<f64>().abs()
}
