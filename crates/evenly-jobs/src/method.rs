//! Which methods a job offers, what they are told, and the registry as JSON.

use evenly::{About, LocalMethod, Method, Optimizer, ParameterKind, Setting, Settings, Unit};
use serde_json::{Value, json};

use crate::error::{Error, names};
use crate::message::Message;

/// The two that make points on a surface without a mesh of them.
pub(crate) const WHITE: &str = "white";
pub(crate) const POISSON_DISK: &str = "poisson-disk";

/// What methods are asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Job {
    /// Points from nothing.
    Generate,
    /// Better points from points.
    Optimize,
    /// Points to begin with.
    Start,
    /// A picture as dots.
    Stipple,
    /// Triangles in a polygon.
    Mesh,
    /// A surface's new mesh.
    Remesh,
    /// Points on a surface.
    Sample,
}

impl Job {
    /// Those that a method is listed with, and their names.
    pub const LISTED: [(Self, &'static str); 6] = [
        (Self::Generate, "generate"),
        (Self::Optimize, "optimize"),
        (Self::Stipple, "stipple"),
        (Self::Mesh, "mesh"),
        (Self::Remesh, "remesh"),
        (Self::Sample, "sample"),
    ];

    /// Whether it can be done by a method.
    pub fn offers(self, method: Method) -> bool {
        match self {
            Self::Generate => true,
            Self::Optimize => method.is_optimizer(),
            Self::Start => method.is_start(),
            Self::Stipple => method.knows_density(),
            Self::Mesh | Self::Remesh => method.is_local(),
            Self::Sample => method.is_local() || [WHITE, POISSON_DISK].contains(&method.name()),
        }
    }

    /// All methods by which it can be done.
    pub fn methods(self) -> Vec<Method> {
        Method::all().filter(|&method| self.offers(method)).collect()
    }

    /// Refuses parameters that none of some methods has.
    pub(crate) fn require_taken(self, settings: &Settings, methods: &[Method]) -> Result<(), Error> {
        let takers = |name: &str| self.methods().into_iter().filter(|method| method.takes(name)).collect();
        match settings.names().find(|name| !methods.iter().any(|method| method.takes(name))) {
            Some(name) => Err(Error::NotTaken { parameter: name.to_owned(), methods: takers(name) }),
            None => Ok(()),
        }
    }

    /// Checks what a method is told, before any spacing is known.
    ///
    /// # Errors
    /// [`Error::NotTaken`] for a parameter of other methods, and as [`Method::optimizer`].
    pub fn check(self, method: Method, settings: &Settings) -> Result<(), Error> {
        self.require_taken(settings, &[method])?;
        method.in_spacings(settings, 1.0)?;
        method.optimizer(&without_lengths(settings), 0)?;
        Ok(())
    }

    /// Refuses a method by which it cannot be done.
    pub(crate) fn require(self, parameter: &'static str, method: Method) -> Result<(), Error> {
        if self.offers(method) { Ok(()) } else { Err(Error::NotOffered { parameter, method, offered: self.methods() }) }
    }
}

/// What a method is told, with lengths in input units as spacings, which are so long; `None` where they vary.
fn in_spacings(method: Method, settings: &Settings, spacing: Option<f64>) -> Result<Settings, Error> {
    let is_relative = |name: &str| method.parameters().iter().any(|(about, _)| about.name == name && about.unit == Unit::Spacings);
    let lengths = settings.names().filter_map(|name| Some((name, settings.get(name)?)));
    let mut lengths = lengths.filter(|(name, value)| matches!(value, Setting::Length(_)) && is_relative(name));
    match (lengths.next(), spacing) {
        (Some((name, length)), None) => {
            Err(Message::default().name(name).text(format!(" is {length}; where spacings vary it must be in spacings")).into())
        }
        _ => Ok(method.in_spacings(settings, spacing.unwrap_or(1.0))?),
    }
}

/// The same error; of a length in input units with what was given, and the spacing that it counts in.
fn in_units(error: evenly::Error, settings: &Settings, spacing: Option<f64>) -> Error {
    match (Error::from(error), spacing) {
        (Error::Library(evenly::Error::InvalidParameter { name, value, expected }), Some(spacing)) => match settings.get(name) {
            Some(length @ Setting::Length(_)) => {
                let spacings = value.parse::<f64>().map_or(value, |number| format!("{number:.4}"));
                Error::invalid(name, format!("{length}, which is {spacings} spacings of {spacing:.4e}"), expected)
            }
            _ => Error::invalid(name, value, expected),
        },
        (other, _) => other,
    }
}

fn without_lengths(settings: &Settings) -> Settings {
    let values = settings.names().filter_map(|name| Some((name, settings.get(name)?)));
    let others = values.filter(|(_, value)| !matches!(value, Setting::Length(_)));
    others.fold(Settings::default(), |all, (name, value)| all.with(name, value.clone()))
}

/// The same for the vertices of a mesh.
///
/// # Errors
/// As [`on_meshes`].
pub(crate) fn check_on_meshes(method: Method, settings: &Settings) -> Result<(), Error> {
    Job::Mesh.require_taken(settings, &[method])?;
    method.in_spacings(settings, 1.0)?;
    method.on_meshes(&without_lengths(settings), 0)?;
    Ok(())
}

/// What a method is told, with lengths as spacings, and the method with it; `None` for one that makes points.
///
/// # Errors
/// As [`Job::check`]; a length in input units where spacings vary.
pub(crate) fn optimizer(
    method: Method,
    settings: &Settings,
    spacing: Option<f64>,
    seed: u64,
) -> Result<(Settings, Option<Box<dyn Optimizer>>), Error> {
    let told = in_spacings(method, settings, spacing)?;
    let optimizer = method.optimizer(&told, seed).map_err(|error| in_units(error, settings, spacing))?;
    Ok((told, optimizer))
}

/// The same for the vertices of a mesh, over what else is usual.
pub(crate) fn on_meshes(
    method: Method,
    settings: &Settings,
    usual: &Settings,
    spacing: Option<f64>,
    seed: u64,
) -> Result<LocalMethod, Error> {
    let told = usual.clone().overlaid(&in_spacings(method, settings, spacing)?);
    method.on_meshes(&told, seed).map_err(|error| in_units(error, settings, spacing))
}

/// Refuses a method that knows no density, where there is one.
pub(crate) fn require_density(method: Method) -> Result<(), Error> {
    if method.knows_density() {
        return Ok(());
    }
    Err(Error::NotTaken { parameter: "density".into(), methods: Job::Stipple.methods() })
}

/// Refuses a start that knows no density, where there is one.
pub(crate) fn require_density_of_start(start: Method) -> Result<(), Error> {
    if start.knows_density() {
        return Ok(());
    }
    let known: Vec<Method> = Job::Start.methods().into_iter().filter(Method::knows_density).collect();
    Err(Message::default().setting("start", start).text(format!(" goes by no density; take {}", names(&known))).into())
}

/// Refuses what comes before an optimiser, where there is none.
pub(crate) fn require_beginning(method: Method, start: Option<Method>, is_warped: bool) -> Result<(), Error> {
    if let Some(start) = start {
        Job::Start.require("start", start)?;
        if !method.is_optimizer() {
            return Err(Error::NotTaken { parameter: "start".into(), methods: Job::Optimize.methods() });
        }
    }
    if !is_warped && !method.is_warped_first() {
        return Err(Error::NotTaken { parameter: "no_warp".into(), methods: Method::all().filter(Method::is_warped_first).collect() });
    }
    Ok(())
}

/// The jobs that a method can do, by their names; `density` where its points follow one.
pub fn jobs_of(method: Method) -> Vec<&'static str> {
    let jobs = Job::LISTED.into_iter().filter(|(job, _)| job.offers(method)).map(|(_, name)| name);
    jobs.chain(method.knows_density().then_some("density")).collect()
}

/// A parameter's value where none is given, in words.
pub fn default_of(about: &About, default: Option<&Setting>) -> Option<String> {
    if about.default.is_empty() { default.map(ToString::to_string) } else { Some(about.default.into()) }
}

fn unit_of(unit: Unit) -> Option<&'static str> {
    match unit {
        Unit::None => None,
        Unit::Spacings => Some("spacings"),
        Unit::Input => Some("input"),
    }
}

/// All methods and what they can be told, as JSON.
pub fn registry() -> Value {
    let parameter = |(about, default): (About, Option<Setting>)| {
        let (kind, choices) = match about.kind {
            ParameterKind::Number => ("number", None),
            ParameterKind::Target => ("target", None),
            ParameterKind::Count => ("count", None),
            ParameterKind::Flag => ("flag", None),
            ParameterKind::Choice(choices) => ("choice", Some(choices.iter().map(|choice| choice.name).collect::<Vec<_>>())),
        };
        json!({ "name": about.name, "kind": kind, "unit": unit_of(about.unit), "choices": choices, "default": default_of(&about, default.as_ref()), "doc": about.doc })
    };
    let method = |method: Method| {
        let parameters: Vec<Value> = method.parameters().into_iter().map(parameter).collect();
        json!({ "name": method.name(), "title": method.title(), "paper": method.paper(), "jobs": jobs_of(method), "parameters": parameters })
    };
    Method::all().map(method).collect()
}
