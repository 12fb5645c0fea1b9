//! The optimisers behind one face: what a run needs to know of whichever it is.

use evenly::{
    CapacityParams, CvtParams, DistMeshParams, Error, FarthestPointParams, LloydParams, OptBetaParams, PointSet, ProcrustesParams,
    PushPullParams, Report, RunContext, Targets, WellSpacedParams, capacity, cvt, distmesh, farthest_point, lloyd, opt_beta, procrustes,
    push_pull, warp, warp_isotropic, well_spaced,
};
use serde::Serialize;
use serde_json::Value;

/// What the record shows of a method's parameters.
pub trait Parameters {
    fn parameters(&self) -> Value;
}

impl<T: Serialize> Parameters for T {
    fn parameters(&self) -> Value {
        serde_json::json!(self)
    }
}

/// A method with its parameters.
pub trait Optimizer: Parameters + Send + Sync {
    fn run(&self, points: &mut PointSet, run: &mut RunContext) -> Result<Report, Error>;

    /// Checks its parameters.
    fn check(&self) -> Result<(), Error>;

    /// What its own chance depends on.
    fn seed(&self) -> Option<u64> {
        None
    }

    /// What evens out a start as suits the method; `None` for one that takes points as they are.
    fn warp(&self) -> Option<fn(&mut PointSet)> {
        None
    }

    /// What it was asked to reach, if that can be measured.
    fn targets(&self) -> Option<&dyn Targets> {
        None
    }
}

impl Optimizer for ProcrustesParams {
    fn run(&self, points: &mut PointSet, run: &mut RunContext) -> Result<Report, Error> {
        procrustes(points, self, run)
    }

    fn check(&self) -> Result<(), Error> {
        self.validate()
    }

    fn warp(&self) -> Option<fn(&mut PointSet)> {
        Some(warp)
    }
}

impl Optimizer for PushPullParams {
    fn run(&self, points: &mut PointSet, run: &mut RunContext) -> Result<Report, Error> {
        push_pull(points, self, run)
    }

    fn check(&self) -> Result<(), Error> {
        self.validate()
    }

    fn seed(&self) -> Option<u64> {
        Some(self.seed)
    }

    fn warp(&self) -> Option<fn(&mut PointSet)> {
        Some(warp_isotropic)
    }

    fn targets(&self) -> Option<&dyn Targets> {
        Some(self)
    }
}

impl Optimizer for WellSpacedParams {
    fn run(&self, points: &mut PointSet, run: &mut RunContext) -> Result<Report, Error> {
        well_spaced(points, self, run)
    }

    fn check(&self) -> Result<(), Error> {
        self.validate()
    }

    fn seed(&self) -> Option<u64> {
        Some(self.seed)
    }

    fn warp(&self) -> Option<fn(&mut PointSet)> {
        Some(warp_isotropic)
    }

    fn targets(&self) -> Option<&dyn Targets> {
        Some(self)
    }
}

impl Optimizer for OptBetaParams {
    fn run(&self, points: &mut PointSet, run: &mut RunContext) -> Result<Report, Error> {
        opt_beta(points, self, run)
    }

    fn check(&self) -> Result<(), Error> {
        self.validate()
    }

    fn targets(&self) -> Option<&dyn Targets> {
        self.beta.map(|_| self as &dyn Targets)
    }
}

impl Optimizer for LloydParams {
    fn run(&self, points: &mut PointSet, run: &mut RunContext) -> Result<Report, Error> {
        lloyd(points, self, run)
    }

    fn check(&self) -> Result<(), Error> {
        self.validate()
    }

    fn seed(&self) -> Option<u64> {
        Some(self.seed)
    }
}

impl Optimizer for DistMeshParams {
    fn run(&self, points: &mut PointSet, run: &mut RunContext) -> Result<Report, Error> {
        distmesh(points, self, run)
    }

    fn check(&self) -> Result<(), Error> {
        self.validate()
    }

    fn seed(&self) -> Option<u64> {
        Some(self.seed)
    }
}

impl Optimizer for CapacityParams {
    fn run(&self, points: &mut PointSet, run: &mut RunContext) -> Result<Report, Error> {
        capacity(points, self, run)
    }

    fn check(&self) -> Result<(), Error> {
        self.validate()
    }

    fn seed(&self) -> Option<u64> {
        Some(self.seed)
    }

    fn targets(&self) -> Option<&dyn Targets> {
        Some(self)
    }
}

impl Optimizer for FarthestPointParams {
    fn run(&self, points: &mut PointSet, run: &mut RunContext) -> Result<Report, Error> {
        farthest_point(points, self, run)
    }

    fn check(&self) -> Result<(), Error> {
        self.validate()
    }

    fn targets(&self) -> Option<&dyn Targets> {
        self.min_distance.map(|_| self as &dyn Targets)
    }
}

impl Optimizer for CvtParams {
    fn run(&self, points: &mut PointSet, run: &mut RunContext) -> Result<Report, Error> {
        cvt(points, self, run)
    }

    fn check(&self) -> Result<(), Error> {
        self.validate()
    }
}
