//! Sharp corners are cut off: each becomes one isosceles triangle, and what is left of the domain has no corner below 60 degrees.
//!
//! No mesh has better angles than its corners, and refinement does not end at sharp ones. With the
//! corner's triangle set apart, neither the sizing nor the points know of it. A needle is set apart as
//! far as it is much narrower than the spacing: as a ladder, whose rungs are a spacing apart.

use std::collections::{HashMap, HashSet};

use glam::DVec2;

use super::outline::{Of, Outline, Segment};
use crate::predicates::is_left_turn;
use crate::space::{GRID, snap};
use crate::triangulation::{Planar, prev};

/// Corners below this angle are cut off.
const SHARP_DEG: f64 = 60.0;
/// How much of the way to what is nearest a cap takes at most.
const SHARE: f64 = 0.45;
/// Caps whose base is shorter than this are not cut: their corner stays as it is.
const LEAST_BASE: f64 = 1e3 * GRID;

/// Corners whose caps are narrower than this part of their length are needles.
const NARROW: f64 = 0.125;

/// A triangle at a sharp corner.
#[derive(Debug, Clone)]
pub(super) struct Cap {
    /// The corner, and the ends of the base, counter-clockwise.
    pub corners: [u32; 3],
    /// Of a needle, from the corner on, the ends of rungs: on the leg from the corner, and on that to it.
    pub rungs: Vec<[u32; 2]>,
    /// On what its legs lie: that towards the corner, and that from it.
    pub legs: [Of; 2],
    /// The outline's segment that is its base.
    pub base: u32,
}

/// Cuts off the sharp corners of an outline, of which this is the triangulation. Its points keep their numbers; `radii` is how long the legs of each one's cap may be.
pub(super) fn cut_off(outline: &Outline, planar: &Planar, radii: &[f64]) -> (Outline, Vec<Cap>) {
    let Planar { half_edges, source, lines, .. } = planar;
    let mut cut = outline.clone();
    let number: HashMap<[u32; 2], usize> = outline.segments.iter().map(|segment| segment.ends).zip(0..).collect();
    let has_line: HashSet<u32> = lines.iter().flatten().map(|&v| source[v as usize]).collect();
    let place = |v: u32| outline.points[source[v as usize] as usize];
    let mut caps = Vec::new();
    for first in (0..half_edges.origin.len() as u32).filter(|&h| half_edges.is_boundary(h)) {
        let corner = source[half_edges.origin[first as usize] as usize];
        let at = outline.points[corner as usize];
        // Along the fan around the corner, from the segment that leaves it to that which arrives.
        let (mut angle, mut room) = (0.0, f64::INFINITY);
        let mut last = first;
        for h in half_edges.around(first) {
            let (u, w) = (place(half_edges.target(h)), place(half_edges.origin[prev(h) as usize]));
            angle += (u - at).angle_to(w - at);
            room = room.min(distance_to_segment(at, u, w));
            last = h;
        }
        if angle.to_degrees() >= SHARP_DEG || has_line.contains(&corner) {
            continue;
        }
        let (leaving, arriving) = (source[half_edges.target(first) as usize], source[half_edges.origin[prev(last) as usize] as usize]);
        let (Some(&to), Some(&from)) = (number.get(&[corner, leaving]), number.get(&[arriving, corner])) else { continue };
        let ends = |radius: f64| [leaving, arriving].map(|v| snap(at + radius * (outline.points[v as usize] - at).normalize_or_zero()));
        let is_base = |[p, q]: [DVec2; 2]| p.distance(q) >= LEAST_BASE && is_left_turn(p - at, q - at);
        let step = radii[corner as usize];
        let width = 2.0 * libm::sin(0.5 * angle);
        let is_needle = width < NARROW;
        // Up to where it is wide enough for triangles, or ends.
        let radius = if is_needle { (NARROW * step / width).min(room * (1.0 - width)) } else { step.min(SHARE * room) };
        let [p, q] = ends(radius);
        if !is_base([p, q]) {
            continue;
        }
        let n_rungs = if is_needle { (radius / step).ceil() } else { 1.0 };
        let rungs = (1..n_rungs as u32).map(|k| ends(radius * f64::from(k) / n_rungs)).filter(|&rung| is_base(rung));
        let mut numbers = Vec::new();
        for rung in rungs {
            numbers.push([cut.points.len() as u32, cut.points.len() as u32 + 1]);
            cut.points.extend(rung);
        }
        let n = cut.points.len() as u32;
        cut.points.extend([p, q]);
        cut.segments[to].ends[0] = n;
        cut.segments[from].ends[1] = n + 1;
        let base = cut.segments.len() as u32;
        cut.segments.push(Segment { ends: [n + 1, n], of: Of::Base });
        let legs = [outline.segments[from].of, outline.segments[to].of];
        caps.push(Cap { corners: [corner, n, n + 1], rungs: numbers, legs, base });
    }
    (cut, caps)
}

fn distance_to_segment(p: DVec2, a: DVec2, b: DVec2) -> f64 {
    let way = b - a;
    let share = ((p - a).dot(way) / way.length_squared()).clamp(0.0, 1.0);
    p.distance(a + share * way)
}
