//! `evenly analyze`: the proof.

use std::path::PathBuf;

use anyhow::{Context as _, bail};
use evenly::{
    Measures, PointSet, PowerSpectrum, RadialSpectrum, differential_spectrum, local_spacings, measure, power_spectrum, radial_spectrum,
};
use evenly_io::{Subject, Target, is_mesh_file, write_figure};
use serde::Serialize;
use serde_json::Value;

use crate::measured::{self, fields, line, shown};
use crate::measuring_args::Analyze;
use crate::{files, record, session, surface_measures};

pub fn run(args: &Analyze) -> anyhow::Result<u8> {
    if args.reference.is_some() || args.inputs.iter().any(|path| is_mesh_file(path)) {
        return surface_measures::analyze(args);
    }
    if args.certify.is_some() {
        bail!("--certify is for a mesh, as .ply .obj .off .stl .gltf .glb .msh .vtu or .npz");
    }
    let plot = args.plot.as_ref().map(|path| Target::figure(path, args.measured.force)).transpose()?;
    if args.local && args.inputs.len() > 1 {
        bail!("--local is for one set");
    }
    if args.local && !args.spectrum && plot.is_none() {
        bail!("--local is for --spectrum and --plot");
    }
    if args.density.is_given() && args.inputs.len() > 1 && (args.spectrum || plot.is_some()) {
        bail!("--density with --spectrum or --plot is for one set");
    }
    files::require_one_stdin(args.inputs.iter().chain(&args.density.path()).chain(args.space.path()))?;
    let density = args.density.density()?;
    let read = |path: &PathBuf| Ok(args.metric.applied(files::read_points(path, &args.space)?.with_density(&density))?);
    let sets: Vec<PointSet> = args.inputs.iter().map(read).collect::<anyhow::Result<_>>()?;
    let is_local = args.local || args.density.is_given();
    let pool = session::pool(args.measured.threads, false)?;
    let names = || args.inputs.iter().map(|path| path.display().to_string());
    let measured = names().zip(&sets).map(|(name, points)| Ok((name.clone(), pool.install(|| measure(points)).context(name)?)));
    let measured: Vec<(String, Measures)> = measured.collect::<anyhow::Result<_>>()?;
    let spectrum = if args.spectrum { Some(pool.install(|| Spectrum::of(&sets, is_local))) } else { None };
    let spectrum = spectrum.transpose().with_context(|| names().collect::<Vec<_>>().join(", "))?;
    if let Some(plot) = &plot {
        let (radial, power) = (spectrum.as_ref().map(|s| &s.radial), spectrum.as_ref().and_then(|s| s.power.as_ref()));
        let subject = Subject { sets: &sets, name: &title(args), is_local, most_points: None, radial, power };
        pool.install(|| write_figure(&subject, &args.draw, &record::recipe(None), plot)).with_context(|| plot.name())?;
    }
    let found = Found { measured, spectrum };
    measured::print(&found.json(), args.measured.json, || found.table())
}

/// Sets side by side in the table, before the next go below.
const ABREAST: usize = 4;

/// What depends on all sets together.
#[derive(Serialize)]
struct Spectrum {
    #[serde(flatten)]
    radial: RadialSpectrum,
    /// A Fourier spectrum means nothing where the density varies.
    #[serde(flatten)]
    power: Option<PowerSpectrum>,
}

impl Spectrum {
    fn of(sets: &[PointSet], is_local: bool) -> Result<Self, evenly::Error> {
        Ok(match sets {
            [points] if is_local => Self { radial: differential_spectrum(points, &local_spacings(points)?)?, power: None },
            _ => Self { radial: radial_spectrum(sets)?, power: Some(power_spectrum(sets, PowerSpectrum::MAX_FREQUENCY)?) },
        })
    }
}

/// A name's last letters, as many as a column holds.
fn ending(name: &str) -> String {
    const MOST: usize = 24;
    let n = name.chars().count();
    if n <= MOST { name.into() } else { std::iter::once('\u{2026}').chain(name.chars().skip(n + 1 - MOST)).collect() }
}

/// The counts of valences as fields of their own, which stand in columns.
fn spread(mut measures: serde_json::Map<String, Value>) -> serde_json::Map<String, Value> {
    if let Some(Value::Object(counts)) = measures.remove("valence") {
        let of = |is_it: &dyn Fn(usize) -> bool| -> u64 {
            counts.iter().filter(|(k, _)| k.parse().is_ok_and(is_it)).filter_map(|(_, n)| n.as_u64()).sum()
        };
        measures.extend([5, 6, 7].map(|k| (format!("valence_{k}"), of(&|n| n == k).into())));
        measures.insert("valence_other".into(), of(&|n| !(5..=7).contains(&n)).into());
    }
    measures
}

/// The first file's name.
fn title(args: &Analyze) -> String {
    let name = args.inputs.first().and_then(|path| path.file_stem());
    name.map_or_else(String::new, |name| if name == "-" { "points".into() } else { name.to_string_lossy().into_owned() })
}

/// All that was asked for: the measures of each set by its name, and the spectrum of all.
struct Found {
    measured: Vec<(String, Measures)>,
    spectrum: Option<Spectrum>,
}

impl Found {
    /// One object; several sets are in a list of it.
    fn json(&self) -> Value {
        let of_spectrum = self.spectrum.as_ref().map_or_else(|| Value::Object(Default::default()), |spectrum| serde_json::json!(spectrum));
        let mut object = serde_json::Map::new();
        match &self.measured[..] {
            [(_, measures)] => object.extend(fields(serde_json::json!(measures))),
            sets => {
                let set = |(name, measures): &(String, Measures)| {
                    let mut set = serde_json::Map::from_iter([("name".to_owned(), Value::from(name.as_str()))]);
                    set.extend(fields(serde_json::json!(measures)));
                    Value::Object(set)
                };
                object.insert("sets".into(), sets.iter().map(set).collect());
            }
        }
        object.extend(fields(of_spectrum));
        Value::Object(object)
    }

    /// A line a measure, a column a set, in the names of the JSON; no curves.
    fn table(&self) -> String {
        let mut text = String::new();
        for sets in self.measured.chunks(ABREAST) {
            if self.measured.len() > 1 {
                line(&mut text, "", sets.iter().map(|(name, _)| ending(name)));
            }
            let columns: Vec<_> = sets.iter().map(|(_, measures)| fields(serde_json::json!(measures))).collect();
            let columns: Vec<_> = if columns.len() > 1 { columns.into_iter().map(spread).collect() } else { columns };
            for name in columns[0].keys() {
                line(&mut text, name, columns.iter().map(|column| shown(name, &column[name])));
            }
        }
        for (name, value) in self.spectrum.iter().flat_map(|spectrum| fields(serde_json::json!(spectrum))) {
            if !value.is_array() {
                line(&mut text, &name, std::iter::once(shown(&name, &value)));
            }
        }
        text
    }
}
