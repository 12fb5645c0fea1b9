//! What a method can be told, and the parameters that come of it. Which method takes which flag stands in `method.rs`.

use anyhow::{anyhow, bail};
use clap::{Args, ValueEnum};
use evenly::{
    CANDIDATES_A_POINT, CapacityParams, CvtParams, DartParams, Density, DistMeshParams, Error, FarthestPointParams, LloydParams,
    MAX_POINTS, Mode, OptBetaParams, PointSet, PoissonDiskParams, ProcrustesParams, PushPullParams, PushPullPreset, Schedule, Space,
    WellSpacedParams, dart, eliminate, hexagonal, jittered, poisson_disk_around, poisson_disk_by_density, poisson_disk_of_density,
    white_by_density,
};

use crate::method::Method;
use crate::optimizer::Optimizer;

/// What an optimiser can be told.
#[derive(Args)]
pub struct OptimizerArgs {
    /// Take points as they are: not evened out first
    #[arg(long)]
    pub no_warp: bool,
    /// Stop after so many iterations or passes [default: by the method]
    ///
    /// By default 100 of lloyd and cvt, 200 of distmesh, 500 of procrustes and farthest-point, 10000 of opt-beta, which ends where 1000 sweeps bring nothing, and 2000 of the others, more for more than 1000 points.
    #[arg(short, long, value_name = "I", allow_negative_numbers = true)]
    iterations: Option<usize>,
    /// Targets, with the tolerance and relaxation that they need; the flags below change them one by one [default: balanced, unless one of them is given]
    #[arg(long, value_enum, help_heading = "Targets")]
    preset: Option<PresetArg>,
    /// No two points nearer than this many hexagonal spacings, up to 1; or off [default: the preset's; farthest-point: 0.9]
    #[arg(long, value_name = "R", value_parser = parse_target, allow_negative_numbers = true, help_heading = "Targets")]
    min_distance: Option<Target>,
    /// No place farther from a point than this many hexagonal spacings, 0.577 at least; or off
    #[arg(long, value_name = "R", value_parser = parse_target, allow_negative_numbers = true, help_heading = "Targets")]
    coverage_radius: Option<Target>,
    /// No Voronoi cell's area farther from the mean than this part of it; or off [default: 0.0386]
    ///
    /// Where push-pull is given a target without a preset, lengths that are not given are off.
    #[arg(long, value_name = "T", value_parser = parse_target, allow_negative_numbers = true, help_heading = "Targets")]
    capacity_tolerance: Option<Target>,
    /// Coverage radius over smallest distance: below 0.707 no triangle is obtuse [default: 0.75; opt-beta: 0.85]
    ///
    /// Well-spaced is known to reach 0.67 on a torus and 0.72 in a rectangle; opt-beta 0.72 with 1,000 points in 3000 sweeps, 0.76 to 0.79 with 10,000 in 1000.
    #[arg(long, value_name = "B", allow_negative_numbers = true, help_heading = "Targets")]
    beta: Option<f64>,
    /// paper: plain steps, the energy never rises (but where a rectangle is triangulated anew); fast: momentum [default: fast]
    #[arg(long, value_enum, hide_possible_values = true, help_heading = "Steps")]
    mode: Option<ModeArg>,
    /// Side of the model triangle in hexagonal spacings, good within 1 to 1.625 [default: 1.5]
    #[arg(long, value_name = "D", allow_negative_numbers = true, hide_short_help = true, help_heading = "Steps")]
    side: Option<f64>,
    /// Stop when so little happens [default: procrustes: 0.00002; lloyd: 0.0001; cvt: 0.00001; distmesh: 0.001]
    ///
    /// Procrustes: an iteration (with --mode fast two in a row) gains less than this share of the domain's area. Lloyd and distmesh: no point goes farther
    /// than this many hexagonal spacings. Cvt: on average (rms) points are no farther from their centroids.
    #[arg(long, value_name = "T", allow_negative_numbers = true, hide_short_help = true, help_heading = "Steps")]
    tolerance: Option<f64>,
    /// The part of each move that is made; 1.2 lets push-pull reach tougher targets, in turn [default: the preset's, 1; summed: 0.5;
    /// farthest-point: 1.8]
    #[arg(long, value_name = "W", allow_negative_numbers = true, hide_short_help = true, help_heading = "Steps")]
    relaxation: Option<f64>,
    /// A point only looks at the gap that it leaves itself
    #[arg(long, hide_short_help = true, help_heading = "Steps")]
    local: bool,
    /// The part of each move that is made [default: 0.7 above a beta of 0.9, else 1]
    #[arg(long, value_name = "W", allow_negative_numbers = true, hide_short_help = true, help_heading = "Steps")]
    damping: Option<f64>,
    /// in-turn: points move at each visit; summed: at the end of a pass, the paper's parallel variant [default: in-turn]
    #[arg(long, value_enum, hide_possible_values = true, hide_short_help = true, help_heading = "Steps")]
    schedule: Option<ScheduleArg>,
}

/// What a method that makes points can be told.
#[derive(Args)]
#[command(next_help_heading = "Starts")]
pub struct StartArgs {
    /// No two points nearer than this, in input units, where a density is largest; their number is chance
    #[arg(long, value_name = "R", allow_negative_numbers = true)]
    pub spacing: Option<f64>,
    /// No place farther from all points than this, in the domain's units: more than the spacing makes points fewer, and more random
    #[arg(long, value_name = "R", allow_negative_numbers = true, hide_short_help = true)]
    coverage: Option<f64>,
    /// In a polygon only points that see each other keep the spacing: none counts across a slit, or between parts
    #[arg(long, hide_short_help = true)]
    visible: bool,
    /// Misses in a row after which a set is full, or without --spacing the spacing shrinks [default: 1000]
    #[arg(long, value_name = "K", allow_negative_numbers = true, hide_short_help = true)]
    tries: Option<usize>,
}

/// A number, or none.
#[derive(Clone, Copy)]
pub struct Target(pub Option<f64>);

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
pub enum PresetArg {
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
    /// The optimiser of a method, with what it was told; `None` for a method that is none.
    pub fn optimizer(&self, method: Method, seed: u64) -> anyhow::Result<Option<Box<dyn Optimizer>>> {
        Ok(Some(match method {
            Method::Procrustes => Box::new(self.procrustes().map_err(by_flag)?),
            Method::PushPull => Box::new(self.push_pull(seed).map_err(by_flag)?),
            Method::WellSpaced => Box::new(self.well_spaced(seed).map_err(by_flag)?),
            Method::OptBeta => Box::new(self.opt_beta().map_err(by_flag)?),
            Method::Lloyd => Box::new(self.lloyd(seed).map_err(by_flag)?),
            Method::Cvt => Box::new(self.cvt().map_err(by_flag)?),
            Method::FarthestPoint => Box::new(self.farthest_point().map_err(by_flag)?),
            Method::DistMesh => Box::new(self.distmesh(seed).map_err(by_flag)?),
            Method::Capacity => Box::new(self.capacity(seed).map_err(by_flag)?),
            _ => return Ok(None),
        }))
    }

    fn procrustes(&self) -> Result<ProcrustesParams, Error> {
        let mut params = ProcrustesParams::default();
        set(&mut params.mode, self.mode.map(Into::into));
        set(&mut params.side, self.side);
        set(&mut params.tolerance, self.tolerance);
        set(&mut params.max_iterations, self.iterations);
        params.validate()?;
        Ok(params)
    }

    fn push_pull(&self, seed: u64) -> Result<PushPullParams, Error> {
        let &Self { preset, min_distance, coverage_radius, capacity_tolerance, .. } = self;
        let mut params = PushPullParams::preset(preset.map(Into::into).unwrap_or_default());
        let given = [min_distance, coverage_radius, capacity_tolerance].into_iter().flatten();
        let is_picked = preset.is_none() && { given }.any(|target| target.0.is_some());
        if is_picked {
            (params.min_distance, params.coverage_radius) = (None, None);
        }
        set(&mut params.min_distance, min_distance.map(|target| target.0));
        set(&mut params.coverage_radius, coverage_radius.map(|target| target.0));
        set(&mut params.capacity_tolerance, capacity_tolerance.map(|target| target.0));
        if self.schedule == Some(ScheduleArg::Summed) {
            (params.schedule, params.relaxation) = (Schedule::Summed, 0.5);
        }
        set(&mut params.relaxation, self.relaxation);
        params.max_passes = self.iterations;
        params.seed = seed;
        params.validate()?;
        Ok(params)
    }

    fn well_spaced(&self, seed: u64) -> Result<WellSpacedParams, Error> {
        let mut params = WellSpacedParams { max_passes: self.iterations, seed, ..WellSpacedParams::default() };
        set(&mut params.beta, self.beta);
        params.validate()?;
        Ok(params)
    }

    fn opt_beta(&self) -> Result<OptBetaParams, Error> {
        let mut params = OptBetaParams { beta: self.beta, damping: self.damping, ..OptBetaParams::default() };
        set(&mut params.iterations, self.iterations);
        params.validate()?;
        Ok(params)
    }

    fn lloyd(&self, seed: u64) -> Result<LloydParams, Error> {
        let mut params = LloydParams { seed, ..LloydParams::default() };
        set(&mut params.iterations, self.iterations);
        set(&mut params.tolerance, self.tolerance);
        params.validate()?;
        Ok(params)
    }

    fn cvt(&self) -> Result<CvtParams, Error> {
        let mut params = CvtParams::default();
        set(&mut params.iterations, self.iterations);
        set(&mut params.tolerance, self.tolerance);
        params.validate()?;
        Ok(params)
    }

    fn farthest_point(&self) -> Result<FarthestPointParams, Error> {
        let mut params = FarthestPointParams { is_local: self.local, ..FarthestPointParams::default() };
        set(&mut params.min_distance, self.min_distance.map(|target| target.0));
        set(&mut params.relaxation, self.relaxation);
        set(&mut params.iterations, self.iterations);
        params.validate()?;
        Ok(params)
    }

    fn distmesh(&self, seed: u64) -> Result<DistMeshParams, Error> {
        let mut params = DistMeshParams { seed, ..DistMeshParams::default() };
        set(&mut params.iterations, self.iterations);
        set(&mut params.tolerance, self.tolerance);
        params.validate()?;
        Ok(params)
    }

    fn capacity(&self, seed: u64) -> Result<CapacityParams, Error> {
        let mut params = CapacityParams { max_passes: self.iterations, seed, ..CapacityParams::default() };
        let off =
            Error::InvalidParameter { name: "capacity_tolerance", value: "off".into(), expected: "a number: there is no other target" };
        set(&mut params.capacity_tolerance, self.capacity_tolerance.map(|target| target.0.ok_or(off)).transpose()?);
        params.validate()?;
        Ok(params)
    }
}

impl StartArgs {
    /// Makes points by a method that is no optimiser, and says what the user should know.
    pub fn make(&self, method: Method, fixed: &PointSet, n_points: Option<usize>, seed: u64) -> anyhow::Result<(PointSet, Option<String>)> {
        if self.spacing.is_some() && n_points.is_some() {
            bail!("--spacing and --n-points exclude each other: how many points fit is chance");
        }
        if self.spacing.is_none() && n_points.is_none() && [Method::PoissonDisk, Method::Dart].contains(&method) {
            bail!("--spacing or --n-points is missing: how near to each other, or how many?");
        }
        match (method, n_points) {
            (Method::PoissonDisk, _) if fixed.n_points() == 0 || fixed.density().is_uniform() => self.poisson_disk(fixed, n_points, seed),
            (Method::Dart, _) if fixed.n_points() == 0 => {
                let mut params = DartParams { n_points, spacing: self.spacing, seed, ..DartParams::default() };
                set(&mut params.tries, self.tries);
                Ok((dart(fixed.space(), &params).map_err(by_flag)?, None))
            }
            (_, Some(n)) => Ok((start_around(fixed, method, n, seed)?, None)),
            (_, None) if self.spacing.is_some() => {
                bail!("--fixed goes with --spacing for poisson-disk without a density alone; give --n-points")
            }
            (_, None) => bail!("--n-points is missing: how many?"),
        }
    }

    fn poisson_disk(&self, fixed: &PointSet, n_points: Option<usize>, seed: u64) -> anyhow::Result<(PointSet, Option<String>)> {
        let about = PoissonDiskParams::for_about_by_density(fixed.space(), fixed.density(), n_points.unwrap_or(1));
        let estimated = PoissonDiskParams { seed, ..about };
        let params = self.spacing.map_or(estimated, |spacing| PoissonDiskParams { spacing, ..estimated });
        let params = PoissonDiskParams { coverage: self.coverage, is_visible: self.visible, ..params };
        let points = if fixed.density().is_uniform() {
            poisson_disk_around(fixed, &params).map_err(by_flag)?
        } else {
            poisson_disk_by_density(fixed.space(), fixed.density(), &params).map_err(by_flag)?
        };
        let note = n_points.filter(|&n| n != points.n_points()).map(|n| {
            let why = match self.coverage {
                Some(_) => "with a wider coverage fewer points are needed",
                None if n < points.n_points() / 2 && fixed.density().is_uniform() => "on so narrow a torus the spacing cannot be wider",
                None => "a maximal set's number of points is chance",
            };
            format!("{why}: {} for {n}, with a spacing of {:.6e}", points.n_points(), params.spacing)
        });
        Ok((points, note))
    }
}

/// As [`start`], in the space of points that stay, which are among them and come first.
pub fn start_around(fixed: &PointSet, method: Method, n_points: usize, seed: u64) -> anyhow::Result<PointSet> {
    let (space, density, n_fixed) = (fixed.space(), fixed.density(), fixed.n_points());
    if n_fixed == 0 {
        return Ok(start(method, space, density, n_points, seed)?);
    }
    if n_points < n_fixed {
        bail!("--n-points is {n_points}, but {n_fixed} points stay: they are among them");
    }
    let with = |others: PointSet| {
        let all = fixed.positions().iter().chain(others.positions()).copied().collect();
        PointSet::new(space, all)?.with_density(density).with_fixed(n_fixed)
    };
    Ok(match method {
        _ if n_points == n_fixed => with(PointSet::new(space, Vec::new())?)?,
        Method::White | Method::Jittered => with(start(method, space, density, n_points - n_fixed, seed)?)?,
        // Those go that crowd around the ones that stay.
        _ => eliminate(&with(start(method, space, density, n_points, seed)?)?, n_points)?,
    })
}

/// Exactly so many points for an optimiser to begin with.
pub fn start(method: Method, space: &Space, density: &Density, n_points: usize, seed: u64) -> Result<PointSet, Error> {
    match method {
        Method::PoissonDisk => poisson_disk_of_density(space, density, n_points, seed),
        Method::Dart => dart(space, &DartParams { n_points: Some(n_points), seed, ..DartParams::default() }),
        Method::Eliminate => {
            let n_candidates = n_points.saturating_mul(CANDIDATES_A_POINT).min(MAX_POINTS.max(n_points));
            eliminate(&white_by_density(space, density, n_candidates, seed)?, n_points)
        }
        Method::Jittered => jittered(space, n_points, seed),
        Method::Hexagonal => hexagonal(space, n_points),
        _ => white_by_density(space, density, n_points, seed),
    }
}

/// The same error, with the name that the user knows.
pub fn by_flag(error: Error) -> anyhow::Error {
    match error {
        Error::InvalidParameter { name, value, expected } => {
            let flag = if name.starts_with("max_") { "iterations".to_owned() } else { name.replace('_', "-") };
            anyhow!("--{flag} is {value}; it must be {expected}")
        }
        other => other.into(),
    }
}

pub fn set<T>(field: &mut T, value: Option<T>) {
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

pub fn parse_target(text: &str) -> Result<Target, String> {
    if text == "off" {
        return Ok(Target(None));
    }
    text.parse().map(|number| Target(Some(number))).map_err(|_| "it must be a number, or off".to_owned())
}
