//! [`Files`]: what requests name, read from files and stdin.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use anyhow::bail;
use evenly::{Density, PointSet, Polygon};
use evenly_io::{Columns, DensityFile, Extent, Photograph, TrianglesRead};
use evenly_jobs::{Error, Resource, Resources, positioned};

use crate::shared_args::SpaceArgs;
use crate::talk::say;
use crate::wording::{Flags, told};

/// Files, by the names that requests have for them.
#[derive(Default)]
pub struct Files {
    paths: HashMap<String, PathBuf>,
    /// How far off flattened curves of an SVG may be.
    pub curve_tolerance: Option<f64>,
    /// The other columns of the points that were read last, and the domain that they carry along.
    pub columns: Columns,
    extent: Option<Extent>,
    /// The picture, where it has been read before.
    pub picture: Option<Photograph>,
}

impl Files {
    /// What a request calls a file.
    pub fn name<T>(&mut self, path: &Path) -> Resource<T> {
        let name = path.display().to_string();
        self.paths.insert(name.clone(), path.into());
        Resource::Name(name)
    }

    /// The same of a file that may be missing.
    pub fn names<T>(&mut self, path: Option<&PathBuf>) -> Option<Resource<T>> {
        path.map(|path| self.name(path))
    }

    fn path(&self, name: &str) -> PathBuf {
        self.paths.get(name).cloned().unwrap_or_else(|| name.into())
    }
}

impl Resources for Files {
    fn positions(&mut self, name: &str) -> Result<Vec<[f64; 2]>, Error> {
        let table = evenly_io::read_table(&self.path(name))?;
        (self.columns, self.extent) = (table.columns, table.extent);
        Ok(table.positions)
    }

    fn extent(&mut self, _: &str) -> Option<Extent> {
        self.extent
    }

    fn lengths(&mut self, name: &str) -> Result<Vec<[f64; 3]>, Error> {
        Ok(evenly_io::read_rows(&self.path(name))?)
    }

    fn polygon(&mut self, name: &str) -> Result<Polygon, Error> {
        Ok(evenly_io::read_polygon(&self.path(name), self.curve_tolerance)?)
    }

    fn regions(&mut self, name: &str) -> Result<(Polygon, Vec<(String, Polygon)>), Error> {
        Ok(evenly_io::read_regions(&self.path(name), self.curve_tolerance)?)
    }

    fn lines(&mut self, name: &str) -> Result<Vec<Vec<[f64; 2]>>, Error> {
        Ok(evenly_io::read_lines(&self.path(name))?)
    }

    fn density(&mut self, name: &str) -> Result<Density, Error> {
        Ok(name.parse::<DensityFile>().map_err(Error::Resource)?.read()?)
    }

    fn mesh(&mut self, name: &str) -> Result<TrianglesRead, Error> {
        Ok(evenly_io::read_triangles(&self.path(name))?)
    }

    fn places(&mut self, name: &str) -> Result<Vec<[f64; 3]>, Error> {
        Ok(evenly_io::read_triangles_or_points(&self.path(name))?.mesh.vertices)
    }

    fn numbers(&mut self, name: &str) -> Result<Vec<f64>, Error> {
        Ok(evenly_io::read_numbers(&self.path(name))?)
    }

    fn picture(&mut self, name: &str) -> Result<Photograph, Error> {
        match self.picture.take() {
            Some(picture) => Ok(picture),
            None => Ok(Photograph::read(&self.path(name))?),
        }
    }
}

/// Refuses to read stdin twice.
pub fn require_one_stdin<'a>(inputs: impl IntoIterator<Item = &'a PathBuf>) -> anyhow::Result<()> {
    if inputs.into_iter().filter(|path| path.as_os_str() == "-").count() > 1 {
        bail!("- is stdin, which can be read once");
    }
    Ok(())
}

/// Reads points, and says what was done to them and their domain.
pub fn read_points(input: &Path, space: &SpaceArgs) -> anyhow::Result<PointSet> {
    let mut files = Files::default();
    let domain = space.domain(&mut files)?;
    let (points, notes) = positioned(&files.name(input), domain.as_ref(), &mut files).map_err(told)?;
    notes.iter().for_each(|note| say(format_args!("note: {}: {}", input.display(), note.shown(&Flags))));
    Ok(points)
}
