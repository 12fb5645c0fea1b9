//! One visit: a star is read, the rule looks at it, and what it asks for is done.

use glam::DVec2;

use crate::star::Rule;
use crate::triangulation::{LiveMesh, MIRROR, Outside, StarBuffer, Territory};

/// Moves below this, in spacings, are rounding.
const STILL: f64 = 1e-6;
/// The longest move, in spacings.
const LONGEST: f64 = 1.0;

/// What has been done in a cell, or in a pass.
#[derive(Debug, Default)]
pub(super) struct Work {
    pub n_visits: usize,
    /// Points at which the rule had something to do.
    pub n_unstable: usize,
    /// The sum of squares of the moves that it asked for, in spacings.
    pub unrest: f64,
    pub n_flips: usize,
    /// Points whose visit would have reached out of the cell's territory.
    pub deferred: Vec<u32>,
}

impl Work {
    /// Counts a visit that found so much unrest.
    pub fn count(&mut self, unrest: f64) {
        self.n_visits += 1;
        self.n_unstable += usize::from(unrest > 0.0);
        self.unrest += unrest;
    }

    pub fn add(&mut self, other: &Self) {
        self.n_visits += other.n_visits;
        self.n_unstable += other.n_unstable;
        self.unrest += other.unrest;
        self.n_flips += other.n_flips;
        self.deferred.extend(&other.deferred);
    }
}

/// Visits a point; returns the sum of squares of the moves that the rule asked for, in spacings. If there are any, the point stays dirty.
pub(super) fn visit(mesh: &LiveMesh, rule: &impl Rule, v: u32, territory: Territory, buffer: &mut StarBuffer) -> Result<f64, Outside> {
    let unrest = ask(mesh, rule, v, territory, buffer)?;
    for k in 0..buffer.moves.len() {
        let (point, by) = buffer.moves[k];
        mesh.relocate(point, by, territory, buffer)?;
    }
    if unrest == 0.0 {
        mesh.clean(v);
    }
    Ok(unrest)
}

/// Reads a star, and leaves the moves that the rule asks for in the buffer; returns the sum of their squares, in spacings.
pub(super) fn ask(mesh: &LiveMesh, rule: &impl Rule, v: u32, territory: Territory, buffer: &mut StarBuffer) -> Result<f64, Outside> {
    mesh.read(v, territory, buffer)?;
    let StarBuffer { star, spokes, moves, .. } = buffer;
    moves.clear();
    if !rule.visit(star) {
        return Ok(0.0);
    }
    // What is wrong is unrest, even where nothing can be moved: steps of a rule may undo each other.
    let mut unrest = STILL * STILL;
    let mut own: DVec2 = spokes.iter().zip(&star.weights).map(|(spoke, &weight)| weight * spoke.way).sum();
    for (spoke, length) in spokes.iter().zip(&star.lengths) {
        let change = (length - spoke.length).clamp(-LONGEST, LONGEST);
        if change.abs() <= STILL || spoke.length == 0.0 {
            continue;
        }
        unrest += change * change;
        let by = change / spoke.length * spoke.way;
        let point = mesh.point(spoke.vertex);
        if spoke.vertex == MIRROR {
            // The image goes as far as the vertex, to the other side.
            own -= 0.5 * by;
        } else if point != v {
            moves.push((point, by));
        }
    }
    let own_length = own.length() / mesh.spacing();
    if own_length > STILL {
        unrest += own_length * own_length;
        moves.push((v, own.clamp_length_max(LONGEST * mesh.spacing())));
    }
    Ok(unrest)
}
