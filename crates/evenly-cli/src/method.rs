//! The methods, and which flags each of them takes.

use anyhow::bail;
use clap::builder::{PossibleValuesParser, StyledStr, TypedValueParser};
use clap::parser::ValueSource;
use clap::{ArgMatches, Command, ValueEnum};
use evenly::Space;

use Method::{
    Capacity, Cvt, Dart, DistMesh, Eliminate, FarthestPoint, Hexagonal, Jittered, Lloyd, OptBeta, PoissonDisk, Procrustes, PushPull,
    WellSpaced, White,
};

/// How points are made, or made better.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Method {
    /// Procrustes analysis (Papazov and Hege)
    Procrustes,
    /// Push-pull optimization (Ahmed, Guo, Yan et al.)
    PushPull,
    /// Low beta, the ratio of the largest gap to the smallest distance (Ebeida et al.)
    WellSpaced,
    /// Opt-beta: the least ratio of each cell by itself (Ebeida et al.)
    OptBeta,
    /// Lloyd's method: to the centroids of the Voronoi cells
    Lloyd,
    /// Lloyd's energy by a quasi-Newton method (Liu et al.)
    Cvt,
    /// Farthest-point optimization (Schloemer et al.)
    FarthestPoint,
    /// Springs between neighbours (Persson and Strang)
    #[value(name = "distmesh")]
    DistMesh,
    /// Voronoi cells of equal area, and nothing else (Balzer et al.)
    Capacity,
    /// Maximal Poisson-disk sampling (Ebeida et al.)
    PoissonDisk,
    /// Dart throwing (Cook)
    Dart,
    /// Weighted sample elimination (Yuksel), in progressive order
    Eliminate,
    /// Independent uniform points
    White,
    /// One point in each cell of a grid, whose order outlives an optimiser as peaks in the spectrum
    Jittered,
    /// The hexagonal lattice
    Hexagonal,
    /// Even out long density waves, and nothing else
    Warp,
}

const OPTIMIZERS: &[Method] = &[Procrustes, PushPull, WellSpaced, OptBeta, Lloyd, Cvt, FarthestPoint, DistMesh, Capacity];

/// Those that know a density.
const BY_DENSITY: &[Method] = &[Procrustes, PushPull, WellSpaced, Lloyd, DistMesh, Capacity, PoissonDisk, Eliminate, White, Method::Warp];

/// The flags that not every method takes, by their ids.
const FLAGS: &[(&str, &[Method])] = &[
    ("start", OPTIMIZERS),
    ("density", BY_DENSITY),
    ("iterations", OPTIMIZERS),
    ("no_warp", &[Procrustes, PushPull, WellSpaced, Lloyd, DistMesh, Capacity]),
    ("mode", &[Procrustes]),
    ("side", &[Procrustes]),
    ("tolerance", &[Procrustes, Lloyd, Cvt, DistMesh]),
    ("preset", &[PushPull]),
    ("min_distance", &[PushPull, FarthestPoint]),
    ("coverage_radius", &[PushPull]),
    ("capacity_tolerance", &[PushPull, Capacity]),
    ("relaxation", &[PushPull, FarthestPoint]),
    ("local", &[FarthestPoint]),
    ("schedule", &[PushPull]),
    ("beta", &[WellSpaced, OptBeta]),
    ("damping", &[OptBeta]),
    ("spacing", &[PoissonDisk, Dart]),
    ("coverage", &[PoissonDisk]),
    ("visible", &[PoissonDisk]),
    ("tries", &[Dart]),
];

impl Method {
    pub fn name(self) -> String {
        self.to_possible_value().map_or_else(String::new, |value| value.get_name().to_owned())
    }

    /// Whether it improves points.
    pub fn is_optimizer(self) -> bool {
        OPTIMIZERS.contains(&self)
    }

    /// Whether it makes points that an optimiser can begin with.
    pub fn is_start(self) -> bool {
        [PoissonDisk, Dart, Eliminate, White, Jittered, Hexagonal].contains(&self)
    }

    /// What it starts from, as an optimiser, if nothing else is asked for: in a polygon, where no warp takes long waves out, what has none.
    pub fn default_start(self, space: &Space, has_density: bool) -> Self {
        match (self, space) {
            (method, Space::Polygon(_)) => {
                if has_density || method == OptBeta {
                    Eliminate
                } else {
                    Jittered
                }
            }
            (OptBeta, _) => PoissonDisk,
            _ => White,
        }
    }

    /// All that make points there, optimisers, then starts.
    pub fn all_in(space: &Space) -> Vec<Self> {
        let is_there = |method: &Self| *method != Self::Warp && (*method != Hexagonal || space.region().is_none());
        Self::value_variants().iter().copied().filter(is_there).collect()
    }
}

/// Refuses flags that none of these methods takes.
pub fn refuse_others_flags(methods: &[Method], matches: &ArgMatches) -> anyhow::Result<()> {
    let is_given = |id: &str| matches.try_contains_id(id).is_ok() && matches.value_source(id) == Some(ValueSource::CommandLine);
    let is_taken = |takers: &[Method]| methods.iter().any(|method| takers.contains(method));
    match FLAGS.iter().find(|(id, takers)| is_given(id) && !is_taken(takers)) {
        Some((id, takers)) => bail!("--{} is for --method {}", id.replace('_', "-"), names(takers)),
        None => Ok(()),
    }
}

/// Reads those methods that are offered.
pub fn parser(is_offered: fn(Method) -> bool) -> impl TypedValueParser<Value = Method> {
    let offered = Method::value_variants().iter().filter(move |&&method| is_offered(method));
    PossibleValuesParser::new(offered.filter_map(Method::to_possible_value)).try_map(|name| Method::from_str(&name, false))
}

/// The command with each flag's methods in its help.
pub fn with_methods(command: Command) -> Command {
    command.mut_args(|arg| {
        let own = FLAGS.iter().find(|(id, methods)| arg.get_id() == id && methods.len() < OPTIMIZERS.len());
        let Some((_, methods)) = own else { return arg };
        let own = |help: Option<&StyledStr>| format!("{}: {}", names(methods), help.map(ToString::to_string).unwrap_or_default());
        let help = own(arg.get_help());
        match arg.get_long_help() {
            Some(long) => arg.clone().help(help).long_help(own(Some(long))),
            None => arg.help(help),
        }
    })
}

fn names(methods: &[Method]) -> String {
    let names: Vec<String> = methods.iter().map(|method| method.name()).collect();
    match &names[..] {
        [all @ .., last] if !all.is_empty() => format!("{} or {last}", all.join(", ")),
        _ => names.concat(),
    }
}

impl Method {
    pub fn knows_density(self) -> bool {
        BY_DENSITY.contains(&self)
    }

    /// Refuses a method that knows no density, where there is one.
    pub fn refuse_density(self) -> anyhow::Result<()> {
        if !self.knows_density() {
            bail!("--density is for --method {}", names(BY_DENSITY));
        }
        Ok(())
    }

    /// Refuses a start that knows no density, where there is one.
    pub fn require_density(self) -> anyhow::Result<()> {
        let known: Vec<Self> = BY_DENSITY.iter().copied().filter(|method| method.is_start()).collect();
        if !known.contains(&self) {
            bail!("--start {} goes by no density; take {}", self.name(), names(&known));
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::args::command;

    #[test]
    fn every_flag_of_the_table_is_one_and_every_method_is_offered() {
        let command = command();
        let verb = |name: &str| command.get_subcommands().find(|verb| verb.get_name() == name).cloned().unwrap_or_default();
        for (id, methods) in FLAGS {
            let has = |name: &str| verb(name).get_arguments().any(|arg| arg.get_id() == id);
            assert!(has("generate"), "{id}");
            assert!(has("optimize") || *id == "start" || !methods.iter().any(|method| method.is_optimizer()), "{id}");
        }
        for &method in Method::value_variants() {
            assert!(method.is_optimizer() != (method.is_start() || method == Method::Warp));
        }
    }
}
