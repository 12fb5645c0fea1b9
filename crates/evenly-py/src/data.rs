//! What requests name: the package's arrays, and files.

use std::collections::HashMap;

use evenly::{Density, Polygon, TriangleMesh};
use evenly_io::{DensityFile, Photograph, TrianglesRead, read_triangles};
use evenly_jobs::{Error, Regions, Resources};
use numpy::{PyReadonlyArray2, PyReadonlyArray3, PyUntypedArrayMethods as _};
use pyo3::prelude::*;

use crate::answer::value_error;
use crate::arrays::{Integers, Rows, indices, rows};
use crate::spaces::Rings;

/// Data as the package hands them over.
#[derive(FromPyObject)]
pub enum Given<'py> {
    /// Places, or places and lengths.
    Rows(Rows<'py>),
    /// A density: rows from the top.
    Pixels(PyReadonlyArray2<'py, f32>),
    /// A picture: rows from the top, of red, green, blue and opacity from 0 to 1.
    Colours(PyReadonlyArray3<'py, f32>),
    /// Vertices and triangles.
    Mesh(Rows<'py>, Integers<'py>),
    /// Lines.
    Lines(Vec<Rows<'py>>),
    /// A polygon.
    Rings(Rings),
    /// Parts by their names.
    Regions(Vec<(String, Rings)>),
    /// A number for each vertex.
    Numbers(Vec<f64>),
}

/// Data as they are worked with.
enum Datum {
    Places(Vec<[f64; 2]>),
    Rows(Vec<[f64; 3]>),
    Density([usize; 2], Vec<f32>),
    Picture(Photograph),
    Mesh(TriangleMesh),
    Lines(Vec<Vec<[f64; 2]>>),
    Regions(Vec<(String, Rings)>),
    Numbers(Vec<f64>),
}

impl Given<'_> {
    fn owned(&self) -> PyResult<Datum> {
        Ok(match self {
            Self::Rows(array) if array.shape()[1] == 3 => Datum::Rows(rows(array)?),
            Self::Rows(array) => Datum::Places(rows(array)?),
            Self::Pixels(pixels) => {
                let [height, width] = [0, 1].map(|axis| pixels.shape()[axis]);
                Datum::Density([width, height], pixels.as_slice().map_err(value_error)?.to_vec())
            }
            Self::Colours(pixels) => {
                let shape = [1, 0].map(|axis| pixels.shape()[axis]);
                let colours = pixels.as_slice().map_err(value_error)?.as_chunks::<4>().0;
                let picture = Photograph::of_colours("the picture", shape, colours);
                Datum::Picture(picture.ok_or_else(|| value_error("a picture has height x width x 4 values"))?)
            }
            Self::Mesh(vertices, triangles) => {
                Datum::Mesh(TriangleMesh { vertices: rows(vertices)?, triangles: indices(triangles)?, attributes: Vec::new() })
            }
            Self::Lines(lines) => Datum::Lines(lines.iter().map(rows).collect::<PyResult<_>>()?),
            Self::Rings(rings) => Datum::Lines(rings.clone()),
            Self::Regions(regions) => Datum::Regions(regions.clone()),
            Self::Numbers(numbers) => Datum::Numbers(numbers.clone()),
        })
    }
}

/// Data by the names that a request has for them; what is not there is a file.
pub struct Data(HashMap<String, Datum>);

impl Data {
    /// Takes the data over.
    pub fn new(given: &HashMap<String, Given>) -> PyResult<Self> {
        given.iter().map(|(name, given)| Ok((name.clone(), given.owned()?))).collect::<PyResult<_>>().map(Self)
    }

    fn missing<T>(name: &str) -> Result<T, Error> {
        Err(Error::Resource(format!("{name} is of another kind than it must be")))
    }
}

impl Resources for Data {
    fn positions(&mut self, name: &str) -> Result<Vec<[f64; 2]>, Error> {
        match self.0.remove(name) {
            Some(Datum::Places(places)) => Ok(places),
            _ => Self::missing(name),
        }
    }

    fn lengths(&mut self, name: &str) -> Result<Vec<[f64; 3]>, Error> {
        self.places(name)
    }

    fn polygon(&mut self, name: &str) -> Result<Polygon, Error> {
        Polygon::from_rings(self.lines(name)?).map_err(|error| Error::Data { name: name.into(), error })
    }

    fn regions(&mut self, name: &str) -> Result<(Polygon, Vec<(String, Polygon)>), Error> {
        let Some(Datum::Regions(regions)) = self.0.remove(name) else { return Self::missing(name) };
        let regions = regions.into_iter().map(|(name, rings)| (name, evenly_jobs::Rings(rings))).collect();
        evenly_jobs::Data::make(&Regions(regions))
    }

    fn lines(&mut self, name: &str) -> Result<Vec<Vec<[f64; 2]>>, Error> {
        match self.0.remove(name) {
            Some(Datum::Lines(lines)) => Ok(lines),
            _ => Self::missing(name),
        }
    }

    fn density(&mut self, name: &str) -> Result<Density, Error> {
        match self.0.remove(name) {
            Some(Datum::Density([width, height], values)) => {
                Density::image(width, height, &values).map_err(|error| Error::of(error, name, &[("values", "density")]))
            }
            Some(_) => Self::missing(name),
            None => Ok(name.parse::<DensityFile>().map_err(|error| Error::Resource(format!("density: {error}")))?.read()?),
        }
    }

    fn mesh(&mut self, name: &str) -> Result<TrianglesRead, Error> {
        match self.0.remove(name) {
            Some(Datum::Mesh(mesh)) => Ok(TrianglesRead { mesh, notes: Vec::new() }),
            Some(_) => Self::missing(name),
            None => Ok(read_triangles(name.as_ref())?),
        }
    }

    fn places(&mut self, name: &str) -> Result<Vec<[f64; 3]>, Error> {
        match self.0.remove(name) {
            Some(Datum::Rows(rows)) => Ok(rows),
            _ => Self::missing(name),
        }
    }

    fn numbers(&mut self, name: &str) -> Result<Vec<f64>, Error> {
        match self.0.remove(name) {
            Some(Datum::Numbers(numbers)) => Ok(numbers),
            Some(_) => Self::missing(name),
            None => Ok(evenly_io::read_numbers(name.as_ref())?),
        }
    }

    fn picture(&mut self, name: &str) -> Result<Photograph, Error> {
        match self.0.remove(name) {
            Some(Datum::Picture(picture)) => Ok(picture),
            Some(_) => Self::missing(name),
            None => Ok(Photograph::read(name.as_ref())?),
        }
    }
}
