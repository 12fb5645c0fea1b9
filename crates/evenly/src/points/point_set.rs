//! [`PointSet`]: points, and the domain they live in.

use glam::DVec2;
use rayon::prelude::*;

use crate::density::{Density, Field};
use crate::error::Error;
use crate::space::{Domain, Space};

/// The largest number of points: half-edges are counted in 32 bits, also on a finite cover of a torus.
pub const MAX_POINTS: usize = 40_000_000;

/// Points, the domain they live in, and the density that is wanted there; all finite, all inside. Some may be told to stay where they are.
#[derive(Debug, Clone, PartialEq)]
pub struct PointSet {
    space: Space,
    density: Density,
    positions: Vec<[f64; 2]>,
    n_fixed: usize,
}

impl PointSet {
    /// Takes points of any order; on a torus they are wrapped into the domain.
    ///
    /// # Errors
    /// [`Error::NotFinite`] and [`Error::OutsideDomain`] name the first such point, counted from 0;
    /// [`Error::TooManyPoints`] beyond [`MAX_POINTS`].
    pub fn new(space: impl Into<Space>, mut positions: Vec<[f64; 2]>) -> Result<Self, Error> {
        /// Farther out than this many periods, a point's place within its period is lost in rounding.
        const FAR: f64 = 1e9;
        let space = space.into();
        if positions.len() > MAX_POINTS {
            return Err(Error::TooManyPoints(positions.len(), MAX_POINTS));
        }
        let (origin, size) = (space.origin(), space.size());
        let domain = space.domain();
        for (index, point) in positions.iter_mut().enumerate() {
            let at = *point;
            if !at.iter().all(|x| x.is_finite()) {
                return Err(Error::NotFinite { index, point: at });
            }
            let is_inside = |axis: usize| at[axis] >= origin[axis] && at[axis] <= origin[axis] + size[axis];
            let is_near = |axis: usize| (at[axis] / size[axis] - origin[axis] / size[axis]).abs() < FAR;
            if space.is_periodic() && is_near(0) && is_near(1) {
                if (0..2).any(|axis| !is_inside(axis) || at[axis] == origin[axis] + size[axis]) {
                    *point = domain.restore(domain.normalize(at));
                }
            } else if !(is_inside(0) && is_inside(1) && domain.holds(at)) {
                return Err(Error::OutsideDomain { index, point: at, domain: place_of(&space) });
            }
        }
        Ok(Self { space, density: Density::uniform(), positions, n_fixed: 0 })
    }

    /// Takes points that lie in the domain, to rounding: those that do not are put at its nearest place.
    fn inside(space: &Space, mut positions: Vec<[f64; 2]>) -> Result<Self, Error> {
        let domain = space.domain();
        for point in positions.iter_mut().filter(|point| !domain.holds(**point)) {
            *point = domain.restore(domain.normalize(*point));
        }
        Self::new(space, positions)
    }

    /// The same points, of which the first `n_fixed` stay where they are, whatever method runs: the others find their places around them.
    ///
    /// # Errors
    /// [`Error::InvalidParameter`] where there are not so many points, and where two of those that stay share a place.
    pub fn with_fixed(self, n_fixed: usize) -> Result<Self, Error> {
        let invalid = |value: String, expected| Err(Error::InvalidParameter { name: "n_fixed", value, expected });
        let Some(fixed) = self.positions.get(..n_fixed) else {
            return invalid(n_fixed.to_string(), "at most the number of points");
        };
        let mut places: Vec<[u64; 2]> = fixed.iter().map(|p| p.map(|x| (x + 0.0).to_bits())).collect();
        places.sort_unstable();
        if let Some([x, y]) = places.windows(2).find(|pair| pair[0] == pair[1]).map(|pair| pair[0].map(f64::from_bits)) {
            return invalid(format!("{n_fixed}, with two points at ({x}, {y})"), "of points that have a place each");
        }
        Ok(Self { n_fixed, ..self })
    }

    /// How many points stay where they are: the first.
    pub fn n_fixed(&self) -> usize {
        self.n_fixed
    }

    /// The same points in the [unit square](Space::in_unit_square) of their domain, with the density that
    /// goes with them. Those that stay, stay.
    ///
    /// # Errors
    /// [`Error::InvalidParameter`] where two points that stay share a place there.
    ///
    /// # Example
    /// ```
    /// use evenly::{PointSet, Rectangle, RunContext, WellSpacedParams, jittered, well_spaced};
    ///
    /// // 20 trials at 100 to 260 degrees and 1 to 5 bars.
    /// let factors = PointSet::new(Rectangle::new([100.0, 1.0], [160.0, 4.0])?, Vec::new())?;
    /// let mut trials = jittered(factors.space().in_unit_square(), 20, 1)?;
    /// well_spaced(&mut trials, &WellSpacedParams::default(), &mut RunContext::default())?;
    /// let trials = trials.restored_to(&factors)?;
    /// assert!(trials.positions().iter().all(|&[x, y]| (100.0..=260.0).contains(&x) && (1.0..=5.0).contains(&y)));
    /// # Ok::<(), evenly::Error>(())
    /// ```
    pub fn in_unit_square(&self) -> Result<Self, Error> {
        let positions = self.positions.iter().map(|&p| self.space.to_unit(p)).collect();
        Self::inside(&self.space.in_unit_square(), positions)?.with_density(&self.density).with_fixed(self.n_fixed)
    }

    /// Points of the [unit square](Space::in_unit_square) of another set's domain, restored to that domain.
    /// The first of them are the points of the other set that stay, and come back with their coordinates.
    ///
    /// # Errors
    /// Those of [`PointSet::new`] and [`PointSet::with_fixed`].
    pub fn restored_to(&self, other: &Self) -> Result<Self, Error> {
        let (space, fixed) = (&other.space, &other.positions[..other.n_fixed]);
        let moved = self.positions.iter().skip(fixed.len()).map(|&p| space.of_unit(p)).collect();
        let all = fixed.iter().copied().chain(Self::inside(space, moved)?.positions).collect();
        Self::new(space, all)?.with_density(&self.density).with_fixed(fixed.len())
    }

    /// The same points where another density is wanted: methods and measures will go by it. Uniform at first.
    #[must_use]
    pub fn with_density(self, density: &Density) -> Self {
        Self { density: density.clone(), ..self }
    }

    /// The density that is wanted.
    pub fn density(&self) -> &Density {
        &self.density
    }

    /// The domain.
    pub fn space(&self) -> &Space {
        &self.space
    }

    /// The points, in the order in which they were given.
    pub fn positions(&self) -> &[[f64; 2]] {
        &self.positions
    }

    /// The points alone.
    pub fn into_positions(self) -> Vec<[f64; 2]> {
        self.positions
    }

    /// How many points there are.
    pub fn n_points(&self) -> usize {
        self.positions.len()
    }

    /// The spacing of the hexagonal lattice with as many points, in input units.
    pub fn hex_spacing(&self) -> f64 {
        self.space.hex_spacing(self.n_points())
    }

    /// The domain and all positions in its normalised coordinates.
    pub(crate) fn normalized(&self) -> (Domain, Vec<DVec2>) {
        let domain = self.space.domain();
        let positions = self.positions.par_iter().map(|&p| domain.normalize(p)).collect();
        (domain, positions)
    }

    /// A set of points that lie in the normalised domain by construction.
    pub(crate) fn from_normalized(space: Space, positions: impl Iterator<Item = DVec2>) -> Self {
        let domain = space.domain();
        Self { space, density: Density::uniform(), n_fixed: 0, positions: positions.map(|q| domain.restore(domain.land(q))).collect() }
    }

    /// Moves point `order[k]` to `positions[k]`, unless it is one that stays, or to the nearest place where the density is not 0.
    pub(crate) fn place(&mut self, domain: &Domain, order: &[u32], positions: &[DVec2]) {
        let field = self.field(domain);
        for (&index, &q) in order.iter().zip(positions).filter(|(index, _)| **index as usize >= self.n_fixed) {
            self.positions[index as usize] = domain.restore(field.as_ref().map_or(q, |field| domain.walk(q, field.settle(q))));
        }
    }

    /// The density in normalised coordinates, where it varies.
    pub(crate) fn field(&self, domain: &Domain) -> Option<Field> {
        self.density.field(domain)
    }

    /// The same set with point `order[k]` at `positions[k]`.
    pub(crate) fn moved(&self, domain: &Domain, order: &[u32], positions: &[DVec2]) -> Self {
        let mut moved = self.clone();
        moved.place(domain, order, positions);
        moved
    }

    /// Checks that a set of so many points can be made.
    pub(crate) fn validate(space: &Space, n_points: usize) -> Result<(), Error> {
        if n_points == 0 {
            return Err(Error::InvalidParameter { name: "n_points", value: "0".into(), expected: "1 or more" });
        }
        if n_points > MAX_POINTS {
            return Err(Error::TooManyPoints(n_points, MAX_POINTS));
        }
        space.require_resolution(n_points)
    }
}

/// The domain, for a message about a point outside.
fn place_of(space: &Space) -> String {
    if space.region().is_some() { format!("of the polygon within {space}") } else { space.to_string() }
}
