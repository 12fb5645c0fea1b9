//! Domains and densities, as the package hands them over.

use std::path::PathBuf;

use evenly::{Density, PointSet, Polygon, Rectangle, Space, Torus};
use evenly_io::DensityFile;
use numpy::{PyReadonlyArray2, PyUntypedArrayMethods as _};
use pyo3::prelude::*;

use crate::answer::value_error;
use crate::arrays::{Rows, rows};

/// Rings, an odd number of which enclose the inside.
pub type Rings = Vec<Vec<[f64; 2]>>;
/// Parts, each an outer ring and its holes.
type Parts = Vec<Vec<Vec<[f64; 2]>>>;

/// A domain: `("torus" | "rectangle", origin, size, is_unit)`, or the rings of a polygon and whether
/// distances are those of the unit square.
#[derive(FromPyObject)]
pub enum SpaceArg {
    Box(String, [f64; 2], [f64; 2], bool),
    Polygon(Rings, bool),
}

/// A density: none, an array of pixels, or the command line's words for a picture.
#[derive(FromPyObject)]
pub enum DensityArg<'py> {
    Pixels(PyReadonlyArray2<'py, f32>),
    Words(String),
}

impl SpaceArg {
    pub fn is_unit(&self) -> bool {
        let (Self::Box(.., is_unit) | Self::Polygon(_, is_unit)) = *self;
        is_unit
    }

    pub fn space(self) -> PyResult<Space> {
        match self {
            Self::Box(kind, origin, size, _) if kind == "torus" => Ok(Torus::new(origin, size).map_err(value_error)?.into()),
            Self::Box(_, origin, size, _) => Ok(Rectangle::new(origin, size).map_err(value_error)?.into()),
            Self::Polygon(rings, _) => Ok(Space::from(&Polygon::from_rings(rings).map_err(value_error)?)),
        }
    }
}

/// The density; uniform if none is given.
pub fn density(py: Python, density: Option<DensityArg>) -> PyResult<Density> {
    match density {
        None => Ok(Density::uniform()),
        Some(DensityArg::Words(words)) => {
            let file: DensityFile = words.parse().map_err(|error| value_error(format!("density: {error}")))?;
            py.detach(|| file.read()).map_err(value_error)
        }
        Some(DensityArg::Pixels(pixels)) => {
            let [height, width] = [0, 1].map(|axis| pixels.shape()[axis]);
            let values = pixels.as_slice().map_err(value_error)?.to_vec();
            py.detach(|| Density::image(width, height, &values))
                .map_err(|error| value_error(error.to_string().replace("values is", "density is")))
        }
    }
}

/// Points with all that goes with them, of which the first `n_fixed` stay.
pub fn point_set(py: Python, positions: &Rows, space: SpaceArg, wanted: Option<DensityArg>, n_fixed: usize) -> PyResult<PointSet> {
    let positions = rows(positions)?;
    let points = py.detach(|| PointSet::new(space.space()?, positions).map_err(value_error))?;
    points
        .with_density(&density(py, wanted)?)
        .with_fixed(n_fixed)
        .map_err(|error| value_error(error.to_string().replace("n_fixed", "fixed")))
}

/// The same, as they are measured.
pub fn measured_set(py: Python, positions: &Rows, space: SpaceArg, wanted: Option<DensityArg>) -> PyResult<PointSet> {
    let is_unit = space.is_unit();
    let points = point_set(py, positions, space, wanted, 0)?;
    if is_unit { points.in_unit_square().map_err(value_error) } else { Ok(points) }
}

/// A polygon's clean rings, its area and what was repaired.
type Clean = (Rings, f64, Vec<String>);

#[pyfunction]
pub fn polygon(py: Python, parts: Parts) -> PyResult<Clean> {
    py.detach(|| Ok(clean(&Polygon::new(parts).map_err(value_error)?)))
}

/// The same of a file.
#[pyfunction]
pub fn read_polygon(py: Python, path: PathBuf) -> PyResult<Clean> {
    py.detach(|| Ok(clean(&evenly_io::read_polygon(&path, None).map_err(value_error)?)))
}

/// The parts of a file, by their names.
#[pyfunction]
pub fn read_regions(py: Python, path: PathBuf) -> PyResult<Vec<(String, Clean)>> {
    let (_, regions) = py.detach(|| evenly_io::read_regions(&path, None)).map_err(value_error)?;
    Ok(regions.iter().map(|(name, polygon)| (name.clone(), clean(polygon))).collect())
}

fn clean(polygon: &Polygon) -> Clean {
    (polygon.rings().to_vec(), polygon.area(), polygon.repairs().to_vec())
}
