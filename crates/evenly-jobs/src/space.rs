//! [`Domain`]: where points are, and in whose units their distances count.

use evenly::{Rectangle, Space, Torus};
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
        /// Its lower left corner.
        #[serde(default)]
        origin: [f64; 2],
        /// Width and height.
        #[serde(default = "unit")]
        size: [f64; 2],
    },
    /// Bounded.
    Rectangle {
        /// Its lower left corner.
        #[serde(default)]
        origin: [f64; 2],
        /// Width and height.
        #[serde(default = "unit")]
        size: [f64; 2],
    },
    /// The inside of a polygon.
    Polygon {
        /// Its rings.
        polygon: Resource<Rings>,
    },
}

fn unit() -> [f64; 2] {
    [1.0; 2]
}

impl Default for Domain {
    fn default() -> Self {
        Self::Torus { origin: [0.0; 2], size: unit() }
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

impl Domain {
    /// The space, and what was repaired of it.
    ///
    /// # Errors
    /// As [`Torus::new`], [`Rectangle::new`] and [`Resources::polygon`].
    pub fn space(&self, resources: &mut dyn Resources) -> Result<(Space, Vec<Message>), Error> {
        match self {
            &Self::Torus { origin, size } => Ok((Torus::new(origin, size)?.into(), Vec::new())),
            &Self::Rectangle { origin, size } => Ok((Rectangle::new(origin, size)?.into(), Vec::new())),
            Self::Polygon { polygon } => {
                let made = polygon.get(resources)?;
                let repairs = made.repairs().iter().map(|repair| format!("{}: {repair}", polygon.called()).into()).collect();
                Ok((Space::from(&made), repairs))
            }
        }
    }
}
