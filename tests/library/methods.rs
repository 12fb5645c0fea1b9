//! All optimisers, quick ones, for tests.

use evenly::{
    CapacityParams, CvtParams, DistMeshParams, FarthestPointParams, LloydParams, OptBetaParams, PointSet, ProcrustesParams, PushPullParams,
    PushPullPreset, Report, RunContext, WellSpacedParams, capacity, cvt, distmesh, farthest_point, lloyd, opt_beta, procrustes, push_pull,
    well_spaced,
};

pub type Optimize = fn(&mut PointSet) -> Report;

pub const OPTIMIZERS: [(&str, Optimize); 9] = [
    ("procrustes", |points| {
        let params = ProcrustesParams { max_iterations: 70, ..ProcrustesParams::default() };
        procrustes(points, &params, &mut RunContext::default()).unwrap()
    }),
    ("push-pull", |points| {
        let params = PushPullParams { max_passes: Some(60), ..PushPullParams::preset(PushPullPreset::Fast) };
        push_pull(points, &params, &mut RunContext::default()).unwrap()
    }),
    ("well-spaced", |points| {
        let params = WellSpacedParams { beta: 0.9, max_passes: Some(60), ..WellSpacedParams::default() };
        well_spaced(points, &params, &mut RunContext::default()).unwrap()
    }),
    ("capacity", |points| {
        let params = CapacityParams { max_passes: Some(60), ..CapacityParams::default() };
        capacity(points, &params, &mut RunContext::default()).unwrap()
    }),
    ("lloyd", |points| {
        let params = LloydParams { iterations: 15, ..LloydParams::default() };
        lloyd(points, &params, &mut RunContext::default()).unwrap()
    }),
    ("distmesh", |points| {
        let params = DistMeshParams { iterations: 15, ..DistMeshParams::default() };
        distmesh(points, &params, &mut RunContext::default()).unwrap()
    }),
    ("opt-beta", |points| {
        let params = OptBetaParams { iterations: 5, ..OptBetaParams::default() };
        opt_beta(points, &params, &mut RunContext::default()).unwrap()
    }),
    ("cvt", |points| {
        let params = CvtParams { iterations: 10, ..CvtParams::default() };
        cvt(points, &params, &mut RunContext::default()).unwrap()
    }),
    ("farthest-point", |points| {
        let params = FarthestPointParams { iterations: 3, ..FarthestPointParams::default() };
        farthest_point(points, &params, &mut RunContext::default()).unwrap()
    }),
];
