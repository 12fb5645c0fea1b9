//! [`measure`]: every measure at once.

use std::collections::BTreeMap;

use rayon::prelude::*;
use serde::Serialize;

use super::distinct::Distinct;
use super::each::PointMeasures;
use super::sight::{Seen, largest_reach, look};
use super::star::{StarMeasures, StarReader};
use super::triangles;
use super::weighted::{density_error, weigh};
use crate::density::Field;
use crate::error::Error;
use crate::points::PointSet;
use crate::triangulation::Triangulation;

/// What [`measure`] finds. Lengths are in hexagonal spacings, `sqrt(2 A / (sqrt(3) n))`; capacities in mean capacities, `A / n`.
///
/// In a rectangle and in a polygon Voronoi cells are clipped to the domain, triangles are the dual of the clipped diagram,
/// and the measures of order and the valences leave out vertices whose cell reaches the boundary. Angles are NaN where there is no triangle.
///
/// In a polygon a boundary hides what lies behind it: but for `min_distance`, distances are to points that a point sees, and its cell is what it sees of the places that are nearer to it than to
/// other points that it sees. Behind corners cells may overlap, or leave a little out.
///
/// Where the density varies, distances, the coverage radius and capacities are measured in it: lengths are integrals of its root along segments, from a point to its Delaunay
/// neighbours and, the mean of three, from a triangle's corners to its circumcentre; areas are integrals of the density itself. Its mean is 1. Angles are what they are.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Measures {
    /// How many points there are.
    pub n_points: usize,
    /// The hexagonal spacing, in input units.
    pub hex_spacing: f64,
    /// Points that share their place with an earlier one. They count in the distances, and nowhere else.
    pub coincident_points: usize,
    /// Smallest distance of two points; 1 at most, and for the hexagonal lattice. In a polygon whatever stands between them.
    pub min_distance: f64,
    /// Mean over the points of the distance to the nearest other; in a polygon over those that see another, NaN if none does.
    pub mean_distance: f64,
    /// Radius of the largest disk in the domain without a point; 0.577 for the hexagonal lattice.
    pub coverage_radius: f64,
    /// `coverage_radius / min_distance`, in a polygon over `min_distance_visible`; 0.577 for the hexagonal lattice, below 0.707 no triangle is obtuse. Infinite if points coincide.
    pub beta: f64,
    /// Mean over the points of |mean over its neighbours of exp(6 i theta)|: psi6.
    pub bond_order: f64,
    /// The definition of the tool psa: sum over the points of |sum over the edges between consecutive neighbours of exp(6 i theta)|,
    /// divided by the sum of valences.
    pub bond_order_psa: f64,
    /// |mean over the points of the mean over its neighbours of exp(6 i theta)|: near 0 unless one lattice fills the domain.
    pub bond_order_global: f64,
    /// Standard deviation of the Voronoi cells' areas. In a polygon of several parts from the mean of each one's part: no point goes from one to another.
    pub capacity_sd: f64,
    /// Largest deviation of a Voronoi cell's area from the mean, or from that of its part.
    pub capacity_max_deviation: f64,
    /// The energy of centroidal Voronoi tessellations: the sum over the cells of the squared distance to their point, integrated; relative to that of
    /// the hexagonal lattice, which has the least. NaN where the density varies.
    pub cvt_energy: f64,
    /// Root mean square deviation of the triangles' angles from 60 degrees (Papazov and Hege, equation 7).
    pub angle_rms_deg: f64,
    /// Mean of twice the inradius over the circumradius; 1 for equilateral triangles (equation 8).
    pub triangle_quality: f64,
    /// Smallest angle.
    pub min_angle_deg: f64,
    /// Largest angle.
    pub max_angle_deg: f64,
    /// Share of triangles with an angle above 90 degrees.
    pub obtuse_fraction: f64,
    /// How many vertices have each number of neighbours.
    pub valence: BTreeMap<usize, usize>,
    /// Where the density varies, how far the number of points in cells of equal mass, a hundred points' worth each, is from what it should be: relative, root mean
    /// square. `None` below 150 points, and in a polygon.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub density_error: Option<f64>,
    /// What only a bounded domain has.
    #[serde(flatten, skip_serializing_if = "Option::is_none")]
    pub boundary: Option<BoundaryMeasures>,
}

/// Measures of a bounded domain's boundary.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BoundaryMeasures {
    /// `angle_rms_deg` of the triangles with a corner on the boundary of the triangulation.
    pub boundary_angle_rms_deg: f64,
    /// `angle_rms_deg` of all other triangles.
    pub interior_angle_rms_deg: f64,
    /// Share of the domain that no triangle covers.
    pub uncovered_fraction: f64,
    /// Vertices without a triangle.
    pub isolated_points: usize,
    /// In a polygon, the smallest distance of two points that see each other; infinite where none sees another.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub min_distance_visible: Option<f64>,
    /// In a polygon, `capacity_max_deviation` of the cells that stay clear of the boundary: what methods with such a target hold. At a ragged boundary they allow a quarter more.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub inner_capacity_max_deviation: Option<f64>,
}

impl Measures {
    /// The largest deviation of a cell's area for which a method stands that has such a target.
    pub(crate) fn capacity_deviation_held(&self) -> f64 {
        let inner = self.boundary.as_ref().and_then(|boundary| boundary.inner_capacity_max_deviation);
        inner.unwrap_or(self.capacity_max_deviation)
    }

    /// The smallest distance that methods with such a target keep: in a polygon that of points that see each other.
    pub(crate) fn min_distance_held(&self) -> f64 {
        self.boundary.as_ref().and_then(|boundary| boundary.min_distance_visible).unwrap_or(self.min_distance)
    }
}

/// Sums over vertices, added up in a fixed order.
#[derive(Clone, Default)]
struct Sums {
    min_distance: f64,
    distance: f64,
    /// Vertices that see no other.
    n_alone: usize,
    reach: f64,
    capacity_squares: f64,
    capacity_deviation: f64,
    inner_capacity_deviation: f64,
    second_moment: f64,
    n_inner: usize,
    bond_order: f64,
    bond_edges: f64,
    bond: [f64; 2],
    neighbours: usize,
    valence: BTreeMap<usize, usize>,
}

/// The second moment of a regular hexagon of area 1: 5 / (18 sqrt(3)).
const HEXAGON: f64 = 0.160_375_074_774_976_5;

/// Measures a set of at least three points, not all on one line.
///
/// # Errors
/// [`Error::Degenerate`] for fewer points, or where a rectangle's points all lie on one line.
pub fn measure(points: &PointSet) -> Result<Measures, Error> {
    let distinct = Distinct::triangulate(points)?;
    let Distinct { triangulation, is_shared, .. } = &distinct;
    let (domain, coincident_points, n_distinct) = (distinct.domain(), distinct.coincident_points, triangulation.n_base());
    let mean_capacity = domain.area() / n_distinct as f64;
    let n_points = points.n_points();
    let spacing = domain.hex_spacing(n_points);

    let mut sums = Sums { min_distance: f64::INFINITY, ..Sums::default() };
    let field = points.field(&domain);
    let is_live = field.is_some() || domain.boundary.is_some();
    let mut live = is_live.then(|| distinct.live(field.clone())).transpose()?;
    if let Some(live) = live.as_mut().filter(|_| domain.boundary.is_some()) {
        let stars = look(live, f64::INFINITY, |seen: Seen| seen.measures())?;
        let bounds: Vec<f64> = stars.iter().map(|star| star.reach).collect();
        stars.into_iter().zip(is_shared).for_each(|(star, &is_shared)| sums.add(star, mean_capacity, is_shared));
        if field.is_none() {
            sums.reach = largest_reach(live, &bounds);
        }
    } else {
        sums = sum_up(triangulation, mean_capacity, is_shared);
    }
    let triangles = triangles::measure(triangulation, live.as_mut())?;

    let mut cvt_energy = sums.second_moment / (HEXAGON * n_distinct as f64 * mean_capacity * mean_capacity);
    if let Some(live) = live.filter(|_| field.is_some()) {
        let weighted = weigh(&mut live.in_units_of(spacing), &domain, spacing)?;
        sums.take(&weighted, spacing, is_shared);
        cvt_energy = f64::NAN;
    }
    // In a polygon's frame most of the mass may lie outside.
    let density_error =
        field.as_ref().filter(|_| domain.boundary.is_none()).and_then(|field| density_error(&domain, field, points.normalized().1));
    let n_inner = (sums.n_inner as f64).max(1.0);
    let is_visible = domain.boundary.is_some();
    let distance = |nearest: f64| if coincident_points > 0 { 0.0 } else { nearest / spacing };
    let visible = distance(sums.min_distance);
    let min_distance = if is_visible { distance(nearest_of_all(triangulation, field.as_ref())) } else { visible };
    let coverage_radius = sums.reach / spacing;
    Ok(Measures {
        n_points,
        hex_spacing: points.space().hex_spacing(n_points),
        coincident_points,
        min_distance,
        mean_distance: sums.distance / (n_points - sums.n_alone) as f64 / spacing,
        coverage_radius,
        beta: coverage_radius / visible,
        bond_order: sums.bond_order / n_inner,
        bond_order_psa: sums.bond_edges / (sums.neighbours as f64).max(1.0),
        bond_order_global: libm::hypot(sums.bond[0], sums.bond[1]) / n_inner,
        capacity_sd: (sums.capacity_squares / n_distinct as f64).sqrt(),
        capacity_max_deviation: sums.capacity_deviation,
        cvt_energy,
        angle_rms_deg: triangles.all.angle_rms_deg(),
        triangle_quality: triangles.all.quality(),
        min_angle_deg: triangles.all.min_angle_deg(),
        max_angle_deg: triangles.all.max_angle_deg(),
        obtuse_fraction: triangles.all.obtuse_fraction(),
        valence: sums.valence,
        density_error,
        boundary: (!triangulation.domain.is_periodic).then(|| BoundaryMeasures {
            boundary_angle_rms_deg: triangles.boundary.angle_rms_deg(),
            interior_angle_rms_deg: triangles.interior.angle_rms_deg(),
            uncovered_fraction: (1.0 - triangles.all.area / domain.area()).max(0.0),
            isolated_points: triangles.isolated_points,
            min_distance_visible: is_visible.then_some(visible),
            inner_capacity_max_deviation: domain.boundary.is_some().then_some(sums.inner_capacity_deviation),
        }),
    })
}

/// The smallest distance of two points, whatever stands between them: the nearest of a point is a neighbour.
fn nearest_of_all(triangulation: &Triangulation, field: Option<&Field>) -> f64 {
    let Triangulation { half_edges, positions, .. } = triangulation;
    let ends = (0..half_edges.origin.len() as u32).map(|h| [half_edges.origin[h as usize], half_edges.target(h)]);
    let lengths = ends.map(|ends| {
        let [from, to] = ends.map(|v| positions[v as usize]);
        (to - from).length() * field.map_or(1.0, |field| field.stretch_between(from, to - from, f64::INFINITY))
    });
    lengths.fold(f64::INFINITY, f64::min)
}

/// Sums over all vertices of a triangulation.
fn sum_up(triangulation: &Triangulation, mean_capacity: f64, is_shared: &[bool]) -> Sums {
    let outgoing = triangulation.half_edges.outgoing(triangulation.positions.len());
    let parts: Vec<Sums> = (0..triangulation.n_base())
        .collect::<Vec<_>>()
        .par_chunks(1 << 14)
        .map(|vertices| {
            let mut reader = StarReader::new(triangulation, &outgoing);
            let mut sums = Sums { min_distance: f64::INFINITY, ..Sums::default() };
            for &vertex in vertices {
                sums.add(reader.read(vertex), mean_capacity, is_shared[vertex]);
            }
            sums
        })
        .collect();
    let mut sums = Sums { min_distance: f64::INFINITY, ..Sums::default() };
    for part in &parts {
        sums.merge(part);
    }
    sums
}

impl Sums {
    fn add(&mut self, star: StarMeasures, mean_capacity: f64, is_shared: bool) {
        self.min_distance = self.min_distance.min(star.nearest);
        // A point that shares its place has its nearest neighbour at distance 0.
        if !is_shared && star.nearest.is_finite() {
            self.distance += star.nearest;
        }
        self.n_alone += usize::from(!is_shared && !star.nearest.is_finite());
        self.reach = self.reach.max(star.reach);
        let deviation = star.capacity / mean_capacity - 1.0;
        self.capacity_squares += deviation * deviation;
        self.capacity_deviation = self.capacity_deviation.max(deviation.abs());
        self.second_moment += star.second_moment;
        if star.is_inner {
            self.inner_capacity_deviation = self.inner_capacity_deviation.max(deviation.abs());
            self.n_inner += 1;
            self.neighbours += star.valence;
            self.bond_order += star.bond.length();
            self.bond_edges += star.bond_edges.length();
            self.bond[0] += star.bond.x;
            self.bond[1] += star.bond.y;
            *self.valence.entry(star.valence).or_default() += 1;
        }
    }

    /// Takes what is measured in a density's own measure instead.
    fn take(&mut self, weighted: &[PointMeasures], spacing: f64, is_shared: &[bool]) {
        let deviations = || weighted.iter().map(|point| point.capacity - 1.0);
        self.min_distance = weighted.iter().map(|point| point.nearest).fold(f64::INFINITY, f64::min) * spacing;
        let counts =
            |(point, is_shared): (&PointMeasures, &bool)| (!is_shared && point.nearest.is_finite()).then_some(point.nearest * spacing);
        self.distance = weighted.iter().zip(is_shared).filter_map(counts).sum();
        self.reach = weighted.iter().map(|point| point.reach).fold(0.0, f64::max) * spacing;
        self.capacity_squares = deviations().map(|deviation| deviation * deviation).sum();
        self.capacity_deviation = deviations().map(f64::abs).fold(0.0, f64::max);
        let inner = deviations().zip(weighted).filter(|(_, point)| point.is_inner);
        self.inner_capacity_deviation = inner.map(|(deviation, _)| deviation.abs()).fold(0.0, f64::max);
    }

    fn merge(&mut self, other: &Self) {
        self.min_distance = self.min_distance.min(other.min_distance);
        self.distance += other.distance;
        self.n_alone += other.n_alone;
        self.reach = self.reach.max(other.reach);
        self.capacity_squares += other.capacity_squares;
        self.capacity_deviation = self.capacity_deviation.max(other.capacity_deviation);
        self.inner_capacity_deviation = self.inner_capacity_deviation.max(other.inner_capacity_deviation);
        self.second_moment += other.second_moment;
        self.n_inner += other.n_inner;
        self.neighbours += other.neighbours;
        self.bond_order += other.bond_order;
        self.bond_edges += other.bond_edges;
        self.bond[0] += other.bond[0];
        self.bond[1] += other.bond[1];
        for (&valence, n) in &other.valence {
            *self.valence.entry(valence).or_default() += n;
        }
    }
}
