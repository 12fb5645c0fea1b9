//! [`LocalMethod`]: a method as meshes are made by it. What it reads is a star, so it moves vertices on any mesh, in the plane or on a surface.

use std::fmt;
use std::sync::Arc;

use serde::ser::{Serialize, SerializeMap as _, Serializer};

use super::opt_beta::OptBetaParams;
use super::optimizer::{Optimizer, Optimizing};
use super::push_pull::PushPullParams;
use super::registry::Method;
use crate::error::Error;
use crate::parameter::Setting;
use crate::star::{Rule, Senses, Star};

/// How the vertices of a mesh are moved.
pub(crate) enum Local {
    /// By Push-Pull's moves, to one shortest distance and one largest circumradius, or to cells of one area.
    Targets(PushPullParams),
    /// By a rule, for so many passes.
    Passes(Box<dyn LocalRule>, usize),
    /// By rows, until the least ratio is reached.
    LeastRatio(OptBetaParams),
    /// Not at all.
    Stay,
}

/// A rule that does not look beyond the star, whichever it is.
pub(crate) trait LocalRule: Sync + Send {
    fn senses(&self) -> Senses;
    fn visit(&self, star: &mut Star) -> bool;
}

impl<R: Rule + Send> LocalRule for R {
    fn senses(&self) -> Senses {
        Rule::senses(self)
    }

    fn visit(&self, star: &mut Star) -> bool {
        Rule::visit(self, star)
    }
}

/// Any such rule is one.
pub(crate) struct ByRule<'a>(pub &'a dyn LocalRule);

impl Rule for ByRule<'_> {
    fn senses(&self) -> Senses {
        self.0.senses()
    }

    fn visit(&self, star: &mut Star) -> bool {
        self.0.visit(star)
    }
}

/// A method with its parameters, for the vertices of a mesh: of [`MeshParams`](crate::MeshParams) and [`RemeshParams`](crate::RemeshParams). The parameters of
/// a method become one, as in `LloydParams::default().into()`; [`Method::on_meshes`] makes one from settings.
#[derive(Clone)]
pub struct LocalMethod(Arc<dyn AnyLocal>);

/// A method that may be local, whatever its parameters are.
trait AnyLocal: Send + Sync {
    fn method(&self) -> Method;
    fn parameters(&self) -> Vec<(&'static str, Setting)>;
    fn seed(&self) -> Option<u64>;
    fn check(&self) -> Result<(), Error>;
    fn local(&self) -> Option<Local>;
}

impl<P: Optimizing> AnyLocal for P {
    fn method(&self) -> Method {
        Optimizer::method(self)
    }

    fn parameters(&self) -> Vec<(&'static str, Setting)> {
        Optimizer::parameters(self)
    }

    fn seed(&self) -> Option<u64> {
        Optimizer::seed(self)
    }

    fn check(&self) -> Result<(), Error> {
        Optimizing::check(self)
    }

    fn local(&self) -> Option<Local> {
        Optimizing::local(self)
    }
}

/// Vertices that stay where they began.
struct Staying(Method);

impl AnyLocal for Staying {
    fn method(&self) -> Method {
        self.0
    }

    fn parameters(&self) -> Vec<(&'static str, Setting)> {
        Vec::new()
    }

    fn seed(&self) -> Option<u64> {
        None
    }

    fn check(&self) -> Result<(), Error> {
        Ok(())
    }

    fn local(&self) -> Option<Local> {
        Some(Local::Stay)
    }
}

impl<P: Optimizing> From<P> for LocalMethod {
    fn from(params: P) -> Self {
        Self(Arc::new(params))
    }
}

impl LocalMethod {
    /// Vertices stay where a method that makes points has put them.
    pub(super) fn staying(method: Method) -> Self {
        Self(Arc::new(Staying(method)))
    }

    /// Which method it is.
    pub fn method(&self) -> Method {
        self.0.method()
    }

    /// The values of its parameters, by their names.
    pub fn parameters(&self) -> Vec<(&'static str, Setting)> {
        self.0.parameters()
    }

    /// The largest circumradius over the shortest distance that all triangles shall have, where it aims at both.
    pub fn beta(&self) -> Option<f64> {
        let [distance, radius] = self.lengths();
        Some(radius? / distance?)
    }

    /// The shortest distance and the largest circumradius that it aims at, in spacings.
    pub fn lengths(&self) -> [Option<f64>; 2] {
        match self.0.local() {
            Some(Local::Targets(targets)) => [targets.min_distance, targets.coverage_radius],
            _ => [None, None],
        }
    }

    /// Checks its parameters, and that it moves the vertices of meshes.
    ///
    /// # Errors
    /// [`Error::InvalidParameter`] as the method's parameters have it, and for a method that needs more than a star.
    pub fn check(&self) -> Result<(), Error> {
        self.0.check()?;
        if self.0.local().is_some() {
            return Ok(());
        }
        let expected = "one that reads a star alone: others need the plane, or all points at once";
        Err(Error::InvalidParameter { name: "method", value: self.method().name().into(), expected })
    }

    /// How it moves vertices; not at all where [`check`](Self::check) refuses it.
    pub(crate) fn local(&self) -> Local {
        self.0.local().unwrap_or(Local::Stay)
    }
}

impl PartialEq for LocalMethod {
    fn eq(&self, other: &Self) -> bool {
        self.method() == other.method() && self.parameters() == other.parameters() && self.0.seed() == other.0.seed()
    }
}

impl fmt::Debug for LocalMethod {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.debug_tuple(self.method().name()).field(&self.parameters()).finish()
    }
}

/// As `{"lloyd": {"iterations": 100, ...}}`.
impl Serialize for LocalMethod {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let parameters: std::collections::BTreeMap<_, _> = self.parameters().into_iter().collect();
        let mut map = serializer.serialize_map(Some(1))?;
        map.serialize_entry(self.method().name(), &parameters)?;
        map.end()
    }
}
