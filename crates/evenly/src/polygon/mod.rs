//! [`Polygon`]: what rings of straight segments enclose, with holes, in one part or several.

mod clean;
mod corners;
mod simplify;
mod union;
mod weld;

use std::collections::{HashMap, HashSet};

use glam::DVec2;

use self::clean::{LeftOut, clean};
use self::corners::Corners;
use self::union::{Figure, Union, union};
use crate::error::Error;
use crate::space::{Domain, Rectangle, Region, Space};
use crate::triangulation::{Crossing, Graph, HalfEdges, Planar, next, planar};

/// A bounded domain with a boundary of straight segments. It may have holes and several parts, and parts may touch in points.
///
/// Its boundary is clean: no segment crosses another, no corner is there twice in a row, and none lies on a straight line, unless another ring touches it there.
#[derive(Debug, Clone, PartialEq)]
pub struct Polygon {
    rings: Vec<Vec<[f64; 2]>>,
    frame: Rectangle,
    area: f64,
    repairs: Vec<String>,
    /// Distinct corners in normalised coordinates, and as they were given.
    corners: Vec<DVec2>,
    given: Vec<[f64; 2]>,
    /// The boundary's segments, by their corners; the inside is on their left.
    boundary: Vec<[u32; 2]>,
}

/// Which places rings enclose.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum FillRule {
    /// Those that an odd number of rings go around, whichever way they run.
    #[default]
    EvenOdd,
    /// Those around which rings wind, one way more often than the other.
    NonZero,
}

/// Rings, and which places they enclose.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Shape {
    /// In input units. Each may be closed by its first point once more.
    pub rings: Vec<Vec<[f64; 2]>>,
    /// What is inside of them.
    pub rule: FillRule,
    /// Only what each of these encloses, too, belongs to the shape.
    pub clips: Vec<Vec<Shape>>,
}

/// Clean rings stay as they are from the second time on, and where parts touch from the third.
const MOST_CLEANINGS: usize = 4;
/// Shapes whose common area is less than this part of all have none.
const LEAST_SHARED: f64 = 1e-9;

impl Polygon {
    /// What the parts enclose together: of each the first ring is the outer one, and the others are its holes, or islands in them. Rings may be closed by their first point once more.
    ///
    /// What is repaired is told by [`Self::repairs`]: doubled and collinear points, spikes, rings without an area, rings that are there twice or run the wrong way,
    /// parts that overlap or share segments, rings that cross themselves or each other. There, an odd number of a part's rings enclose its inside.
    ///
    /// # Errors
    /// [`Error::InvalidPolygon`] where a hole lies outside of its part, nothing is enclosed, or a coordinate is not finite; [`Error::InvalidSpace`] where f64 cannot tell
    /// its width from nothing.
    ///
    /// # Example
    /// ```
    /// let square = |low: f64, high: f64| vec![[low, low], [high, low], [high, high], [low, high]];
    /// let polygon = evenly::Polygon::new(vec![vec![square(0.0, 3.0), square(1.0, 2.0)]])?;
    /// assert_eq!((polygon.area(), polygon.rings().len()), (8.0, 2));
    /// # Ok::<(), evenly::Error>(())
    /// ```
    pub fn new(parts: Vec<Vec<Vec<[f64; 2]>>>) -> Result<Self, Error> {
        let shapes: Vec<Shape> = parts.into_iter().map(|rings| Shape { rings, ..Shape::default() }).collect();
        let mut polygon = Self::of_shapes(&shapes)?;
        check_holes(&shapes)?;
        let is_wrong = |(k, ring): (usize, &Vec<[f64; 2]>)| (signed_area(ring) > 0.0) != (k == 0);
        let n_turned = shapes.iter().flat_map(|shape| shape.rings.iter().enumerate()).filter(|&ring| is_wrong(ring)).count();
        if n_turned > 0 {
            polygon.repairs.push(format!("{} the wrong way: turned", counted(n_turned, "ring runs", "rings run")));
        }
        Ok(polygon)
    }

    /// What an odd number of the rings enclose, whichever way they run.
    ///
    /// # Errors
    /// As [`Self::of_shapes`].
    pub fn from_rings(rings: Vec<Vec<[f64; 2]>>) -> Result<Self, Error> {
        Self::of_shapes(&[Shape { rings, ..Shape::default() }])
    }

    /// What the shapes enclose together.
    ///
    /// # Errors
    /// As [`Self::new`], but for holes.
    pub fn of_shapes(shapes: &[Shape]) -> Result<Self, Error> {
        let mut polygon = Self::of(shapes)?;
        // So a polygon is the same, to the bit, as that of its own rings.
        for _ in 0..MOST_CLEANINGS {
            let again = Self::of(&[Shape { rings: polygon.rings.clone(), ..Shape::default() }])?;
            let is_clean = again.rings == polygon.rings;
            polygon = Self { repairs: polygon.repairs, ..again };
            if is_clean {
                break;
            }
        }
        Ok(polygon)
    }

    fn of(shapes: &[Shape]) -> Result<Self, Error> {
        let given = all_rings(shapes);
        let frame = frame(&given)?;
        let domain = Space::from(frame).domain();
        let mut repairs = Vec::new();
        let nothing = |at: [f64; 2]| Err(Error::InvalidPolygon { problem: "encloses nothing".into(), at });

        // Clean rings, and their corners by number.
        let mut corners = Corners::default();
        let mut left_out = LeftOut::default();
        let figures: Vec<Figure> = shapes.iter().map(|shape| cleaned(shape, &domain, &mut left_out)).collect();
        let mut sides = Vec::new();
        for ring in figures.iter().flat_map(|figure| &figure.rings) {
            let numbers: Vec<u32> = ring.iter().map(|corner| corners.number(corner.at, || corner.input)).collect();
            sides.extend(segments(&numbers));
        }
        repairs.extend(left_out.told());
        let n_given = corners.places.len();

        // What they enclose.
        let Union { rings, n_doubled, shared_area } = union(&figures);
        let rings: Vec<Vec<u32>> =
            rings.iter().map(|ring| ring.iter().map(|&at| corners.number(at, || domain.restore(at))).collect()).collect();
        let boundary: Vec<[u32; 2]> = rings.iter().flat_map(|ring| segments(ring)).collect();
        let planar = planar(Graph { points: &corners.places, boundary: &boundary, lines: &[] })
            .map_err(|Crossing(crossed)| crosses(&corners.inputs, crossed[0]))?;
        if planar.half_edges.n_triangles() == 0 {
            return nothing(given.iter().flat_map(|ring| ring.first()).next().copied().unwrap_or_default());
        }
        let unit = domain.restore_length(1.0);
        let twice_inside: f64 =
            planar.half_edges.triangles().map(|corners| twice_area(&corners.map(|v| planar.positions[v as usize]))).sum();

        // What was wrong with them.
        if n_doubled > 0 {
            repairs.push(format!("{} there twice: left out", counted(n_doubled, "ring is", "rings are")));
        }
        if let Some(&at) = corners.inputs.get(n_given) {
            let n = corners.places.len() - n_given;
            let [x, y] = at.map(|x| in_digits_of(x, unit));
            repairs.push(format!("the boundary crosses itself in {}, the first at ({x}, {y}): cut there", counted(n, "place", "places")));
        }
        if shared_area > LEAST_SHARED * twice_inside {
            repairs.push(format!("shapes overlap by an area of {}: united", rounded(shared_area * unit * unit)));
        }
        let mut seen = HashSet::new();
        let n_shared = sides.iter().filter(|[a, b]| !seen.insert([a.min(b), a.max(b)])).count();
        if n_shared > 0 && n_doubled == 0 && shared_area <= LEAST_SHARED * twice_inside {
            repairs.push(format!("{} by two rings: left out", counted(n_shared, "segment is shared", "segments are shared")));
        }

        // Only what is on the boundary is a corner.
        let loops = loops(&planar);
        let rings = loops.iter().map(|ring| ring.iter().map(|&v| corners.inputs[v as usize]).collect()).collect();
        let boundary: Vec<[u32; 2]> = loops.iter().flat_map(|ring| segments(ring)).collect();
        let mut kept = Corners::default();
        let boundary =
            boundary.into_iter().map(|ends| ends.map(|v| kept.number(corners.places[v as usize], || corners.inputs[v as usize]))).collect();
        Ok(Self { rings, frame, area: 0.5 * twice_inside * unit * unit, repairs, corners: kept.places, given: kept.inputs, boundary })
    }

    /// The rings, in input units, without a closing point: the inside is on their left, so outer ones run counter-clockwise, and holes clockwise.
    pub fn rings(&self) -> &[Vec<[f64; 2]>] {
        &self.rings
    }

    /// The area inside, in input units squared.
    pub fn area(&self) -> f64 {
        self.area
    }

    /// The smallest rectangle around it.
    pub fn frame(&self) -> &Rectangle {
        &self.frame
    }

    /// Whether a place, in input units, lies inside.
    pub fn holds(&self, [x, y]: [f64; 2]) -> bool {
        let sides = self.rings.iter().flat_map(|ring| ring.iter().zip(ring.iter().cycle().skip(1)));
        let crossed = sides.filter(|([ax, ay], [bx, by])| (*ay <= y) != (*by <= y) && ax + (bx - ax) * ((y - ay) / (by - ay)) > x);
        crossed.count() % 2 == 1
    }

    /// What was repaired, in plain words.
    pub fn repairs(&self) -> &[String] {
        &self.repairs
    }

    /// The same with one more thing to say of it.
    pub fn noted(mut self, note: impl Into<String>) -> Self {
        self.repairs.push(note.into());
        self
    }

    /// The frame in normalised coordinates.
    pub(crate) fn domain(&self) -> Domain {
        Space::from(self.frame).domain()
    }

    /// Distinct corners in normalised coordinates.
    pub(crate) fn corners(&self) -> &[DVec2] {
        &self.corners
    }

    /// The corners as they were given.
    pub(crate) fn given(&self) -> &[[f64; 2]] {
        &self.given
    }

    /// The boundary's segments, by their corners; the inside is on their left.
    pub(crate) fn boundary(&self) -> &[[u32; 2]] {
        &self.boundary
    }
}

impl From<&Polygon> for Space {
    /// The inside of the polygon, for points.
    fn from(polygon: &Polygon) -> Self {
        let Polygon { corners, boundary, .. } = polygon;
        // Its boundary is clean, so nothing crosses.
        let inside = planar(Graph { points: corners, boundary, lines: &[] }).unwrap_or_default();
        let part_of = inside.half_edges.components();
        let mut parts = vec![Vec::new(); part_of.iter().max().map_or(0, |&last| last as usize + 1)];
        for (corners, &part) in inside.half_edges.triangles().zip(&part_of) {
            parts[part as usize].push(corners.map(|v| inside.positions[v as usize]));
        }
        // Each segment belongs to the part on its left.
        let half_edges = (0..inside.half_edges.origin.len() as u32).filter(|&h| inside.half_edges.is_boundary(h));
        let ends = |h: u32| [inside.half_edges.origin[h as usize], inside.half_edges.target(h)].map(|v| inside.source[v as usize]);
        let by_ends: HashMap<[u32; 2], u32> = half_edges.map(|h| (ends(h), part_of[h as usize / 3])).collect();
        let part = |ends: &[u32; 2]| by_ends.get(ends).copied().unwrap_or_default();
        let segments = boundary.iter().map(|ends| (ends.map(|v| corners[v as usize]), part(ends))).collect();
        Region::new(polygon.frame, polygon.rings.clone(), polygon.area, parts, segments).into()
    }
}

/// The rings of shapes, and of what clips them.
fn all_rings(shapes: &[Shape]) -> Vec<&Vec<[f64; 2]>> {
    shapes.iter().flat_map(|shape| shape.rings.iter().chain(shape.clips.iter().flat_map(|clip| all_rings(clip)))).collect()
}

/// The shape with clean rings, normalised.
fn cleaned(shape: &Shape, domain: &Domain, left_out: &mut LeftOut) -> Figure {
    let clip = |shapes: &Vec<Shape>| shapes.iter().map(|shape| cleaned(shape, domain, &mut LeftOut::default())).collect();
    Figure { rings: clean(&shape.rings, domain, left_out), rule: shape.rule, clips: shape.clips.iter().map(clip).collect() }
}

/// The rectangle around all points.
fn frame(rings: &[&Vec<[f64; 2]>]) -> Result<Rectangle, Error> {
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for &at in rings.iter().copied().flatten() {
        if !at.iter().all(|x| x.is_finite()) {
            return Err(Error::InvalidPolygon { problem: "has a coordinate that is not finite".into(), at });
        }
        for axis in 0..2 {
            (low[axis], high[axis]) = (low[axis].min(at[axis]), high[axis].max(at[axis]));
        }
    }
    if low[0] > high[0] {
        return Err(Error::InvalidSpace("the polygon has no points".into()));
    }
    Rectangle::new(low, [high[0] - low[0], high[1] - low[1]])
}

/// The segments of a ring.
fn segments(ring: &[u32]) -> impl Iterator<Item = [u32; 2]> {
    (0..ring.len()).map(|k| [ring[k], ring[(k + 1) % ring.len()]])
}

/// The rings of points around a triangulation's boundary, with the inside on their left; each begins with its first point, and they come in the order of these: so what is clean stays as it is.
fn loops(planar: &Planar) -> Vec<Vec<u32>> {
    let Planar { half_edges, source, .. } = planar;
    let mut is_seen = vec![false; half_edges.origin.len()];
    let mut loops = Vec::new();
    for start in (0..half_edges.origin.len() as u32).filter(|&h| half_edges.is_boundary(h)) {
        let mut ring = Vec::new();
        let mut h = start;
        while !std::mem::replace(&mut is_seen[h as usize], true) {
            ring.push(source[half_edges.origin[h as usize] as usize]);
            h = following(half_edges, h);
        }
        let first = (0..ring.len()).min_by_key(|&k| [ring[k], ring[(k + 1) % ring.len()]]);
        if let Some(first) = first {
            ring.rotate_left(first);
            loops.push(ring);
        }
    }
    loops.sort();
    loops
}

/// The half-edge of the boundary that leaves where `h`, on the boundary, arrives.
fn following(half_edges: &HalfEdges, h: u32) -> u32 {
    let mut at = next(h);
    while !half_edges.is_boundary(at) {
        at = next(half_edges.twin[at as usize]);
    }
    at
}

/// That segments cross, where the grid is too coarse to part them.
fn crosses(inputs: &[[f64; 2]], segment: [u32; 2]) -> Error {
    let [a, b] = segment.map(|v| inputs[v as usize]);
    let problem = format!("crosses itself, ({}, {}) to ({}, {}) and another segment", a[0], a[1], b[0], b[1]);
    Error::InvalidPolygon { problem, at: [0, 1].map(|axis| 0.5 * (a[axis] + b[axis])) }
}

/// A number with the right one of two words.
fn counted(n: usize, one: &str, many: &str) -> String {
    format!("{n} {}", if n == 1 { one } else { many })
}

/// A coordinate to nine digits of the domain's size.
fn in_digits_of(x: f64, size: f64) -> f64 {
    let n_digits = (9 - libm::log10(size).floor() as i32).clamp(0, 300) as usize;
    format!("{x:.n_digits$}").parse().unwrap_or(x)
}

/// A number to six digits.
fn rounded(x: f64) -> f64 {
    format!("{x:.5e}").parse().unwrap_or(x)
}

/// Twice the area that a ring encloses, negative if it runs clockwise.
fn twice_area(ring: &[DVec2]) -> f64 {
    let Some(&from) = ring.first() else { return 0.0 };
    ring.iter().zip(ring.iter().cycle().skip(1)).map(|(&a, &b)| (a - from).perp_dot(b - from)).sum()
}

/// The area that a ring in input units encloses, negative if it runs clockwise.
fn signed_area(ring: &[[f64; 2]]) -> f64 {
    let ring: Vec<DVec2> = ring.iter().map(|&p| p.into()).collect();
    0.5 * twice_area(&ring)
}

/// Checks that no hole lies outside of the first ring of its shape.
fn check_holes(shapes: &[Shape]) -> Result<(), Error> {
    for shape in shapes {
        let Some((outer, holes)) = shape.rings.split_first() else { continue };
        if let Some(&at) = holes.iter().filter(|hole| is_apart(hole, outer)).find_map(|hole| hole.first()) {
            return Err(Error::InvalidPolygon { problem: "has a hole that lies outside".into(), at });
        }
    }
    Ok(())
}

/// Whether no corner of a ring lies within another, nor the other's within it.
fn is_apart(one: &[[f64; 2]], other: &[[f64; 2]]) -> bool {
    let is_within = |p: &[f64; 2], ring: &[[f64; 2]]| {
        let sides = ring.iter().zip(ring.iter().cycle().skip(1));
        let crossed = sides.filter(|(a, b)| {
            (a[1] <= p[1]) != (b[1] <= p[1]) && {
                let x = a[0] + (b[0] - a[0]) * ((p[1] - a[1]) / (b[1] - a[1]));
                x >= p[0]
            }
        });
        crossed.count() % 2 == 1 || ring.contains(p)
    };
    !one.iter().any(|p| is_within(p, other)) && !other.iter().any(|p| is_within(p, one))
}
