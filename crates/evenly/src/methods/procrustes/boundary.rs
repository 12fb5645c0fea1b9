//! The boundary of a rectangle, sampled before the inside: corners stay, points between them slide along their wall.
//!
//! Any triangulation of points of which the outermost lie on the boundary, corners included, covers the whole rectangle, and a
//! vertex is never without triangles. The paper's dual of the clipped Voronoi diagram does neither; it is what remains here where
//! no triangle at the boundary has an obtuse angle opposite to it, which [`resettle`] sees to.

use glam::DVec2;

use crate::error::Error;
use crate::points::part;
use crate::space::Domain;
use crate::triangulation::{BOUNDARY, HalfEdges, Triangulation, clipped, delaunay, next, prev};

/// Points nearer to a wall than this, in spacings, are either on it or moved away from it.
const CLEARANCE: f64 = 0.6;

/// Points of a polygon nearer to each other than this, in spacings, are moved apart.
const TOO_NEAR: f64 = 0.25;
/// A place nearer than this to a point that stays, in spacings, is taken.
const TAKEN: f64 = 1e-6;
/// The fewest points that can sample a boundary: one a corner.
const FEWEST: usize = 4;

/// Whether a rectangle is too narrow for points on its boundary and others inside.
pub(super) fn is_narrow(size: DVec2, spacing: f64) -> bool {
    size.min_element() < 3.0 * spacing
}

/// What kind of boundary there is to see to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Rim {
    /// None, or too few points for one.
    None,
    /// A rectangle's walls.
    Walls,
    /// A polygon's, which stops points.
    Polygon,
    /// That of places without any density, which stops them too.
    Gaps,
}

/// Iterations after which a rectangle's triangulation is rebuilt, while boundary points find their place.
const REBUILDS: [usize; 4] = [3, 6, 12, 24];
/// A polygon's is after each so many, until so many have been made; and after each so many more.
const CUT: usize = 3;
const LAST_CUT: usize = 60;
const LATER_CUT: usize = 30;

impl Rim {
    pub fn of(domain: &Domain, has_gaps: bool, n_points: usize) -> Self {
        match () {
            () if domain.boundary.is_some() => Self::Polygon,
            () if has_gaps => Self::Gaps,
            () if domain.is_periodic || n_points < FEWEST => Self::None,
            () => Self::Walls,
        }
    }

    /// Makes the triangulation one that ends at the boundary.
    pub fn settle(self, triangulation: Triangulation, n_fixed: usize, spacing: f64) -> Result<Triangulation, Error> {
        match self {
            Self::None | Self::Gaps => Ok(triangulation),
            Self::Walls => settle(triangulation, n_fixed, spacing),
            Self::Polygon => cut_out(triangulation, n_fixed, spacing),
        }
    }

    /// Whether the triangulation is rebuilt after so many iterations.
    pub fn is_settling(self, iteration: usize) -> bool {
        match self {
            Self::None => false,
            Self::Walls => REBUILDS.contains(&iteration),
            Self::Polygon | Self::Gaps => iteration.is_multiple_of(if iteration <= LAST_CUT { CUT } else { LATER_CUT }),
        }
    }

    /// Rebuilds the triangulation.
    pub fn resettle(self, mut triangulation: Triangulation, n_fixed: usize, spacing: f64) -> Result<Triangulation, Error> {
        match self {
            Self::Walls => resettle(triangulation, n_fixed, spacing),
            Self::Gaps if triangulation.domain.is_periodic => {
                triangulation.legalize();
                Ok(triangulation)
            }
            Self::Gaps => {
                let Triangulation { positions, domain, order, .. } = triangulation;
                delaunay(&domain, positions, order)
            }
            _ => self.settle(triangulation, n_fixed, spacing),
        }
    }

    /// Whether the boundary has found its place after so many iterations.
    pub fn has_settled(self, iteration: usize) -> bool {
        match self {
            Self::None => true,
            Self::Walls => REBUILDS.iter().all(|&at| at < iteration),
            Self::Polygon | Self::Gaps => iteration > LAST_CUT,
        }
    }
}

/// Moves points onto the boundary: one to each corner, others evenly spaced along the walls; and the rest off it.
///
/// The caller's first `n_fixed` points stay; places that they take are theirs.
fn settle(triangulation: Triangulation, n_fixed: usize, spacing: f64) -> Result<Triangulation, Error> {
    let size = triangulation.domain.size;
    let is_fixed: Vec<bool> = triangulation.order.iter().map(|&index| (index as usize) < n_fixed).collect();
    let fixed = || triangulation.positions.iter().zip(&is_fixed).filter(|(_, is)| **is).map(|(p, _)| p);
    let mut places = places(size, triangulation.positions.len());
    places.retain(|place| fixed().all(|p| p.distance(*place) > TAKEN * spacing));
    places.truncate(is_fixed.len() - n_fixed);
    let chosen = nearest_vertices(&triangulation, &places, is_fixed.clone());
    let Triangulation { mut positions, domain, order, .. } = triangulation;
    let mut is_chosen = is_fixed;
    for (&vertex, &place) in chosen.iter().zip(&places) {
        positions[vertex as usize] = domain.land(place);
        is_chosen[vertex as usize] = true;
    }
    for (p, _) in positions.iter_mut().zip(&is_chosen).filter(|(_, is_chosen)| !**is_chosen) {
        *p = domain.land(cleared(*p, size, spacing));
    }
    delaunay(&domain, positions, order)
}

/// Moves points of a polygon apart that have come together at its boundary.
pub(super) fn part_crowded(domain: &Domain, positions: &mut [DVec2], order: &[u32], n_fixed: usize, spacing: f64) {
    part(domain, positions, |vertex| (order[vertex] as usize) < n_fixed, TOO_NEAR, spacing);
}

/// Retriangulates, and cuts what lies outside of a polygon off: the dual of the clipped Voronoi diagram stays.
fn cut_out(triangulation: Triangulation, n_fixed: usize, spacing: f64) -> Result<Triangulation, Error> {
    let Triangulation { mut positions, domain, order, .. } = triangulation;
    part_crowded(&domain, &mut positions, &order, n_fixed, spacing);
    let mut cut = delaunay(&domain, positions, order)?;
    cut.half_edges = clipped(&cut)?;
    Ok(cut)
}

/// Makes the triangulation Delaunay again; points that come too near to the boundary join it, those that crowd on it leave it.
fn resettle(mut triangulation: Triangulation, n_fixed: usize, spacing: f64) -> Result<Triangulation, Error> {
    triangulation.legalize();
    let moves = joining(&triangulation).into_iter().chain(leaving(&triangulation, spacing));
    let moves: Vec<(u32, DVec2)> = moves.filter(|&(vertex, _)| triangulation.order[vertex as usize] as usize >= n_fixed).collect();
    if moves.is_empty() {
        return Ok(triangulation);
    }
    let Triangulation { mut positions, domain, order, .. } = triangulation;
    for (vertex, place) in moves {
        positions[vertex as usize] = domain.land(place);
    }
    delaunay(&domain, positions, order)
}

/// The corners, and places evenly spaced between them, counter-clockwise; as many as suit `n_points`.
fn places(size: DVec2, n_points: usize) -> Vec<DVec2> {
    // With spacing 1 / y, n hexagonal cells, of which a boundary point has half and a corner a quarter, fill the rectangle:
    // (2 / sqrt(3)) A y^2 + (P / 2) y + 1 = n.
    let (a, b) = (2.0 / 3f64.sqrt() * size.x * size.y, size.x + size.y);
    let per_length = (-b + (b * b + 4.0 * a * (n_points as f64 - 1.0)).sqrt()) / (2.0 * a);
    let intervals = (size * per_length).round().max(DVec2::ONE);
    let (mut nx, mut ny) = (intervals.x as usize, intervals.y as usize);
    while 2 * (nx + ny) > n_points {
        *(if nx > ny { &mut nx } else { &mut ny }) -= 1;
    }
    let along = |n: usize, from: DVec2, to: DVec2| (0..n).map(move |k| from + (to - from) * (k as f64 / n as f64));
    let (right, left) = (DVec2::new(size.x, 0.0), DVec2::new(0.0, size.y));
    let walls = along(nx, DVec2::ZERO, right).chain(along(ny, right, size)).chain(along(nx, size, left));
    walls.chain(along(ny, left, DVec2::ZERO)).collect()
}

/// For each place a vertex of its own near to it.
fn nearest_vertices(triangulation: &Triangulation, places: &[DVec2], mut is_taken: Vec<bool>) -> Vec<u32> {
    let Triangulation { half_edges, positions, .. } = triangulation;
    let outgoing = half_edges.outgoing(positions.len());
    let neighbours =
        |v: u32| half_edges.around(outgoing[v as usize]).flat_map(|h| [half_edges.target(h), half_edges.origin[prev(h) as usize]]);
    let distance = |v: u32, place: DVec2| positions[v as usize].distance_squared(place);
    let mut at = 0;
    let mut chosen = Vec::with_capacity(places.len());
    for &place in places {
        // Walk to the nearest vertex: on a Delaunay triangulation no other vertex stops the walk.
        while let Some(nearer) = neighbours(at).find(|&v| distance(v, place) < distance(at, place)) {
            at = nearer;
        }
        let vertex = nearest_free(at, neighbours, |v| distance(v, place), &is_taken);
        is_taken[vertex as usize] = true;
        chosen.push(vertex);
    }
    chosen
}

/// The nearest vertex that is not taken, among those the fewest edges away from `start`.
fn nearest_free<N: Iterator<Item = u32>>(
    start: u32,
    neighbours: impl Fn(u32) -> N,
    distance: impl Fn(u32) -> f64,
    is_taken: &[bool],
) -> u32 {
    let mut ring = vec![start];
    let mut seen = vec![start];
    loop {
        let free = ring.iter().copied().filter(|&v| !is_taken[v as usize]);
        if let Some(nearest) = free.min_by(|&a, &b| distance(a).total_cmp(&distance(b))) {
            return nearest;
        }
        let mut wider: Vec<u32> = ring.iter().flat_map(|&v| neighbours(v)).filter(|v| !seen.contains(v)).collect();
        wider.sort_unstable();
        wider.dedup();
        seen.extend(&wider);
        ring = wider;
    }
}

/// A place that keeps clear of the walls: what is nearer to one is moved away from it.
fn cleared(p: DVec2, size: DVec2, spacing: f64) -> DVec2 {
    let clearance = DVec2::splat(CLEARANCE * spacing).min(0.4 * size);
    let from_low = DVec2::select(p.cmplt(clearance), clearance + 0.1 * p, p);
    let gap = size - from_low;
    DVec2::select(gap.cmplt(clearance), size - (clearance + 0.1 * gap), from_low)
}

/// Vertices that see an edge of the boundary at an obtuse angle, and their places on it.
fn joining(triangulation: &Triangulation) -> Vec<(u32, DVec2)> {
    let Triangulation { half_edges, positions, .. } = triangulation;
    let at = |h: u32| positions[half_edges.origin[h as usize] as usize];
    boundary(half_edges)
        .filter_map(|h| {
            let (a, b, apex) = (at(h), at(next(h)), at(prev(h)));
            let edge = b - a;
            let is_on_wall = edge.x == 0.0 || edge.y == 0.0;
            let place = a + edge * (apex - a).dot(edge) / edge.length_squared();
            (is_on_wall && (a - apex).dot(b - apex) < 0.0).then_some((half_edges.origin[prev(h) as usize], place))
        })
        .collect()
}

/// Vertices that lie on a wall between two neighbours on it that are too near, and places off the wall; never two in a row.
fn leaving(triangulation: &Triangulation, spacing: f64) -> Vec<(u32, DVec2)> {
    let Triangulation { half_edges, positions, domain, .. } = triangulation;
    let mut following = vec![BOUNDARY; positions.len()];
    for h in boundary(half_edges) {
        following[half_edges.origin[h as usize] as usize] = half_edges.target(h);
    }
    let mut leaving = Vec::new();
    let mut has_left = vec![false; positions.len()];
    for before in boundary(half_edges).map(|h| half_edges.origin[h as usize]) {
        let vertex = following[before as usize];
        let after = following[vertex as usize];
        let [a, b, c] = [before, vertex, after].map(|v| positions[v as usize]);
        let is_straight = (a.x == b.x && b.x == c.x) || (a.y == b.y && b.y == c.y);
        let is_crowded = a.distance(c) < 1.2 * spacing;
        if is_straight && is_crowded && ![before, after].iter().any(|&v| has_left[v as usize]) {
            has_left[vertex as usize] = true;
            leaving.push((vertex, cleared(b, domain.size, spacing)));
        }
    }
    leaving
}

fn boundary(half_edges: &HalfEdges) -> impl Iterator<Item = u32> {
    (0..half_edges.origin.len() as u32).filter(|&h| half_edges.is_boundary(h))
}
