//! Vertices go from where a crease or a boundary has too many beside it to where it has too few.
//!
//! The angle between two creases at one of their points, a half turn where they run straight, is shared by the triangles there: two have 90 degrees each, four 45, both outside of
//! what targets usually ask for. How many there are no move changes, and no flip without taking from the next point: the vertex that is missing comes from elsewhere.

use glam::{DVec2, DVec3};

use super::live::LiveSurface;
use super::polish::Bounds;
use crate::sweep::Ground as _;
use crate::triangulation::{BOUNDARY, Spoke, next, prev};

/// A vertex inside with so few neighbours is one too many, where the angles around it sum to this in degrees: where they sum to less it makes the shape.
const FEW_NEIGHBOURS: usize = 4;
const FLAT_DEG: f64 = 300.0;
/// So many are put in at once, or one in so many: each shakes what is around.
const MOST: usize = 2;
const PART: usize = 100;
/// So many are looked at for each that is missing: some cannot be taken out.
const CHOICE: usize = 3;
/// Angles that are off by less than this, in degrees, are within their bounds.
const SPARE_DEG: f64 = 0.5;

/// Where vertices are missing, and which can be spared.
#[derive(Default)]
struct Plan {
    /// Half-edges that leave a point of a crease, each to be followed by a new edge.
    wanting: Vec<u32>,
    /// The most dispensable first.
    spared: Vec<u32>,
}

impl LiveSurface<'_> {
    /// Takes vertices out where they can be spared, and puts them in where they are missing. Returns how many.
    pub(super) fn transplant(&mut self, bounds: Bounds) -> usize {
        let Plan { wanting, spared } = self.plan(bounds);
        let most = MOST.max(self.n_points() / PART);
        let mut spared = spared.into_iter();
        let mut n_put = 0;
        let mut is_touched = vec![false; self.n_points()];
        for h in wanting {
            let corners = [h, next(h), prev(h)].map(|h| self.mesh.origin(h));
            let Some(&beside) = corners.iter().find(|&&v| !self.is_fixed(v)) else { continue };
            if corners.iter().any(|&v| is_touched[v as usize]) {
                continue;
            }
            let is_apart = |&v: &u32| !is_touched[v as usize] && !corners.contains(&v) && !self.is_beside(v, &corners);
            let Some(v) = spared.find(is_apart) else { break };
            let around = self.neighbours(v);
            if !self.free_to_three(v) {
                continue;
            }
            let [_, second, third] = self.mesh.unite(v);
            let middle = corners.iter().map(|&v| self.at(v)).sum::<DVec3>() / 3.0;
            self.mesh.set_place(v, self.land(&self.vertex(beside), middle).numbers());
            self.mesh.divide(v, [h / 3, second, third]);
            for v in corners.into_iter().chain(around).chain([v]) {
                is_touched[v as usize] = true;
                self.soil(v);
            }
            n_put += 1;
            if n_put == most {
                break;
            }
        }
        debug_assert_eq!(self.check(), Ok(()));
        n_put
    }

    fn plan(&self, bounds: Bounds) -> Plan {
        let mut plan = Plan::default();
        let (mut ring, mut few, mut others) = (Vec::new(), Vec::new(), Vec::new());
        for v in 0..self.n_points() as u32 {
            self.walk_alone(v, &mut ring);
            if self.is_bound(v) {
                self.sectors(v, &ring).iter().for_each(|sector| self.look_into(sector, bounds, &mut plan));
            } else if self.is_spare(v, &ring) {
                if ring.len() <= FEW_NEIGHBOURS {
                    few.push(v);
                } else {
                    let nearest = ring.iter().map(|spoke| spoke.way.length()).fold(f64::INFINITY, f64::min);
                    others.push((nearest / self.local_spacing(v), v));
                }
            }
        }
        plan.spared.extend(few);
        // What is one too many beside a crease goes where there is most room; what is missing there comes from where there is least.
        let n_wanting = plan.wanting.len();
        if plan.spared.len() > n_wanting {
            plan.wanting.extend(self.roomy().take(plan.spared.len() - n_wanting));
        }
        others.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        plan.spared.extend(others.into_iter().map(|(_, v)| v).take(CHOICE * n_wanting));
        plan
    }

    /// Plans for the angle between two creases: a vertex more, or one fewer.
    fn look_into(&self, sector: &[&Spoke<DVec3>], bounds: Bounds, plan: &mut Plan) {
        let [least, most] = bounds.degrees();
        let angles: Vec<f64> = sector.windows(2).map(|pair| pair[0].way.angle_between(pair[1].way).to_degrees()).collect();
        let (sum, n) = (angles.iter().sum::<f64>(), angles.len() as f64);
        if !bounds.divides(sum) {
            return;
        }
        if sum > n * most + SPARE_DEG {
            let widest = (0..angles.len()).max_by(|&a, &b| angles[a].total_cmp(&angles[b]));
            plan.wanting.extend(widest.map(|k| sector[k].half_edge));
        } else if sum < n * least - SPARE_DEG {
            let inner = (1..angles.len()).filter(|&k| self.is_inside(sector[k].vertex));
            let narrowest = inner.min_by(|&a, &b| (angles[a - 1] + angles[a]).total_cmp(&(angles[b - 1] + angles[b])));
            plan.spared.extend(narrowest.map(|k| sector[k].vertex));
        }
    }

    /// Whether a vertex is on no crease or boundary, and does not stay.
    fn is_inside(&self, v: u32) -> bool {
        !self.is_bound(v) && !self.is_fixed(v)
    }

    /// Whether a vertex is away from creases and boundaries, and the surface about flat there.
    fn is_spare(&self, v: u32, ring: &[Spoke<DVec3>]) -> bool {
        let is_away = self.is_inside(v) && ring.iter().all(|spoke| !self.is_bound(spoke.vertex));
        let after = ring.iter().cycle().skip(1);
        is_away && ring.iter().zip(after).map(|(a, b)| a.way.angle_between(b.way)).sum::<f64>() > FLAT_DEG.to_radians()
    }

    /// Triangles of which no corner is on a crease or stays, the largest first, each by a half-edge.
    fn roomy(&self) -> impl Iterator<Item = u32> {
        let area = |t: u32| {
            let corners = [0, 1, 2].map(|k| self.mesh.origin(3 * t + k));
            let [a, b, c] = corners.map(|v| self.at(v));
            let size = corners.iter().map(|&v| self.size(v)).sum::<f64>();
            corners.into_iter().all(|v| self.is_inside(v)).then(|| ((b - a).cross(c - a).length() / (size * size), 3 * t))
        };
        let mut all: Vec<(f64, u32)> = (0..self.mesh.n_half_edges() as u32 / 3).filter_map(area).collect();
        all.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        all.into_iter().map(|(_, h)| h)
    }

    /// The spokes around a vertex from crease to crease, both included.
    pub(super) fn sectors<'r>(&self, v: u32, ring: &'r [Spoke<DVec3>]) -> Vec<Vec<&'r Spoke<DVec3>>> {
        let bonds: Vec<usize> = (0..ring.len()).filter(|&k| self.is_bond(v, ring[k].vertex)).collect();
        let is_open = ring.iter().any(|spoke| spoke.half_edge == BOUNDARY);
        let ends = bonds.iter().skip(1).copied().chain(bonds.first().filter(|_| !is_open).map(|&k| k + ring.len()));
        bonds.iter().zip(ends).map(|(&from, to)| (from..=to).map(|k| &ring[k % ring.len()]).collect()).collect()
    }

    fn is_beside(&self, v: u32, others: &[u32]) -> bool {
        self.neighbours(v).iter().any(|other| others.contains(other))
    }

    /// Flips spokes of a vertex until three are left. Whether that can be done, and a triangle can take its place.
    fn free_to_three(&self, v: u32) -> bool {
        let at = self.at(v);
        let [x, y] = self.tangents(v);
        let flat = |other: u32| {
            let way = self.at(other) - at;
            DVec2::new(way.dot(x), way.dot(y))
        };
        let mut n_spokes = self.neighbours(v).len();
        let (mut h, mut n_kept) = (self.mesh.outgoing(v), 0);
        while n_spokes > 3 && n_kept < n_spokes {
            let turned = self.mesh.turn(h).1;
            let corners = self.mesh.quadrilateral(h);
            let [_, q, r, s] = corners.map(flat);
            // The triangle that is cut off must be one; the other goes with the vertex.
            if (q - s).perp_dot(r - s) > 0.0 && r.perp_dot(s) <= 0.0 && self.can_join(corners) {
                self.flip(h);
                (n_spokes, n_kept) = (n_spokes - 1, 0);
            } else {
                n_kept += 1;
            }
            h = turned;
        }
        let across = self.mesh.twin(next(self.mesh.outgoing(v)));
        let is_tetrahedron = across != BOUNDARY && self.neighbours(v).contains(&self.mesh.turn(across).0);
        // A tetrahedron has the triangle already.
        n_spokes == 3 && !is_tetrahedron
    }
}
