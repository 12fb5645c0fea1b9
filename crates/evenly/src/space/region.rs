//! [`Region`]: the inside of a polygon, as a domain for points.

use std::sync::Arc;

use glam::DVec2;
use serde::Serialize;
use serde::ser::SerializeStruct as _;

use super::boundary::Boundary;
use super::{Domain, Rectangle, snap, ulp};

/// What the rings of a [`Polygon`](crate::Polygon) enclose, its boundary included; `Space::from(&polygon)` makes one. Cheap to clone.
#[derive(Debug, Clone)]
pub struct Region(Arc<Inner>);

#[derive(Debug)]
struct Inner {
    frame: Rectangle,
    rings: Vec<Vec<[f64; 2]>>,
    area: f64,
    /// In normalised coordinates: triangles that fill it, part by part, and what is around them.
    triangles: Vec<[DVec2; 3]>,
    n_triangles: Vec<usize>,
    boundary: Arc<Boundary>,
}

impl Region {
    /// The inside of rings in input units, given in normalised coordinates as well: by triangles that fill each part, and by segments with the inside on their left, each with its part.
    pub(crate) fn new(
        frame: Rectangle,
        rings: Vec<Vec<[f64; 2]>>,
        area: f64,
        parts: Vec<Vec<[DVec2; 3]>>,
        segments: Vec<([DVec2; 2], u32)>,
    ) -> Self {
        let domain = Domain::new(frame.origin, frame.size, false);
        let rounding = (0..2).map(|axis| ulp(frame.origin[axis].abs().max((frame.origin[axis] + frame.size[axis]).abs())));
        let unit = domain.restore_length(1.0);
        let (segments, part_of) = segments.into_iter().unzip();
        let filled = |triangles: &Vec<[DVec2; 3]>| triangles.iter().map(|[a, b, c]| 0.5 * (b - a).perp_dot(c - a)).sum::<f64>();
        let areas = parts.iter().map(filled).collect();
        let boundary = Boundary::new(segments, part_of, areas, domain.size, 2.0 * rounding.fold(0.0, f64::max) / unit);
        let n_triangles = parts.iter().map(Vec::len).collect();
        let triangles = parts.into_iter().flatten().collect();
        Self(Arc::new(Inner { frame, rings, area, triangles, n_triangles, boundary: Arc::new(boundary) }))
    }

    /// The rings, in input units, without a closing point: the inside is on their left.
    pub fn rings(&self) -> &[Vec<[f64; 2]>] {
        &self.0.rings
    }

    /// The area inside, in input units squared.
    pub fn area(&self) -> f64 {
        self.0.area
    }

    /// The smallest rectangle around it.
    pub fn frame(&self) -> &Rectangle {
        &self.0.frame
    }

    /// Triangles that fill it, in normalised coordinates.
    pub(crate) fn triangles(&self) -> &[[DVec2; 3]] {
        &self.0.triangles
    }

    /// The same, for each of its parts that nowhere hang together.
    pub(crate) fn parts(&self) -> impl Iterator<Item = &[[DVec2; 3]]> {
        let mut left = &self.0.triangles[..];
        self.0.n_triangles.iter().map(move |&n| left.split_off(..n).unwrap_or_default())
    }

    /// The same with the frame scaled to the unit square, each axis by itself.
    pub(super) fn in_unit_square(&self) -> Self {
        let Inner { frame, rings, area, boundary, .. } = &*self.0;
        let Rectangle { origin, size } = *frame;
        let square = Rectangle { origin: [0.0; 2], size: [1.0; 2] };
        let scale = 1.0 / Domain::new(origin, size, false).size;
        let rings = rings.iter().map(|ring| ring.iter().map(|&p| frame.to_unit(p)).collect()).collect();
        let parts = self.parts().map(|triangles| triangles.iter().map(|corners| corners.map(|p| snap(p * scale))).collect());
        let segments = boundary.segments().iter().enumerate();
        let segments = segments.map(|(number, ends)| (ends.map(|p| snap(p * scale)), boundary.part_at(number) as u32));
        Self::new(square, rings, area / (size[0] * size[1]), parts.collect(), segments.collect())
    }

    pub(super) fn domain(&self) -> Domain {
        let Rectangle { origin, size } = self.0.frame;
        Domain::new(origin, size, false).within(Arc::clone(&self.0.boundary))
    }
}

impl PartialEq for Region {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0) || self.0.rings == other.0.rings
    }
}

/// The rings stay where they came from.
impl Serialize for Region {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut region = serializer.serialize_struct("Region", 5)?;
        region.serialize_field("origin", &self.0.frame.origin)?;
        region.serialize_field("size", &self.0.frame.size)?;
        region.serialize_field("area", &self.0.area)?;
        region.serialize_field("n_rings", &self.0.rings.len())?;
        region.serialize_field("n_corners", &self.0.rings.iter().map(Vec::len).sum::<usize>())?;
        region.end()
    }
}
