//! [`State`]: the points of a mesh and what holds them, from the first on.

use std::sync::Arc;

use glam::DVec2;

use super::background::Background;
use super::border::Parts;
use super::outline::{Of, Outline};
use super::scatter::Scattered;
use crate::points::hilbert_order;
use crate::space::Domain;
use crate::triangulation::{BORDER, Bonds, Track};

/// What holds the points, by point, and where they are.
#[derive(Debug, Clone)]
pub(super) struct State {
    pub points: Vec<DVec2>,
    /// The outline's point that each is; [`BORDER`] for those that are none.
    pub corners: Vec<u32>,
    /// Their rails are the outline's segments.
    pub bonds: Bonds,
}

impl State {
    /// The outline's points, those on its segments, and those inside.
    pub fn new(outline: &Outline, background: Background, parts: &[Parts], inside: Scattered) -> Self {
        let Background { sizing, mut hints, .. } = background;
        let mut points = outline.points.clone();
        let mut corners: Vec<u32> = (0..points.len() as u32).collect();
        let mut tracks = vec![Track::Fixed; points.len()];
        let (mut border, mut lines) = (Vec::new(), Vec::new());
        for ((rail, segment), parts) in (0..).zip(&outline.segments).zip(parts) {
            let first = points.len() as u32;
            points.extend(&parts.points);
            hints.extend(&parts.hints);
            tracks.extend(parts.points.iter().map(|_| Track::Rail(rail)));
            let [start, end] = segment.ends;
            let chain: Vec<u32> = std::iter::once(start).chain(first..points.len() as u32).chain([end]).collect();
            let edges = if matches!(segment.of, Of::Line(_)) { &mut lines } else { &mut border };
            edges.extend(chain.windows(2).map(|ends| ([ends[0], ends[1]], rail)));
        }
        tracks.extend(inside.points.iter().map(|_| Track::Free));
        points.extend(inside.points);
        hints.extend(inside.hints);
        corners.resize(points.len(), BORDER);
        let bonds = Bonds {
            tracks,
            rails: outline.segments.iter().map(|segment| segment.ends.map(|v| outline.points[v as usize])).collect(),
            on_rail: border.iter().chain(&lines).map(|&(_, rail)| rail).collect(),
            border: border.into_iter().map(|(ends, _)| ends).collect(),
            lines: lines.into_iter().map(|(ends, _)| ends).collect(),
            sizing: Arc::new(sizing),
            hints,
        };
        Self { points, corners, bonds }
    }

    /// The same along the Hilbert curve.
    pub fn in_order(self, domain: &Domain) -> Self {
        let order = hilbert_order(&self.points, domain.size);
        let mut number = vec![0u32; self.points.len()];
        order.iter().zip(0..).for_each(|(&point, k)| number[point as usize] = k);
        let renumbered = |edges: &[[u32; 2]]| edges.iter().map(|ends| ends.map(|v| number[v as usize])).collect();
        let Self { points, corners, bonds } = self;
        Self {
            points: order.iter().map(|&point| points[point as usize]).collect(),
            corners: order.iter().map(|&point| corners[point as usize]).collect(),
            bonds: Bonds {
                tracks: order.iter().map(|&point| bonds.tracks[point as usize]).collect(),
                hints: order.iter().map(|&point| bonds.hints[point as usize]).collect(),
                border: renumbered(&bonds.border),
                lines: renumbered(&bonds.lines),
                ..bonds
            },
        }
    }
}
