//! [`Optimizer`]: a method that improves points, with its parameters, whichever it is.

use super::local::{Local, LocalMethod};
use super::registry::Method;
use super::targets::Targets;
use crate::error::Error;
use crate::parameter::{AnyEntry, Entry, Setting, Settings};
use crate::points::PointSet;
use crate::run::{Report, RunContext};

// What parameters do that several methods have.
pub(super) const ITERATIONS: &str = "Stop after so many iterations or passes";
pub(super) const PASSES: &str = "2000, more for more than 1000 points";
pub(super) const MIN_DISTANCE: &str = "No two points nearer than this many hexagonal spacings, up to 1";
pub(super) const CAPACITY_TOLERANCE: &str = "No Voronoi cell's area farther from the mean than this part of it";
pub(super) const BETA: &str = "Coverage radius over smallest distance: below 0.707 no triangle is obtuse";

/// A method that improves points, with its parameters.
pub trait Optimizer: Send + Sync {
    /// Runs it on points, in place.
    ///
    /// # Errors
    /// As the method's own function; the points are untouched then.
    fn run(&self, points: &mut PointSet, run: &mut RunContext) -> Result<Report, Error>;

    /// Checks its parameters, as [`run`](Self::run) does before it begins.
    ///
    /// # Errors
    /// [`Error::InvalidParameter`] for a value outside its range.
    fn check(&self) -> Result<(), Error>;

    /// What it was asked to reach, if that can be measured.
    fn targets(&self) -> Option<&dyn Targets>;

    /// Which method it is.
    fn method(&self) -> Method;

    /// The values of its parameters, by their names; without those that are found on the way.
    fn parameters(&self) -> Vec<(&'static str, Setting)>;

    /// What its own chance depends on, if it has any.
    fn seed(&self) -> Option<u64>;
}

/// What a method's parameters say of it.
pub(crate) trait Optimizing: Clone + Send + Sync + 'static {
    const ENTRY: &'static Entry<Self>;
    /// What evens out points before it, unless they follow a density; `None` for one that takes them as they are.
    const WARP: Option<fn(&mut PointSet)> = None;
    /// The name of the method that makes the points to begin with, where no polygon or density wants another.
    const START: &'static str = "white";
    /// And in a polygon without a density, where no warp takes long waves out.
    const START_IN_POLYGONS: &'static str = "jittered";
    /// Other values than usual that parameters have on meshes, unless they are given.
    const ON_MESHES: &'static [(&'static str, Setting)] = &[];

    fn run(&self, points: &mut PointSet, run: &mut RunContext) -> Result<Report, Error>;

    fn check(&self) -> Result<(), Error>;

    fn targets(&self) -> Option<&dyn Targets> {
        None
    }

    /// How it moves the vertices of meshes, if what it reads is a star.
    fn local(&self) -> Option<Local> {
        None
    }
}

impl<P: Optimizing> Optimizer for P {
    fn run(&self, points: &mut PointSet, run: &mut RunContext) -> Result<Report, Error> {
        Optimizing::run(self, points, run)
    }

    fn check(&self) -> Result<(), Error> {
        Optimizing::check(self)
    }

    fn targets(&self) -> Option<&dyn Targets> {
        Optimizing::targets(self)
    }

    fn method(&self) -> Method {
        Method::of_optimizer(P::ENTRY)
    }

    fn parameters(&self) -> Vec<(&'static str, Setting)> {
        P::ENTRY.values(self)
    }

    fn seed(&self) -> Option<u64> {
        P::ENTRY.seed_of(self)
    }
}

/// The entry of a method that improves points, whatever its parameters are.
pub(crate) trait AnyOptimizer: AnyEntry {
    fn warp(&self) -> Option<fn(&mut PointSet)>;
    fn start(&self) -> [&'static str; 2];
    fn optimizer(&self, settings: &Settings, seed: u64) -> Result<Box<dyn Optimizer>, Error>;
    fn is_local(&self) -> bool;
    fn on_meshes(&self, settings: &Settings, seed: u64) -> Result<LocalMethod, Error>;
}

impl<P: Optimizing> AnyOptimizer for Entry<P> {
    fn warp(&self) -> Option<fn(&mut PointSet)> {
        P::WARP
    }

    fn start(&self) -> [&'static str; 2] {
        [P::START, P::START_IN_POLYGONS]
    }

    fn optimizer(&self, settings: &Settings, seed: u64) -> Result<Box<dyn Optimizer>, Error> {
        let params = self.params(settings, seed)?;
        Optimizing::check(&params)?;
        Ok(Box::new(params))
    }

    fn is_local(&self) -> bool {
        (self.begin)(&Settings::default()).local().is_some()
    }

    fn on_meshes(&self, settings: &Settings, seed: u64) -> Result<LocalMethod, Error> {
        // A preset brings its own.
        let own = P::ON_MESHES.iter().filter(|_| settings.get("preset").is_none());
        let usual = own.fold(Settings::default(), |all, (name, value)| all.with(name, value.clone()));
        let method = LocalMethod::from(self.params(&usual.overlaid(settings), seed)?);
        method.check()?;
        Ok(method)
    }
}
