//! How sets are made that several parts show.

use evenly::{CvtParams, DistMeshParams, FarthestPointParams, OptBetaParams, WellSpacedParams};

use super::lab::Recipe;

pub fn farthest() -> Recipe {
    Recipe::plain("FPO", "white", FarthestPointParams { min_distance: Some(0.925), ..FarthestPointParams::default() })
}

/// The steps of Schloemer et al., not exaggerated.
pub fn farthest_of_paper() -> Recipe {
    let params = FarthestPointParams { min_distance: Some(0.925), relaxation: 1.0, iterations: 5000, ..FarthestPointParams::default() };
    Recipe::plain("FPO, own steps", "white", params)
}

/// As in the paper: from a maximal Poisson-disk set.
pub fn by_opt_beta(name: &'static str, beta: f64) -> Recipe {
    Recipe::plain(name, "poisson-disk", OptBetaParams { beta: Some(beta), ..OptBetaParams::default() })
}

pub fn by_well_spaced(name: &'static str, beta: f64) -> Recipe {
    Recipe::plain(name, "poisson-disk", WellSpacedParams { beta, ..WellSpacedParams::default() })
}

pub fn cvt() -> Recipe {
    Recipe::plain("CVT", "poisson-disk", CvtParams::default())
}

pub fn distmesh() -> Recipe {
    Recipe::plain("DistMesh", "poisson-disk", DistMeshParams::default())
}

/// As Ebeida et al. have it: each point to the largest gap beside it.
pub fn farthest_local() -> Recipe {
    let params = FarthestPointParams { min_distance: None, is_local: true, iterations: 200, ..FarthestPointParams::default() };
    Recipe::plain("Far-Point", "poisson-disk", params)
}
