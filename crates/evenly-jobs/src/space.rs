//! [`Domain`]: where points are, and in whose units their distances count.

use evenly::{Rectangle, Space, Torus};
use evenly_io::Extent;
use serde::{Deserialize, Serialize};

use crate::error::Error;
use crate::message::Message;
use crate::resource::{Resource, Resources, Rings};

/// A domain.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
pub enum Domain {
    /// Periodic.
    Torus {
        /// Its lower left corner: of the points' file, or (0, 0).
        #[serde(default)]
        origin: Option<[f64; 2]>,
        /// Width and height: of the points' file, or (1, 1).
        #[serde(default)]
        size: Option<[f64; 2]>,
    },
    /// Bounded.
    Rectangle {
        /// Its lower left corner: of the points' file, or (0, 0).
        #[serde(default)]
        origin: Option<[f64; 2]>,
        /// Width and height: of the points' file, or (1, 1).
        #[serde(default)]
        size: Option<[f64; 2]>,
    },
    /// The inside of a polygon.
    Polygon {
        /// Its rings.
        polygon: Resource<Rings>,
    },
}

impl Default for Domain {
    fn default() -> Self {
        Self::Torus { origin: None, size: None }
    }
}

/// In whose units distances count.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Metric {
    /// Those of the input: both axes have the same.
    #[default]
    Input,
    /// Parts of the domain's width and of its height.
    Unit,
}

/// A domain as points are put into it.
pub(crate) struct Place {
    pub space: Space,
    /// Whether nobody has said where it lies.
    pub is_assumed: bool,
    /// What was repaired of it.
    pub notes: Vec<Message>,
}

impl Domain {
    /// The space, and what was repaired of it.
    ///
    /// # Errors
    /// As [`Torus::new`], [`Rectangle::new`] and [`Resources::polygon`].
    pub fn space(&self, resources: &mut dyn Resources) -> Result<(Space, Vec<Message>), Error> {
        let Place { space, notes, .. } = Self::place(Some(self), None, resources)?;
        Ok((space, notes))
    }

    /// Where points lie whose file carries an extent, or none.
    pub(crate) fn place(domain: Option<&Self>, carried: Option<Extent>, resources: &mut dyn Resources) -> Result<Place, Error> {
        let (is_periodic, origin, size) = match domain {
            None => (carried.is_none_or(|extent| extent.is_periodic), None, None),
            Some(&Self::Torus { origin, size }) => (true, origin, size),
            Some(&Self::Rectangle { origin, size }) => (false, origin, size),
            Some(Self::Polygon { polygon }) => {
                let made = polygon.get(resources)?;
                let notes = made.repairs().iter().map(|repair| format!("{}: {repair}", polygon.called()).into()).collect();
                return Ok(Place { space: Space::from(&made), is_assumed: false, notes });
            }
        };
        // Who gives one of the two means the usual other.
        let carried = carried.filter(|_| origin.is_none() && size.is_none());
        let is_assumed = carried.is_none() && origin.is_none() && size.is_none();
        let (origin, size) = match carried {
            Some(Extent { origin, size, .. }) => (origin, size),
            None => (origin.unwrap_or([0.0; 2]), size.unwrap_or([1.0; 2])),
        };
        let space = if is_periodic { Torus::new(origin, size)?.into() } else { Rectangle::new(origin, size)?.into() };
        Ok(Place { space, is_assumed, notes: Vec::new() })
    }
}
