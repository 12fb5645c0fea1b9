//! Reading a star: its spokes are made Delaunay first.
//!
//! The edges between neighbours are not: they are spokes of the neighbours, which see to them when they are read. Until then the star may lack a
//! neighbour. What it shows is certain once [`LiveMesh::legalize`] finds nothing to flip in all of the mesh.

use glam::DVec2;
use rayon::prelude::*;

use super::echoes::{close, hide, reflect};
use super::half_edges::{BOUNDARY, next};
use super::held::Held;
use super::live::{LEAST_DENSITY, LiveMesh, Outside};
use super::shared::Territory;
use super::sight::Sight;
use super::spoke::{MIRROR, Spoke};
use super::walls::WallCell;
use crate::density::Field;
use crate::error::Error;
use crate::star::{Senses, Star, Wall, Wedge};

/// The gradient of a length that is 1 at the origin and as given at some places, by least squares; zero where these do not tell.
pub(crate) fn slope(known: impl Iterator<Item = (DVec2, f64)>) -> DVec2 {
    let (mut xx, mut xy, mut yy, mut right) = (0.0, 0.0, 0.0, DVec2::ZERO);
    for (place, length) in known {
        (xx, xy, yy) = (xx + place.x * place.x, xy + place.x * place.y, yy + place.y * place.y);
        right += (length - 1.0) * place;
    }
    let determinant = xx * yy - xy * xy;
    if determinant <= f64::EPSILON * (xx + yy) * (xx + yy) {
        return DVec2::ZERO;
    }
    DVec2::new(yy * right.x - xy * right.y, xx * right.y - xy * right.x) / determinant
}

/// The fewest points that a thread looks at in one go.
const CHUNK: usize = 1 << 12;
/// The corners of cells are looked at up to so many times the longest spoke.
const FAR: f64 = 16.0;
/// By how much more than others the area of a cell at a wall or boundary may be off whose point stays.
const LEEWAY_AT_WALLS: f64 = 1.0;
/// Where the sum of two cotangents is less than this much of its terms, exact arithmetic decides on its sign.
const DOUBT: f64 = 1e-9;

/// What one thread reads stars into.
#[derive(Default)]
pub(crate) struct StarBuffer {
    pub star: Star,
    /// What is to be found of the density's measure.
    pub senses: Senses,
    /// The star's spokes, as vectors.
    pub spokes: Vec<Spoke>,
    /// What a rule makes of the star: which points are to move, and by what.
    pub moves: Vec<(u32, DVec2)>,
    /// Edges flipped so far.
    pub n_flips: usize,
    /// The spokes of a vertex that moves.
    pub(super) moving: Vec<Spoke>,
    /// The vertices around one.
    pub near: Vec<u32>,
    pub(super) wall_cell: WallCell,
    /// What is seen of a cell that a polygon's boundary cuts; nothing of others.
    pub sight: Sight,
    /// The corners of a cell.
    corners: Vec<DVec2>,
    /// The mean density along the sides of what is seen of it.
    seen_sides: Vec<f64>,
}

/// What [`LiveMesh::distances`] finds.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Distances {
    pub smallest: f64,
    pub largest_radius: f64,
    pub mean_ratio: f64,
}

impl StarBuffer {
    /// One that finds so much of the density's measure.
    pub fn sensing(senses: Senses) -> Self {
        Self { senses, ..Self::default() }
    }
}

impl LiveMesh {
    /// Makes the spokes of `v` Delaunay, and reads its star.
    pub fn read(&self, v: u32, territory: Territory, buffer: &mut StarBuffer) -> Result<(), Outside> {
        self.read_in::<false>(v, territory, buffer)
    }

    /// The same, in a [plain](Self::is_plain) mesh if `PLAIN`: then nothing but that is looked at.
    pub fn read_in<const PLAIN: bool>(&self, v: u32, territory: Territory, buffer: &mut StarBuffer) -> Result<(), Outside> {
        self.restore_in::<PLAIN>(v, territory, &mut buffer.spokes, &mut buffer.n_flips)?;
        self.fill::<PLAIN>(v, buffer);
        if PLAIN {
            return Ok(());
        }
        if let Some(boundary) = &self.domain.boundary
            && !self.is_clear(boundary, v, buffer)
        {
            self.fill_within(boundary, v, territory, buffer)?;
        }
        if self.is_fixed(v) && buffer.star.is_mirror.contains(&true) {
            buffer.star.leeway = LEEWAY_AT_WALLS;
        }
        if let Some(field) = &self.field {
            self.weigh(field, v, buffer);
        }
        if let Some(held) = &self.held {
            self.scale_sizes(held, v, buffer);
        }
        let neighbours = buffer.spokes.iter().filter(|spoke| spoke.vertex < self.n_live).map(|spoke| self.point(spoke.vertex));
        buffer.star.slack = self.patience.slack(v, buffer.star.leeway > 0.0, neighbours);
        if let Some(share) = self.shares.get(v as usize) {
            let star = &mut buffer.star;
            let mass = star.metric.mass.unwrap_or_else(|| star.measure_cell());
            star.metric.mass = Some(mass * share);
        }
        Ok(())
    }

    /// Whether a point or one of its neighbours is fixed.
    pub fn is_at_fixed(&self, v: u32, spokes: &[Spoke]) -> bool {
        self.has_fixed() && (self.is_fixed(v) || spokes.iter().any(|spoke| self.is_fixed(self.point(spoke.vertex))))
    }

    /// Looks at the stars of all points, in order.
    pub fn look<T: Send>(&mut self, senses: Senses, look: impl Fn(&Self, u32, &mut StarBuffer) -> T + Sync) -> Result<Vec<T>, Error> {
        self.legalize();
        if self.mend()? {
            self.legalize();
        }
        let mesh = &*self;
        let all = (0..self.n_points() as u32).into_par_iter().with_min_len(CHUNK);
        let seen = all.map_init(
            || StarBuffer::sensing(senses),
            |buffer, v| {
                // With everything free, nothing lies outside.
                let _ = mesh.read(v, Territory::EVERYTHING, buffer);
                look(mesh, v, buffer)
            },
        );
        Ok(seen.collect())
    }

    /// The smallest distance of two points and the largest circumradius, in the wanted spacings where a mesh varies them, and in spacings elsewhere; and the mean over the points of the ratio
    /// of their own largest circumradius to their own smallest distance.
    pub fn distances(&mut self) -> Result<Distances, Error> {
        let seen = self.look(Senses::default(), |_, _, StarBuffer { star, .. }| {
            let neighbours = (0..star.n_spokes()).filter(|&k| !star.is_mirror[k]);
            let nearest = neighbours.map(|k| star.lengths[k] * star.stretch(k)).fold(f64::INFINITY, f64::min);
            [nearest, (0..star.n_spokes()).map(|k| star.weighted_radius(k)).fold(0.0, f64::max)]
        })?;
        let n = seen.len() as f64;
        Ok(Distances {
            smallest: seen.iter().map(|star| star[0]).fold(f64::INFINITY, f64::min),
            largest_radius: seen.iter().map(|star| star[1]).fold(0.0, f64::max),
            mean_ratio: seen.iter().map(|[nearest, farthest]| farthest / nearest).sum::<f64>() / n,
        })
    }

    /// Moves all points, each by its own vector or as far as it gets.
    pub fn move_all(&mut self, by: &[DVec2]) {
        let mut buffer = StarBuffer::default();
        for (point, &by) in (0..).zip(by) {
            // With everything free, nothing lies outside.
            let _ = self.relocate(point, by, Territory::EVERYTHING, &mut buffer);
        }
    }

    /// Lays out the star of `v`, which has just been read, and the stars of its neighbours.
    pub fn look_around(&self, v: u32, territory: Territory, buffer: &mut StarBuffer) -> Result<(), Outside> {
        let StarBuffer { star, spokes, moving, near, n_flips, .. } = buffer;
        self.walk(v, territory, moving)?;
        near.clear();
        near.extend(moving.iter().map(|spoke| spoke.vertex));
        for k in 0..near.len() {
            if near[k] < self.n_live {
                self.restore(near[k], territory, moving, n_flips)?;
                for spoke in moving.iter() {
                    if !near.contains(&spoke.vertex) {
                        near.push(spoke.vertex);
                    }
                }
            }
        }
        // Flips around the neighbours may have added some.
        self.walk(v, territory, moving)?;
        let is_in_ring = |other: u32| other == v || moving.iter().any(|spoke| spoke.vertex == other);
        let (at, scale) = (self.mesh.position(v), 1.0 / self.spacing);
        let is_seen = |other: u32| other < self.n_live && self.domain.sees(at, self.mesh.position(other));
        let place = |other: u32| is_seen(other).then(|| scale * self.spoke(at, other));
        star.ring.clear();
        star.ring.extend(moving.iter().filter_map(|spoke| place(spoke.vertex)));
        star.beyond.clear();
        star.beyond.extend(near.iter().filter(|&&other| !is_in_ring(other)).filter_map(|&other| place(other)));
        star.walls.clear();
        (star.rail, star.slope) = (None, DVec2::ZERO);
        if let Some(held) = &self.held {
            star.rail = held.rail(v);
            star.slope = slope(moving.iter().map(|spoke| (scale * spoke.way, held.size(spoke.vertex) / held.size(v))));
            for (spoke, after) in moving.iter().zip(moving[1..].iter().chain(&moving[..1])) {
                if spoke.half_edge != BOUNDARY && self.is_wall(held, spoke, after) {
                    let normal = -(after.way - spoke.way).perp().normalize_or_zero();
                    star.walls.push(Wall { normal, distance: scale * spoke.way.dot(normal) });
                }
            }
            if moving[moving.len() - 1].half_edge == BOUNDARY {
                reflect(star);
            }
        } else if self.domain.boundary.is_some() {
            let walls = spokes.iter().filter(|spoke| spoke.vertex == MIRROR);
            star.walls.extend(walls.map(|spoke| Wall { normal: spoke.way.normalize_or_zero(), distance: 0.5 * spoke.length }));
        } else if !self.domain.is_periodic {
            let (low, high) = (scale * at, scale * (self.domain.size - at));
            let walls = [(DVec2::NEG_X, low.x), (DVec2::NEG_Y, low.y), (DVec2::X, high.x), (DVec2::Y, high.y)];
            star.walls.extend(walls.map(|(normal, distance)| Wall { normal, distance }));
        }
        Ok(())
    }

    /// Goes around `v`, and flips its spokes until none is illegal.
    pub(super) fn restore(&self, v: u32, territory: Territory, ring: &mut Vec<Spoke>, n_flips: &mut usize) -> Result<(), Outside> {
        self.restore_in::<false>(v, territory, ring, n_flips)
    }

    fn restore_in<const PLAIN: bool>(
        &self,
        v: u32,
        territory: Territory,
        ring: &mut Vec<Spoke>,
        n_flips: &mut usize,
    ) -> Result<(), Outside> {
        loop {
            self.walk_in::<PLAIN>(v, territory, ring)?;
            let Some(h) = self.find_illegal(ring) else { return Ok(()) };
            self.flip(h);
            *n_flips += 1;
        }
    }

    /// Goes once around `v`, counter-clockwise.
    pub(super) fn walk(&self, v: u32, territory: Territory, ring: &mut Vec<Spoke>) -> Result<(), Outside> {
        self.walk_in::<false>(v, territory, ring)
    }

    #[inline]
    fn walk_in<const PLAIN: bool>(&self, v: u32, territory: Territory, ring: &mut Vec<Spoke>) -> Result<(), Outside> {
        ring.clear();
        let at = self.mesh.position(v);
        let first = self.mesh.outgoing(v);
        let (mut vertex, mut half_edge) = (self.mesh.origin(next(first)), first);
        let mut way = self.spoke(at, vertex);
        loop {
            if !self.is_free(vertex, territory) {
                return Err(Outside);
            }
            let (after, turned) = self.mesh.turn(half_edge);
            let way_after = self.spoke(at, after);
            let (dot, cross) = (way.dot(way_after), way.perp_dot(way_after));
            ring.push(Spoke { vertex, half_edge, way, squared: way.length_squared(), dot, cross, ..Spoke::default() });
            (vertex, half_edge, way) = (after, turned, way_after);
            if half_edge == first {
                return Ok(());
            }
            if !PLAIN && half_edge == BOUNDARY {
                if !self.is_free(vertex, territory) {
                    return Err(Outside);
                }
                ring.push(Spoke { vertex, half_edge, way, squared: way.length_squared(), ..Spoke::default() });
                return Ok(());
            }
        }
    }

    /// A spoke that is illegal.
    fn find_illegal(&self, ring: &[Spoke]) -> Option<u32> {
        // The angles opposite an edge sum to less than pi where their cotangents sum to more than 0.
        let is_doubtful = |a: f64, b: f64| a + b <= DOUBT * (a.abs() + b.abs());
        let mut before = &ring[ring.len() - 1];
        for (k, spoke) in ring.iter().enumerate() {
            let after = ring.get(k + 1).unwrap_or(&ring[0]);
            let is_doubted = is_doubtful((after.squared - spoke.dot) * before.cross, (before.squared - before.dot) * spoke.cross);
            if is_doubted && spoke.half_edge != BOUNDARY && self.is_illegal(spoke.half_edge) {
                return Some(spoke.half_edge);
            }
            before = spoke;
        }
        None
    }

    /// Turns the spokes in the buffer into a star; near a wall that of the cell which the walls clip.
    fn fill<const PLAIN: bool>(&self, v: u32, buffer: &mut StarBuffer) {
        let StarBuffer { star, spokes, senses, wall_cell, sight, .. } = buffer;
        sight.outline.clear();
        let scale = 1.0 / self.spacing;
        star.clear();
        star.lengths.extend(spokes.iter().map(|spoke| spoke.squared.sqrt() * scale));
        star.is_mirror.resize(spokes.len(), false);
        let area_scale = scale * scale;
        let after = star.lengths[1..].iter().chain(&star.lengths[..1]);
        for ((spoke, &length), length_after) in spokes.iter_mut().zip(&star.lengths).zip(after) {
            spoke.length = length;
            // One division for both the sine and its inverse.
            let (product, cross) = (length * length_after, spoke.cross * area_scale);
            let inverse = 1.0 / (product * cross);
            let over_product = inverse * cross;
            let cos = spoke.dot * area_scale * over_product;
            star.wedges.push(Wedge { cos, sin: cross * over_product, cosecant: product * product * inverse });
        }
        if PLAIN {
            return;
        }
        if let Some(held) = &self.held {
            if senses.echoes {
                self.wall_off(held, v, star, spokes);
            }
            let n = spokes.len();
            if spokes[n - 1].half_edge == BOUNDARY {
                close(star, spokes);
                if senses.echoes && held.is_on_rail(v) {
                    hide(star, spokes, n);
                }
            }
        } else if !self.domain.is_periodic && self.domain.boundary.is_none() {
            let at = self.mesh.position(v);
            let wall = at.min(self.domain.size - at).min_element() * scale;
            let is_clear = spokes.iter().zip(0..).all(|(spoke, k)| spoke.vertex < self.n_live && star.is_covered(k, wall));
            if !is_clear {
                let neighbours = spokes.iter().filter(|spoke| spoke.vertex < self.n_live);
                wall_cell.clip(at, self.domain.size, neighbours.map(|spoke| (spoke.vertex, spoke.way)));
                wall_cell.fill(star, spokes, scale);
            }
        }
    }
}

impl LiveMesh {
    /// Finds what the star's lengths, radii and area are in the spacings that are wanted at its vertices.
    fn scale_sizes(&self, held: &Held, v: u32, buffer: &mut StarBuffer) {
        let StarBuffer { star, spokes, senses, .. } = buffer;
        let own = held.size(v);
        let n = spokes.len();
        for (k, spoke) in spokes.iter().enumerate() {
            let (size, after) = (held.size(spoke.vertex), held.size(spokes[if k + 1 == n { 0 } else { k + 1 }].vertex));
            let root = 2.0 * self.spacing / (own + size);
            star.metric.spokes.push(root);
            star.metric.sides.push(root * root);
            star.metric.radii.push(3.0 * self.spacing / (own + size + after));
        }
        if senses.centroid {
            star.metric.sizes.extend(spokes.iter().map(|spoke| held.size(spoke.vertex) / own));
        }
        star.metric.scale = self.spacing / own;
        star.metric.mass = Some(star.measure_cell() * star.metric.scale * star.metric.scale * held.fullness(v));
    }

    /// Finds what the star's lengths, radii and area are in the measure of the density.
    fn weigh(&self, field: &Field, v: u32, buffer: &mut StarBuffer) {
        let StarBuffer { star, spokes, senses, corners, sight, seen_sides, .. } = buffer;
        let at = self.mesh.position(v);
        let n = star.n_spokes();
        // A needle's centre may be anywhere, and the way there endless. Cells of points that are spread at all have none so far away.
        let longest = spokes.iter().map(|spoke| spoke.way.length_squared()).fold(0.0, f64::max).sqrt();
        let farthest = self.domain.size.length().min(FAR * longest);
        corners.clear();
        corners.extend((0..n).map(|k| {
            let [along_u, along_v] = star.centre(k);
            let centre = along_u * spokes[k].way + along_v * spokes[star.after(k)].way;
            if centre.is_finite() { centre.clamp_length_max(farthest) } else { DVec2::ZERO }
        }));
        let around = || spokes.iter().map(|spoke| spoke.way).chain(corners.iter().copied());
        let (low, high) = (around().fold(DVec2::ZERO, DVec2::min), around().fold(DVec2::ZERO, DVec2::max));
        let [least, most] = field.root_bounds(at + low, at + high);
        if let Some(enough) = senses.lengths {
            let stretch = |(spoke, &length): (&Spoke, &f64)| match spoke.vertex {
                _ if length * least >= enough => least,
                // The way to a mirror image is that to the wall, and back.
                MIRROR => field.stretch(at, 0.5 * spoke.way),
                _ => field.stretch_between(at, spoke.way, most),
            };
            star.metric.spokes.extend(spokes.iter().zip(&star.lengths).map(stretch));
        }
        if let Some(allowed) = senses.radii {
            for (k, &centre) in corners.iter().enumerate() {
                let radius = star.circumradius(k);
                // On a wall it is shared with the neighbour alone, whose image sees what the neighbour sees.
                let others = [&spokes[k], &spokes[star.after(k)]].into_iter().filter(|spoke| spoke.vertex != MIRROR);
                let ways = std::iter::once((at, centre)).chain(others.map(|spoke| (at + spoke.way, centre - spoke.way)));
                let n = ways.clone().count() as f64;
                // Each way is no more than the bound; as they are found one after the other, that may be enough.
                let (mut found, mut n_left) = (0.0, n);
                for (from, way) in ways {
                    if radius * (found + n_left * most) <= n * allowed {
                        break;
                    }
                    found += field.stretch(from, way);
                    n_left -= 1.0;
                }
                let bound = if n_left > 0.0 { n_left * most } else { 0.0 };
                star.metric.radii.push((found + bound) / n);
            }
        }
        let unit = 1.0 / (self.spacing * self.spacing);
        let is_hull = !sight.outline.is_empty();
        if senses.centroid {
            let (mass, centroid) = field.centroid(at, if is_hull { &sight.outline } else { corners });
            (star.metric.mass, star.metric.centroid) = (Some(mass * unit), Some(centroid / self.spacing));
        } else if senses.mass {
            let of_corners = field.mass(at, corners, &mut star.metric.sides);
            seen_sides.clear();
            let mass = if is_hull { field.mass(at, &sight.outline, seen_sides) } else { of_corners };
            star.metric.mass = Some(mass * unit);
        }
        let density = match star.metric.mass {
            Some(mass) => mass / star.measure_cell().max(f64::MIN_POSITIVE),
            None => field.at(at),
        };
        star.metric.scale = density.clamp(LEAST_DENSITY, 1.0 / LEAST_DENSITY).sqrt();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::points::hilbert_order;
    use crate::{Rectangle, Space, Torus, measure, warp, white};

    fn spaces() -> [Space; 4] {
        [
            Torus::new([0.0, 0.0], [1.0, 1.0]).unwrap().into(),
            Torus::new([-3.0, 7.0], [30.0, 1.0]).unwrap().into(),
            Rectangle::new([0.0, 0.0], [1.0, 1.0]).unwrap().into(),
            Rectangle::new([1e6, 0.0], [0.5, 20.0]).unwrap().into(),
        ]
    }

    /// Stars are the only thing that rules see, so what they show must be what an independent measurement finds.
    #[test]
    fn the_stars_of_all_points_show_what_is_measured() {
        for space in spaces() {
            for (n, is_warped) in [(3, false), (10, false), (300, false), (300, true), (5000, true)] {
                let mut points = white(&space, n, 3).unwrap();
                if is_warped {
                    warp(&mut points);
                }
                let measures = measure(&points).unwrap();
                let (domain, positions) = points.normalized();
                let order = hilbert_order(&positions, domain.size);
                let sorted = order.iter().map(|&index| positions[index as usize]).collect();
                let mesh = LiveMesh::new(&domain, None, sorted, order, domain.hex_spacing(n)).unwrap();
                let mean = 3f64.sqrt() / 2.0;
                let (mut area, mut radius, mut distance, mut deviation) = (0.0, 0.0f64, f64::INFINITY, 0.0f64);
                let mut buffer = StarBuffer::default();
                for v in 0..n as u32 {
                    mesh.read(v, Territory::EVERYTHING, &mut buffer).unwrap();
                    let star = &mut buffer.star;
                    let capacity = star.measure_cell();
                    area += capacity;
                    deviation = deviation.max((capacity / mean - 1.0).abs());
                    radius = (0..star.n_spokes()).map(|k| star.circumradius(k)).fold(radius, f64::max);
                    let neighbours = star.lengths.iter().zip(&star.is_mirror).filter(|(_, is_mirror)| !**is_mirror);
                    distance = neighbours.map(|(length, _)| *length).fold(distance, f64::min);
                }
                assert_eq!(buffer.n_flips, 0);
                let case = format!("{space}, {n}");
                assert!((area / (n as f64 * mean) - 1.0).abs() < 1e-9, "{case}: {area}");
                assert!((radius / measures.coverage_radius - 1.0).abs() < 1e-6, "{case}: {radius}");
                assert!((distance / measures.min_distance - 1.0).abs() < 1e-6, "{case}: {distance}");
                assert!((deviation - measures.capacity_max_deviation).abs() < 1e-6, "{case}: {deviation}");
            }
        }
    }
}
