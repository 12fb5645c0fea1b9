//! [`Ground`]: what a sweep needs of the points that it moves, in the plane or on a surface.

use std::ops::{Add, AddAssign, Mul, SubAssign};

use glam::{DVec2, DVec3};

use super::cells::Cells;
use crate::error::Error;
use crate::star::{Senses, Star};
use crate::triangulation::{LiveMesh, Outside, Spoke, StarBuffer, Territory};

/// A vector, of the plane or of space.
pub(crate) trait Way:
    Copy + Default + PartialEq + Send + Sync + Add<Output = Self> + AddAssign + SubAssign + Mul<f64, Output = Self>
{
    fn length(self) -> f64;
    fn clamp_length_max(self, most: f64) -> Self;
}

impl Way for DVec2 {
    fn length(self) -> f64 {
        self.length()
    }

    fn clamp_length_max(self, most: f64) -> Self {
        self.clamp_length_max(most)
    }
}

impl Way for DVec3 {
    fn length(self) -> f64 {
        self.length()
    }

    fn clamp_length_max(self, most: f64) -> Self {
        self.clamp_length_max(most)
    }
}

/// The star that has been read last, and what a rule makes of it.
pub(crate) struct Reading<'a, W> {
    pub star: &'a mut Star,
    pub spokes: &'a [Spoke<W>],
    /// Which points are to move, and by what.
    pub moves: &'a mut Vec<(u32, W)>,
}

/// What one thread reads stars into.
pub(crate) trait Buffer<W>: Default + Send {
    /// One that finds so much of the density's measure.
    fn sensing(senses: Senses) -> Self;
    fn reading(&mut self) -> Reading<'_, W>;
    /// Edges flipped so far.
    fn n_flips(&self) -> usize;
}

/// Points on a triangulation that is Delaunay where it is looked at. Several threads may move points, each in its own territory.
pub(crate) trait Ground: Sync + Sized {
    type Way: Way;
    type Buffer: Buffer<Self::Way>;
    /// All that is needed to come back to where points have been.
    type State: Clone + Sync;
    /// The vertices that a thread may touch.
    type Territory: Copy + Sync;
    /// All of them.
    const EVERYTHING: Self::Territory;

    fn n_points(&self) -> usize;
    /// The wanted spacing, where it varies its mean.
    fn spacing(&self) -> f64;
    /// The spacing that is wanted where a point is.
    fn local_spacing(&self, point: u32) -> f64;
    fn has_density(&self) -> bool;
    /// Whether there are points that cannot go everywhere.
    fn holds_points(&self) -> bool;
    /// Whether a point may see others than its neighbours in the mesh.
    fn sees_beyond(&self) -> bool;
    /// The point of which a vertex is a copy.
    fn point(&self, v: u32) -> u32;

    /// Whether something has changed around a point since it was last cleaned.
    fn is_dirty(&self, point: u32) -> bool;
    fn clean(&self, point: u32);
    fn soil_all(&self);
    /// Counts a visit at which something was wrong with a point.
    fn count_unrest(&self, _point: u32) {}

    /// Whether it may be [plain](Self::is_plain) at all.
    const MAY_BE_PLAIN: bool = false;
    /// Whether points move freely among their like: nothing varies, holds them, or stands in their way. Code for `PLAIN` then does without all of that.
    fn is_plain(&self) -> bool {
        false
    }

    /// Makes the spokes of `v` Delaunay, and reads its star.
    fn read<const PLAIN: bool>(&self, v: u32, territory: Self::Territory, buffer: &mut Self::Buffer) -> Result<(), Outside>;
    /// Lays out the star of `v`, which has just been read, and the stars of its neighbours.
    fn look_around(&self, v: u32, territory: Self::Territory, buffer: &mut Self::Buffer) -> Result<(), Outside>;
    /// A vector of the plane in which `look_around` has laid out the star of `v`.
    fn unfolded(&self, v: u32, by: DVec2) -> Self::Way;
    /// The part of a move that a point can make.
    fn along(&self, point: u32, by: Self::Way) -> Self::Way;
    /// Moves a point, and soils what stands around; or as far as it gets.
    fn relocate<const PLAIN: bool>(
        &self,
        point: u32,
        by: Self::Way,
        territory: Self::Territory,
        buffer: &mut Self::Buffer,
    ) -> Result<(), Outside>;

    /// Makes all of the mesh Delaunay. Returns how many flips it took.
    fn legalize(&mut self) -> usize;
    /// Retriangulates where the mesh is torn. Whether it had to.
    fn mend(&mut self) -> Result<bool, Error>;
    /// Proves what the mesh claims to be, but for the Delaunay property.
    fn check(&self) -> Result<(), String>;
    /// Whether points may stay in the cells where they are, after a pass that put so many visits off.
    fn keeps_cells(&self, _n_deferred: usize) -> bool {
        false
    }
    /// The points as threads share them.
    fn cells(&mut self) -> Cells<Self::Territory>;
    /// Sorts points by rows so many spacings high, and along them.
    fn sort_by_rows(&self, points: &mut [u32], height: f64);

    /// Where the caller's points are, in input units; none where vertices are no such points.
    fn shown(&self) -> Vec<[f64; 2]> {
        Vec::new()
    }
    fn state(&self) -> Self::State;
    fn restore(&mut self, state: Self::State) -> Result<(), Error>;
}

impl Buffer<DVec2> for StarBuffer {
    fn sensing(senses: Senses) -> Self {
        Self::sensing(senses)
    }

    fn reading(&mut self) -> Reading<'_, DVec2> {
        let Self { star, spokes, moves, .. } = self;
        Reading { star, spokes, moves }
    }

    fn n_flips(&self) -> usize {
        self.n_flips
    }
}

impl Ground for LiveMesh {
    type Way = DVec2;
    type Buffer = StarBuffer;
    type State = Vec<DVec2>;
    type Territory = Territory;

    const EVERYTHING: Territory = Territory::EVERYTHING;

    fn n_points(&self) -> usize {
        self.n_points()
    }

    fn spacing(&self) -> f64 {
        self.spacing()
    }

    fn local_spacing(&self, point: u32) -> f64 {
        self.local_spacing(point)
    }

    fn has_density(&self) -> bool {
        self.has_density()
    }

    fn holds_points(&self) -> bool {
        self.holds_points()
    }

    fn sees_beyond(&self) -> bool {
        self.domain().boundary.is_some()
    }

    fn point(&self, v: u32) -> u32 {
        self.point(v)
    }

    fn is_dirty(&self, point: u32) -> bool {
        self.is_dirty(point)
    }

    fn clean(&self, point: u32) {
        self.clean(point);
    }

    fn soil_all(&self) {
        self.soil_all();
    }

    fn count_unrest(&self, point: u32) {
        self.patience.count(point);
    }

    const MAY_BE_PLAIN: bool = true;

    fn is_plain(&self) -> bool {
        self.is_plain()
    }

    fn read<const PLAIN: bool>(&self, v: u32, territory: Territory, buffer: &mut StarBuffer) -> Result<(), Outside> {
        self.read_in::<PLAIN>(v, territory, buffer)
    }

    fn look_around(&self, v: u32, territory: Territory, buffer: &mut StarBuffer) -> Result<(), Outside> {
        self.look_around(v, territory, buffer)
    }

    fn unfolded(&self, _: u32, by: DVec2) -> DVec2 {
        by
    }

    fn along(&self, point: u32, by: DVec2) -> DVec2 {
        self.along(point, by)
    }

    fn relocate<const PLAIN: bool>(&self, point: u32, by: DVec2, territory: Territory, buffer: &mut StarBuffer) -> Result<(), Outside> {
        self.relocated::<PLAIN>(point, by, territory, buffer)
    }

    fn legalize(&mut self) -> usize {
        self.legalize()
    }

    fn mend(&mut self) -> Result<bool, Error> {
        self.mend()
    }

    fn check(&self) -> Result<(), String> {
        self.check()
    }

    fn cells(&mut self) -> Cells<Territory> {
        Cells::of_plane(self)
    }

    fn sort_by_rows(&self, points: &mut [u32], height: f64) {
        self.sort_by_rows(points, height);
    }

    fn shown(&self) -> Vec<[f64; 2]> {
        self.shown()
    }

    fn state(&self) -> Vec<DVec2> {
        self.points()
    }

    fn restore(&mut self, places: Vec<DVec2>) -> Result<(), Error> {
        self.rebuild(places)
    }
}
