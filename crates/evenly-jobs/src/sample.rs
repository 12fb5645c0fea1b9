//! [`SampleRequest`]: points on a surface.

use evenly::{
    Method, Outcome, Report, SampleParams, Settings, SurfacePoint, SurfaceSampling, sample_surface, surface_sizes, triangle_side,
};
use serde::{Deserialize, Serialize};

use crate::context::{Context, Event, Stage};
use crate::error::Error;
use crate::memory;
use crate::message::Message;
use crate::method::{Job, POISSON_DISK, WHITE, check_on_meshes, on_meshes};
use crate::points::Ending;
use crate::resource::{Resource, Resources, Triangles};
use crate::surface::{Prepared, Repair, Sizing, number_of};

/// Points on a surface: a number of them, or a spacing.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct SampleRequest {
    /// The mesh on which they lie.
    pub mesh: Resource<Triangles>,
    /// How many, exactly; of `poisson-disk` about.
    #[serde(default)]
    pub n_points: Option<usize>,
    /// The smallest distance of two points, for `poisson-disk`; else their usual one; in the mesh's units.
    #[serde(default)]
    pub spacing: Option<f64>,
    /// How they are spread.
    #[serde(default)]
    #[cfg_attr(test, schemars(with = "crate::schema::MethodName"))]
    pub method: Method,
    /// What the method is told.
    #[serde(default)]
    #[cfg_attr(test, schemars(with = "crate::schema::Parameters"))]
    pub parameters: Settings,
    /// Points nearer to each other here and there.
    #[serde(default)]
    pub density: Option<Resource<Sizing>>,
    /// The same seed makes the same points.
    #[serde(default)]
    pub seed: u64,
    /// Mend the mesh; done in any case where there is no other way.
    #[serde(default)]
    pub repair: bool,
    /// Make one of corners that lie within this distance of each other, in the mesh's units.
    #[serde(default)]
    pub weld: Option<f64>,
}

/// Points on a surface, and how they came about.
pub struct SampleOutcome {
    /// The points.
    pub points: Vec<SurfacePoint>,
    /// How they came about.
    pub report: Report,
    /// What the user should know.
    pub notes: Vec<Message>,
    /// Of the surface, in the mesh's units squared.
    pub area: f64,
}

/// Parameters of the library that have another name here.
const NAMES: [(&str, &str); 4] =
    [("error", "density curvature"), ("sizes", "density"), ("linear", "density linear"), ("attr", "density attr")];

impl SampleRequest {
    /// The same with the defaults.
    pub fn of(mesh: Resource<Triangles>) -> Self {
        Self {
            mesh,
            n_points: None,
            spacing: None,
            method: Method::default(),
            parameters: Settings::default(),
            density: None,
            seed: 0,
            repair: false,
            weld: None,
        }
    }

    /// Checks what can be checked without data.
    ///
    /// # Errors
    /// Sizes that do not go together, and what the method is told wrongly.
    pub fn check(&self) -> Result<(), Error> {
        Job::Sample.require("method", self.method)?;
        if self.n_points.is_some() == self.spacing.is_some() {
            return Err(Message::from("give either ").name("n_points").text(" or ").name("spacing").into());
        }
        if self.method.is_local() {
            check_on_meshes(self.method, &self.parameters)
        } else {
            Job::Sample.require_taken(&self.parameters, &[])
        }
    }

    /// Spreads the points.
    ///
    /// # Errors
    /// As [`check`](Self::check), for data that cannot be worked with, and as [`sample_surface`].
    pub fn run(&self, resources: &mut dyn Resources, context: &mut Context) -> Result<SampleOutcome, Error> {
        self.check()?;
        context.enter(Stage::Read);
        // Points need no manifold.
        let repair = if self.repair { Repair::Always } else { Repair::Needed };
        let Prepared { surface, mut notes } = Prepared::new(&self.mesh, self.weld, repair, resources)?;
        notes.iter().for_each(|note| context.tell(Event::Note(note)));
        let named = |error| Error::of(error, self.mesh.called(), &NAMES);
        let sizing = self.density.as_ref().map(|density| density.get(resources)).transpose()?;
        let n_points = number_of(&surface, self.n_points, "spacing", self.spacing)?.unwrap_or_default();
        memory::require_vertices(n_points)?;
        let side = triangle_side(surface.area(), 2.0 * n_points as f64);
        let method = || on_meshes(self.method, &self.parameters, &Settings::default(), sizing.is_none().then_some(side), self.seed);
        let sampling = match (self.method.name(), self.spacing) {
            (WHITE, _) => SurfaceSampling::White(n_points),
            (POISSON_DISK, Some(spacing)) => SurfaceSampling::PoissonDisk(spacing),
            (POISSON_DISK, None) => SurfaceSampling::poisson_disk_of(&surface, n_points),
            _ => SurfaceSampling::Vertices(n_points, method()?),
        };
        let sizes = sizing.map_or(Ok(Vec::new()), |sizing| surface_sizes(&surface, &sizing, Some(n_points))).map_err(named)?;
        let params = SampleParams { sampling, sizes, seed: self.seed };
        let (points, report) = context.run(|run| sample_surface(&surface, &params, run)).map_err(named)?;
        notes.extend(report.notes.iter().cloned().map(Message::from));
        Ok(SampleOutcome { points, report, notes, area: surface.area() })
    }
}

impl SampleOutcome {
    /// How the job ended.
    pub fn ending(&self) -> Ending {
        match self.report.outcome {
            Outcome::Cancelled => Ending::Cancelled,
            Outcome::IterationLimit => Ending::Missed,
            _ => Ending::Done,
        }
    }
}
