//! The spacing for every place: what is asked for, and less where the boundary is detailed or the domain narrow.
//!
//! A coarse mesh without thin triangles has sides as long as the domain's details are far apart (the
//! local feature size, Ruppert 1995). So its shortest sides say how fine points must stand; from there on
//! the spacing grows by no more than so much a length. But a detail that stands alone, as a point next to
//! the boundary, is left to refinement at the end and to coarsening, which take a small part of the triangles of
//! a spacing that grows gently.

use std::cmp::Reverse;
use std::collections::{BinaryHeap, HashMap};

use glam::DVec2;

use super::outline::Outline;
use crate::points::hilbert_order;
use crate::triangulation::{HalfEdges, Planar, Refinement, Refining, Sizing, prev, smallest};

/// The coarse mesh has no angle below about 25 degrees: 1 / (2 sin 25).
const ASPECT: f64 = 1.183;

/// Where a spacing is given for each place, circumradii of the coarse mesh are up to so many of it.
const COARSE: f64 = 2.0;
/// Where the spacing grows away from the boundary, segments of the coarse mesh are up to so many of it.
const FINE: f64 = 3.0;

/// So many vertices a corner of the domain, and so many in all, are as many as the coarse mesh needs
/// where no walls nearly touch.
const MOST_ADDED: usize = 100;
const LEAST_ADDED: usize = 20_000;
/// A detail below this part of the wanted spacing may stand alone.
const FINE_DETAIL: f64 = 0.4;
/// It does, if nothing farther off than so many of its sizes is about as fine, as far as is looked.
const ALONE: [f64; 2] = [20.0, 40.0];
const AS_FINE: f64 = 1.5;

/// The spacing, and the segment of the outline on which each half-edge of its boundary lies, by its ends.
pub(super) struct Background {
    pub sizing: Sizing,
    /// A triangle of the sizing at each of the outline's points.
    pub hints: Vec<u32>,
    pub segments: HashMap<[u32; 2], u32>,
}

/// How the spacing is to vary, in normalised units.
#[derive(Clone, Copy)]
pub(super) struct Grading<'a> {
    /// The largest spacing on the boundary, and anywhere.
    pub on_boundary: f64,
    pub largest: f64,
    /// By how much the spacing may grow a length.
    pub growth: f64,
    /// Details below this are not followed, but where they stand alone: those down to that.
    pub floor: f64,
    pub finest: f64,
    /// And nothing is shorter than this.
    pub least: f64,
    pub max_vertices: usize,
    /// A spacing for each place, where one is given: it may be less than the others.
    pub wanted: Option<&'a (dyn Fn(DVec2) -> f64 + Sync)>,
    /// Whether details that stand alone are followed as well.
    pub follows_all: bool,
}

/// Finds the spacing in an outline, of which `planar` is the triangulation.
pub(super) fn background(outline: &Outline, planar: Planar, grading: &Grading) -> Background {
    // Vertices may have another number than their points.
    let by_points: HashMap<[u32; 2], u32> = outline.segments.iter().zip(0..).map(|(segment, number)| (segment.ends, number)).collect();
    let segments = (0..planar.half_edges.origin.len() as u32).filter_map(|h| {
        let ends = [planar.half_edges.origin[h as usize], planar.half_edges.target(h)];
        Some((ends, *by_points.get(&ends.map(|v| planar.source[v as usize]))?))
    });
    let segments: HashMap<[u32; 2], u32> = segments.collect();
    let source = planar.source.clone();
    let largest = grading.wanted.map(|wanted| move |p: DVec2| COARSE * wanted(p).max(grading.least));
    let largest = largest.as_ref().map(|largest| largest as &(dyn Fn(DVec2) -> f64 + Sync));
    let longest = if grading.largest > grading.on_boundary { FINE * grading.on_boundary } else { f64::INFINITY };
    let refined = |floor: f64, max_vertices: usize| {
        let refining = Refining { longest, aspect: ASPECT, floor, halves_all: true, is_sparing: false, max_vertices, largest };
        Refinement::run(planar.clone(), segments.clone(), refining)
    };
    // As far as it goes; or, between walls that nearly touch, to the floor alone.
    let most = MOST_ADDED * planar.positions.len() + LEAST_ADDED;
    let mut refinement = refined(grading.finest, most.min(grading.max_vertices));
    if refinement.positions.len() >= most.min(grading.max_vertices) {
        refinement = refined(grading.floor, grading.max_vertices);
    }
    let Refinement { mut half_edges, positions, segments, .. } = refinement;

    // Neighbours in the plane become neighbours in memory.
    let order = hilbert_order(&positions, positions.iter().fold(DVec2::ZERO, |size, &p| size.max(p)));
    let mut number = vec![0u32; order.len()];
    order.iter().zip(0..).for_each(|(&v, new)| number[v as usize] = new);
    half_edges.origin.iter_mut().for_each(|v| *v = number[*v as usize]);
    let half_edges = half_edges.filtered(|_, corners| Some(smallest(corners)));
    let positions: Vec<DVec2> = order.iter().map(|&v| positions[v as usize]).collect();
    let segments = segments.into_iter().map(|(ends, segment)| (ends.map(|v| number[v as usize]), segment)).collect();
    // The outline's point that each vertex is.
    let point_of: Vec<Option<u32>> = order.iter().map(|&v| source.get(v as usize).copied()).collect();

    let wanted = |&p: &DVec2| grading.wanted.map_or(f64::INFINITY, |wanted| wanted(p).max(grading.least));
    let asked: Vec<f64> = positions.iter().map(|p| wanted(p).min(grading.largest)).collect();
    let mut sizes = asked.clone();
    // The domain's own segments.
    let mut facts = vec![f64::INFINITY; positions.len()];
    for h in 0..half_edges.origin.len() as u32 {
        let (a, b) = (half_edges.origin[h as usize] as usize, half_edges.target(h) as usize);
        let length = positions[a].distance(positions[b]);
        let length = length.min(if half_edges.is_boundary(h) { grading.on_boundary } else { grading.largest });
        if point_of[a].is_some() && point_of[b].is_some() && half_edges.is_boundary(h) {
            facts[a] = facts[a].min(length);
            facts[b] = facts[b].min(length);
        }
        sizes[a] = sizes[a].min(length);
        sizes[b] = sizes[b].min(length);
    }
    let mut sizing = Sizing { half_edges, positions, sizes };
    if !grading.follows_all {
        leave_out_lone_details(&mut sizing, &asked, &facts, grading.growth);
    }
    // A short segment is a fact; that the domain is thin is followed to the floor alone.
    sizing.sizes.iter_mut().zip(facts).for_each(|(size, fact)| *size = size.max(fact.min(grading.floor)));
    limit_growth(&mut sizing, grading.growth);
    let mut hints = vec![0; outline.points.len()];
    for (t, corners) in (0..).zip(sizing.half_edges.triangles()) {
        for point in corners.into_iter().filter_map(|v| point_of[v as usize]) {
            hints[point as usize] = t;
        }
    }
    Background { sizing, hints, segments }
}

/// Gives vertices at details that stand alone the spacing that was asked for; `facts` are the lengths of
/// segments, which are followed in any case.
fn leave_out_lone_details(sizing: &mut Sizing, asked: &[f64], facts: &[f64], growth: f64) {
    let mut grown: Vec<f64> = facts.iter().zip(asked).map(|(fact, asked)| fact.min(*asked)).collect();
    limit(&sizing.half_edges, &sizing.positions, &mut grown, growth);
    let Sizing { half_edges, positions, sizes } = sizing;
    let outgoing = half_edges.outgoing(positions.len());
    let mut is_seen = vec![u32::MAX; positions.len()];
    let mut stack = Vec::new();
    let mut is_alone = |v: u32| {
        let (at, size) = (positions[v as usize], sizes[v as usize]);
        stack.clear();
        stack.push(v);
        is_seen[v as usize] = v;
        while let Some(u) = stack.pop() {
            let distance = positions[u as usize].distance(at);
            if distance > ALONE[1] * size {
                continue;
            }
            if distance >= ALONE[0] * size && sizes[u as usize] < AS_FINE * size {
                return false;
            }
            for h in half_edges.around(outgoing[u as usize]) {
                for other in [half_edges.target(h), half_edges.origin[prev(h) as usize]] {
                    if std::mem::replace(&mut is_seen[other as usize], v) != v {
                        stack.push(other);
                    }
                }
            }
        }
        true
    };
    // Where the spacing that grows from short segments is as fine, nothing is left out.
    let is_fine = |v: usize| sizes[v] < FINE_DETAIL * asked[v] && facts[v] >= FINE_DETAIL * asked[v] && sizes[v] < grown[v];
    let fine = (0..positions.len()).filter(|&v| is_fine(v)).map(|v| v as u32);
    let alone: Vec<u32> = fine.filter(|&v| is_alone(v)).collect();
    for v in alone {
        sizes[v as usize] = asked[v as usize];
    }
}

/// Makes sizes smaller where they differ by more than `growth` a length from a neighbour's.
pub(super) fn limit_growth(sizing: &mut Sizing, growth: f64) {
    limit(&sizing.half_edges, &sizing.positions, &mut sizing.sizes, growth);
}

fn limit(half_edges: &HalfEdges, positions: &[DVec2], sizes: &mut [f64], growth: f64) {
    let outgoing = half_edges.outgoing(positions.len());
    // Positive numbers are in the order of their bits. Only from a size that is less than a neighbour's another may follow.
    let mut queue: BinaryHeap<Reverse<(u64, u32)>> = BinaryHeap::new();
    for h in (0..half_edges.origin.len() as u32).filter(|&h| h == outgoing[half_edges.origin[h as usize] as usize]) {
        let v = half_edges.origin[h as usize];
        let mut others = half_edges.around(h).flat_map(|h| [half_edges.target(h), half_edges.origin[prev(h) as usize]]);
        if others.any(|other| sizes[v as usize] < sizes[other as usize]) {
            queue.push(Reverse((sizes[v as usize].to_bits(), v)));
        }
    }
    while let Some(Reverse((bits, v))) = queue.pop() {
        let size = f64::from_bits(bits);
        if size > sizes[v as usize] {
            continue;
        }
        let mut reach = |other: u32| {
            let most = size + growth * positions[v as usize].distance(positions[other as usize]);
            if most < sizes[other as usize] {
                sizes[other as usize] = most;
                queue.push(Reverse((most.to_bits(), other)));
            }
        };
        for h in half_edges.around(outgoing[v as usize]) {
            reach(half_edges.target(h));
            reach(half_edges.origin[prev(h) as usize]);
        }
    }
}
