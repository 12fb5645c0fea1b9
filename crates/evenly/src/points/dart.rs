//! Dart throwing: uniform places, one after the other, of which those stay that are not too near to an earlier one.
//!
//! Cook, "Stochastic Sampling in Computer Graphics", ACM Transactions on Graphics 5(1), 1986, doi 10.1145/7529.8927. For an exact number the spacing
//! shrinks as it gets hard to find room, after McCool and Fiume, "Hierarchical Poisson Disk Sampling Distributions", Graphics Interface 1992.
//!
//! Cost: O(n tries) at most. It does not promise that all gaps are filled: [`poisson_disk`](super::poisson_disk::poisson_disk) does.

use super::bins::Bins;
use super::maximal::SPACING;
use super::point_set::PointSet;
use super::poisson_disk::{rounding_margin, validate_spacing};
use super::random::Random;
use super::start::{Starting, Told};
use super::uniform::Uniform;
use crate::density::Density;
use crate::error::Error;
use crate::parameter::{Entry, Group, Parameter, Unit};
use crate::space::{Domain, Space};

/// What [`dart`] can be told.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DartParams {
    /// How many points, exactly; `None` for as many as fit, which needs a spacing.
    pub n_points: Option<usize>,
    /// No two points are nearer than this, in input units; `None` for a spacing that starts wide and shrinks: the first points of such a set are
    /// spread evenly too.
    pub spacing: Option<f64>,
    /// Where so many darts in a row have missed, the spacing shrinks, or the set is taken for full; 1 or more.
    pub tries: usize,
    /// The same seed gives the same points.
    pub seed: u64,
}

impl Default for DartParams {
    fn default() -> Self {
        Self { n_points: None, spacing: None, tries: 1000, seed: 0 }
    }
}

/// The part of itself to which the spacing shrinks at a time.
const SHRINKAGE: f64 = 0.99;

/// Points from darts. With a spacing alone how many there are is chance; with both there may be fewer than `n_points`, where no more fit.
///
/// # Errors
/// [`Error::InvalidParameter`] for neither a number nor a spacing, or one that is not positive, and for no tries; [`Error::TooManyPoints`] and
/// [`Error::TooFine`] for more points than the domain can hold.
pub fn dart(space: impl Into<Space>, params: &DartParams) -> Result<PointSet, Error> {
    let space = space.into();
    params.validate(&space)?;
    let domain = space.domain();
    let input_to_domain = 1.0 / domain.restore_length(1.0);
    let widest = domain.hex_spacing(1).max(domain.size.max_element());
    let mut spacing = params.spacing.map_or(widest, |spacing| spacing * input_to_domain);
    let mut darts = Darts {
        random: Random::new(params.seed, 3),
        uniform: Uniform::new(&space),
        bins: Bins::new(&domain, 1.1 * spacing),
        domain: domain.clone(),
    };
    let mut bin = spacing;
    while params.n_points.is_none_or(|n| darts.bins.places().len() < n) {
        // Far from 0 rounding brings points nearer.
        let distance = spacing * (1.0 + rounding_margin(&space, domain.restore_length(spacing)));
        if darts.throw(distance, params.tries) {
            continue;
        }
        if params.spacing.is_some() {
            break;
        }
        spacing *= SHRINKAGE;
        // Bins must be as wide as the distance that is asked for, which is a little more.
        if spacing < 0.5 * bin {
            bin = spacing;
            darts.rebin(1.1 * bin);
        }
    }
    Ok(PointSet::from_normalized(space, darts.bins.places().iter().copied()))
}

impl DartParams {
    /// Checks the parameters, as [`dart`] does before it begins.
    ///
    /// # Errors
    /// As there.
    pub fn validate(&self, space: &Space) -> Result<(), Error> {
        let invalid = |name, value: String, expected| Err(Error::InvalidParameter { name, value, expected });
        if self.tries == 0 {
            return invalid("tries", "0".into(), "1 or more");
        }
        match (self.n_points, self.spacing) {
            (None, None) => invalid("spacing", "not given".into(), "given, or the number of points"),
            (_, Some(spacing)) if !(spacing > 0.0 && spacing.is_finite()) => invalid("spacing", spacing.to_string(), "positive and finite"),
            (n_points, Some(spacing)) => {
                validate_spacing(space, spacing)?;
                PointSet::validate(space, n_points.unwrap_or(1))
            }
            (Some(n_points), None) => PointSet::validate(space, n_points),
        }
    }
}

struct Darts {
    domain: Domain,
    random: Random,
    uniform: Uniform,
    bins: Bins,
}

impl Darts {
    /// Throws until a dart stays; whether one of so many did.
    fn throw(&mut self, distance: f64, tries: usize) -> bool {
        for _ in 0..tries {
            let place = self.domain.land(self.uniform.place(&mut self.random));
            if self.bins.near(place).all(|(_, way)| way.length_squared() >= distance * distance) {
                self.bins.push(place);
                return true;
            }
        }
        false
    }

    fn rebin(&mut self, side: f64) {
        let mut bins = Bins::new(&self.domain, side);
        self.bins.places().iter().for_each(|&place| bins.push(place));
        self.bins = bins;
    }
}

/// Its entry among the methods that make points; what it can be told, less the number and the seed.
#[derive(Clone, Copy)]
pub(crate) struct Dart(DartParams);

impl Starting for Dart {
    const ENTRY: &'static Entry<Self> = &Entry {
        name: "dart",
        title: "Dart throwing (Cook)",
        paper: "Cook 1986, doi 10.1145/7529.8927; McCool and Fiume 1992",
        knows_density: false,
        begin: |_| Self(DartParams::default()),
        seed: Some(|p| &mut p.0.seed),
        parameters: &[
            Parameter::own_number("spacing", "R", |p: &mut Self| &mut p.0.spacing, SPACING).of(Group::Starts).counting(Unit::Input),
            Parameter::count(
                "tries",
                "K",
                |p: &mut Self| &mut p.0.tries,
                "Misses in a row after which a set is full, or without a spacing the spacing shrinks",
            )
            .of(Group::Starts)
            .rare(),
        ],
    };

    fn exactly(space: &Space, _: &Density, n_points: usize, seed: u64) -> Result<PointSet, Error> {
        dart(space, &DartParams { n_points: Some(n_points), seed, ..DartParams::default() })
    }

    fn make(&self, fixed: &PointSet, n_points: Option<usize>, _: u64) -> Result<Option<Told>, Error> {
        if self.0.spacing.is_none() && n_points.is_none() {
            return Err(Error::Missing { names: &["spacing", "n_points"], question: "how near to each other, or how many?" });
        }
        if self.0.spacing.is_some() && n_points.is_some() {
            return Err(Error::Excluded { names: ["spacing", "n_points"], why: "how many points fit is chance" });
        }
        if fixed.n_points() > 0 {
            return Ok(None);
        }
        Ok(Some((dart(fixed.space(), &DartParams { n_points, ..self.0 })?, None)))
    }
}
