//! Points along creases and borders: evenly spaced from corner to corner, before anything else, and there they stay.

use super::draft::Draft;
use crate::surface::Chain;

/// The gaps between them, in the wanted spacings.
const GAP: f64 = 1.1;
/// A place so near to the end of an edge, relative to its length, is that end.
const AT_END: f64 = 1e-6;

/// Pins the corners, and points between them so many spacings apart.
pub(super) fn pin_chains(draft: &mut Draft, spacing: f64) {
    let features = draft.features;
    for chain in &features.chains {
        pin_chain(draft, chain, spacing);
    }
}

fn pin_chain(draft: &mut Draft, chain: &Chain, spacing: f64) {
    let steps: Vec<(u32, u32)> = chain.steps().collect();
    // In the wanted spacings, so that gaps vary as they do.
    let lengths: Vec<f64> = steps.iter().map(|&(a, b)| weighted(draft, a, b)).collect();
    let total: f64 = lengths.iter().sum();
    let least = if chain.is_closed { 3 } else { 1 };
    let n_gaps = ((total / (GAP * spacing)).round() as usize).max(least);
    draft.pin(chain.vertices[0]);
    draft.pin(steps[steps.len() - 1].1);
    let (mut k, mut behind) = (1, 0.0);
    for (&(a, b), length) in steps.iter().zip(lengths) {
        let mut at = a;
        let mut from = 0.0;
        while k < n_gaps {
            let to = (total * k as f64 / n_gaps as f64 - behind) / length;
            if to > 1.0 - AT_END {
                break;
            }
            k += 1;
            if to - from <= AT_END {
                draft.pin(at);
            } else if let Some(h) = draft.find_edge(at, b) {
                let share = (to - from) / (1.0 - from);
                at = draft.split(h, if draft.mesh.origin[h as usize] == at { share } else { 1.0 - share });
                draft.pin(at);
                from = to;
            }
        }
        // A place at the very end of the edge.
        if k < n_gaps && (total * k as f64 / n_gaps as f64 - behind) / length <= 1.0 + AT_END {
            draft.pin(b);
            k += 1;
        }
        behind += length;
    }
}

fn weighted(draft: &Draft, a: u32, b: u32) -> f64 {
    let [a, b] = [a, b].map(|v| &draft.vertices[v as usize]);
    a.place.at.distance(b.place.at) * 2.0 / (a.size + b.size)
}
