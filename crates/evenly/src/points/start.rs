//! [`Starting`]: methods that make points from nothing, for an optimiser to begin with or as they are.

use super::point_set::PointSet;
use crate::density::Density;
use crate::error::Error;
use crate::parameter::{AnyEntry, Entry, Settings};
use crate::space::Space;

/// Points, and what the user should know of them.
pub(crate) type Told = (PointSet, Option<String>);

/// A method that makes points, as its parameters say.
pub(crate) trait Starting: Clone + 'static {
    const ENTRY: &'static Entry<Self>;
    /// Whether its points have long density waves, which warping takes out.
    const HAS_LONG_WAVES: bool = false;
    /// Whether it takes polygons.
    const TAKES_POLYGONS: bool = true;
    /// Whether it holds many candidates for each point.
    const HOLDS_CANDIDATES: bool = false;
    /// Whether its points do not depend on points that are there already.
    const IS_INDEPENDENT: bool = false;

    /// Exactly so many points, for an optimiser to begin with.
    fn exactly(space: &Space, density: &Density, n_points: usize, seed: u64) -> Result<PointSet, Error>;

    /// Points as its parameters ask for them, among them those that stay, which come first; `None` where exactly so many are wanted.
    fn make(&self, _fixed: &PointSet, _n_points: Option<usize>, _seed: u64) -> Result<Option<Told>, Error> {
        Ok(None)
    }
}

/// The entry of a method that makes points, whatever its parameters are.
pub(crate) trait AnyStart: AnyEntry {
    fn has_long_waves(&self) -> bool;
    fn takes_polygons(&self) -> bool;
    fn holds_candidates(&self) -> bool;
    fn is_independent(&self) -> bool;
    fn exactly(&self, space: &Space, density: &Density, n_points: usize, seed: u64) -> Result<PointSet, Error>;
    fn check(&self, settings: &Settings) -> Result<(), Error>;
    fn make(&self, settings: &Settings, fixed: &PointSet, n_points: Option<usize>, seed: u64) -> Result<Option<Told>, Error>;
}

impl<P: Starting> AnyStart for Entry<P> {
    fn has_long_waves(&self) -> bool {
        P::HAS_LONG_WAVES
    }

    fn takes_polygons(&self) -> bool {
        P::TAKES_POLYGONS
    }

    fn holds_candidates(&self) -> bool {
        P::HOLDS_CANDIDATES
    }

    fn is_independent(&self) -> bool {
        P::IS_INDEPENDENT
    }

    fn exactly(&self, space: &Space, density: &Density, n_points: usize, seed: u64) -> Result<PointSet, Error> {
        P::exactly(space, density, n_points, seed)
    }

    fn check(&self, settings: &Settings) -> Result<(), Error> {
        self.params(settings, 0).map(drop)
    }

    fn make(&self, settings: &Settings, fixed: &PointSet, n_points: Option<usize>, seed: u64) -> Result<Option<Told>, Error> {
        self.params(settings, seed)?.make(fixed, n_points, seed)
    }
}
