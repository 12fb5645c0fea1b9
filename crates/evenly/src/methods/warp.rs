//! Warping as a method of its own: long density waves are evened out, and nothing else. What it does stands in `points/warp.rs`.

use super::optimizer::Optimizing;
use crate::error::Error;
use crate::parameter::Entry;
use crate::points::{PointSet, warp};
use crate::run::{Outcome, Report, RunContext};

/// It has no parameters.
#[derive(Debug, Clone, Copy)]
pub(super) struct Warp;

impl Optimizing for Warp {
    const ENTRY: &'static Entry<Self> = &Entry {
        name: "warp",
        title: "Even out long density waves, and nothing else",
        paper: "",
        knows_density: true,
        begin: |_| Self,
        seed: None,
        parameters: &[],
    };

    fn run(&self, points: &mut PointSet, _: &mut RunContext) -> Result<Report, Error> {
        if points.space().region().is_some() {
            let expected = "a torus or a rectangle for warp, which moves points by their sides";
            return Err(Error::InvalidParameter { name: "space", value: "a polygon".into(), expected });
        }
        warp(points);
        let mut report = Report::new("warp", points.n_points());
        (report.outcome, report.iterations) = (Outcome::IterationsDone, 1);
        Ok(report)
    }

    fn check(&self) -> Result<(), Error> {
        Ok(())
    }
}
