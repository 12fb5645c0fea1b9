//! Points on the boundary and on lines: each segment is divided into parts as long as the spacing there, as nearly as whole numbers allow.

use glam::DVec2;

use super::background::Background;
use super::outline::{Of, Outline};
use crate::space::snap;

/// Parts that are off the spacing by no more than this leave it as it is: so it stays the same everywhere.
const SLACK: f64 = 0.12;

/// What stands on a segment, its ends not counted.
#[derive(Debug, Clone, Default)]
pub(super) struct Parts {
    /// From its start to its end.
    pub points: Vec<DVec2>,
    /// The triangle of the sizing at each.
    pub hints: Vec<u32>,
}

/// A piece of a segment: an edge of the sizing.
#[derive(Clone, Copy)]
struct Piece {
    ends: [u32; 2],
    /// A triangle that has it.
    triangle: u32,
    /// Where it begins, as a part of the segment.
    from: f64,
    to: f64,
    /// How many spacings it is long.
    n_spacings: f64,
}

/// Divides each segment of the outline, and makes the spacing on the boundary that of the parts.
pub(super) fn divide(outline: &Outline, background: &mut Background) -> Vec<Parts> {
    let pieces = pieces(outline, background);
    let sizing = &mut background.sizing;
    let mut stretches: Vec<(f64, u32)> = vec![(0.0, 0); sizing.sizes.len()];
    let mut all = Vec::with_capacity(pieces.len());
    for (segment, pieces) in outline.segments.iter().zip(&pieces) {
        let length: f64 = pieces.iter().map(|piece| piece.n_spacings).sum();
        // The whole number from which it is least far off, as a ratio.
        let whole = length.floor().max(1.0);
        let n_parts = match segment.of {
            Of::Base => 1.0,
            _ if length * length > whole * (whole + 1.0) => whole + 1.0,
            _ => whole,
        };
        let part = length / n_parts;
        for piece in pieces {
            for v in piece.ends {
                let (sum, n) = &mut stretches[v as usize];
                let stretch = if libm::log(part).abs() < SLACK { 0.0 } else { libm::log(part) };
                (*sum, *n) = (*sum + stretch, *n + 1);
            }
        }
        let [start, end] = segment.ends.map(|v| outline.points[v as usize]);
        let mut parts = Parts::default();
        let (mut before, mut pieces) = (0.0, pieces.iter());
        let mut piece = pieces.next();
        for k in 1..n_parts as usize {
            let wanted = k as f64 * part;
            while let Some(at) = piece
                && before + at.n_spacings < wanted
                && pieces.len() > 0
            {
                before += at.n_spacings;
                piece = pieces.next();
            }
            let Some(at) = piece else { break };
            let [from, to] = at.ends.map(|v| sizing.sizes[v as usize]);
            let share = at.from + (at.to - at.from) * share_at((wanted - before) / at.n_spacings, to / from);
            parts.points.push(snap(start + share * (end - start)));
            parts.hints.push(at.triangle);
        }
        all.push(parts);
    }
    for (size, (sum, n)) in sizing.sizes.iter_mut().zip(stretches) {
        *size *= libm::exp(sum / f64::from(n.max(1)));
    }
    all
}

/// How many spacings each segment of the outline is long.
pub(super) fn lengths(outline: &Outline, background: &Background) -> Vec<f64> {
    pieces(outline, background).iter().map(|pieces| pieces.iter().map(|piece| piece.n_spacings).sum()).collect()
}

/// The pieces of each segment, from its start to its end.
fn pieces(outline: &Outline, background: &Background) -> Vec<Vec<Piece>> {
    let Background { sizing, segments, .. } = background;
    let mut pieces: Vec<Vec<Piece>> = vec![Vec::new(); outline.segments.len()];
    for h in 0..sizing.half_edges.origin.len() as u32 {
        let ends = [sizing.half_edges.origin[h as usize], sizing.half_edges.target(h)];
        let Some(&number) = segments.get(&ends) else { continue };
        let [start, end] = outline.segments[number as usize].ends.map(|v| outline.points[v as usize]);
        let way = end - start;
        let [from, to] = ends.map(|v| (sizing.positions[v as usize] - start).dot(way) / way.length_squared());
        let [first, last] = ends.map(|v| sizing.sizes[v as usize]);
        let n_spacings = (to - from) * way.length() * mean_inverse(first, last);
        pieces[number as usize].push(Piece { ends, triangle: h / 3, from, to, n_spacings });
    }
    for pieces in &mut pieces {
        pieces.sort_by(|a, b| a.from.total_cmp(&b.from));
    }
    pieces
}

/// The mean of 1 / x between two numbers.
fn mean_inverse(a: f64, b: f64) -> f64 {
    let ratio = b / a;
    if (ratio - 1.0).abs() < 1e-6 { 2.0 / (a + b) } else { libm::log(ratio) / (b - a) }
}

/// How far along a piece lies what is a given share of its length in spacings, if these grow by this ratio.
fn share_at(share: f64, ratio: f64) -> f64 {
    if (ratio - 1.0).abs() < 1e-6 { share } else { (libm::pow(ratio, share) - 1.0) / (ratio - 1.0) }
}
