//! How points are spread over a surface: nearest distances, and differential domain analysis.
//!
//! Wei and Wang, "Differential Domain Analysis for Non-uniform Sampling", ACM Transactions on Graphics 30(4), 2011, doi 10.1145/2010324.1964945, section 6. A surface
//! has no Fourier spectrum, but distances: how many points there are at each, relative to what white noise has there. That is counted, at many places spread evenly over the same
//! surface, so that neither its curvature nor its boundary nor its shape counts for the points' order. The radial power is the transform of that, as in the plane.

use rayon::prelude::*;
use serde::Serialize;

use super::distance::quasi_random;
use super::neighbours::{Neighbours, Seen, Spot};
use super::walk::Place;
use super::{Facets, Surface};
use crate::error::Error;
use crate::geometry::spacing::hexagonal_spacing;
use crate::measure::{BINS, RadialSpectrum, level};

/// What [`measure_on_surface`] finds, by ways along the surface.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct SurfaceMeasures {
    /// How many points there are.
    pub n_points: usize,
    /// The surface's area, in input units.
    pub area: f64,
    /// The hexagonal lattice's spacing with as many points: 1 for the two that follow, in input units.
    pub spacing: f64,
    /// The smallest distance of two points, relative to the spacing.
    pub min_distance: f64,
    /// The mean distance to the nearest point, relative to the spacing.
    pub mean_distance: f64,
    /// How far the farthest point is from the surface, in input units.
    pub off_surface: f64,
}

/// So far differences are counted, in mean spacings; fewer points see less.
const REACH: f64 = 8.0;
const FEWEST: usize = 100;
/// Places that stand for the surface's area, for each of the points, but no more than this in all.
const PLACES: usize = 8;
const MOST_PLACES: usize = 2_000_000;
/// Points whose differences are counted, at most, and in one go.
const MOST: usize = 20_000;
const CHUNK: usize = 256;
/// What white noise has is the mean over so many bins to both sides: the surface's shape shows in wider ones.
const SMOOTH: usize = 20;
/// By how many neighbours a spacing is guessed.
const NEIGHBOURS: usize = 64;

/// The distances of points on a surface, each taken at the surface's nearest place.
///
/// # Errors
/// [`Error::InvalidParameter`] for points that are not finite; [`Error::Degenerate`] if no two lie on one connected part.
pub fn measure_on_surface(surface: &Surface, points: &[[f64; 3]]) -> Result<SurfaceMeasures, Error> {
    let (spots, off) = spots(surface, points)?;
    let near = Neighbours::new(surface, &spots);
    let hexagonal = hexagonal_spacing(surface.inner_area(), spots.len() as f64);
    let of_chunk = |chunk: &[Spot], first: usize| {
        let (mut seen, mut distances) = (Seen::new(surface), Vec::new());
        let nearest = |(k, spot): (usize, &Spot)| {
            nearest_others(surface, &near, (first + k, spot), 1, hexagonal, &mut seen, &mut distances);
            distances.first().copied()
        };
        chunk.iter().enumerate().filter_map(nearest).collect::<Vec<f64>>()
    };
    let nearest: Vec<f64> = spots.par_chunks(CHUNK).enumerate().flat_map_iter(|(k, chunk)| of_chunk(chunk, k * CHUNK)).collect();
    if nearest.is_empty() {
        return Err(Error::Degenerate("no two points lie on one part of the surface".into()));
    }
    Ok(SurfaceMeasures {
        n_points: spots.len(),
        area: surface.area(),
        spacing: surface.frame.length_outward(hexagonal),
        min_distance: nearest.iter().copied().fold(f64::INFINITY, f64::min) / hexagonal,
        mean_distance: nearest.iter().sum::<f64>() / nearest.len() as f64 / hexagonal,
        off_surface: surface.frame.length_outward(off),
    })
}

/// Differential domain analysis: the pair correlation of points on a surface, and the radial power that belongs to it. Each point's distances are taken in its own spacing, as its
/// nearest neighbours have it, if `is_local`, and white noise is of the density that they have; else in the mean one.
///
/// # Errors
/// [`Error::InvalidParameter`] for points that are not finite; [`Error::Degenerate`] for fewer than 100, and for too few of them around one.
///
/// # Example
/// ```
/// use evenly::{RemeshParams, RunContext, SampleParams, Surface, SurfaceSampling, TriangleMesh, sample_surface, surface_spectrum};
///
/// // An octahedron.
/// let vertices = vec![[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, -1.0]];
/// let triangles = vec![[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4], [1, 0, 5], [2, 1, 5], [3, 2, 5], [0, 3, 5]];
/// let surface = Surface::new(&TriangleMesh { vertices, triangles, attributes: Vec::new() })?;
/// let sampling = SurfaceSampling::Vertices(500, RemeshParams::default().method);
/// let params = SampleParams { sampling, sizes: Vec::new(), seed: 7 };
/// let (points, _) = sample_surface(&surface, &params, &mut RunContext::default())?;
/// let positions: Vec<[f64; 3]> = points.iter().map(|point| point.position).collect();
/// let spectrum = surface_spectrum(&surface, &positions, false)?;
/// assert!(spectrum.effective_nyquist > 0.7);
/// # Ok::<(), evenly::Error>(())
/// ```
pub fn surface_spectrum(surface: &Surface, points: &[[f64; 3]], is_local: bool) -> Result<RadialSpectrum, Error> {
    let n = points.len();
    if n < FEWEST {
        return Err(Error::Degenerate(format!("{n} points on a surface are too few for a spectrum: it takes {FEWEST}")));
    }
    let (spots, _) = spots(surface, points)?;
    let near = Neighbours::new(surface, &spots);
    // A disk of that radius holds a quarter of all at most.
    let reach = REACH.min((n as f64 / (4.0 * std::f64::consts::PI)).sqrt());
    let n_bins = (reach * BINS as f64) as usize;
    let mean = (surface.inner_area() / n as f64).sqrt();
    let ground = Ground::new(surface, &spots);
    let land = Neighbours::new(surface, &ground.spots);
    let spacings = if is_local { local_spacings(surface, &near, &land, &ground, mean)? } else { vec![mean; n] };
    // White noise of that density has so many points on each part of the ground. Parts of the surface without points are never seen.
    let expected: Vec<f64> = ground.of_each(surface, |seen, k| {
        let nearest = if is_local { nearest(surface, &near, &ground.spots[k], mean, seen).unwrap_or_default() } else { 0 };
        ground.areas[k] / spacings[nearest].powi(2)
    });
    // 1. Of each point the others, and those of white noise, at each distance.
    let step = n.div_ceil(MOST);
    let centres: Vec<usize> = (0..n).step_by(step).collect();
    let count = |centres: &[usize]| {
        let mut seen = Seen::new(surface);
        let mut counts = vec![[0.0; 2]; n_bins];
        for &centre in centres {
            let (from, scale) = (&spots[centre], BINS as f64 / spacings[centre]);
            let bin = |distance: f64| ((distance * scale) as usize).min(n_bins - 1);
            near.visit(from, reach * spacings[centre], &mut seen, |other, distance| {
                if other != centre {
                    counts[bin(distance)][0] += 1.0;
                }
            });
            land.visit(from, reach * spacings[centre], &mut seen, |k, distance| counts[bin(distance)][1] += expected[k]);
        }
        counts
    };
    let counted: Vec<Vec<[f64; 2]>> = centres.par_chunks(CHUNK).map(count).collect();
    let mut counts = vec![[0.0; 2]; n_bins];
    for chunk in counted {
        counts.iter_mut().zip(chunk).for_each(|(sum, more)| *sum = [sum[0] + more[0], sum[1] + more[1]]);
    }
    // 2. What white noise has, relative to a plane, changes slowly.
    let ring = |bin: usize| std::f64::consts::PI * (2.0 * bin as f64 + 1.0) / (BINS * BINS) as f64 * centres.len() as f64;
    let relative: Vec<[f64; 2]> = counts.iter().enumerate().map(|(bin, [_, white])| [*white, ring(bin)]).collect();
    let share = |bin: usize| {
        let window = &relative[bin.saturating_sub(SMOOTH)..n_bins.min(bin + SMOOTH + 1)];
        window.iter().map(|[white, _]| white).sum::<f64>() / window.iter().map(|[_, plane]| plane).sum::<f64>()
    };
    // Of n points each has n - 1 others.
    let others = 1.0 - 1.0 / n as f64;
    let mut correlation: Vec<f64> = counts.iter().enumerate().map(|(bin, [own, _])| own / (ring(bin) * share(bin) * others)).collect();
    if let Some(bin) = correlation.iter().position(|g| !g.is_finite()) {
        let distance = bin as f64 / BINS as f64;
        return Err(Error::Degenerate(format!(
            "{distance} spacings from the points there is no surface to count on: are they heaped in one place?"
        )));
    }
    // 3. A guessed spacing is a little wrong.
    if is_local {
        level(&mut correlation)?;
    }
    Ok(RadialSpectrum::of(1, correlation))
}

/// The nearest places of a surface to points, and how far the farthest of these is.
fn spots(surface: &Surface, points: &[[f64; 3]]) -> Result<(Vec<Spot>, f64), Error> {
    if let Some((k, p)) = points.iter().enumerate().find(|(_, p)| !p.iter().all(|x| x.is_finite())) {
        let value = format!("({}, {}, {}) at {k}", p[0], p[1], p[2]);
        return Err(Error::InvalidParameter { name: "points", value, expected: "finite" });
    }
    let facets = Facets::new((0..surface.n_triangles()).map(|t| surface.corners(t)).collect());
    let spot = |&p: &[f64; 3]| {
        let at = surface.frame.inward(p);
        let face = facets.nearest(at).map_or(0, |(t, _)| t as u32);
        let place = surface.nearest_on(face, at);
        (Spot::new(surface, &place), place.at.distance(at))
    };
    let spots: Vec<(Spot, f64)> = points.par_iter().map(spot).collect();
    let off = spots.iter().map(|&(_, off)| off).fold(0.0, f64::max);
    Ok((spots.into_iter().map(|(spot, _)| spot).collect(), off))
}

/// The distances from a point to so many others that are nearest, in order; fewer, if there are no more on its part of the surface. The search begins within `reach`.
fn nearest_others(
    surface: &Surface,
    near: &Neighbours,
    (centre, from): (usize, &Spot),
    rank: usize,
    mut reach: f64,
    seen: &mut Seen,
    distances: &mut Vec<f64>,
) {
    let farthest = 2.0 * surface.frame.length_inward(surface.diagonal());
    loop {
        distances.clear();
        let mut least = reach;
        near.search(from, reach, seen, |other, distance| {
            if other != centre {
                distances.push(distance);
            }
            // Of many the farther half is forgotten now and then.
            if distances.len() > 2 * rank {
                distances.select_nth_unstable_by(rank - 1, f64::total_cmp);
                distances.truncate(rank);
                least = distances[rank - 1];
            }
            least
        });
        if distances.len() >= rank || reach > farthest {
            distances.sort_unstable_by(f64::total_cmp);
            distances.truncate(rank);
            return;
        }
        reach *= 2.0;
    }
}

/// The nearest of some places to another; none if there is none on its part of the surface. The search begins within `reach`.
fn nearest(surface: &Surface, near: &Neighbours, from: &Spot, mut reach: f64, seen: &mut Seen) -> Option<usize> {
    let farthest = 2.0 * surface.frame.length_inward(surface.diagonal());
    loop {
        let mut best = None;
        near.search(from, reach, seen, |k, distance| {
            best = Some(k);
            distance
        });
        if best.is_some() || reach > farthest {
            return best;
        }
        reach *= 2.0;
    }
}

/// Each point's own spacing: the root of the area that each of its nearest neighbours has, by the ground in the disks to them.
fn local_spacings(surface: &Surface, near: &Neighbours, land: &Neighbours, ground: &Ground, mean: f64) -> Result<Vec<f64>, Error> {
    // Of one neighbour alone the pair correlation would show a spike where that neighbour is.
    let ranks = NEIGHBOURS / 2..=NEIGHBOURS;
    let spacing = |(seen, distances, places): &mut (Seen, Vec<f64>, Vec<(f64, f64)>), centre: usize, from: &Spot| {
        nearest_others(surface, near, (centre, from), NEIGHBOURS, 4.0 * mean, seen, distances);
        let farthest = distances.last().copied().unwrap_or_default();
        if distances.len() < NEIGHBOURS || farthest == 0.0 {
            let text = format!("around point {centre} there are too few others, or all in one place, for a local spacing");
            return Err(Error::Degenerate(text));
        }
        places.clear();
        land.visit(from, farthest, seen, |k, distance| places.push((distance, ground.areas[k])));
        places.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
        let (mut sum, mut area, mut places) = (0.0, 0.0, places.iter().peekable());
        for (&distance, k) in distances.iter().zip(1..) {
            while let Some((_, part)) = places.next_if(|place| place.0 < distance) {
                area += part;
            }
            if ranks.contains(&k) {
                sum += area / k as f64;
            }
        }
        if sum == 0.0 {
            return Err(Error::Degenerate(format!("around point {centre} the others are too near to each other for a local spacing")));
        }
        Ok((sum / ranks.clone().count() as f64).sqrt())
    };
    let of_chunk = |(k, chunk): (usize, &[Spot])| {
        let mut room = (Seen::new(surface), Vec::new(), Vec::new());
        chunk.iter().enumerate().map(|(i, from)| spacing(&mut room, k * CHUNK + i, from)).collect::<Vec<_>>()
    };
    near.spots.par_chunks(CHUNK).enumerate().flat_map_iter(of_chunk).collect()
}

/// Places that stand for the surface's area, closer where there are more points.
struct Ground {
    spots: Vec<Spot>,
    /// The area for which each stands.
    areas: Vec<f64>,
}

impl Ground {
    /// Half of the places are spread by area, half as the points are.
    fn new(surface: &Surface, points: &[Spot]) -> Self {
        let mut n_points = vec![0.0; surface.n_triangles()];
        points.iter().for_each(|point| n_points[point.face as usize] += 1.0);
        let n_places = (PLACES * points.len()).min(MOST_PLACES) as f64;
        let whole = surface.inner_area();
        let (mut ground, mut wanted, mut area) = (Self { spots: Vec::new(), areas: Vec::new() }, 0.0, 0.0);
        for (t, n_own) in n_points.into_iter().enumerate() {
            let [a, b, c] = surface.corners(t);
            let own = 0.5 * (b - a).cross(c - a).length();
            wanted += 0.5 * n_places * (own / whole + n_own / points.len() as f64);
            // What small triangles have goes to the next place.
            area += own;
            let n = wanted as usize;
            for _ in 0..n {
                let [u, v] = quasi_random(ground.spots.len());
                let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
                ground.spots.push(Spot::new(surface, &Place::new(surface, t as u32, [1.0 - u - v, u, v])));
                ground.areas.push(area / n as f64);
            }
            if n > 0 {
                wanted -= n as f64;
                area = 0.0;
            }
        }
        ground
    }

    /// A number for each place.
    fn of_each(&self, surface: &Surface, number: impl Fn(&mut Seen, usize) -> f64 + Sync) -> Vec<f64> {
        let of_chunk = |chunk: usize| {
            let mut seen = Seen::new(surface);
            (CHUNK * chunk..self.spots.len().min(CHUNK * (chunk + 1))).map(|k| number(&mut seen, k)).collect::<Vec<_>>()
        };
        (0..self.spots.len().div_ceil(CHUNK)).into_par_iter().flat_map_iter(of_chunk).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::surface::white;
    use crate::{PointSet, Rectangle, TriangleMesh, poisson_disk_of, radial_spectrum};

    /// A square of side 1, in squares of two triangles.
    fn square(n: usize) -> Surface {
        let at = |i: usize, j: usize| i * (n + 1) + j;
        let vertices = (0..(n + 1) * (n + 1)).map(|k| [(k / (n + 1)) as f64 / n as f64, (k % (n + 1)) as f64 / n as f64, 0.0]).collect();
        let cells = (0..n * n).map(|k| (k / n, k % n));
        let triangles =
            cells.flat_map(|(i, j)| [[at(i, j), at(i + 1, j), at(i + 1, j + 1)], [at(i, j), at(i + 1, j + 1), at(i, j + 1)]]).collect();
        Surface::new(&TriangleMesh { vertices, triangles, attributes: Vec::new() }).unwrap()
    }

    fn in_space(points: &PointSet) -> Vec<[f64; 3]> {
        points.positions().iter().map(|&[x, y]| [x, y, 0.0]).collect()
    }

    fn noise(surface: &Surface, n: usize, seed: u64) -> Vec<[f64; 3]> {
        white(surface, &vec![1.0; surface.n_vertices()], n, seed).iter().map(|place| surface.frame.outward(place.at)).collect()
    }

    #[test]
    fn in_a_plane_it_is_the_plain_analysis() {
        let points = poisson_disk_of(Rectangle::new([0.0, 0.0], [1.0, 1.0]).unwrap(), 4000, 1).unwrap();
        let plain = radial_spectrum(std::slice::from_ref(&points)).unwrap();
        for is_local in [false, true] {
            let seen = surface_spectrum(&square(10), &in_space(&points), is_local).unwrap();
            for k in [20, 60, 120, 200, 300, 400] {
                let (a, b) = (seen.radial_power[k], plain.radial_power[k]);
                assert!((a - b).abs() < 0.15, "{is_local}, {}: {a} {b}", seen.frequencies[k]);
            }
            let (a, b) = (seen.effective_nyquist, plain.effective_nyquist);
            assert!((a - b).abs() < 0.05, "{is_local}: {a} {b}");
        }
        let measures = measure_on_surface(&square(7), &in_space(&points)).unwrap();
        let plain = crate::measure(&points).unwrap();
        assert!((measures.min_distance - plain.min_distance).abs() < 1e-9 && (measures.spacing - points.hex_spacing()).abs() < 1e-12);
    }

    #[test]
    fn white_noise_has_none_on_any_shape() {
        // A closed ball of twenty-four faces, which is small, and so bent, for so few points.
        let vertices = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, -1.0]].to_vec();
        let triangles = vec![[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4], [1, 0, 5], [2, 1, 5], [3, 2, 5], [0, 3, 5]];
        let surface = Surface::new(&TriangleMesh { vertices, triangles, attributes: Vec::new() }).unwrap();
        for (n, seed) in [(2000, 1), (8000, 2)] {
            let noise = noise(&surface, n, seed);
            let spectrum = surface_spectrum(&surface, &noise, false).unwrap();
            let tenths: Vec<f64> =
                spectrum.pair_correlation[100..].chunks(100).map(|bins| bins.iter().sum::<f64>() / bins.len() as f64).collect();
            assert!(tenths.iter().all(|g| (g - 1.0).abs() < 0.1), "{tenths:?}");
            assert!(spectrum.effective_nyquist < 0.2, "{}", spectrum.effective_nyquist);
        }
    }

    #[test]
    fn wrong_points_are_errors_and_threads_change_nothing() {
        let surface = square(3);
        assert!(surface_spectrum(&surface, &[[0.0; 3]; 99], false).is_err());
        assert!(surface_spectrum(&surface, &[[0.0; 3]; 100], true).is_err());
        assert!(surface_spectrum(&surface, &[[f64::NAN; 3]; 100], false).is_err());
        assert!(measure_on_surface(&surface, &[]).is_err() && measure_on_surface(&surface, &[[0.0; 3]]).is_err());
        let noise = noise(&surface, 1000, 5);
        let run = |n_threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(n_threads).build().unwrap();
            pool.install(|| surface_spectrum(&surface, &noise, true).unwrap())
        };
        assert_eq!(run(1), run(3));
    }
}
