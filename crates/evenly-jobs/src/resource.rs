//! [`Resource`]: data that go with a request, or the name under which the face finds them.

use evenly::{Density, Polygon, Shape, TriangleMesh};
use evenly_io::{Extent, Photograph, TrianglesRead};
use serde::{Deserialize, Serialize};

use crate::error::Error;

/// Data, or their name.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(untagged)]
pub enum Resource<T> {
    /// What the face calls them: a file, an array.
    Name(String),
    /// The data themselves.
    Data(T),
}

/// Where a face finds data by their names.
pub trait Resources {
    /// Points, as (n, 2).
    ///
    /// # Errors
    /// [`Error::Resource`], as all of these: where there is nothing of the name, or not what is asked for.
    fn positions(&mut self, name: &str) -> Result<Vec<[f64; 2]>, Error> {
        unknown(name)
    }

    /// The domain that the points of a name carry along, if they do.
    fn extent(&mut self, _name: &str) -> Option<Extent> {
        None
    }

    /// Rows of three numbers: places and lengths.
    ///
    /// # Errors
    /// As [`positions`](Self::positions).
    fn lengths(&mut self, name: &str) -> Result<Vec<[f64; 3]>, Error> {
        unknown(name)
    }

    /// A polygon.
    ///
    /// # Errors
    /// As [`positions`](Self::positions).
    fn polygon(&mut self, name: &str) -> Result<Polygon, Error> {
        unknown(name)
    }

    /// What parts enclose together, and the parts by their names.
    ///
    /// # Errors
    /// As [`positions`](Self::positions).
    fn regions(&mut self, name: &str) -> Result<(Polygon, Vec<(String, Polygon)>), Error> {
        unknown(name)
    }

    /// Lines, each from point to point.
    ///
    /// # Errors
    /// As [`positions`](Self::positions).
    fn lines(&mut self, name: &str) -> Result<Vec<Vec<[f64; 2]>>, Error> {
        unknown(name)
    }

    /// A density.
    ///
    /// # Errors
    /// As [`positions`](Self::positions).
    fn density(&mut self, name: &str) -> Result<Density, Error> {
        unknown(name)
    }

    /// A mesh in space, and what was done to it.
    ///
    /// # Errors
    /// As [`positions`](Self::positions).
    fn mesh(&mut self, name: &str) -> Result<TrianglesRead, Error> {
        unknown(name)
    }

    /// Places in space, as (n, 3).
    ///
    /// # Errors
    /// As [`positions`](Self::positions).
    fn places(&mut self, name: &str) -> Result<Vec<[f64; 3]>, Error> {
        unknown(name)
    }

    /// A number for each vertex of a mesh.
    ///
    /// # Errors
    /// As [`positions`](Self::positions).
    fn numbers(&mut self, name: &str) -> Result<Vec<f64>, Error> {
        unknown(name)
    }

    /// A picture.
    ///
    /// # Errors
    /// As [`positions`](Self::positions).
    fn picture(&mut self, name: &str) -> Result<Photograph, Error> {
        unknown(name)
    }
}

fn unknown<T>(name: &str) -> Result<T, Error> {
    Err(Error::Resource(format!("there is nothing of the name {name:?}")))
}

/// Requests that bring all their data along.
pub struct Nothing;

impl Resources for Nothing {}

/// What data are in a request, and what is made of them.
pub trait Data {
    /// What a job works with.
    type Made;
    /// What they are called where they have no name.
    const CALLED: &'static str;

    /// # Errors
    /// [`Error::Resource`] where there is nothing of the name.
    fn find(resources: &mut dyn Resources, name: &str) -> Result<Self::Made, Error>;

    /// # Errors
    /// [`Error::Data`] for data that cannot be worked with.
    fn make(&self) -> Result<Self::Made, Error>;
}

impl<T: Data> Resource<T> {
    /// What a job works with.
    ///
    /// # Errors
    /// As [`Data`].
    pub fn get(&self, resources: &mut dyn Resources) -> Result<T::Made, Error> {
        match self {
            Self::Name(name) => T::find(resources, name),
            Self::Data(data) => data.make(),
        }
    }

    /// What the data are called.
    pub fn called(&self) -> &str {
        match self {
            Self::Name(name) => name,
            Self::Data(_) => T::CALLED,
        }
    }
}

/// What they are called, if there are any.
pub fn called<T: Data>(resource: Option<&Resource<T>>) -> &str {
    resource.map_or(T::CALLED, Resource::called)
}

/// Points, as (n, 2).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(transparent)]
pub struct Positions(pub Vec<[f64; 2]>);

impl Data for Positions {
    type Made = Vec<[f64; 2]>;
    const CALLED: &'static str = "the points";

    fn find(resources: &mut dyn Resources, name: &str) -> Result<Self::Made, Error> {
        resources.positions(name)
    }

    fn make(&self) -> Result<Self::Made, Error> {
        Ok(self.0.clone())
    }
}

/// Rows of x, y and a length.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(transparent)]
pub struct Lengths(pub Vec<[f64; 3]>);

impl Data for Lengths {
    type Made = Vec<[f64; 3]>;
    const CALLED: &'static str = "the sizes";

    fn find(resources: &mut dyn Resources, name: &str) -> Result<Self::Made, Error> {
        resources.lengths(name)
    }

    fn make(&self) -> Result<Self::Made, Error> {
        Ok(self.0.clone())
    }
}

/// A polygon's rings, an odd number of which enclose the inside.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(transparent)]
pub struct Rings(pub Vec<Vec<[f64; 2]>>);

impl Data for Rings {
    type Made = Polygon;
    const CALLED: &'static str = "the polygon";

    fn find(resources: &mut dyn Resources, name: &str) -> Result<Self::Made, Error> {
        resources.polygon(name)
    }

    fn make(&self) -> Result<Self::Made, Error> {
        Polygon::from_rings(self.0.clone()).map_err(|error| Error::of(error, Self::CALLED, &[]))
    }
}

/// Parts, each with its name and its rings.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(transparent)]
pub struct Regions(pub Vec<(String, Rings)>);

impl Data for Regions {
    type Made = (Polygon, Vec<(String, Polygon)>);
    const CALLED: &'static str = "the regions";

    fn find(resources: &mut dyn Resources, name: &str) -> Result<Self::Made, Error> {
        resources.regions(name)
    }

    fn make(&self) -> Result<Self::Made, Error> {
        let shapes: Vec<Shape> = self.0.iter().map(|(_, Rings(rings))| Shape { rings: rings.clone(), ..Shape::default() }).collect();
        let whole = Polygon::of_shapes(&shapes).map_err(|error| Error::of(error, Self::CALLED, &[]))?;
        let region = |(name, Rings(rings)): &(String, Rings)| {
            let polygon = Polygon::from_rings(rings.clone()).map_err(|error| Error::of(error, &format!("region {name:?}"), &[]))?;
            Ok((name.clone(), polygon))
        };
        Ok((whole, self.0.iter().map(region).collect::<Result<_, Error>>()?))
    }
}

/// Lines, each from point to point.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(transparent)]
pub struct Lines(pub Vec<Vec<[f64; 2]>>);

impl Data for Lines {
    type Made = Vec<Vec<[f64; 2]>>;
    const CALLED: &'static str = "the lines";

    fn find(resources: &mut dyn Resources, name: &str) -> Result<Self::Made, Error> {
        resources.lines(name)
    }

    fn make(&self) -> Result<Self::Made, Error> {
        Ok(self.0.clone())
    }
}

/// How many points are wanted where, in proportion: a picture that spans the domain.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Pixels {
    /// Pixels along x.
    pub width: usize,
    /// Pixels along y.
    pub height: usize,
    /// Row by row from the top.
    pub values: Vec<f32>,
}

impl Data for Pixels {
    type Made = Density;
    const CALLED: &'static str = "density";

    fn find(resources: &mut dyn Resources, name: &str) -> Result<Self::Made, Error> {
        resources.density(name)
    }

    fn make(&self) -> Result<Self::Made, Error> {
        Density::image(self.width, self.height, &self.values).map_err(|error| Error::of(error, Self::CALLED, &[("values", "density")]))
    }
}

/// A triangle mesh in space.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Triangles {
    /// As (n, 3).
    pub vertices: Vec<[f64; 3]>,
    /// The vertices of each.
    pub triangles: Vec<[usize; 3]>,
}

impl Data for Triangles {
    type Made = TrianglesRead;
    const CALLED: &'static str = "the mesh";

    fn find(resources: &mut dyn Resources, name: &str) -> Result<Self::Made, Error> {
        resources.mesh(name)
    }

    fn make(&self) -> Result<Self::Made, Error> {
        let mesh = TriangleMesh { vertices: self.vertices.clone(), triangles: self.triangles.clone(), attributes: Vec::new() };
        Ok(TrianglesRead { mesh, notes: Vec::new() })
    }
}

/// Places in space, as (n, 3).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(transparent)]
pub struct Places(pub Vec<[f64; 3]>);

impl Data for Places {
    type Made = Vec<[f64; 3]>;
    const CALLED: &'static str = "the points";

    fn find(resources: &mut dyn Resources, name: &str) -> Result<Self::Made, Error> {
        resources.places(name)
    }

    fn make(&self) -> Result<Self::Made, Error> {
        Ok(self.0.clone())
    }
}

/// A picture's colours.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Colours {
    /// Pixels along x.
    pub width: usize,
    /// Pixels along y.
    pub height: usize,
    /// Red, green, blue and opacity from 0 to 1, row by row from the top.
    pub colours: Vec<[f32; 4]>,
}

impl Data for Colours {
    type Made = Photograph;
    const CALLED: &'static str = "the picture";

    fn find(resources: &mut dyn Resources, name: &str) -> Result<Self::Made, Error> {
        resources.picture(name)
    }

    fn make(&self) -> Result<Self::Made, Error> {
        let picture = Photograph::of_colours(Self::CALLED, [self.width, self.height], &self.colours);
        picture.ok_or_else(|| Error::Resource("a picture has width x height colours".into()))
    }
}
