//! Points go, points come, and the edges between them follow.

use std::collections::HashMap;

use glam::DVec2;

use crate::mesh::state::State;
use crate::triangulation::{BOUNDARY, Edge, Track};

/// What is to be changed.
#[derive(Debug, Clone, Copy)]
pub(super) enum Change {
    /// This point goes.
    Remove(u32),
    /// One comes here, onto this edge of the boundary or of a line.
    Halve(usize, DVec2),
    /// The same, instead of this point beside it.
    Land(u32, usize, DVec2),
    /// One comes here, in a triangle of the sizing near this one.
    Add(DVec2, u32),
}

impl State {
    /// The state with these changes.
    pub(super) fn changed(self, changes: impl Iterator<Item = Change>) -> Self {
        let mut drafts = Drafts::new(self);
        changes.for_each(|change| drafts.change(change));
        drafts.finish()
    }
}

/// A state with points that are to go.
struct Drafts {
    state: State,
    is_gone: Vec<bool>,
    /// Of the edges that there were at first, which have not been halved: that is done once.
    is_whole: Vec<bool>,
}

impl Drafts {
    fn new(state: State) -> Self {
        Self { is_gone: vec![false; state.points.len()], is_whole: vec![true; state.bonds.edges.len()], state }
    }

    fn change(&mut self, change: Change) {
        match change {
            Change::Remove(point) => self.is_gone[point as usize] = true,
            Change::Halve(edge, at) => {
                self.halve(edge, at);
            }
            Change::Land(point, edge, at) => self.is_gone[point as usize] |= self.halve(edge, at),
            Change::Add(at, hint) => {
                self.add(at, Track::Free, hint);
            }
        }
    }

    /// Whether there was an edge to halve.
    fn halve(&mut self, edge: usize, at: DVec2) -> bool {
        if !std::mem::replace(&mut self.is_whole[edge], false) {
            return false;
        }
        let Edge { ends: [from, to], rail, is_line } = self.state.bonds.edges[edge];
        let middle = self.add(at, Track::Rail(rail), self.state.bonds.hints[from as usize]);
        self.state.bonds.edges[edge].ends = [from, middle];
        self.state.bonds.edges.push(Edge { ends: [middle, to], rail, is_line });
        true
    }

    fn add(&mut self, at: DVec2, track: Track, hint: u32) -> u32 {
        let State { points, corners, bonds } = &mut self.state;
        points.push(at);
        corners.push(BOUNDARY);
        bonds.tracks.push(track);
        bonds.hints.push(hint);
        self.is_gone.push(false);
        points.len() as u32 - 1
    }

    /// What is left.
    fn finish(self) -> State {
        let Self { state, is_gone, .. } = self;
        let edges = &state.bonds.edges;
        // Where a point on a rail goes, the edges before and after it become one.
        let leaving: HashMap<[u32; 2], u32> = edges.iter().map(|edge| ([edge.ends[0], edge.rail], edge.ends[1])).collect();
        let left = edges.iter().filter(|edge| !is_gone[edge.ends[0] as usize]).map(|edge| {
            let [from, mut to] = edge.ends;
            while is_gone[to as usize] {
                let Some(&after) = leaving.get(&[to, edge.rail]) else { break };
                to = after;
            }
            Edge { ends: [from, to], ..*edge }
        });
        let left = left.collect();
        state.without(&is_gone, left)
    }
}
