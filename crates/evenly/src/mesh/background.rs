//! The spacing for every place: what is asked for, and less where the border is detailed or the domain narrow.
//!
//! A coarse mesh without thin triangles has sides as long as the domain's details are far apart (the local feature size, Ruppert 1995). So its shortest sides say how
//! fine points must stand; from there on the spacing grows by no more than so much a length.

use std::cmp::Reverse;
use std::collections::{BinaryHeap, HashMap};

use glam::DVec2;

use super::outline::Outline;
use crate::triangulation::{Planar, Refinement, Refining, Sizing, prev};

/// The coarse mesh has no angle below about 25 degrees: 1 / (2 sin 25).
const ASPECT: f64 = 1.183;

/// Where a spacing is given for each place, circumradii of the coarse mesh are up to so many of it.
const COARSE: f64 = 2.0;
/// Where the spacing grows away from the border, segments of the coarse mesh are up to so many of it.
const FINE: f64 = 3.0;

/// The spacing, and the segment of the outline on which each half-edge of its border lies, by its ends.
pub(super) struct Background {
    pub sizing: Sizing,
    /// A triangle of the sizing at each of the outline's points.
    pub hints: Vec<u32>,
    pub segments: HashMap<[u32; 2], u32>,
}

/// How the spacing is to vary, in normalised units.
#[derive(Clone, Copy)]
pub(super) struct Grading<'a> {
    /// The largest spacing on the border, and anywhere.
    pub on_border: f64,
    pub largest: f64,
    /// By how much the spacing may grow a length.
    pub growth: f64,
    /// Details below this are not followed.
    pub floor: f64,
    /// And nothing is shorter than this.
    pub least: f64,
    pub max_vertices: usize,
    /// A spacing for each place, where one is given: it may be less than the others.
    pub wanted: Option<&'a (dyn Fn(DVec2) -> f64 + Sync)>,
}

/// Finds the spacing in an outline, of which `planar` is the triangulation.
pub(super) fn background(outline: &Outline, planar: Planar, grading: &Grading) -> Background {
    // Vertices may have another number than their points.
    let by_points: HashMap<[u32; 2], u32> = outline.segments.iter().zip(0..).map(|(segment, number)| (segment.ends, number)).collect();
    let segments = (0..planar.half_edges.origin.len() as u32).filter_map(|h| {
        let ends = [planar.half_edges.origin[h as usize], planar.half_edges.target(h)];
        Some((ends, *by_points.get(&ends.map(|v| planar.source[v as usize]))?))
    });
    let segments = segments.collect();
    let source = planar.source.clone();
    let largest = grading.wanted.map(|wanted| move |p: DVec2| COARSE * wanted(p).max(grading.least));
    let largest = largest.as_ref().map(|largest| largest as &(dyn Fn(DVec2) -> f64 + Sync));
    let longest = if grading.largest > grading.on_border { FINE * grading.on_border } else { f64::INFINITY };
    let refining =
        Refining { longest, aspect: ASPECT, floor: grading.floor, halves_all: true, max_vertices: grading.max_vertices, largest };
    let Refinement { half_edges, positions, segments, .. } = Refinement::run(planar, segments, refining);

    let wanted = |&p: &DVec2| grading.wanted.map_or(f64::INFINITY, |wanted| wanted(p).max(grading.least));
    let mut sizes: Vec<f64> = positions.iter().map(|p| wanted(p).min(grading.largest)).collect();
    for h in 0..half_edges.origin.len() as u32 {
        let (a, b) = (half_edges.origin[h as usize] as usize, half_edges.target(h) as usize);
        let length = positions[a].distance(positions[b]);
        // A short segment is a fact; that the domain is thin is followed to the floor alone.
        let length = if half_edges.is_border(h) { length.min(grading.on_border) } else { length.max(grading.floor).min(grading.largest) };
        sizes[a] = sizes[a].min(length);
        sizes[b] = sizes[b].min(length);
    }
    let mut sizing = Sizing { half_edges, positions, sizes };
    limit_growth(&mut sizing, grading.growth);
    let mut hints = vec![0; outline.points.len()];
    for (t, corners) in (0..).zip(sizing.half_edges.triangles()) {
        for point in corners.into_iter().filter_map(|v| source.get(v as usize)) {
            hints[*point as usize] = t;
        }
    }
    Background { sizing, hints, segments }
}

/// Makes sizes smaller where they differ by more than `growth` a length from a neighbour's.
pub(super) fn limit_growth(sizing: &mut Sizing, growth: f64) {
    let Sizing { half_edges, positions, sizes } = sizing;
    let outgoing = half_edges.outgoing(positions.len());
    // Positive numbers are in the order of their bits.
    let mut queue: BinaryHeap<Reverse<(u64, u32)>> = sizes.iter().zip(0..).map(|(size, v)| Reverse((size.to_bits(), v))).collect();
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
