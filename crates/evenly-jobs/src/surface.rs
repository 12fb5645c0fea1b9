//! Surfaces as requests have them: welded, repaired, and where edges are to be shorter.

use std::fmt;

use evenly::{Attribute, Surface, SurfacePoint, SurfaceSizing, TriangleMesh, expected_vertices};
use serde::de::{self, Deserializer, Visitor};
use serde::ser::Serializer;
use serde::{Deserialize, Serialize};

use crate::error::Error;
use crate::message::Message;
use crate::resource::{Data, Resource, Resources, Triangles};

/// A length, or off.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OrOff(pub Option<f64>);

/// As a number or `"off"`.
impl Serialize for OrOff {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self.0 {
            Some(number) => serializer.serialize_f64(number),
            None => serializer.serialize_str("off"),
        }
    }
}

impl<'de> Deserialize<'de> for OrOff {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct NumberOrOff;

        impl Visitor<'_> for NumberOrOff {
            type Value = OrOff;

            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("a number, or \"off\"")
            }

            fn visit_f64<E: de::Error>(self, number: f64) -> Result<OrOff, E> {
                Ok(OrOff(Some(number)))
            }

            fn visit_u64<E: de::Error>(self, number: u64) -> Result<OrOff, E> {
                Ok(OrOff(Some(number as f64)))
            }

            fn visit_i64<E: de::Error>(self, number: i64) -> Result<OrOff, E> {
                Ok(OrOff(Some(number as f64)))
            }

            fn visit_str<E: de::Error>(self, text: &str) -> Result<OrOff, E> {
                if text == "off" { Ok(OrOff(None)) } else { Err(E::invalid_value(de::Unexpected::Str(text), &self)) }
            }
        }

        deserializer.deserialize_any(NumberOrOff)
    }
}

/// A number for each vertex of the mesh: lengths, in proportion.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(transparent)]
pub struct Sizing(pub Vec<f64>);

/// Words are `curvature[:error]`, `lfs`, `linear:axis,ratio`, `attr:NAME`, or the name of numbers.
impl Data for Sizing {
    type Made = SurfaceSizing;
    const CALLED: &'static str = "density";

    fn find(resources: &mut dyn Resources, words: &str) -> Result<SurfaceSizing, Error> {
        let told = |what: &str| Message::default().setting("density", words).text(format!(": {what}"));
        if is_resource(words) {
            return resources.numbers(words).map(SurfaceSizing::Given).map_err(|error| told(&error.to_string()).into());
        }
        let (name, value) = words.split_once(':').map_or((words, None), |(name, value)| (name, Some(value)));
        let number = |text: &str| text.parse::<f64>().map_err(|_| told(&format!("{text:?} is no number")));
        Ok(match (name, value) {
            ("curvature", error) => SurfaceSizing::Curvature { error: error.map(number).transpose()? },
            ("lfs", None) => SurfaceSizing::FeatureSize,
            ("linear", Some(value)) => {
                let parts = value.split_once(',').and_then(|(axis, ratio)| Some(("xyz".find(axis).filter(|_| axis.len() == 1)?, ratio)));
                let (axis, ratio) = parts.ok_or_else(|| told("it must be linear:axis,ratio, as linear:z,4"))?;
                SurfaceSizing::Linear { axis, ratio: number(ratio)? }
            }
            ("attr", Some(name)) => SurfaceSizing::Attribute(name.to_owned()),
            _ => return Err(told("it must be curvature[:error], lfs, linear:axis,ratio, attr:NAME, or a file").into()),
        })
    }

    fn make(&self) -> Result<SurfaceSizing, Error> {
        Ok(SurfaceSizing::Given(self.0.clone()))
    }
}

/// Whether words for a density on a surface name numbers.
pub fn is_resource(words: &str) -> bool {
    !["curvature", "lfs", "linear", "attr"].contains(&words.split(':').next().unwrap_or(words))
}

/// A surface, and what was done to it.
pub struct Prepared {
    /// The surface.
    pub surface: Surface,
    /// What the user should know of it.
    pub notes: Vec<Message>,
}

/// Whether a mesh is mended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Repair {
    Never,
    /// Where there is no other way.
    Needed,
    Always,
}

impl Prepared {
    /// The surface of a mesh, welded and repaired as it is asked for.
    pub(crate) fn new(mesh: &Resource<Triangles>, weld: Option<f64>, repair: Repair, resources: &mut dyn Resources) -> Result<Self, Error> {
        let read = mesh.get(resources)?;
        let mut notes: Vec<Message> = read.notes.into_iter().map(Message::from).collect();
        let welded = welded(read.mesh, weld, &mut notes)?;
        let surface = match surface_of(&welded, mesh.called(), repair == Repair::Always) {
            Err(Error::Repairable { .. }) if repair == Repair::Needed => surface_of(&welded, mesh.called(), true)?,
            surface => surface?,
        };
        notes.extend(notes_on(&surface));
        Ok(Self { surface, notes })
    }
}

/// The surface of a mesh.
///
/// # Errors
/// As [`Surface::new`], with the mesh's name; [`Error::Repairable`] where it can be repaired.
pub fn surface_of(mesh: &TriangleMesh, name: &str, is_repaired: bool) -> Result<Surface, Error> {
    let surface = if is_repaired { Surface::repaired(mesh) } else { Surface::new(mesh) };
    surface.map_err(|error| {
        let name = name.to_owned();
        // Where another way leads on it is said.
        if !is_repaired && Surface::repaired(mesh).is_ok() { Error::Repairable { name, error } } else { Error::Data { name, error } }
    })
}

/// The mesh with corners welded that lie within a tolerance, if there is one.
fn welded(mesh: TriangleMesh, tolerance: Option<f64>, notes: &mut Vec<Message>) -> Result<TriangleMesh, Error> {
    let Some(tolerance) = tolerance else { return Ok(mesh) };
    if !(tolerance > 0.0 && tolerance.is_finite()) {
        return Err(Error::invalid("weld", tolerance, "positive and finite"));
    }
    let (mesh, n) = mesh.welded(tolerance);
    notes.push(format!("{n} vertices within {tolerance} of another were put to its place").into());
    Ok(mesh)
}

/// What was done to a surface, and what else there is to say of it.
fn notes_on(surface: &Surface) -> Vec<Message> {
    let seams = surface.near_boundaries().map(|(n, distance)| {
        let near = Message::from(format!("{n} boundary vertices lie within {distance:.1e} of another one; if they should be one, "));
        near.setting("weld", format!("{:.0e}", 10.0 * distance)).text(" joins them")
    });
    surface.notes().iter().cloned().map(Message::from).chain(seams).collect()
}

/// What points know of the surface: facet, barycentric coordinates, normal.
pub fn place_attributes(places: &[SurfacePoint]) -> Vec<Attribute> {
    let column = |name: &str, of: &dyn Fn(&SurfacePoint) -> f64| Attribute { name: name.into(), values: places.iter().map(of).collect() };
    vec![
        column("nx", &|place| place.normal[0]),
        column("ny", &|place| place.normal[1]),
        column("nz", &|place| place.normal[2]),
        column("facet", &|place| place.facet as f64),
        column("bary0", &|place| place.barycentric[0]),
        column("bary1", &|place| place.barycentric[1]),
        column("bary2", &|place| place.barycentric[2]),
    ]
}

/// How many points are asked for, by their number or by a length, which is that parameter's.
pub(crate) fn number_of(surface: &Surface, n: Option<usize>, parameter: &'static str, length: Option<f64>) -> Result<Option<usize>, Error> {
    if let Some(length) = length.filter(|&length| !(length > 0.0 && length.is_finite())) {
        return Err(Error::invalid(parameter, length, "positive and finite"));
    }
    let of_length = |length: f64| (expected_vertices(surface, &vec![length; surface.n_vertices()]).round() as usize).max(4);
    Ok(n.or(length.map(of_length)))
}
