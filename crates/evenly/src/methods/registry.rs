//! The registry: every method that there is. A new one is a file of its own, with an entry, and a line here; the command line, its
//! help, Python, the docs and the tables of laws in the tests go through this list.

use std::fmt;

use serde::de::{self, Deserializer};
use serde::ser::Serializer;
use serde::{Deserialize, Serialize};

use super::local::LocalMethod;
use super::optimizer::{AnyOptimizer, Optimizer, Optimizing};
use super::{
    CapacityParams, CvtParams, DistMeshParams, FarthestPointParams, LloydParams, OptBetaParams, ProcrustesParams, PushPullParams, Warp,
    WellSpacedParams,
};
use crate::density::Density;
use crate::error::Error;
use crate::parameter::{About, AnyEntry, Setting, Settings, Unit};
use crate::points::{AnyStart, Dart, Eliminate, Hexagonal, Jittered, PointSet, PoissonDisk, Starting, Told, White, around};
use crate::space::Space;

/// Methods that improve points.
const OPTIMIZERS: &[&dyn AnyOptimizer] = &[
    ProcrustesParams::ENTRY,
    PushPullParams::ENTRY,
    WellSpacedParams::ENTRY,
    OptBetaParams::ENTRY,
    LloydParams::ENTRY,
    CvtParams::ENTRY,
    FarthestPointParams::ENTRY,
    DistMeshParams::ENTRY,
    CapacityParams::ENTRY,
    Warp::ENTRY,
];

/// Methods that make points.
const STARTS: &[&dyn AnyStart] = &[PoissonDisk::ENTRY, Dart::ENTRY, Eliminate::ENTRY, White::ENTRY, Jittered::ENTRY, Hexagonal::ENTRY];

/// The one that all begin with by a density in a polygon, where it is the evenest.
const BY_DENSITY_IN_POLYGONS: &str = "eliminate";

/// A method of the registry.
#[derive(Clone, Copy)]
pub struct Method(Kind);

#[derive(Clone, Copy)]
enum Kind {
    Optimizer(&'static dyn AnyOptimizer),
    Start(&'static dyn AnyStart),
}

impl PartialEq for Method {
    fn eq(&self, other: &Self) -> bool {
        self.name() == other.name()
    }
}

impl Eq for Method {}

/// The method where none is asked for: Push-Pull.
impl Default for Method {
    fn default() -> Self {
        Self(Kind::Optimizer(PushPullParams::ENTRY))
    }
}

impl fmt::Debug for Method {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl fmt::Display for Method {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// By its name.
impl Serialize for Method {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.name())
    }
}

impl<'de> Deserialize<'de> for Method {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let name = String::deserialize(deserializer)?;
        let unknown = || {
            let names: Vec<&str> = Self::all().map(|method| method.name()).collect();
            de::Error::custom(format!("there is no method {name:?}; there are {}", names.join(", ")))
        };
        Self::named(&name).ok_or_else(unknown)
    }
}

impl Method {
    /// All methods: those that improve points, then those that make some.
    pub fn all() -> impl Iterator<Item = Self> {
        let optimizers = OPTIMIZERS.iter().map(|&entry| Kind::Optimizer(entry));
        optimizers.chain(STARTS.iter().map(|&entry| Kind::Start(entry))).map(Self)
    }

    /// The method of this name.
    pub fn named(name: &str) -> Option<Self> {
        Self::all().find(|method| method.name() == name)
    }

    pub(crate) fn of_optimizer(entry: &'static dyn AnyOptimizer) -> Self {
        Self(Kind::Optimizer(entry))
    }

    fn entry(&self) -> &'static dyn AnyEntry {
        match self.0 {
            Kind::Optimizer(entry) => entry,
            Kind::Start(entry) => entry,
        }
    }

    /// Its name, the same everywhere.
    pub fn name(&self) -> &'static str {
        self.entry().name()
    }

    /// What it does, in a line.
    pub fn title(&self) -> &'static str {
        self.entry().title()
    }

    /// Authors, year and doi of what it is from; empty where there is none.
    pub fn paper(&self) -> &'static str {
        self.entry().paper()
    }

    /// Its parameters, each with its value where none is given; `None` for one that is found on the way.
    pub fn parameters(&self) -> Vec<(About, Option<Setting>)> {
        self.entry().parameters()
    }

    /// Whether it has a parameter of this name.
    pub fn takes(&self, parameter: &str) -> bool {
        self.parameters().iter().any(|(about, _)| about.name == parameter)
    }

    /// Of some settings those that it takes.
    pub fn own(&self, settings: &Settings) -> Settings {
        let names: Vec<&str> = settings.names().filter(|name| self.takes(name)).collect();
        let taken = names.into_iter().filter_map(|name| Some((name, settings.get(name)?)));
        taken.fold(Settings::default(), |taken, (name, value)| taken.with(name, value.clone()))
    }

    /// The same settings with lengths in input units as what the parameters count, where a spacing is so long.
    ///
    /// # Errors
    /// [`Error::InvalidParameter`] for a length where none is counted.
    pub fn in_spacings(&self, settings: &Settings, spacing: f64) -> Result<Settings, Error> {
        let unit =
            |name: &str| self.parameters().into_iter().find(|(about, _)| about.name == name).map(|(about, _)| (about.name, about.unit));
        settings.names().try_fold(settings.clone(), |all, name| match (settings.get(name), unit(name)) {
            (Some(Setting::Length(length)), Some((_, Unit::Spacings))) => Ok(all.with(name, Setting::Number(length / spacing))),
            (Some(Setting::Length(length)), Some((_, Unit::Input))) => Ok(all.with(name, Setting::Number(*length))),
            (Some(value @ Setting::Length(_)), Some((name, Unit::None))) => {
                Err(Error::InvalidParameter { name, value: value.to_string(), expected: "a number alone: it counts no lengths" })
            }
            _ => Ok(all),
        })
    }

    /// Whether its points follow a density.
    pub fn knows_density(&self) -> bool {
        self.entry().knows_density()
    }

    /// Whether it improves points.
    pub fn is_optimizer(&self) -> bool {
        matches!(self.0, Kind::Optimizer(_))
    }

    /// Whether it makes points that an optimiser can begin with.
    pub fn is_start(&self) -> bool {
        matches!(self.0, Kind::Start(_))
    }

    /// Whether it takes this space.
    pub fn takes_space(&self, space: &Space) -> bool {
        match self.0 {
            Kind::Optimizer(_) => space.region().is_none() || self.name() != Warp::ENTRY.name,
            Kind::Start(entry) => space.region().is_none() || entry.takes_polygons(),
        }
    }

    /// Whether its points, as a start, have long density waves, which warping takes out.
    pub fn has_long_waves(&self) -> bool {
        matches!(self.0, Kind::Start(entry) if entry.has_long_waves())
    }

    /// Whether it holds more than the points themselves in memory: a triangulation, or many candidates for each.
    pub fn holds_much(&self) -> bool {
        match self.0 {
            Kind::Optimizer(_) => true,
            Kind::Start(entry) => entry.holds_candidates(),
        }
    }

    /// What evens out points before it; `None` for one that takes them as they are.
    pub fn warp(&self) -> Option<fn(&mut PointSet)> {
        match self.0 {
            Kind::Optimizer(entry) => entry.warp(),
            Kind::Start(_) => None,
        }
    }

    /// Whether points are evened out before it, by a density or without.
    pub fn is_warped_first(&self) -> bool {
        self.is_optimizer() && self.name() != Warp::ENTRY.name && (self.warp().is_some() || self.knows_density())
    }

    /// The method that makes the points to begin with, unless another is asked for.
    pub fn default_start(&self, space: &Space, has_density: bool) -> Self {
        let [anywhere, in_polygons] = match self.0 {
            Kind::Optimizer(entry) => entry.start(),
            Kind::Start(entry) => [entry.name(); 2],
        };
        let name = match space {
            Space::Polygon(_) if has_density => BY_DENSITY_IN_POLYGONS,
            Space::Polygon(_) => in_polygons,
            _ => anywhere,
        };
        Self::named(name).unwrap_or(Self(Kind::Start(White::ENTRY)))
    }

    /// The method with its parameters; `None` for one that makes points.
    ///
    /// # Errors
    /// [`Error::UnknownParameter`] for one that it does not have, [`Error::InvalidParameter`] for a value outside its range.
    pub fn optimizer(&self, settings: &Settings, seed: u64) -> Result<Option<Box<dyn Optimizer>>, Error> {
        match self.0 {
            Kind::Optimizer(entry) => entry.optimizer(settings, seed).map(Some),
            Kind::Start(entry) => entry.check(settings).map(|()| None),
        }
    }

    /// Whether it moves the vertices of meshes, in the plane and on surfaces: whether all that it reads is a star.
    pub fn is_local(&self) -> bool {
        match self.0 {
            Kind::Optimizer(entry) => entry.is_local(),
            Kind::Start(entry) => entry.name() == Eliminate::ENTRY.name,
        }
    }

    /// The method with its parameters, for the vertices of a mesh. Those of a method that makes points stay where they begin.
    ///
    /// # Errors
    /// As [`optimizer`](Self::optimizer), and [`Error::InvalidParameter`] for a method that is not local.
    pub fn on_meshes(&self, settings: &Settings, seed: u64) -> Result<LocalMethod, Error> {
        match self.0 {
            Kind::Optimizer(entry) => entry.on_meshes(settings, seed),
            Kind::Start(entry) => entry.check(settings).map(|()| LocalMethod::staying(*self)),
        }
    }

    /// Exactly so many points for an optimiser to begin with, in the space and by the density of points that stay, which are among them and come first.
    ///
    /// # Errors
    /// [`Error::NoStart`] for a method that improves points; [`Error::InvalidParameter`] for fewer points than stay; and as the method's own function.
    pub fn start(&self, fixed: &PointSet, n_points: usize, seed: u64) -> Result<PointSet, Error> {
        around(self.as_start()?, fixed, n_points, seed)
    }

    /// The same where no points stay.
    ///
    /// # Errors
    /// As [`start`](Self::start).
    pub fn start_in(&self, space: &Space, density: &Density, n_points: usize, seed: u64) -> Result<PointSet, Error> {
        self.as_start()?.exactly(space, density, n_points, seed)
    }

    /// Points as the settings ask for them, and what should be known of them; of some methods their number is chance.
    ///
    /// # Errors
    /// As [`start`](Self::start) and [`optimizer`](Self::optimizer); [`Error::Missing`] and [`Error::Excluded`] for parameters that do not go together.
    pub fn make(&self, settings: &Settings, fixed: &PointSet, n_points: Option<usize>, seed: u64) -> Result<Told, Error> {
        let start = self.as_start()?;
        if let Some(told) = start.make(settings, fixed, n_points, seed)? {
            return Ok(told);
        }
        let n_points = n_points.ok_or(Error::Missing { names: &["n_points"], question: "how many?" })?;
        Ok((around(start, fixed, n_points, seed)?, None))
    }

    fn as_start(&self) -> Result<&'static dyn AnyStart, Error> {
        match self.0 {
            Kind::Start(entry) => Ok(entry),
            Kind::Optimizer(entry) => Err(Error::NoStart { method: entry.name() }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::parameter::ParameterKind;

    #[test]
    fn names_are_distinct_and_every_parameter_is_told_and_can_be_set_to_its_default() {
        for method in Method::all() {
            assert_eq!(Method::all().filter(|other| *other == method).count(), 1, "{method}");
            assert!(!method.title().is_empty() && !method.title().ends_with('.'), "{method}");
            for (about, default) in method.parameters() {
                assert!(!about.doc.is_empty() && !about.doc.ends_with('.'), "{method} {}", about.name);
                assert_eq!(method.parameters().iter().filter(|(other, _)| other.name == about.name).count(), 1);
                let is_valued = !matches!(about.kind, ParameterKind::Flag | ParameterKind::Choice(_));
                assert_eq!(is_valued, !about.symbol.is_empty(), "{method} {}", about.name);
                if let Some(value) = default {
                    let settings = Settings::default().with(about.name, value);
                    assert!(method.optimizer(&settings, 0).is_ok(), "{method} {}", about.name);
                }
            }
        }
    }

    #[test]
    fn what_a_method_does_not_have_is_refused() {
        let settings = Settings::default().with("colour", Setting::On);
        for method in Method::all() {
            let refused = Error::UnknownParameter { name: "colour".into(), method: method.name() };
            assert_eq!(method.optimizer(&settings, 0).err(), Some(refused));
            assert_eq!(method.own(&settings), Settings::default());
        }
    }

    #[test]
    fn every_default_start_is_one() {
        let torus: Space = crate::space::Torus::new([0.0; 2], [1.0; 2]).unwrap().into();
        assert!(Method::all().all(|method| method.default_start(&torus, false).is_start()));
    }
}
