//! What the sweep needs of a mesh on a surface.

use glam::{DVec2, DVec3};

use super::cells::Territory;
use super::live::{LiveSurface, NUMBERS};
use crate::error::Error;
use crate::star::{Senses, Star};
use crate::sweep::{Buffer, Cells, Ground, Reading};
use crate::triangulation::{HalfEdges, Outside, SharedMesh, Spoke};

/// Cells are made again where visits to one point in so many were put off.
const DEFERRED: usize = 100;

/// All that is needed to come back.
#[derive(Clone)]
pub(super) struct State {
    half_edges: HalfEdges,
    places: Vec<[f64; NUMBERS]>,
}

/// What a star is read into.
#[derive(Default)]
pub(super) struct SurfaceBuffer {
    pub star: Star,
    senses: Senses,
    spokes: Vec<Spoke<DVec3>>,
    moves: Vec<(u32, DVec3)>,
    pub(super) n_flips: usize,
    /// The spokes of a vertex that moves.
    pub(super) moving: Vec<Spoke<DVec3>>,
}

impl Buffer<DVec3> for SurfaceBuffer {
    fn sensing(senses: Senses) -> Self {
        Self { senses, ..Self::default() }
    }

    fn reading(&mut self) -> Reading<'_, DVec3> {
        let Self { star, spokes, moves, .. } = self;
        Reading { star, spokes, moves }
    }

    fn n_flips(&self) -> usize {
        self.n_flips
    }
}

impl Ground for LiveSurface<'_> {
    type Way = DVec3;
    type Buffer = SurfaceBuffer;
    type State = State;
    type Territory = Territory;

    const EVERYTHING: Territory = Territory::EVERYTHING;

    fn n_points(&self) -> usize {
        self.mesh.n_vertices()
    }

    fn spacing(&self) -> f64 {
        self.spacing
    }

    fn local_spacing(&self, point: u32) -> f64 {
        self.spacing * self.size(point)
    }

    fn has_density(&self) -> bool {
        !self.is_uniform
    }

    fn holds_points(&self) -> bool {
        self.n_fixed > 0
    }

    fn sees_beyond(&self) -> bool {
        false
    }

    fn point(&self, v: u32) -> u32 {
        v
    }

    fn is_dirty(&self, point: u32) -> bool {
        self.mesh.is_dirty(point)
    }

    fn clean(&self, point: u32) {
        self.mesh.set_dirty(point, false);
    }

    fn soil_all(&self) {
        (0..self.n_points() as u32).for_each(|v| self.soil(v));
    }

    fn read<const PLAIN: bool>(&self, v: u32, territory: Territory, buffer: &mut SurfaceBuffer) -> Result<(), Outside> {
        let SurfaceBuffer { star, senses, spokes, n_flips, .. } = buffer;
        self.restore(v, territory, spokes, n_flips)?;
        self.fill(v, senses, star, spokes);
        Ok(())
    }

    fn look_around(&self, v: u32, territory: Territory, buffer: &mut SurfaceBuffer) -> Result<(), Outside> {
        self.lay_out(v, territory, buffer)
    }

    fn unfolded(&self, v: u32, by: DVec2) -> DVec3 {
        let [x, y] = self.tangents(v);
        by.x * x + by.y * y
    }

    fn along(&self, point: u32, by: DVec3) -> DVec3 {
        if self.is_fixed(point) { DVec3::ZERO } else { by }
    }

    fn relocate<const PLAIN: bool>(&self, point: u32, by: DVec3, territory: Territory, buffer: &mut SurfaceBuffer) -> Result<(), Outside> {
        self.go(point, by, territory, buffer)
    }

    fn legalize(&mut self) -> usize {
        self.legalize()
    }

    fn mend(&mut self) -> Result<bool, Error> {
        Ok(false)
    }

    fn check(&self) -> Result<(), String> {
        self.half_edges().check_manifold(self.n_points())
    }

    fn keeps_cells(&self, n_deferred: usize) -> bool {
        n_deferred * DEFERRED < self.n_points()
    }

    fn cells(&mut self) -> Cells<Territory> {
        self.divide()
    }

    fn sort_by_rows(&self, points: &mut [u32], height: f64) {
        let at = |v: u32| self.at(v);
        let row = |v: u32| (at(v).y / (height * self.spacing)).floor();
        points.sort_by(|&a, &b| row(a).total_cmp(&row(b)).then(at(a).x.total_cmp(&at(b).x)).then(a.cmp(&b)));
    }

    fn state(&self) -> State {
        State { half_edges: self.half_edges(), places: (0..self.n_points() as u32).map(|v| self.mesh.place(v)).collect() }
    }

    fn restore(&mut self, state: State) -> Result<(), Error> {
        self.mesh = SharedMesh::new(&state.half_edges, state.places.into_iter());
        Ok(())
    }
}
