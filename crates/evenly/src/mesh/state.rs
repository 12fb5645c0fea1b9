//! [`State`]: the points of a mesh and what holds them, from the first on.

use std::sync::Arc;

use glam::DVec2;

use super::background::Background;
use super::boundary::Parts;
use super::outline::{Of, Outline};
use super::scatter::Scattered;
use crate::points::hilbert_order;
use crate::space::Domain;
use crate::triangulation::{BOUNDARY, Bonds, Edge, LiveMesh, Track};

/// What holds the points, by point, and where they are.
#[derive(Debug, Clone)]
pub(super) struct State {
    pub points: Vec<DVec2>,
    /// The outline's point that each is; [`BOUNDARY`] for those that are none.
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
        let mut edges = Vec::new();
        for ((rail, segment), parts) in (0..).zip(&outline.segments).zip(parts) {
            let first = points.len() as u32;
            points.extend(&parts.points);
            hints.extend(&parts.hints);
            tracks.extend(parts.points.iter().map(|_| Track::Rail(rail)));
            let [start, end] = segment.ends;
            let chain: Vec<u32> = std::iter::once(start).chain(first..points.len() as u32).chain([end]).collect();
            let is_line = matches!(segment.of, Of::Line(_));
            edges.extend(chain.windows(2).map(|ends| Edge { ends: [ends[0], ends[1]], rail, is_line }));
        }
        tracks.extend(inside.points.iter().map(|_| Track::Free));
        points.extend(inside.points);
        hints.extend(inside.hints);
        corners.resize(points.len(), BOUNDARY);
        let rails = outline.rails();
        let bonds = Bonds { tracks, rails, edges, sizing: Arc::new(sizing), hints };
        Self { points, corners, bonds }
    }

    /// The state of a mesh whose points are these of the outline; `None` where nothing holds them.
    pub fn of(mesh: &LiveMesh, corners: Vec<u32>) -> Option<Self> {
        let (bonds, source) = mesh.bonds()?;
        let mut points = vec![DVec2::ZERO; bonds.tracks.len()];
        (0..).zip(source).for_each(|(v, &point)| points[point as usize] = mesh.position(v));
        Some(Self { points, corners, bonds })
    }

    /// The points that are not gone, in the same order, and these edges between them.
    pub fn without(self, is_gone: &[bool], edges: Vec<Edge>) -> Self {
        let Self { points, corners, bonds } = self;
        let mut number = vec![BOUNDARY; points.len()];
        let kept: Vec<usize> = (0..points.len()).filter(|&k| !is_gone[k]).collect();
        kept.iter().zip(0..).for_each(|(&k, new)| number[k] = new);
        Self {
            points: kept.iter().map(|&k| points[k]).collect(),
            corners: kept.iter().map(|&k| corners[k]).collect(),
            bonds: Bonds {
                tracks: kept.iter().map(|&k| bonds.tracks[k]).collect(),
                hints: kept.iter().map(|&k| bonds.hints[k]).collect(),
                edges: edges.into_iter().map(|edge| Edge { ends: edge.ends.map(|v| number[v as usize]), ..edge }).collect(),
                ..bonds
            },
        }
    }

    /// The same along the Hilbert curve.
    pub fn in_order(self, domain: &Domain) -> Self {
        let order = hilbert_order(&self.points, domain.size);
        let mut number = vec![0u32; self.points.len()];
        order.iter().zip(0..).for_each(|(&point, k)| number[point as usize] = k);
        let Self { points, corners, bonds } = self;
        Self {
            points: order.iter().map(|&point| points[point as usize]).collect(),
            corners: order.iter().map(|&point| corners[point as usize]).collect(),
            bonds: Bonds {
                tracks: order.iter().map(|&point| bonds.tracks[point as usize]).collect(),
                hints: order.iter().map(|&point| bonds.hints[point as usize]).collect(),
                edges: bonds.edges.iter().map(|edge| Edge { ends: edge.ends.map(|v| number[v as usize]), ..*edge }).collect(),
                ..bonds
            },
        }
    }
}
