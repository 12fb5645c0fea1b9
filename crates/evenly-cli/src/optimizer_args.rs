//! What an optimiser can be told: the flags of each method, and the parameters that come of them.

use anyhow::{anyhow, bail};
use clap::{Args, ValueEnum};
use evenly::{Error, Mode, ProcrustesParams, PushPullParams, PushPullPreset, Schedule, WellSpacedParams};

use crate::optimizer::Optimizer;

/// What an optimiser can be told. Flags of one method are refused by another.
#[derive(Args)]
pub struct OptimizerArgs {
    /// Keep the start's own long density waves; without it white noise, and any input, is evened out first
    #[arg(long)]
    pub no_warp: bool,
    /// Stop after so many iterations or passes in any case [default: 500; push-pull and well-spaced: 2000, more for more than 1000 points]
    #[arg(short, long, value_name = "I", allow_negative_numbers = true)]
    iterations: Option<usize>,
    #[command(flatten)]
    procrustes: ProcrustesArgs,
    #[command(flatten)]
    push_pull: PushPullArgs,
    #[command(flatten)]
    well_spaced: WellSpacedArgs,
}

#[derive(Args)]
#[command(next_help_heading = "Procrustes")]
struct ProcrustesArgs {
    /// paper: plain steps, the energy never rises (but where a rectangle is triangulated anew); fast: momentum [default: fast]
    #[arg(long, value_enum, hide_possible_values = true)]
    mode: Option<ModeArg>,
    /// Side of the model triangle in hexagonal spacings, good within 1 to 1.625 [default: 1.5]
    #[arg(long, value_name = "D", allow_negative_numbers = true, hide_short_help = true)]
    side: Option<f64>,
    /// Stop when an iteration (fast: two in a row) gains less than this share of the domain's area [default: 0.00002]
    #[arg(long, value_name = "T", allow_negative_numbers = true)]
    tolerance: Option<f64>,
}

#[derive(Args)]
#[command(next_help_heading = "Push-Pull")]
struct PushPullArgs {
    /// Targets, with the tolerance and relaxation that they need; the flags below change them one by one [default: balanced]
    #[arg(long, value_enum)]
    preset: Option<PresetArg>,
    /// No two points nearer than this many hexagonal spacings, up to 1; or off
    #[arg(long, value_name = "R", value_parser = parse_target, allow_negative_numbers = true)]
    min_distance: Option<Target>,
    /// No place farther from a point than this many hexagonal spacings, 0.577 at least; or off
    #[arg(long, value_name = "R", value_parser = parse_target, allow_negative_numbers = true)]
    coverage_radius: Option<Target>,
    /// No Voronoi cell's area farther from the mean than this part of it; or off. Where a target is given without a preset, lengths that are not
    /// given are off, and this is 0.0386
    #[arg(long, value_name = "T", value_parser = parse_target, allow_negative_numbers = true)]
    capacity_tolerance: Option<Target>,
    /// The part of each move that is made; 1.2 reaches tougher targets, in turn [default: the preset's, 1; summed: 0.5]
    #[arg(long, value_name = "W", allow_negative_numbers = true)]
    relaxation: Option<f64>,
    /// in-turn: points move at each visit; summed: at the end of a pass, the paper's parallel variant [default: in-turn]
    #[arg(long, value_enum, hide_possible_values = true, hide_short_help = true)]
    schedule: Option<ScheduleArg>,
}

#[derive(Args)]
#[command(next_help_heading = "Well-spaced")]
struct WellSpacedArgs {
    /// Coverage radius over smallest distance: below 0.707 no triangle is obtuse; on a torus 0.67 is reached, in a rectangle 0.72 [default: 0.75]
    #[arg(long, value_name = "B", allow_negative_numbers = true)]
    beta: Option<f64>,
}

/// A number, or none.
#[derive(Clone, Copy)]
pub struct Target(Option<f64>);

#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum ModeArg {
    /// Plain steps
    Paper,
    /// Momentum
    Fast,
}

#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum ScheduleArg {
    /// Points move at each visit
    InTurn,
    /// Points move at the end of a pass
    Summed,
}

#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum PresetArg {
    /// Distance 0.75, coverage 0.75, tolerance 0.1
    Fast,
    /// 0.85, 0.67, 0.0386
    Balanced,
    /// 0.90, 0.65, 0.0386: the triangles' angles are 43.8 to 92.5 degrees
    Tough,
    /// 0.80, 0.63, 0.0386: row 1 of the paper's Table 1; on a torus
    Paper1,
    /// 0.90, 0.65, 0.0386: row 2
    Paper2,
    /// 0.92, 0.62, 0.1, relaxation 1.2: row 3, no triangle is obtuse; on a torus
    Paper3,
}

impl OptimizerArgs {
    pub fn procrustes(&self) -> anyhow::Result<Optimizer> {
        refuse(self.push_pull.given(), "push-pull")?;
        refuse(self.well_spaced.given(), "well-spaced")?;
        let ProcrustesArgs { mode, side, tolerance } = self.procrustes;
        let mut params = ProcrustesParams::default();
        set(&mut params.mode, mode.map(Into::into));
        set(&mut params.side, side);
        set(&mut params.tolerance, tolerance);
        set(&mut params.max_iterations, self.iterations);
        params.validate().map_err(by_flag)?;
        Ok(Optimizer::Procrustes(params))
    }

    pub fn push_pull(&self, seed: u64) -> anyhow::Result<Optimizer> {
        refuse(self.procrustes.given(), "procrustes")?;
        refuse(self.well_spaced.given(), "well-spaced")?;
        let PushPullArgs { preset, min_distance, coverage_radius, capacity_tolerance, relaxation, schedule } = self.push_pull;
        let mut params = PushPullParams::preset(preset.map(Into::into).unwrap_or_default());
        let given = [min_distance, coverage_radius, capacity_tolerance].into_iter().flatten();
        let is_picked = preset.is_none() && { given }.any(|target| target.0.is_some());
        if is_picked {
            (params.min_distance, params.coverage_radius) = (None, None);
        }
        set(&mut params.min_distance, min_distance.map(|target| target.0));
        set(&mut params.coverage_radius, coverage_radius.map(|target| target.0));
        set(&mut params.capacity_tolerance, capacity_tolerance.map(|target| target.0));
        if schedule == Some(ScheduleArg::Summed) {
            (params.schedule, params.relaxation) = (Schedule::Summed, 0.5);
        }
        set(&mut params.relaxation, relaxation);
        params.max_passes = self.iterations;
        params.seed = seed;
        params.validate().map_err(by_flag)?;
        Ok(Optimizer::PushPull(params))
    }

    pub fn well_spaced(&self, seed: u64) -> anyhow::Result<Optimizer> {
        refuse(self.procrustes.given(), "procrustes")?;
        refuse(self.push_pull.given(), "push-pull")?;
        let mut params = WellSpacedParams { max_passes: self.iterations, seed, ..WellSpacedParams::default() };
        set(&mut params.beta, self.well_spaced.beta);
        params.validate().map_err(by_flag)?;
        Ok(Optimizer::WellSpaced(params))
    }

    /// For a method that is no optimiser.
    pub fn none(&self) -> anyhow::Result<()> {
        refuse(self.procrustes.given(), "procrustes")?;
        refuse(self.push_pull.given(), "push-pull")?;
        refuse(self.well_spaced.given(), "well-spaced")?;
        refuse(self.iterations.map(|_| "iterations"), OPTIMIZERS)?;
        refuse(self.no_warp.then_some("no-warp"), OPTIMIZERS)
    }
}

impl ProcrustesArgs {
    /// The first flag that was given.
    fn given(&self) -> Option<&'static str> {
        let flags = [("mode", self.mode.is_some()), ("side", self.side.is_some()), ("tolerance", self.tolerance.is_some())];
        flags.into_iter().find(|&(_, is_given)| is_given).map(|(name, _)| name)
    }
}

impl WellSpacedArgs {
    /// Its flag, if it was given.
    fn given(&self) -> Option<&'static str> {
        self.beta.map(|_| "beta")
    }
}

impl PushPullArgs {
    /// The first flag that was given.
    fn given(&self) -> Option<&'static str> {
        let flags = [
            ("preset", self.preset.is_some()),
            ("min-distance", self.min_distance.is_some()),
            ("coverage-radius", self.coverage_radius.is_some()),
            ("capacity-tolerance", self.capacity_tolerance.is_some()),
            ("relaxation", self.relaxation.is_some()),
            ("schedule", self.schedule.is_some()),
        ];
        flags.into_iter().find(|&(_, is_given)| is_given).map(|(name, _)| name)
    }
}

/// Those that take `--start`, `--iterations` and `--no-warp`.
pub const OPTIMIZERS: &str = "procrustes, push-pull or well-spaced";

/// The same error, with the name that the user knows.
fn by_flag(error: Error) -> anyhow::Error {
    match error {
        Error::InvalidParameter { name, value, expected } => {
            let flag = if name.starts_with("max_") { "iterations".to_owned() } else { name.replace('_', "-") };
            anyhow!("--{flag} is {value}; it must be {expected}")
        }
        other => other.into(),
    }
}

pub fn refuse(flag: Option<&str>, method: &str) -> anyhow::Result<()> {
    match flag {
        Some(flag) => bail!("--{flag} is for --method {method}"),
        None => Ok(()),
    }
}

fn set<T>(field: &mut T, value: Option<T>) {
    if let Some(value) = value {
        *field = value;
    }
}

impl From<ModeArg> for Mode {
    fn from(mode: ModeArg) -> Self {
        match mode {
            ModeArg::Paper => Self::Paper,
            ModeArg::Fast => Self::Fast,
        }
    }
}

impl From<PresetArg> for PushPullPreset {
    fn from(preset: PresetArg) -> Self {
        match preset {
            PresetArg::Fast => Self::Fast,
            PresetArg::Balanced => Self::Balanced,
            PresetArg::Tough => Self::Tough,
            PresetArg::Paper1 => Self::Paper1,
            PresetArg::Paper2 => Self::Paper2,
            PresetArg::Paper3 => Self::Paper3,
        }
    }
}

fn parse_target(text: &str) -> Result<Target, String> {
    if text == "off" {
        return Ok(Target(None));
    }
    text.parse().map(|number| Target(Some(number))).map_err(|_| "it must be a number, or off".to_owned())
}
