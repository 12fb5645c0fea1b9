//! A *star*: one vertex seen from itself. It knows lengths and angles, and no coordinates of the domain; a rule reads it, and nothing else.
//!
//! Where a density varies, what rules compare with their targets is weighted by it: lengths and radii by its root, areas by itself. [`Metric`] holds the
//! weights; without a density all are 1.
//!
//! Lengths are in units of the wanted spacing. The wedge of two neighbouring spokes u and v has a circumcircle, and holds a kite of the
//! vertex' Voronoi cell: with c and s the cosine and sine of its angle, R = |u - v| / (2 s), and the half of the
//! Voronoi edge on u that lies in it is (v - u c) / (2 s) long, negative where it lies on the other side of u.

use glam::DVec2;

/// The angle between a spoke and the next one, counter-clockwise.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Wedge {
    pub cos: f64,
    pub sin: f64,
    /// 1 / sin.
    pub cosecant: f64,
}

impl Wedge {
    /// The halves of Voronoi edges that lie in it, on its first spoke, of length `u`, and on its second.
    #[inline]
    fn halves(self, u: f64, v: f64) -> [f64; 2] {
        let half = 0.5 * self.cosecant;
        [(v - u * self.cos) * half, (u - v * self.cos) * half]
    }
}

/// One vertex' neighbourhood. Spoke `k`, wedge `k` and spoke `k + 1` follow each other counter-clockwise; the last wedge closes the ring.
#[derive(Debug, Clone, Default)]
pub(crate) struct Star {
    /// Lengths of the spokes. A rule that moves neighbours leaves their new distances here; the vertex itself goes instead of a mirror image.
    pub lengths: Vec<f64>,
    pub wedges: Vec<Wedge>,
    /// Whether a spoke leads to the vertex' own mirror image behind a wall: its half is the distance to the wall.
    pub is_mirror: Vec<bool>,
    /// A rule that moves the vertex itself leaves a weight for each spoke: it goes by the sum of weight times spoke. Empty at first.
    pub weights: Vec<f64>,
    /// For a rule that asks for it, the star and the stars around it laid out in a plane, the vertex itself at its origin: where the neighbours are,
    /// counter-clockwise.
    pub ring: Vec<DVec2>,
    /// Where their other neighbours are.
    pub beyond: Vec<DVec2>,
    /// And the walls of the domain.
    pub walls: Vec<Wall>,
    /// In that plane, the direction along which alone the vertex can go; zero for one that stays. `None` where it can go anywhere.
    pub rail: Option<DVec2>,
    /// In that plane, the gradient of the wanted length, relative to that at the vertex; zero where it is the same everywhere.
    pub slope: DVec2,
    /// In that plane, where the vertex goes.
    pub shift: DVec2,
    /// Room for a rule's own reckoning.
    pub scratch: Vec<f64>,
    /// The lengths of the Voronoi edges across the spokes, as [`Self::measure_cell`] has found them.
    pub sides: Vec<f64>,
    /// By how much more than others its cell's area may be off, where it lies at a ragged boundary.
    pub leeway: f64,
    /// The share of its targets by which it may miss them, where what cannot move has kept it from rest for long.
    pub slack: f64,
    /// What the density makes of it.
    pub metric: Metric,
}

/// What a rule compares with its targets: where the density varies, each is found by walking through pixels, so only what is asked for is.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Senses {
    /// Lengths that may be below this; of others it is enough to know that they are not.
    pub lengths: Option<f64>,
    /// Radii that may be above this.
    pub radii: Option<f64>,
    pub mass: bool,
    pub centroid: bool,
    /// Whether cells of a mesh end at its boundary, with the vertex' own image behind it. Otherwise triangles count as they are.
    pub echoes: bool,
}

/// A star's weights, as far as a rule has asked for them; the vectors are empty and the scale is 1 where the density is uniform.
#[derive(Debug, Clone)]
pub(crate) struct Metric {
    /// For each spoke the mean of the density's root along it; for one that is as long as was asked for in any case, a bound below it.
    pub spokes: Vec<f64>,
    /// For each wedge the mean of the density's root along the radii of its triangle, from all three corners; or a bound above it.
    pub radii: Vec<f64>,
    /// For each spoke the mean density along the Voronoi edge across it; where the mass is asked for.
    pub sides: Vec<f64>,
    /// For each spoke the wanted length at its end, relative to that at the vertex; where lengths are given, and the centroid is asked for.
    pub sizes: Vec<f64>,
    /// The Voronoi cell's mass, and its centroid by mass relative to the vertex, in spacings.
    pub mass: Option<f64>,
    pub centroid: Option<DVec2>,
    /// The root of the cell's mean density: the local spacing is 1 / scale.
    pub scale: f64,
}

impl Default for Metric {
    fn default() -> Self {
        Self { spokes: Vec::new(), radii: Vec::new(), sides: Vec::new(), sizes: Vec::new(), mass: None, centroid: None, scale: 1.0 }
    }
}

impl Metric {
    pub fn clear(&mut self) {
        self.spokes.clear();
        self.radii.clear();
        self.sides.clear();
        self.sizes.clear();
        (self.mass, self.centroid, self.scale) = (None, None, 1.0);
    }
}

/// The side of a bounded domain: places p inside have p . normal <= distance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Wall {
    pub normal: DVec2,
    pub distance: f64,
}

/// A local method: what is wrong in a star, and what would mend it.
pub(crate) trait Rule: Sync {
    /// Whether the rule looks beyond the star, at `ring`, `beyond` and `walls`, and may leave a `shift`.
    const LOOKS_AROUND: bool = false;

    /// What it compares with its targets.
    fn senses(&self) -> Senses {
        Senses::default()
    }

    /// Leaves new `lengths`, `weights` or a `shift`; false where all is as it should be, and nothing is to be done.
    fn visit(&self, star: &mut Star) -> bool;
}

impl Star {
    pub fn n_spokes(&self) -> usize {
        self.lengths.len()
    }

    pub fn clear(&mut self) {
        self.lengths.clear();
        self.wedges.clear();
        self.is_mirror.clear();
        self.weights.clear();
        (self.shift, self.leeway, self.slack) = (DVec2::ZERO, 0.0, 0.0);
        self.metric.clear();
    }

    /// By how much spoke `k` is longer in the measure of the density.
    #[inline]
    pub fn stretch(&self, k: usize) -> f64 {
        self.metric.spokes.get(k).copied().unwrap_or(1.0)
    }

    /// The same of the radii of wedge `k`'s triangle.
    #[inline]
    fn radial_stretch(&self, k: usize) -> f64 {
        self.metric.radii.get(k).copied().unwrap_or(1.0)
    }

    /// The spoke after `k`.
    #[inline]
    pub fn after(&self, k: usize) -> usize {
        if k + 1 == self.lengths.len() { 0 } else { k + 1 }
    }

    /// Whether the weighted circumradius of wedge `k`'s triangle is at most `radius`.
    #[inline]
    pub fn is_covered(&self, k: usize, radius: f64) -> bool {
        let diameter = 2.0 * radius * self.wedges[k].sin;
        let stretch = self.radial_stretch(k);
        self.rim_squared(k) * (stretch * stretch) <= diameter * diameter
    }

    /// The circumradius of wedge `k`'s triangle.
    pub fn circumradius(&self, k: usize) -> f64 {
        0.5 * self.rim_squared(k).sqrt() * self.wedges[k].cosecant
    }

    /// The same, weighted: the mean of the ways from the triangle's three corners.
    pub fn weighted_radius(&self, k: usize) -> f64 {
        self.circumradius(k) * self.radial_stretch(k)
    }

    /// The circumcentre of wedge `k`'s triangle, as a combination of its two spokes.
    #[inline]
    pub fn centre(&self, k: usize) -> [f64; 2] {
        let (u, v, Wedge { cos, cosecant, .. }) = (self.lengths[k], self.lengths[self.after(k)], self.wedges[k]);
        let half = 0.5 * cosecant * cosecant;
        [(u - v * cos) * half / u, (v - u * cos) * half / v]
    }

    /// The square of the distance between the ends of spokes `k` and `k + 1`.
    #[inline]
    fn rim_squared(&self, k: usize) -> f64 {
        let (u, v) = (self.lengths[k], self.lengths[self.after(k)]);
        u * u + v * v - 2.0 * u * v * self.wedges[k].cos
    }

    /// Whether the weighted circumradii of all wedges' triangles are at most `radius`.
    pub fn is_all_covered(&self, radius: f64) -> bool {
        let mut wedges = 0..self.n_spokes();
        // Mostly there is nothing to weigh with.
        if self.metric.radii.is_empty() {
            return wedges.all(|k| self.rim_squared(k) <= (2.0 * radius * self.wedges[k].sin).powi(2));
        }
        wedges.all(|k| self.is_covered(k, radius))
    }

    /// The spokes laid out in a plane, the first along its x axis.
    pub fn unfolded(&self) -> impl Iterator<Item = DVec2> {
        let mut direction = DVec2::X;
        self.lengths.iter().zip(&self.wedges).map(move |(&length, wedge)| {
            let spoke = length * direction;
            direction = direction.rotate(DVec2::new(wedge.cos, wedge.sin));
            spoke
        })
    }

    /// How far the vertex is to go by `weights` or `shift`, in the measure of the density.
    pub fn own_move(&self) -> f64 {
        let by_weights: DVec2 = self.unfolded().zip(&self.weights).map(|(spoke, &weight)| weight * spoke).sum();
        (by_weights.length() + self.shift.length()) * self.metric.scale
    }

    /// Leaves the way to the centroid of the Voronoi cell: by area in `weights`, by mass in `shift`.
    pub fn find_centroid(&mut self) {
        if let Some(centroid) = self.metric.centroid {
            self.shift = centroid;
            return;
        }
        let n = self.n_spokes();
        self.weights.clear();
        self.weights.resize(n, 0.0);
        let mut mass = 0.0;
        for k in 0..n {
            let after = self.after(k);
            let (u, v) = (self.lengths[k], self.lengths[after]);
            // Two triangles: the vertex, the middle of a spoke, the circumcentre.
            let [half_u, half_v] = self.wedges[k].halves(u, v);
            let (of_u, of_v) = (0.25 * u * half_u, 0.25 * v * half_v);
            let [along_u, along_v] = self.centre(k);
            let (of_u, of_v) = match &self.metric.sizes[..] {
                [] => (Moment::of_uniform(of_u), Moment::of_uniform(of_v)),
                sizes => {
                    let at_centre = 1.0 + along_u * (sizes[k] - 1.0) + along_v * (sizes[after] - 1.0);
                    let to_middle = |size: f64| 0.5 * (1.0 + size);
                    (Moment::of_sizes(of_u, to_middle(sizes[k]), at_centre), Moment::of_sizes(of_v, to_middle(sizes[after]), at_centre))
                }
            };
            let to_centre = of_u.to_centre + of_v.to_centre;
            self.weights[k] += to_centre * along_u + 0.5 * of_u.to_middle;
            self.weights[after] += to_centre * along_v + 0.5 * of_v.to_middle;
            mass += of_u.mass + of_v.mass;
        }
        let scale = if mass > 0.0 { 1.0 / mass } else { 0.0 };
        self.weights.iter_mut().for_each(|weight| *weight *= scale);
    }

    /// The squared distance from the vertex, integrated over its Voronoi cell.
    pub fn second_moment(&self) -> f64 {
        let of_wedge = |k: usize| {
            let (u, v) = (self.lengths[k], self.lengths[self.after(k)]);
            let radius_squared = self.circumradius(k).powi(2);
            // Two triangles, as for the centroid; on each the integral is the area times (u^2 / 2 + R^2) / 6.
            let [half_u, half_v] = self.wedges[k].halves(u, v);
            let of = |length: f64, half: f64| 0.25 * length * half * (0.5 * length * length + radius_squared) / 6.0;
            of(u, half_u) + of(v, half_v)
        };
        (0..self.n_spokes()).map(of_wedge).sum()
    }

    /// The part of the Voronoi cell's area that lies in wedge `k`.
    pub fn kite(&self, k: usize) -> f64 {
        let (u, v) = (self.lengths[k], self.lengths[self.after(k)]);
        let [of_u, of_v] = self.wedges[k].halves(u, v);
        0.25 * (u * of_u + v * of_v)
    }

    /// The area of the Voronoi cell; leaves the lengths of its edges in `sides`.
    #[inline]
    pub fn measure_cell(&mut self) -> f64 {
        let Self { lengths, wedges, sides, .. } = self;
        sides.clear();
        let ([first, .., last], Some(&closing)) = (&lengths[..], wedges.last()) else { return 0.0 };
        // A side lies half in the wedge before its spoke, half in that after it.
        let [last_half, mut half_before] = closing.halves(*last, *first);
        for (pair, wedge) in lengths.windows(2).zip(&*wedges) {
            let [half, half_after] = wedge.halves(pair[0], pair[1]);
            sides.push(half_before + half);
            half_before = half_after;
        }
        sides.push(half_before + last_half);
        // Each side makes a triangle with the vertex, half a spoke high.
        0.25 * lengths.iter().zip(sides).map(|(length, side)| length * *side).sum::<f64>()
    }
}

/// The mass of a triangle of the vertex, the middle of a spoke and a circumcentre, and its first moment: so much of the way to the middle, and to the centre.
struct Moment {
    mass: f64,
    to_middle: f64,
    to_centre: f64,
}

/// Dunavant's rule of fourth degree (1985): the shares of two corners, and the weight; the third has the rest. Each stands for its three turns.
const NODES: [(f64, f64); 2] = [(0.445_948_490_915_965, 0.223_381_589_678_011), (0.091_576_213_509_771, 0.109_951_743_655_322)];
/// Lengths that are extrapolated to a far circumcentre are no less than this part of the vertex' own.
const LEAST_SIZE: f64 = 0.2;

impl Moment {
    fn of_uniform(area: f64) -> Self {
        Self { mass: area, to_middle: area / 3.0, to_centre: area / 3.0 }
    }

    /// With a density by which centroids come to rest with the wanted lengths: their inverse to the fourth (Du, Faber and Gunzburger 1999, section 6.4). They are 1 at the vertex, as given at the
    /// other corners, and linear in between.
    fn of_sizes(area: f64, at_middle: f64, at_centre: f64) -> Self {
        let (at_middle, at_centre) = (at_middle.max(LEAST_SIZE), at_centre.max(LEAST_SIZE));
        let mut moment = Self { mass: 0.0, to_middle: 0.0, to_centre: 0.0 };
        for (share, weight) in NODES {
            let rest = 1.0 - 2.0 * share;
            for [vertex, middle, centre] in [[rest, share, share], [share, rest, share], [share, share, rest]] {
                let size = vertex + middle * at_middle + centre * at_centre;
                let mass = area * weight / (size * size * size * size);
                moment.mass += mass;
                moment.to_middle += mass * middle;
                moment.to_centre += mass * centre;
            }
        }
        moment
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Spokes of one length, evenly around.
    fn regular(n: usize, length: f64) -> Star {
        let (sin, cos) = (std::f64::consts::TAU / n as f64).sin_cos();
        Star {
            lengths: vec![length; n],
            wedges: vec![Wedge { cos, sin, cosecant: 1.0 / sin }; n],
            is_mirror: vec![false; n],
            ..Star::default()
        }
    }

    #[test]
    fn the_star_of_the_hexagonal_lattice_has_its_cell_and_radius() {
        let mut star = regular(6, 1.0);
        assert!((star.measure_cell() - 3f64.sqrt() / 2.0).abs() < 1e-14);
        for k in 0..6 {
            assert!((star.circumradius(k) - 1.0 / 3f64.sqrt()).abs() < 1e-14);
            assert!(star.centre(k).iter().all(|part| (part - 1.0 / 3.0).abs() < 1e-14));
            assert!((star.sides[k] - 1.0 / 3f64.sqrt()).abs() < 1e-14);
            assert!((star.second_moment() - 5.0 / (24.0 * 3f64.sqrt())).abs() < 1e-14);
            assert!(star.is_covered(k, 0.578) && !star.is_covered(k, 0.577));
        }
    }

    /// Against a fine sum over the cell, of lengths that grow along the first spoke.
    #[test]
    fn the_centroid_by_wanted_lengths_is_that_of_their_inverse_to_the_fourth() {
        let mut star = regular(6, 1.0);
        let growth = 0.3;
        let spokes: Vec<DVec2> = star.unfolded().collect();
        star.metric.sizes = spokes.iter().map(|spoke| 1.0 + growth * spoke.x).collect();
        star.find_centroid();
        let found: DVec2 = spokes.iter().zip(&star.weights).map(|(spoke, &weight)| weight * *spoke).sum();
        let (mut mass, mut moment) = (0.0, DVec2::ZERO);
        for (x, y) in (-500..=500).flat_map(|y| (-500..=500).map(move |x| (x, y))) {
            let place = DVec2::new(f64::from(x), f64::from(y)) / 800.0;
            if spokes.iter().all(|spoke| place.dot(*spoke) <= 0.5) {
                let density = (1.0 + growth * place.x).powi(-4);
                mass += density;
                moment += density * place;
            }
        }
        assert!((found - moment / mass).length() < 2e-4, "{found} {}", moment / mass);
    }

    #[test]
    fn in_a_square_star_a_long_spoke_has_a_far_side() {
        let mut star = regular(4, 2.0);
        star.lengths[1] = 3.0;
        // The cell is 2 wide, and from -1 to 1.5 high.
        star.find_centroid();
        assert!((star.own_move() - 0.25).abs() < 1e-14);
        assert!((star.measure_cell() - 5.0).abs() < 1e-14);
        let sides = star.sides.iter().zip([2.5, 2.0, 2.5, 2.0]);
        assert!({ sides }.all(|(side, expected)| (side - expected).abs() < 1e-14));
        assert!((star.circumradius(0) - 13f64.sqrt() / 2.0).abs() < 1e-14);
        assert!(star.centre(0).iter().all(|part| (part - 0.5).abs() < 1e-14));
    }
}
