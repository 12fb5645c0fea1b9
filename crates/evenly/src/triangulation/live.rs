//! [`LiveMesh`]: a Delaunay triangulation whose vertices move, and which is Delaunay where it is looked at.

use std::sync::atomic::{AtomicBool, Ordering::Relaxed};

use glam::DVec2;
use rayon::prelude::*;

use super::delaunay::delaunay;
use super::frame::{FRAME, framed};
use super::half_edges::{BOUNDARY, next};
use super::held::{Bonds, Held};
use super::mesh::Triangulation;
use super::patience::Patience;
use super::planar::{Crossing, Graph, planar};
use super::shared::{SharedMesh, Territory};
use crate::density::Field;
use crate::error::Error;
use crate::predicates::is_in_circle;
use crate::space::{Boundary, Domain};

/// A triangulation of points that [`relocate`](Self::relocate) moves and [`read`](Self::read) shows, from several threads.
///
/// A point is dirty if something has changed around it since it was last cleaned; all are at first.
pub(crate) struct LiveMesh {
    pub(super) mesh: SharedMesh<2>,
    /// The domain that was asked for, and the cover of it that the mesh fills.
    base: Domain,
    pub(super) domain: Domain,
    copies: [u32; 2],
    /// The caller's index of each point.
    order: Vec<u32>,
    /// Vertices that move; those after them are the frame's.
    pub(super) n_live: u32,
    /// The wanted spacing, where the density varies its mean.
    pub(super) spacing: f64,
    /// The density, where it varies.
    pub(super) field: Option<Field>,
    /// Which points stay where they are; empty if none does.
    fixed: Vec<bool>,
    /// For each point the mean capacity over that of its part, where the domain has several; else empty.
    pub(super) shares: Vec<f64>,
    /// How patiently points that something keeps from rest are visited.
    pub patience: Patience,
    /// What holds the points of a mesh with a boundary.
    pub(super) held: Option<Held>,
    /// Whether a point and its copies have gone different ways, or the cover has become too small.
    pub(super) is_torn: AtomicBool,
}

/// Densities below this part of the mean count as this much where a spacing comes of them.
pub(super) const LEAST_DENSITY: f64 = 1e-6;

/// A vertex outside the territory was needed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Outside;

/// For each point the mean capacity over that of the part of a polygon in which it lies: no point goes from one part to another, so each part has a mean of its own. Empty where there is one part.
pub(crate) fn part_shares(boundary: &Boundary, points: &[DVec2], field: Option<&Field>) -> Vec<f64> {
    if boundary.n_parts() < 2 {
        return Vec::new();
    }
    let parts: Vec<usize> = points.par_iter().map(|&p| boundary.part_of(p)).collect();
    let masses = field.map_or_else(|| boundary.part_areas().to_vec(), |field| field.part_masses(boundary));
    let mut n_points = vec![0.0; masses.len()];
    parts.iter().for_each(|&part| n_points[part] += 1.0);
    let mean = masses.iter().sum::<f64>() / points.len() as f64;
    parts.into_iter().map(|part| mean * n_points[part] / masses[part].max(f64::MIN_POSITIVE)).collect()
}

impl LiveMesh {
    /// The Delaunay triangulation of distinct points, given in Hilbert order. Stars will show lengths in units of `spacing`.
    pub fn new(base: &Domain, field: Option<Field>, points: Vec<DVec2>, order: Vec<u32>, spacing: f64) -> Result<Self, Error> {
        let triangulation = if base.is_periodic { delaunay(base, points, order)? } else { framed(base, points, order)? };
        Ok(Self::of(base, field, triangulation, spacing))
    }

    /// Points that are triangulated already: of a bounded domain, with the frame.
    pub fn of(base: &Domain, field: Option<Field>, triangulation: Triangulation, spacing: f64) -> Self {
        let n_frame = if base.is_periodic { 0 } else { FRAME.len() };
        let Triangulation { half_edges, positions, domain, copies, order } = triangulation;
        let is_patient = domain.boundary.is_some() || field.as_ref().is_some_and(Field::has_gaps);
        let share_at_boundary = domain.boundary.as_ref().map_or(0.0, |boundary| 0.5 * boundary.length() * spacing / boundary.area);
        let patience = if is_patient { Patience::of(order.len(), share_at_boundary) } else { Patience::default() };
        let shares =
            domain.boundary.as_ref().map_or_else(Vec::new, |boundary| part_shares(boundary, &positions[..order.len()], field.as_ref()));
        Self {
            mesh: SharedMesh::new(&half_edges, positions.iter().map(|p| p.to_array())),
            base: base.clone(),
            domain,
            copies,
            order,
            n_live: (positions.len() - n_frame) as u32,
            spacing,
            field,
            fixed: Vec::new(),
            shares,
            patience,
            held: None,
            is_torn: AtomicBool::new(false),
        }
    }

    /// The constrained Delaunay triangulation of points of a domain with a boundary. Its points are the triangulation's vertices: parts of the inside that touch in a
    /// point have one each there.
    ///
    /// # Errors
    /// [`Crossing`] where two segments between the points cross.
    pub fn bounded(base: &Domain, points: &[DVec2], bonds: Bonds, spacing: f64) -> Result<Self, Crossing> {
        let [boundary, lines] = bonds.segments();
        let planar = planar(Graph { points, boundary: &boundary, lines: &lines })?;
        let mesh = SharedMesh::new(&planar.half_edges, planar.positions.iter().map(|p| p.to_array()));
        Ok(Self {
            mesh,
            base: base.clone(),
            domain: base.clone(),
            copies: [1, 1],
            n_live: planar.positions.len() as u32,
            spacing,
            field: None,
            fixed: Vec::new(),
            shares: Vec::new(),
            patience: Patience::default(),
            held: Some(Held::new(bonds, &planar)),
            is_torn: AtomicBool::new(false),
            order: planar.source,
        })
    }

    /// The same, of which the caller's first `n_fixed` points stay where they are.
    pub fn with_fixed(mut self, n_fixed: usize) -> Self {
        if n_fixed > 0 {
            self.fixed = self.order.iter().map(|&index| (index as usize) < n_fixed).collect();
            if !self.patience.has_any() {
                self.patience = Patience::of(self.order.len(), 0.0);
            }
        }
        self
    }

    /// The same, of which stars show lengths in units of another spacing.
    pub fn in_units_of(self, spacing: f64) -> Self {
        Self { spacing, ..self }
    }

    pub fn boundary(&self) -> Option<&Boundary> {
        self.domain.boundary.as_deref()
    }

    pub fn has_fixed(&self) -> bool {
        !self.fixed.is_empty()
    }

    /// Whether a point stays where it is.
    #[inline]
    pub fn is_fixed(&self, point: u32) -> bool {
        self.fixed.get(point as usize).is_some_and(|&is| is)
    }

    /// The same points, put at `places` and retriangulated. Where that cannot be, all stays as it was.
    pub fn rebuild(&mut self, places: Vec<DVec2>) -> Result<(), Error> {
        *self = match &self.held {
            None => {
                let rebuilt = Self::new(&self.base, self.field.clone(), places, self.order.clone(), self.spacing)?;
                Self { fixed: std::mem::take(&mut self.fixed), patience: std::mem::take(&mut self.patience), ..rebuilt }
            }
            Some(held) => {
                let bonds = held.bonds();
                let mut points = vec![DVec2::ZERO; bonds.tracks.len()];
                held.source.iter().zip(places).for_each(|(&point, place)| points[point as usize] = place);
                let rebuilt = Self::bounded(&self.base, &points, bonds, self.spacing);
                rebuilt.map_err(|Crossing(_)| Error::Degenerate("the boundary has come to cross itself".into()))?
            }
        };
        Ok(())
    }

    /// Retriangulates where the mesh is torn; of a point and its copies, the point's own way counts. Whether it had to.
    pub fn mend(&mut self) -> Result<bool, Error> {
        let is_torn = *self.is_torn.get_mut();
        if is_torn {
            self.rebuild(self.points())?;
        }
        Ok(is_torn)
    }

    /// How many points there are: vertices that are neither copies nor the frame's.
    pub fn n_points(&self) -> usize {
        self.order.len()
    }

    pub fn domain(&self) -> &Domain {
        &self.domain
    }

    pub fn spacing(&self) -> f64 {
        self.spacing
    }

    /// The spacing of most points.
    pub fn typical_spacing(&self) -> f64 {
        self.held.as_ref().map_or(self.spacing, |held| held.typical_size)
    }

    /// Whether the wanted spacing varies.
    pub fn has_density(&self) -> bool {
        self.field.is_some() || self.held.is_some()
    }

    /// The bonds as they are now, where there are some, and the point that each vertex stands for.
    pub fn bonds(&self) -> Option<(Bonds, &[u32])> {
        self.held.as_ref().map(|held| (held.bonds(), &held.source[..]))
    }

    /// Whether there are points that cannot go everywhere.
    pub fn holds_points(&self) -> bool {
        self.held.is_some() || !self.fixed.is_empty()
    }

    /// The part of a move that a point can make.
    pub fn along(&self, point: u32, by: DVec2) -> DVec2 {
        if self.is_fixed(point) {
            return DVec2::ZERO;
        }
        self.held.as_ref().map_or(by, |held| held.along(point, by))
    }

    /// The spacing that is wanted where a point is.
    pub fn local_spacing(&self, point: u32) -> f64 {
        if let Some(held) = &self.held {
            return held.size(point);
        }
        self.field.as_ref().map_or(self.spacing, |field| self.spacing / field.at(self.position(point)).max(LEAST_DENSITY).sqrt())
    }

    pub fn position(&self, v: u32) -> DVec2 {
        self.mesh.position(v)
    }

    /// Sorts points by rows so many spacings high, and along them.
    pub fn sort_by_rows(&self, points: &mut [u32], height: f64) {
        let row = |v: u32| (self.position(v).y / (height * self.spacing)).floor();
        points.sort_by(|&a, &b| row(a).total_cmp(&row(b)).then(self.position(a).x.total_cmp(&self.position(b).x)).then(a.cmp(&b)));
    }

    pub fn is_dirty(&self, v: u32) -> bool {
        self.mesh.is_dirty(v)
    }

    /// Says that `v` must be looked at again; the point, where it is a copy.
    #[inline]
    pub fn soil(&self, v: u32) {
        if v < self.n_live {
            self.mesh.set_dirty(self.point(v), true);
        }
    }

    #[inline]
    pub(super) fn soil_in<const PLAIN: bool>(&self, v: u32) {
        if PLAIN { self.mesh.set_dirty(v, true) } else { self.soil(v) }
    }

    /// Whether points move freely among their like on a torus: nothing varies, holds them, or stands in their way.
    pub fn is_plain(&self) -> bool {
        let is_free = self.held.is_none() && self.fixed.is_empty() && self.shares.is_empty() && !self.patience.has_any();
        is_free && self.field.is_none() && self.domain.is_periodic && self.domain.boundary.is_none() && !self.is_cover()
    }

    /// Says that all points must be looked at again.
    pub fn soil_all(&self) {
        (0..self.n_points() as u32).for_each(|v| self.soil(v));
    }

    pub fn clean(&self, v: u32) {
        self.mesh.set_dirty(v, false);
    }

    /// Puts a vertex into a block, by which territories tell it.
    pub fn set_block(&mut self, v: u32, block: u32) {
        self.mesh.set_block(v, block);
    }

    /// Whether points have copies.
    #[inline]
    pub fn is_cover(&self) -> bool {
        self.copies != [1, 1]
    }

    /// The point of which `v` is a copy.
    #[inline]
    pub fn point(&self, v: u32) -> u32 {
        if self.is_cover() { v % self.order.len() as u32 } else { v }
    }

    #[inline]
    pub(super) fn spoke(&self, from: DVec2, to: u32) -> DVec2 {
        self.domain.spoke(from, self.mesh.position(to))
    }

    /// Whether `v` may be touched; the frame never changes.
    #[inline]
    pub fn is_free(&self, v: u32, territory: Territory) -> bool {
        v >= self.n_live || self.mesh.is_within(v, territory)
    }

    /// Whether the edge of `h` must be flipped. Exact; never on a boundary. Where the other diagonal is too long for the cover, the mesh is
    /// torn instead.
    pub(super) fn is_illegal(&self, h: u32) -> bool {
        if self.mesh.twin(h) == BOUNDARY {
            return false;
        }
        let [p, q, r, s] = self.mesh.quadrilateral(h);
        let from = self.mesh.position(p);
        let [q, r, s] = [self.spoke(from, q), self.spoke(from, r), self.spoke(from, s)];
        if !is_in_circle(q, r, s)
            || self.held.as_ref().is_some_and(|held| held.is_line(self.mesh.origin(h), self.mesh.origin(self.mesh.twin(h))))
        {
            return false;
        }
        let is_spoke = self.domain.is_spoke(s - r);
        if !is_spoke {
            self.is_torn.store(true, Relaxed);
        }
        is_spoke
    }

    pub(super) fn flip(&self, h: u32) {
        for v in self.mesh.quadrilateral(h) {
            self.soil(v);
        }
        self.mesh.flip(h);
    }

    /// Lawson's flips: makes all of the mesh Delaunay. Returns how many it took.
    pub fn legalize(&mut self) -> usize {
        let all = 0..self.mesh.n_half_edges() as u32;
        let mut suspects: Vec<u32> = all.into_par_iter().filter(|&h| self.mesh.twin(h) > h && self.is_illegal(h)).collect();
        let mut n_flips = 0;
        while let Some(h) = suspects.pop() {
            if self.is_illegal(h) {
                let t = self.mesh.twin(h);
                self.flip(h);
                suspects.extend([h, t, next(h), next(t)]);
                n_flips += 1;
            }
        }
        debug_assert!(*self.is_torn.get_mut() || self.held.is_some() || self.triangulation().check_delaunay() == Ok(()));
        n_flips
    }

    /// A copy as a plain triangulation, the frame included.
    pub fn triangulation(&self) -> Triangulation {
        Triangulation {
            half_edges: self.mesh.half_edges(),
            positions: (0..self.mesh.n_vertices() as u32).map(|v| self.mesh.position(v)).collect(),
            domain: self.domain.clone(),
            copies: self.copies,
            order: self.order.clone(),
        }
    }

    /// Proves what the mesh claims to be, but for the Delaunay property.
    pub fn check(&self) -> Result<(), String> {
        let triangulation = self.triangulation();
        if self.held.is_some() { triangulation.check_bounded() } else { triangulation.check() }
    }

    /// The positions of the points.
    pub fn points(&self) -> Vec<DVec2> {
        let home = |p: DVec2| if self.is_cover() { self.base.land(p - (p / self.base.size).floor() * self.base.size) } else { p };
        (0..self.order.len() as u32).into_par_iter().map(|v| home(self.mesh.position(v))).collect()
    }

    /// Where the points are, in input units and the caller's order; none of a mesh whose vertices are its own.
    pub fn shown(&self) -> Vec<[f64; 2]> {
        if self.held.is_some() { Vec::new() } else { self.base.restored(&self.order, &self.points()) }
    }

    /// The caller's index of each point.
    pub fn into_order(self) -> Vec<u32> {
        self.order
    }
}
