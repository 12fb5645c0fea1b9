//! Push-Pull in the registry: its presets, and what it can be told.

use super::{PushPullParams, PushPullPreset, push_pull};
use crate::error::Error;
use crate::methods::local::Local;
use crate::methods::optimizer::{CAPACITY_TOLERANCE, ITERATIONS, MIN_DISTANCE, Optimizing, PASSES};
use crate::methods::targets::Targets;
use crate::parameter::{Choice, Entry, Parameter, Setting, Settings, Unit};
use crate::points::{PointSet, warp_isotropic};
use crate::run::{Report, RunContext};
use crate::sweep::Schedule;

const PRESETS: [Choice; 6] = [
    Choice { name: "fast", doc: "distance 0.75, coverage 0.75, tolerance 0.1" },
    Choice { name: "balanced", doc: "0.85, 0.67, 0.0386" },
    Choice { name: "tough", doc: "0.90, 0.65, 0.0386: the triangles' angles are 43.8 to 92.5 degrees" },
    Choice { name: "paper1", doc: "0.80, 0.63, 0.0386: row 1 of the paper's Table 1; on a torus" },
    Choice { name: "paper2", doc: "0.90, 0.65, 0.0386: row 2" },
    Choice { name: "paper3", doc: "0.92, 0.62, 0.1, relaxation 1.2: row 3, no triangle is obtuse; on a torus" },
];
const SCHEDULES: [Choice; 2] = [
    Choice { name: "in-turn", doc: "points move at each visit" },
    Choice { name: "summed", doc: "at the end of a pass, the paper's parallel variant" },
];

/// What parameters begin with: a preset's, or where only single targets are given, without the distances that are not.
fn beginning(settings: &Settings) -> PushPullParams {
    let chosen = |name: &str| match settings.get(name) {
        Some(Setting::Choice(choice)) => Some(choice.as_str()),
        _ => None,
    };
    let preset = match chosen("preset") {
        Some("fast") => PushPullPreset::Fast,
        Some("tough") => PushPullPreset::Tough,
        Some("paper1") => PushPullPreset::Paper1,
        Some("paper2") => PushPullPreset::Paper2,
        Some("paper3") => PushPullPreset::Paper3,
        _ => PushPullPreset::Balanced,
    };
    let mut params = PushPullParams::preset(preset);
    let targets = ["min_distance", "coverage_radius", "capacity_tolerance"];
    if chosen("preset").is_none() && targets.iter().any(|name| matches!(settings.get(name), Some(Setting::Number(_)))) {
        (params.min_distance, params.coverage_radius) = (None, None);
    }
    if chosen("schedule") == Some("summed") {
        params.relaxation = 0.5;
    }
    params
}

impl Optimizing for PushPullParams {
    const ENTRY: &'static Entry<Self> = &Entry {
        name: "push-pull",
        title: "Push-pull optimization (Ahmed, Guo, Yan et al.)",
        paper: "Ahmed, Guo, Yan, Franceschi, Zhang and Deussen 2017, doi 10.1109/TVCG.2016.2641963",
        knows_density: true,
        begin: beginning,
        seed: Some(|p| &mut p.seed),
        parameters: &[
            Parameter::own_count("iterations", "I", |p: &mut Self| &mut p.max_passes, ITERATIONS).by_default(PASSES),
            Parameter::beginning(
                "preset",
                &PRESETS,
                "Targets, with the tolerance and relaxation that they need; the flags below change them one by one",
            )
            .by_default("balanced, unless one of them is given"),
            Parameter::target("min_distance", "R", |p: &mut Self| &mut p.min_distance, MIN_DISTANCE)
                .by_default("the preset's")
                .counting(Unit::Spacings),
            Parameter::target(
                "coverage_radius",
                "R",
                |p: &mut Self| &mut p.coverage_radius,
                "No place farther from a point than this many hexagonal spacings, 0.577 at least",
            )
            .by_default("the preset's")
            .counting(Unit::Spacings),
            Parameter::target("capacity_tolerance", "T", |p: &mut Self| &mut p.capacity_tolerance, CAPACITY_TOLERANCE)
                .by_default("the preset's")
                .details("Where a target is given without a preset, distances that are not given are off."),
            Parameter::number(
                "relaxation",
                "W",
                |p: &mut Self| &mut p.relaxation,
                "The part of each move that is made; 1.2 reaches tougher targets, in turn",
            )
            .by_default("the preset's, 1; summed: 0.5")
            .rare(),
            Parameter::choice(
                "schedule",
                &SCHEDULES,
                |p: &Self| p.schedule as usize,
                |p: &mut Self, place| p.schedule = [Schedule::InTurn, Schedule::Summed][place],
                "When points move",
            )
            .rare(),
        ],
    };
    const WARP: Option<fn(&mut PointSet)> = Some(warp_isotropic);
    /// The paper's {0.90, 0.63}, which leave no obtuse triangle, with a tolerance that takes a third of the time.
    const ON_MESHES: &'static [(&'static str, Setting)] = &[
        ("min_distance", Setting::Number(0.90)),
        ("coverage_radius", Setting::Number(0.63)),
        ("capacity_tolerance", Setting::Number(0.1)),
    ];

    fn run(&self, points: &mut PointSet, run: &mut RunContext) -> Result<Report, Error> {
        push_pull(points, self, run)
    }

    fn check(&self) -> Result<(), Error> {
        self.validate()
    }

    fn targets(&self) -> Option<&dyn Targets> {
        Some(self)
    }

    fn local(&self) -> Option<Local> {
        Some(Local::Targets(*self))
    }
}
