//! [`MeshRequest`]: triangles in a polygon.

mod details;
mod sizes;
mod unmet;

use evenly::{
    LocalMethod, Mesh, MeshParams, MeshQuality, MeshRegion, Method, Outcome, Polygon, Report, Setting, Settings, angle_bounds_deg,
    expected_triangles, mesh, mesh_quality, triangle_count, triangle_side,
};
use serde::{Deserialize, Serialize};
use serde_json::Value;

use self::sizes::Sizes;
pub use self::unmet::UnmetAngle;
use self::unmet::{forced, unmet};
use crate::context::{Context, Stage};
use crate::error::Error;
use crate::message::Message;
use crate::method::{Job, check_on_meshes, on_meshes};
use crate::points::Ending;
use crate::resource::{Data as _, Lengths, Lines, Pixels, Positions, Regions, Resource, Resources, Rings, called};

/// Triangles in a polygon. Its size is an `edge_length` or a number of triangles.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(default, deny_unknown_fields)]
pub struct MeshRequest {
    /// The polygon; what the regions cover together if there is none.
    pub polygon: Option<Resource<Rings>>,
    /// Parts of it that are kept apart.
    pub regions: Option<Resource<Regions>>,
    /// The wanted length of edges, in the polygon's units.
    pub edge_length: Option<f64>,
    /// About how many triangles, instead.
    pub n_triangles: Option<usize>,
    /// Fewer corners first: no place of the boundary goes farther than this, in the polygon's units.
    pub simplify: Option<f64>,
    /// The same seed makes the same mesh.
    pub seed: u64,
    /// How points find their places.
    #[cfg_attr(test, schemars(with = "crate::schema::MethodName"))]
    pub method: Method,
    /// What the method is told.
    #[cfg_attr(test, schemars(with = "crate::schema::Parameters"))]
    pub parameters: Settings,
    /// Edges grow away from the boundary, by so much a length.
    pub grade: Option<f64>,
    /// The longest edges wanted, where they grow.
    pub max_edge_length: Option<f64>,
    /// Wanted lengths of edges at points.
    pub sizes: Option<Resource<Lengths>>,
    /// How many vertices are wanted where.
    pub density: Option<Resource<Pixels>>,
    /// No angle shall be smaller, in degrees.
    pub min_angle: Option<f64>,
    /// No triangle shall be obtuse.
    pub no_obtuse: bool,
    /// Points that become vertices.
    pub fixed: Option<Resource<Positions>>,
    /// Lines that become edges.
    pub lines: Option<Resource<Lines>>,
}

/// A mesh, and how it came about.
pub struct MeshOutcome {
    /// The mesh.
    pub mesh: Mesh,
    /// The polygon, as it was given.
    pub polygon: Polygon,
    /// How the mesh came about.
    pub report: Report,
    /// What the user should know.
    pub notes: Vec<Message>,
    /// What was asked of the library.
    pub parameters: Value,
    /// No angle is to be smaller, in degrees.
    least_angle_deg: f64,
    is_non_obtuse: bool,
}

/// What a mesh is worth.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MeshMeasured {
    /// Of its triangles.
    pub quality: MeshQuality,
    /// Where demands were not met, the worst first.
    pub unmet: Vec<UnmetAngle>,
    /// What the polygon forces.
    pub notes: Vec<Message>,
}

/// Parameters of the library that have another name here.
const NAMES: [(&str, &str); 2] = [("growth", "grade"), ("min_angle_deg", "min_angle")];
/// What sets the lengths that push-pull aims at.
const LENGTHS: [&str; 3] = ["preset", "min_distance", "coverage_radius"];
/// No angle is to be smaller, if nothing else is said, in degrees.
const LEAST_ANGLE_DEG: f64 = 25.0;
/// The spacing for so many triangles is no more than so many times that without details.
const LARGEST: f64 = 3.0;
/// Corners nearer to each other than this part of the spacing are joined.
const WELDED: f64 = 1e-6;
/// A spacing for so many triangles is found in so many steps.
const ESTIMATES: usize = 4;
/// Or until a step changes it by less than this part.
const SETTLED: f64 = 1e-3;

impl MeshRequest {
    /// Checks what can be checked without data.
    ///
    /// # Errors
    /// Sizes and parts that do not go together, and what the method is told wrongly.
    pub fn check(&self) -> Result<(), Error> {
        Job::Mesh.require("method", self.method)?;
        check_on_meshes(self.method, &self.parameters)?;
        if self.edge_length.is_some() == self.n_triangles.is_some() {
            let either = Message::from("give either ").name("edge_length").text(" or ").name("n_triangles");
            return Err(either.into());
        }
        if self.max_edge_length.is_some() && self.grade.is_none() {
            return Err(Message::default()
                .name("max_edge_length")
                .text(" is for edges that grow: give ")
                .name("grade")
                .text(" too")
                .into());
        }
        if self.regions.is_some() && self.simplify.is_some() {
            let would = Message::default().name("simplify").text(" would part regions that touch; simplify them before, or leave out ");
            return Err(would.name("regions").into());
        }
        if self.polygon.is_none() && self.regions.is_none() {
            return Err(Message::from("give a polygon, or ").name("regions").into());
        }
        Ok(())
    }

    /// Makes the mesh.
    ///
    /// # Errors
    /// As [`check`](Self::check), for data that cannot be worked with, and as [`mesh`].
    pub fn run(&self, resources: &mut dyn Resources, context: &mut Context) -> Result<MeshOutcome, Error> {
        self.check()?;
        context.enter(Stage::Read);
        let (polygon, regions) = self.shape(resources)?;
        let fixed = self.fixed.as_ref().map_or(Ok(Vec::new()), |fixed| fixed.get(resources))?;
        let lines = self.lines.as_ref().map_or(Ok(Vec::new()), |lines| lines.get(resources))?;
        let sizes = self.sizes.as_ref().map(|sizes| sizes.get(resources)).transpose()?;
        let density = self.density.as_ref().map(|density| density.get(resources)).transpose()?;

        let of_triangles = |n: usize| triangle_side(polygon.area(), n as f64);
        let mut edge_length = self.edge_length.unwrap_or_else(|| of_triangles(self.n_triangles.unwrap_or(1)));
        let mut notes = Vec::new();
        polygon.repairs().iter().for_each(|repair| context.note(&mut notes, repair.clone().into()));
        let own = self.simplified(&polygon, edge_length, &mut notes, context)?;
        let growth = self.grade.unwrap_or(MeshParams::new(edge_length).growth);
        let sizes = Sizes::new(sizes, density, &own, growth)?;
        let is_uniform = sizes.is_none() && self.grade.is_none();
        let wanted = |edge_length: f64| sizes.as_ref().map(|sizes| move |place: [f64; 2]| sizes.at(place, edge_length));
        let params_of = |edge_length: f64| MeshParams {
            growth,
            max_edge_length: match (self.grade, self.max_edge_length) {
                (None, _) => sizes.as_ref().map(|sizes| sizes.largest(edge_length).max(edge_length)),
                (Some(_), Some(largest)) => Some(largest),
                // As far as it grows.
                (Some(_), None) => Some(edge_length.max(own.area().sqrt())),
            },
            is_non_obtuse: self.no_obtuse,
            min_angle_deg: self.min_angle,
            fixed: fixed.clone(),
            lines: lines.clone(),
            regions: regions.clone(),
            seed: self.seed,
            ..MeshParams::new(edge_length)
        };
        params_of(edge_length).validate().map_err(|error| self.named(error))?;
        if let Some(n_triangles) = self.n_triangles {
            for _ in 0..ESTIMATES {
                let wanted = wanted(edge_length);
                let params = MeshParams { wanted: wanted.as_ref().map(|wanted| wanted as _), ..params_of(edge_length) };
                let expected = expected_triangles(&own, &params).map_err(|error| self.named(error))?;
                // Where details take most of them, larger triangles elsewhere save little.
                let before = edge_length;
                edge_length = (edge_length * (expected / n_triangles as f64).sqrt()).min(LARGEST * of_triangles(n_triangles));
                if (edge_length / before - 1.0).abs() < SETTLED {
                    break;
                }
            }
        }
        let method = self.local_method(is_uniform.then_some(edge_length))?;
        let wanted = wanted(edge_length);
        let params = MeshParams { wanted: wanted.as_ref().map(|wanted| wanted as _), method: method.clone(), ..params_of(edge_length) };
        let (mesh, report) = context.run(|run| mesh(&own, &params, run)).map_err(|error| self.named(error))?;
        notes.extend(report.notes.iter().cloned().map(Message::from));
        if self.grade.is_none() && params.wanted.is_none() && report.outcome != Outcome::Cancelled {
            let wanted = self.n_triangles.map_or_else(|| triangle_count(own.area(), edge_length), |n| n as f64);
            notes.extend(details::told(&own, &params, mesh.triangles.len() - mesh.n_in_corners, wanted));
        }
        let least_angle_deg = self.min_angle.or(self.implied_angle_deg(method.as_ref())).unwrap_or(LEAST_ANGLE_DEG);
        let parameters = serde_json::json!(params);
        Ok(MeshOutcome { mesh, report, notes, parameters, least_angle_deg, is_non_obtuse: self.no_obtuse, polygon })
    }

    /// The polygon, and its parts that are kept apart.
    fn shape(&self, resources: &mut dyn Resources) -> Result<(Polygon, Vec<MeshRegion>), Error> {
        let Some(regions) = &self.regions else {
            let polygon = self.polygon.as_ref().ok_or_else(|| Message::from("give a polygon"))?;
            return Ok((polygon.get(resources)?, Vec::new()));
        };
        let (whole, regions) = regions.get(resources)?;
        let polygon = self.polygon.as_ref().map(|polygon| polygon.get(resources)).transpose()?;
        let regions = regions.into_iter().map(|(name, polygon)| MeshRegion { name, polygon }).collect();
        Ok((polygon.unwrap_or(whole), regions))
    }

    /// The polygon without what is not wanted of its corners.
    fn simplified(&self, polygon: &Polygon, edge_length: f64, notes: &mut Vec<Message>, context: &mut Context) -> Result<Polygon, Error> {
        let n_repairs = polygon.repairs().len();
        let corners = |polygon: &Polygon| polygon.rings().iter().map(Vec::len).sum::<usize>();
        let mut own = polygon.clone();
        if let Some(tolerance) = self.simplify {
            own = own.simplified(tolerance).map_err(|error| self.named(error))?;
            context.note(notes, format!("simplified: {} corners instead of {}", corners(&own), corners(polygon)).into());
        }
        if edge_length > 0.0 && edge_length.is_finite() {
            own = own.welded(WELDED * edge_length).map_err(|error| self.named(error))?;
        }
        own.repairs()[n_repairs..].iter().for_each(|repair| context.note(notes, repair.clone().into()));
        Ok(own)
    }

    /// The library's error, with what is to blame.
    fn named(&self, error: evenly::Error) -> Error {
        let data = match error {
            evenly::Error::NotInside { what: "fixed point", .. } => called(self.fixed.as_ref()),
            evenly::Error::NotInside { .. } => called(self.lines.as_ref()),
            _ => self.polygon.as_ref().map_or_else(|| self.regions.as_ref().map_or(Rings::CALLED, Resource::called), Resource::called),
        };
        Error::of(error, data, &NAMES)
    }

    /// The method with its parameters; `None` where nothing is said of push-pull: its targets then suit the demands.
    fn local_method(&self, edge_length: Option<f64>) -> Result<Option<LocalMethod>, Error> {
        let is_default = self.method == Method::default() && !LENGTHS.iter().any(|name| self.parameters.get(name).is_some());
        if is_default && self.parameters.is_empty() {
            return Ok(None);
        }
        let usual = if is_default { MeshParams::usual_targets(self.no_obtuse) } else { Settings::default() };
        on_meshes(self.method, &self.parameters, &usual, edge_length, self.seed).map(Some)
    }

    /// The smallest angle that targets imply that were given, in degrees.
    fn implied_angle_deg(&self, method: Option<&LocalMethod>) -> Option<f64> {
        let of_lengths = method?.beta().filter(|_| LENGTHS.iter().any(|name| self.parameters.get(name).is_some()));
        let beta = match self.parameters.get("beta") {
            Some(Setting::Number(beta)) => Some(*beta),
            Some(Setting::Count(beta)) => Some(*beta as f64),
            _ => of_lengths,
        };
        angle_bounds_deg(beta?).map(|[least, _]| least)
    }
}

impl MeshOutcome {
    /// Measures the mesh, and looks where it is not as it was to be.
    pub fn measured(&self) -> MeshMeasured {
        MeshMeasured {
            quality: mesh_quality(&self.mesh),
            unmet: unmet(&self.mesh, self.least_angle_deg, self.is_non_obtuse),
            notes: forced(&self.mesh, self.least_angle_deg).into_iter().map(Message::from).collect(),
        }
    }

    /// How the job ended.
    pub fn ending(&self, measured: Option<&MeshMeasured>) -> Ending {
        match measured {
            _ if self.report.outcome == Outcome::Cancelled => Ending::Cancelled,
            Some(measured) if !measured.unmet.is_empty() => Ending::Missed,
            _ => Ending::Done,
        }
    }
}
