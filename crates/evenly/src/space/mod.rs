//! Where points live: the periodic [`Torus`], the bounded [`Rectangle`], the [`Region`] in a polygon. Inside, all are one normalised [`Domain`](domain::Domain).

mod boundary;
mod domain;
mod grid;
mod region;
mod segment_tree;

pub(crate) use boundary::Boundary;
pub(crate) use domain::Domain;
pub(crate) use grid::{GRID, snap};
pub use region::Region;
pub(crate) use segment_tree::{SegmentTree, nearest};

use serde::Serialize;

use crate::error::Error;

/// The largest ratio of a domain's sides: beyond it, the short side has too few bits left.
const MAX_ASPECT: f64 = 1e6;
/// The sides that leave room for the arithmetic on them.
const SIDES: std::ops::RangeInclusive<f64> = 1e-270..=1e270;

/// A rectangle whose opposite sides are one: points that leave on the right come in on the left. Its sets tile the plane.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Torus {
    origin: [f64; 2],
    size: [f64; 2],
}

/// A bounded rectangle; its boundary belongs to it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Rectangle {
    origin: [f64; 2],
    size: [f64; 2],
}

impl Torus {
    /// A torus of this width and height, with its lower left corner at `origin`, both in input units.
    ///
    /// # Errors
    /// [`Error::InvalidSpace`] where a side is not positive and finite, or the sides differ by more than a millionfold.
    pub fn new(origin: [f64; 2], size: [f64; 2]) -> Result<Self, Error> {
        validate(origin, size)?;
        Ok(Self { origin, size })
    }
}

impl Rectangle {
    /// A rectangle of this width and height, with its lower left corner at `origin`, both in input units.
    ///
    /// # Errors
    /// [`Error::InvalidSpace`] where a side is not positive and finite, or the sides differ by more than a millionfold.
    pub fn new(origin: [f64; 2], size: [f64; 2]) -> Result<Self, Error> {
        validate(origin, size)?;
        Ok(Self { origin, size })
    }
}

impl Rectangle {
    /// A place's part of the width and of the height.
    fn to_unit(self, p: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|axis| ((p[axis] - self.origin[axis]) / self.size[axis]).clamp(0.0, 1.0))
    }

    /// The place with these parts of the width and of the height.
    fn of_unit(self, p: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|axis| (self.origin[axis] + p[axis] * self.size[axis]).min(self.origin[axis] + self.size[axis]))
    }
}

fn validate(origin: [f64; 2], size: [f64; 2]) -> Result<(), Error> {
    let invalid = |text: String| Err(Error::InvalidSpace(text));
    for side in size {
        if !SIDES.contains(&side) {
            return invalid(format!("the domain's sides are {} x {}; both must be positive and finite", size[0], size[1]));
        }
    }
    if !(origin[0].is_finite() && origin[1].is_finite()) {
        return invalid(format!("the domain's origin is ({}, {}); it must be finite", origin[0], origin[1]));
    }
    let aspect = (size[0] / size[1]).max(size[1] / size[0]);
    if aspect > MAX_ASPECT {
        return invalid(format!("the domain's sides, {} x {}, differ by more than {MAX_ASPECT:e}", size[0], size[1]));
    }
    for axis in 0..2 {
        let resolution = ulp(origin[axis].abs().max((origin[axis] + size[axis]).abs()));
        if size[axis] < 64.0 * resolution {
            return invalid(format!(
                "a side of {} at {} is lost in rounding: numbers there are {resolution:e} apart; move the origin nearer to 0",
                size[axis], origin[axis]
            ));
        }
    }
    Ok(())
}

/// The distance from `x` to the next larger f64.
fn ulp(x: f64) -> f64 {
    x.next_up() - x
}

/// A domain for points.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum Space {
    /// Periodic.
    Torus(Torus),
    /// Bounded.
    Rectangle(Rectangle),
    /// Bounded by straight segments, perhaps with holes and in several parts.
    Polygon(Region),
}

impl From<Torus> for Space {
    fn from(torus: Torus) -> Self {
        Self::Torus(torus)
    }
}

impl From<Rectangle> for Space {
    fn from(rectangle: Rectangle) -> Self {
        Self::Rectangle(rectangle)
    }
}

impl From<Region> for Space {
    fn from(region: Region) -> Self {
        Self::Polygon(region)
    }
}

impl From<&Space> for Space {
    fn from(space: &Space) -> Self {
        space.clone()
    }
}

impl Space {
    /// The lower left corner, in input units.
    pub fn origin(&self) -> [f64; 2] {
        match self {
            Self::Torus(torus) => torus.origin,
            Self::Rectangle(rectangle) => rectangle.origin,
            Self::Polygon(region) => region.frame().origin,
        }
    }

    /// Width and height, in input units.
    pub fn size(&self) -> [f64; 2] {
        match self {
            Self::Torus(torus) => torus.size,
            Self::Rectangle(rectangle) => rectangle.size,
            Self::Polygon(region) => region.frame().size,
        }
    }

    /// Whether opposite sides are one.
    pub fn is_periodic(&self) -> bool {
        matches!(self, Self::Torus(_))
    }

    /// What it is called: torus, rectangle or polygon.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Torus(_) => "torus",
            Self::Rectangle(_) => "rectangle",
            Self::Polygon(_) => "polygon",
        }
    }

    /// The inside of a polygon, where it is that.
    pub fn region(&self) -> Option<&Region> {
        if let Self::Polygon(region) = self { Some(region) } else { None }
    }

    fn frame(&self) -> Rectangle {
        Rectangle { origin: self.origin(), size: self.size() }
    }

    /// The same domain with its frame scaled to the unit square, each axis by itself.
    ///
    /// Where the axes have units of their own, as the factors of an experiment do, a distance means
    /// something only there: points that are spread in it are restored by
    /// [`PointSet::restored_to`](crate::PointSet::restored_to).
    #[must_use]
    pub fn in_unit_square(&self) -> Self {
        let (origin, size) = ([0.0; 2], [1.0; 2]);
        match self {
            Self::Torus(_) => Torus { origin, size }.into(),
            Self::Rectangle(_) => Rectangle { origin, size }.into(),
            Self::Polygon(region) => region.in_unit_square().into(),
        }
    }

    /// A place's part of the frame's width and height.
    pub(crate) fn to_unit(&self, p: [f64; 2]) -> [f64; 2] {
        self.frame().to_unit(p)
    }

    /// The place with these parts of the frame's width and height.
    pub(crate) fn of_unit(&self, p: [f64; 2]) -> [f64; 2] {
        self.frame().of_unit(p)
    }

    /// The domain's area, in input units squared.
    pub fn area(&self) -> f64 {
        self.region().map_or(self.size()[0] * self.size()[1], Region::area)
    }

    /// The spacing of the hexagonal lattice with `n_points` points, `sqrt(2 A / (sqrt(3) n))`, in input units:
    /// the unit of all relative lengths.
    pub fn hex_spacing(&self, n_points: usize) -> f64 {
        // Side by side, so that tiny domains do not underflow.
        let [width, height] = self.size().map(|side| (side / n_points as f64).sqrt());
        width * height * (2.0 * n_points as f64 / 3f64.sqrt()).sqrt() * self.fullness().sqrt()
    }

    /// The length of its boundary, in input units; on a torus that of the lines along which it is cut open.
    pub(crate) fn perimeter(&self) -> f64 {
        let length = |ring: &Vec<[f64; 2]>| -> f64 {
            let ends = ring.iter().zip(ring.iter().cycle().skip(1));
            ends.map(|(a, b)| libm::hypot(b[0] - a[0], b[1] - a[1])).sum()
        };
        match self.region() {
            Some(region) => region.rings().iter().map(length).sum(),
            None => 2.0 * (self.size()[0] + self.size()[1]),
        }
    }

    /// The share of the frame that is inside.
    pub(crate) fn fullness(&self) -> f64 {
        self.region().map_or(1.0, |region| region.area() / region.frame().size[0] / region.frame().size[1])
    }

    /// The same in normalised coordinates.
    pub(crate) fn domain(&self) -> Domain {
        self.region().map_or_else(|| Domain::new(self.origin(), self.size(), self.is_periodic()), Region::domain)
    }

    /// The distance between neighbouring f64 at the domain's far end, in input units.
    pub(crate) fn resolution(&self) -> f64 {
        let (origin, size) = (self.origin(), self.size());
        (0..2).map(|axis| ulp(origin[axis].abs().max((origin[axis] + size[axis]).abs()))).fold(0.0, f64::max)
    }

    /// Checks that f64 can tell `n_points` points apart here.
    pub(crate) fn require_resolution(&self, n_points: usize) -> Result<(), Error> {
        let resolution = self.resolution();
        let spacing = self.hex_spacing(n_points);
        if spacing < 64.0 * resolution {
            return Err(Error::TooFine { n_points, domain: self.to_string(), spacing, resolution });
        }
        Ok(())
    }
}

impl std::fmt::Display for Space {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let (origin, size) = (self.origin(), self.size());
        write!(f, "{} x {} at ({}, {})", size[0], size[1], origin[0], origin[1])
    }
}
