//! [`Field`]: a density in the normalised coordinates of a domain, with exact lengths, masses and centroids.
//!
//! A length is the integral of the root of the density. A mass is found by Green's theorem: the integral of the density up to the boundary, along the
//! boundary; so the cost grows with the pixels that the boundary crosses.

use std::sync::Arc;

use glam::DVec2;

use super::raster::Raster;
use super::walk::Walk;
use crate::space::{Boundary, Domain};

/// A density on a domain, 1 on average.
#[derive(Debug, Clone)]
pub(crate) struct Field {
    raster: Arc<Raster>,
    is_periodic: bool,
    /// Pixels to a unit along each axis.
    resolution: DVec2,
    /// From the raster's densities to those that are 1 on average.
    scale: f64,
    root_scale: f64,
}

/// A pixel of a row.
struct Pixel {
    start: f64,
    /// Of the row, what lies before it.
    before: f64,
    value: f64,
}

/// How far from a pixel's boundary points are put, in pixels: rounding does not take them over it.
const CLEARANCE: f64 = 1.0 / 64.0;
/// The least mean density in a polygon, relative to that of its frame.
const LEAST_INSIDE: f64 = 1e-9;
/// No way is shorter than this part of itself, also where there is no density at all.
const LEAST_STRETCH: f64 = 1e-6;
/// The part of their places' roots that counts in a gap between two points.
const GAP: f64 = 0.5;
/// Where the integrand is a polynomial of third degree at most, two places are enough: the nodes of Gauss.
const NODES: [f64; 2] = [0.211_324_865_405_187_1, 0.788_675_134_594_812_9];

impl Field {
    pub(super) fn new(raster: &Arc<Raster>, domain: &Domain) -> Self {
        let size = DVec2::new(raster.columns as f64, raster.rows as f64);
        let scale = size.x * size.y / raster.total();
        let mut field = Self {
            raster: Arc::clone(raster),
            is_periodic: domain.is_periodic,
            resolution: size / domain.size,
            scale,
            root_scale: scale.sqrt(),
        };
        if let Some(boundary) = &domain.boundary {
            let inside: f64 = field.part_masses(boundary).iter().sum();
            // Where there is next to nothing inside, nothing can be made of it.
            if inside > LEAST_INSIDE * boundary.area {
                field.scale = scale * boundary.area / inside;
                field.root_scale = field.scale.sqrt();
            }
        }
        field
    }

    /// The mass of each part of a polygon's inside.
    pub fn part_masses(&self, boundary: &Boundary) -> Vec<f64> {
        let mut masses = vec![0.0; boundary.n_parts()];
        for (number, [a, b]) in boundary.segments().iter().enumerate() {
            masses[boundary.part_at(number)] += self.flux(a * self.resolution, b * self.resolution).0;
        }
        masses.iter().map(|pixels| pixels * self.scale / (self.resolution.x * self.resolution.y)).collect()
    }

    /// Whether there are places without any density.
    pub fn has_gaps(&self) -> bool {
        self.raster.has_zeros
    }

    /// The largest density of the picture.
    pub fn largest(&self) -> f64 {
        self.scale * self.raster.largest()
    }

    /// The density at a place.
    #[inline]
    pub fn at(&self, place: DVec2) -> f64 {
        let pixel = place * self.resolution;
        let (column, row) = self.inside(floor(pixel.x), floor(pixel.y));
        self.scale * self.raster.value(column, row)
    }

    /// The pixel of the picture that is meant by this one: on a torus the picture goes on for ever, in a rectangle its outermost pixels do.
    #[inline]
    fn inside(&self, column: i64, row: i64) -> (usize, usize) {
        let (columns, rows) = (self.raster.columns as i64, self.raster.rows as i64);
        if (0..columns).contains(&column) && (0..rows).contains(&row) {
            (column as usize, row as usize)
        } else if self.is_periodic {
            (column.rem_euclid(columns) as usize, row.rem_euclid(rows) as usize)
        } else {
            (column.clamp(0, columns - 1) as usize, row.clamp(0, rows - 1) as usize)
        }
    }

    /// Bounds for the root of the density in a box; wide ones where it reaches out of the picture.
    pub fn root_bounds(&self, low: DVec2, high: DVec2) -> [f64; 2] {
        let (low, high) = (low * self.resolution, high * self.resolution);
        let end = DVec2::new(self.raster.columns as f64, self.raster.rows as f64);
        if !(low.cmpge(DVec2::ZERO).all() && high.cmplt(end).all()) {
            return [0.0, f64::INFINITY];
        }
        let corner = |pixel: DVec2| [pixel.x as usize, pixel.y as usize];
        self.raster.extremes(corner(low), corner(high)).map(|density| self.root_scale * density.sqrt())
    }

    /// By what the length of a segment between two points is to be multiplied: the mean of the density's root along it. Where there is next to no density between them, as
    /// across a gap, it is half of what it is at their places: they are not neighbours as if there were no gap. The root is known to be `most` at most.
    pub fn stretch_between(&self, from: DVec2, by: DVec2, most: f64) -> f64 {
        let stretch = self.stretch(from, by);
        if stretch >= GAP * most {
            return stretch;
        }
        stretch.max(GAP * self.at(from).min(self.at(from + by)).sqrt()).max(LEAST_STRETCH)
    }

    /// The mean of the density's root along a segment.
    #[inline]
    pub fn stretch(&self, from: DVec2, by: DVec2) -> f64 {
        let from = from * self.resolution;
        let mut walk = Walk::new(from, from + by * self.resolution);
        let (mut sum, mut before) = (0.0, 0.0);
        if let Some(mut index) = self.clear_index(&walk) {
            let sums = self.raster.sums();
            let (across, up) = self.strides(&walk);
            let root = |index: usize| (sums[index + 1] - sums[index]).sqrt();
            for _ in 0..walk.n_crossings {
                let (t, is_column) = walk.cross();
                sum += (t - before) * root(index);
                index = index.wrapping_add(if is_column { across } else { up });
                before = t;
            }
            sum += (1.0 - before) * root(index);
        } else {
            let root = |column, row| {
                let (column, row) = self.inside(column, row);
                self.raster.value(column, row).sqrt()
            };
            for _ in 0..walk.n_crossings {
                let (column, row) = (walk.column, walk.row);
                let (t, is_column) = walk.cross();
                sum += (t - before) * root(column, row);
                walk.column += if is_column { walk.step[0] } else { 0 };
                walk.row += if is_column { 0 } else { walk.step[1] };
                before = t;
            }
            sum += (1.0 - before) * root(walk.column, walk.row);
        }
        self.root_scale * sum
    }

    /// The mass in a polygon, given counter-clockwise by its corners relative to `at`; leaves in `sides` the mean density along the side that ends in each corner.
    pub fn mass(&self, at: DVec2, corners: &[DVec2], sides: &mut Vec<f64>) -> f64 {
        let at = at * self.resolution;
        let mut sum = 0.0;
        let mut from = corners.last().map_or(at, |&corner| at + corner * self.resolution);
        for &corner in corners {
            let to = at + corner * self.resolution;
            let (before, mean) = self.flux(from, to);
            sum += before;
            sides.push(self.scale * mean);
            from = to;
        }
        sum * self.scale / (self.resolution.x * self.resolution.y)
    }

    /// What lies before a segment in the rows that it crosses, in pixels, negative where it goes down; and the mean along it.
    fn flux(&self, from: DVec2, to: DVec2) -> (f64, f64) {
        let mut walk = Walk::new(from, to);
        let by = to - from;
        let (mut sum, mut mean, mut before) = (0.0, 0.0, 0.0);
        let mut add = |t: f64, start: f64, row_before: f64, value: f64| {
            sum += (t - before) * (row_before + value * (from.x + 0.5 * (before + t) * by.x - start));
            mean += (t - before) * value;
            before = t;
        };
        if let Some(mut at) = self.clear_index(&walk) {
            let sums = self.raster.sums();
            let (across, up) = self.strides(&walk);
            let mut start = walk.column as f64;
            for _ in 0..walk.n_crossings {
                let (t, is_column) = walk.cross();
                add(t, start, sums[at], sums[at + 1] - sums[at]);
                at = at.wrapping_add(if is_column { across } else { up });
                start += if is_column { walk.step[0] as f64 } else { 0.0 };
            }
            add(1.0, start, sums[at], sums[at + 1] - sums[at]);
        } else {
            for _ in 0..walk.n_crossings {
                let (column, row) = (walk.column, walk.row);
                let (t, is_column) = walk.cross();
                let Pixel { start, before, value } = self.pixel(column, row);
                add(t, start, before, value);
                walk.column += if is_column { walk.step[0] } else { 0 };
                walk.row += if is_column { 0 } else { walk.step[1] };
            }
            let Pixel { start, before, value } = self.pixel(walk.column, walk.row);
            add(1.0, start, before, value);
        }
        (sum * by.y, mean)
    }

    /// The index of a way's first pixel among the sums, if all of it stays clear of the picture's boundary.
    #[inline]
    fn clear_index(&self, walk: &Walk) -> Option<usize> {
        let (columns, rows) = (self.raster.columns as i64, self.raster.rows as i64);
        let n = walk.n_crossings as i64 + 1;
        let is_clear = walk.column >= n && walk.row >= n && walk.column + n < columns && walk.row + n < rows;
        is_clear.then(|| (walk.column + walk.row * (columns + 1)) as usize)
    }

    /// How the index changes from one column, and from one row, to the next of a way.
    #[inline]
    fn strides(&self, walk: &Walk) -> (usize, usize) {
        (walk.step[0] as usize, (walk.step[1] * (self.raster.columns as i64 + 1)) as usize)
    }

    /// A pixel, and the sum of its row up to it.
    fn pixel(&self, column: i64, row: i64) -> Pixel {
        let (inside, row) = self.inside(column, row);
        let (start, before) = if self.is_periodic && column != inside as i64 {
            // Whole periods before it.
            let periods = (column - inside as i64) / self.raster.columns as i64;
            (column as f64, periods as f64 * self.raster.before(self.raster.columns, row))
        } else {
            (inside as f64, 0.0)
        };
        Pixel { start, before: before + self.raster.before(inside, row), value: self.raster.value(inside, row) }
    }

    /// The integrals of the raster's density in a row up to `x`, which lies in `column`; and of density times `x`.
    fn moment_up_to(&self, x: f64, column: i64, row: i64) -> [f64; 2] {
        let (inside, row) = self.inside(column, row);
        let columns = self.raster.columns as f64;
        let periods = if self.is_periodic { ((column - inside as i64) / self.raster.columns as i64) as f64 } else { 0.0 };
        let (sum, moment) = (self.raster.before(inside, row), self.raster.moment_before(inside, row));
        let value = self.raster.value(inside, row);
        let (start, x) = (inside as f64, x - periods * columns);
        let (sum, moment) = (sum + value * (x - start), moment + 0.5 * value * (x - start) * (x + start));
        if periods == 0.0 {
            return [sum, moment];
        }
        // Before it lie whole periods, the k-th of them k periods from the start.
        let (of_row, moment_of_row) = (self.raster.before(self.raster.columns, row), self.raster.moment_before(self.raster.columns, row));
        let shifts = 0.5 * periods * (periods - 1.0) * columns;
        [sum + periods * of_row, moment + periods * (columns * sum + moment_of_row) + shifts * of_row]
    }

    /// The mass in a polygon, given as in [`Self::mass`], and its centroid relative to `at`.
    pub fn centroid(&self, at: DVec2, corners: &[DVec2]) -> (f64, DVec2) {
        let (mut sum, mut moment) = (0.0, DVec2::ZERO);
        let origin = at * self.resolution;
        let mut from = corners.last().map_or(origin, |&corner| origin + corner * self.resolution);
        for &corner in corners {
            let to = origin + corner * self.resolution;
            let by = to - from;
            let mut walk = Walk::new(from, to);
            let mut before = 0.0;
            for crossing in 0..=walk.n_crossings {
                let (column, row) = (walk.column, walk.row);
                let (t, is_column) = if crossing < walk.n_crossings { walk.cross() } else { (1.0, false) };
                for node in NODES {
                    let place = from + (before + node * (t - before)) * by;
                    let [mass, of_x] = self.moment_up_to(place.x, column, row);
                    let weight = 0.5 * (t - before) * by.y;
                    sum += weight * mass;
                    moment += weight * DVec2::new(of_x - origin.x * mass, (place.y - origin.y) * mass);
                }
                walk.column += if is_column { walk.step[0] } else { 0 };
                walk.row += if is_column { 0 } else { walk.step[1] };
                before = t;
            }
            from = to;
        }
        let centroid = if sum > 0.0 { moment / sum / self.resolution } else { DVec2::ZERO };
        (sum * self.scale / (self.resolution.x * self.resolution.y), centroid)
    }

    /// The mass in a box of the domain.
    pub fn mass_in(&self, low: DVec2, high: DVec2) -> f64 {
        let (low, high) = (low * self.resolution, high * self.resolution);
        let sum: f64 =
            self.rows(low.y, high.y).map(|(row, part)| part * (self.raster.up_to(high.x, row) - self.raster.up_to(low.x, row))).sum();
        sum * self.scale / (self.resolution.x * self.resolution.y)
    }

    /// The area of the places in a box of the domain that have some density.
    pub fn area_with_some(&self, low: DVec2, high: DVec2) -> f64 {
        let (low, high) = (low * self.resolution, high * self.resolution);
        let columns = (low.x as usize).min(self.raster.columns - 1)..(high.x.ceil() as usize).min(self.raster.columns);
        let width = |column: usize| (high.x.min(column as f64 + 1.0) - low.x.max(column as f64)).max(0.0);
        let in_row = |row: usize| -> f64 { columns.clone().filter(|&column| self.raster.value(column, row) > 0.0).map(width).sum() };
        let pixels: f64 = self.rows(low.y, high.y).map(|(row, part)| part * in_row(row)).sum();
        pixels / (self.resolution.x * self.resolution.y)
    }

    /// The rows between two heights, in pixels, and how much of each.
    fn rows(&self, low: f64, high: f64) -> impl Iterator<Item = (usize, f64)> + Clone + use<> {
        let first = (low as usize).min(self.raster.rows - 1);
        let end = (high.ceil() as usize).clamp(first + 1, self.raster.rows);
        (first..end).map(move |row| (row, (high.min(row as f64 + 1.0) - low.max(row as f64)).max(0.0)))
    }

    /// Where a box is to be cut across an axis, so that this share of its mass lies below; in a box without mass, by area.
    pub fn cut(&self, low: DVec2, high: DVec2, axis: usize, share: f64) -> f64 {
        let (from, to) = (low * self.resolution, high * self.resolution);
        let rows = self.rows(from.y, to.y);
        let row_mass = |row: usize, x: f64| self.raster.up_to(x, row) - self.raster.up_to(from.x, row);
        let mass_up_to = |x: f64| rows.clone().map(|(row, part)| part * row_mass(row, x)).sum::<f64>();
        let total = mass_up_to(to.x);
        let wanted = share * total;
        let by_area = low[axis] + share * (high[axis] - low[axis]);
        if total <= 0.0 || wanted.is_nan() {
            return by_area;
        }
        let place = if axis == 1 {
            let mut below = 0.0;
            let mut place = to.y;
            for (row, part) in rows {
                let mass = part * row_mass(row, to.x);
                if below + mass >= wanted && mass > 0.0 {
                    place = from.y.max(row as f64) + part * (wanted - below) / mass;
                    break;
                }
                below += mass;
            }
            place
        } else {
            // The first column whose end has as much before it; in it the mass grows evenly.
            let (mut first, mut end) = (from.x as usize, to.x.ceil() as usize);
            while end - first > 1 {
                let middle = first + (end - first) / 2;
                if mass_up_to(middle as f64) < wanted { first = middle } else { end = middle }
            }
            let (left, right) = (from.x.max(first as f64), to.x.min(end as f64));
            let (before, after) = (mass_up_to(left), mass_up_to(right));
            if after > before { left + (right - left) * ((wanted - before) / (after - before)).clamp(0.0, 1.0) } else { right }
        };
        (place / self.resolution[axis]).clamp(low[axis], high[axis])
    }

    /// A place by two numbers from 0 to 1: uniform ones make places whose density is this one.
    pub fn place(&self, mass: f64, height: f64) -> DVec2 {
        let (x, row) = self.raster.place(mass * self.raster.total());
        let y = row as f64 + CLEARANCE + (1.0 - 2.0 * CLEARANCE) * height;
        let column = x.floor();
        DVec2::new(x.clamp(column + CLEARANCE, column + 1.0 - CLEARANCE), y) / self.resolution
    }

    /// The place itself where there is density, or else one in the nearest pixel that has some: no two places come to the same.
    pub fn settle(&self, place: DVec2) -> DVec2 {
        if !self.raster.has_zeros || self.at(place) > 0.0 {
            return place;
        }
        let pixel = place * self.resolution;
        let (columns, rows) = (self.raster.columns as i64, self.raster.rows as i64);
        let (column, row) = (floor(pixel.x), floor(pixel.y));
        let mut nearest = (f64::INFINITY, place);
        let reach = if self.is_periodic { rows / 2 } else { rows };
        for distance in 0..=reach {
            let gap = (distance as f64 - 1.0).max(0.0) / self.resolution.y;
            if gap * gap > nearest.0 {
                break;
            }
            for row in [row - distance, row + distance] {
                if !self.is_periodic && !(0..rows).contains(&row) {
                    continue;
                }
                for found in self.full_columns(column, row, columns) {
                    let low = DVec2::new(found as f64, row as f64);
                    let in_pixel = (low + DVec2::new(inward(pixel.x - low.x), inward(pixel.y - low.y))) / self.resolution;
                    let squared = in_pixel.distance_squared(place);
                    if squared < nearest.0 {
                        nearest = (squared, in_pixel);
                    }
                }
            }
        }
        nearest.1
    }

    /// The columns to both sides of one, in a row, that are the nearest with density; on a torus perhaps a period away.
    fn full_columns(&self, column: i64, row: i64, columns: i64) -> impl Iterator<Item = i64> + use<> {
        let (inside, row) = self.inside(column, row);
        let shift = if self.is_periodic { column - inside as i64 } else { 0 };
        let found = self.raster.nearest_in_row(inside, row);
        let wrapped = |at: usize, turns: i64| {
            if self.is_periodic {
                self.raster.nearest_in_row(at, row)[usize::from(turns < 0)].map(|c| c as i64 + turns * columns)
            } else {
                None
            }
        };
        let after = found[0].map(|c| c as i64).or_else(|| wrapped(0, 1));
        let before = found[1].map(|c| c as i64).or_else(|| wrapped(columns as usize - 1, -1));
        [after, before].into_iter().flatten().map(move |c| c + shift)
    }
}

/// A coordinate that lies outside of a pixel, from its start, taken inside: at its boundary, and the deeper the farther away it was, to a quarter.
fn inward(x: f64) -> f64 {
    let depth = |outside: f64| CLEARANCE + 0.25 * outside / (1.0 + outside);
    if x < 0.0 {
        depth(-x)
    } else if x > 1.0 {
        1.0 - depth(x - 1.0)
    } else {
        x.clamp(CLEARANCE, 1.0 - CLEARANCE)
    }
}

/// The largest integer that is not above a number.
#[inline]
fn floor(x: f64) -> i64 {
    let towards_zero = x as i64;
    towards_zero - i64::from((towards_zero as f64) > x)
}
