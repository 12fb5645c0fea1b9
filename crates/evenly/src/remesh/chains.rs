//! Points along creases and boundaries: evenly spaced from corner to corner, before anything else, and there they stay.
//!
//! Where two chains meet at a sharp angle, the points on both alternate: the triangles between them have right angles then, where points side by side would leave obtuse ones.

use std::collections::BTreeMap;

use super::draft::Draft;
use super::rows::Gap;
use crate::surface::Chain;

/// The gaps between them, in the wanted spacings.
const GAP: f64 = 1.1;
/// A corner is sharp below this, in degrees.
const SHARP_DEG: f64 = 35.0;
/// The least part of a gap that is left where gaps at sharp corners are longer.
const LEAST_ROOM: f64 = 0.5;
/// A place so near to the end of an edge, relative to its length, is that end.
const AT_END: f64 = 1e-6;

/// Where a chain's points are to be; lengths in the wanted spacings, so that gaps vary as they do.
struct Plan {
    /// Of each step.
    lengths: Vec<f64>,
    total: f64,
    n_gaps: usize,
    /// Places of given points, in order, if they are at least half as many as there would be.
    given: Vec<f64>,
    /// The first gap and the last, where a corner there is sharp.
    at_corners: [Option<f64>; 2],
}

impl Plan {
    fn new(draft: &Draft, chain: &Chain, spacing: f64, on_edges: &BTreeMap<[u32; 2], Vec<f64>>) -> Self {
        let lengths: Vec<f64> = chain.steps().map(|(a, b)| weighted(draft, a, b)).collect();
        let total: f64 = lengths.iter().sum();
        let least = if chain.is_closed { 3 } else { 1 };
        let n_gaps = ((total / (GAP * spacing)).round() as usize).max(least);
        let mut given = Vec::new();
        let mut behind = 0.0;
        for ((a, b), length) in chain.steps().zip(&lengths) {
            let shares = on_edges.get(&[a.min(b), a.max(b)]).into_iter().flatten();
            given.extend(shares.map(|share| behind + length * if a < b { *share } else { 1.0 - share }));
            behind += length;
            given.extend(on_edges.get(&[b; 2]).map(|_| behind));
        }
        // What lies at the ends is there anyway.
        given.retain(|&place| place > AT_END * total && place < (1.0 - AT_END) * total);
        given.sort_by(f64::total_cmp);
        given.dedup_by(|a, b| *a - *b <= AT_END * total);
        if given.is_empty() || 2 * given.len() + 2 < n_gaps || given.len() + 1 < least {
            return Self { lengths, total, n_gaps, given: Vec::new(), at_corners: [None; 2] };
        }
        Self { lengths, total, n_gaps: given.len() + 1, given, at_corners: [None; 2] }
    }

    fn gap(&self) -> f64 {
        self.total / self.n_gaps as f64
    }

    /// The gaps between the points, with their middles on the chain.
    fn gaps(&self, draft: &Draft, chain: &Chain) -> Vec<Gap> {
        let mut ends = vec![0.0];
        ends.extend(self.places());
        ends.push(self.total);
        let mut steps = chain.steps().zip(&self.lengths).peekable();
        let mut behind = 0.0;
        let mut gaps = Vec::with_capacity(ends.len());
        for pair in ends.windows(2) {
            let middle = 0.5 * (pair[0] + pair[1]);
            while let Some((_, length)) = steps.next_if(|(_, length)| middle > behind + **length) {
                behind += length;
            }
            if let Some(&((a, b), length)) = steps.peek() {
                let at = draft.at(a).lerp(draft.at(b), (middle - behind) / length);
                gaps.push(Gap { edge: [a, b], middle: at, length: pair[1] - pair[0] });
            }
        }
        gaps
    }

    /// How far along the chain the points inside are.
    fn places(&self) -> Vec<f64> {
        if !self.given.is_empty() {
            return self.given.clone();
        }
        let [mut first, mut last] = self.at_corners.map(|gap| gap.unwrap_or(self.gap()));
        // What a sharp corner asks for is not given where it would leave no room for the others.
        if self.total - first - last < LEAST_ROOM * self.gap() * (self.n_gaps as f64 - 2.0)
            || first.max(last) > self.total - LEAST_ROOM * self.gap()
        {
            (first, last) = (self.gap(), self.gap());
        }
        match self.n_gaps {
            ..2 => Vec::new(),
            2 if self.at_corners[0].is_none() => vec![self.total - last],
            2 => vec![first],
            n => {
                let gap = (self.total - first - last) / (n - 2) as f64;
                (0..n - 1).map(|k| first + k as f64 * gap).collect()
            }
        }
    }
}

/// Pins the corners, and points between them so many spacings apart, or those that are given on edges; returns the gaps between them. Nothing is done if those were more than `most`: then
/// this returns how many.
pub(super) fn pin_chains(draft: &mut Draft, spacing: f64, most: usize, on_edges: &BTreeMap<[u32; 2], Vec<f64>>) -> Result<Vec<Gap>, usize> {
    let chains = &draft.features.chains;
    let mut plans: Vec<Plan> = chains.iter().map(|chain| Plan::new(draft, chain, spacing, on_edges)).collect();
    let n_points = plans.iter().fold(0, |sum: usize, plan| sum.saturating_add(plan.n_gaps - 1));
    if n_points > most {
        return Err(n_points);
    }
    fit_sharp_corners(draft, chains, &mut plans);
    for (chain, plan) in chains.iter().zip(&plans) {
        pin_chain(draft, chain, plan);
    }
    Ok(chains.iter().zip(&plans).filter(|(chain, _)| !chain.is_loose).flat_map(|(chain, plan)| plan.gaps(draft, chain)).collect())
}

/// Where two chains meet at a sharp angle, the first point of the one stands at the foot of that of the other.
fn fit_sharp_corners(draft: &Draft, chains: &[Chain], plans: &mut [Plan]) {
    // The ends of chains at each vertex.
    let mut ends: BTreeMap<u32, Vec<(usize, usize)>> = BTreeMap::new();
    for (k, chain) in chains.iter().enumerate().filter(|(_, chain)| !chain.is_closed) {
        let n = chain.vertices.len();
        ends.entry(chain.vertices[0]).or_default().push((k, 0));
        ends.entry(chain.vertices[n - 1]).or_default().push((k, 1));
    }
    let way = |&(k, end): &(usize, usize)| {
        let all = &chains[k].vertices;
        let [from, to] = if end == 0 { [all[0], all[1]] } else { [all[all.len() - 1], all[all.len() - 2]] };
        (draft.at(to) - draft.at(from)).normalize_or_zero()
    };
    let gaps: Vec<f64> = plans.iter().map(Plan::gap).collect();
    let least_cos = libm::cos(SHARP_DEG.to_radians());
    for at in ends.values() {
        for (k, one) in at.iter().enumerate() {
            for other in &at[..k] {
                let cos = way(one).dot(way(other));
                let (&(short, end), &(long, _)) = if gaps[one.0] < gaps[other.0] { (one, other) } else { (other, one) };
                let foot = &mut plans[short].at_corners[end];
                if cos > least_cos && foot.is_none() {
                    *foot = Some(cos * gaps[long]);
                }
            }
        }
    }
}

fn pin_chain(draft: &mut Draft, chain: &Chain, plan: &Plan) {
    let steps: Vec<(u32, u32)> = chain.steps().collect();
    draft.pin(chain.vertices[0]);
    draft.pin(steps[steps.len() - 1].1);
    let mut places = plan.places().into_iter().peekable();
    let mut behind = 0.0;
    for (&(a, b), length) in steps.iter().zip(&plan.lengths) {
        let mut at = a;
        let mut from = 0.0;
        // Relative to this step.
        let share = |place: &f64| (place - behind) / length;
        while let Some(to) = places.next_if(|place| share(place) <= 1.0 - AT_END).map(|place| share(&place)) {
            if to - from <= AT_END {
                draft.pin(at);
            } else if let Some(h) = draft.find_edge(at, b) {
                let part = (to - from) / (1.0 - from);
                at = draft.split(h, if draft.mesh.origin[h as usize] == at { part } else { 1.0 - part });
                draft.pin(at);
                from = to;
            }
        }
        // A place at the very end of the edge.
        if places.next_if(|place| share(place) <= 1.0 + AT_END).is_some() {
            draft.pin(b);
        }
        behind += length;
    }
}

fn weighted(draft: &Draft, a: u32, b: u32) -> f64 {
    let [a, b] = [a, b].map(|v| &draft.vertices[v as usize]);
    a.place.at.distance(b.place.at) * 2.0 / (a.size + b.size)
}
