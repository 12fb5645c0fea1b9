//! One visit: a star is read, the rule looks at it, and what it asks for is done.

use glam::DVec2;

use super::ground::{Buffer, Ground, Reading, Way};
use crate::star::{Rule, Star};
use crate::triangulation::{MIRROR, Outside, Spoke};

/// Moves below this, in local spacings, are not worth making.
const STILL: f64 = 1e-9;
/// The longest move, in local spacings.
const LONGEST: f64 = 1.0;
/// How far another point pushes one where the density varies, in the spacing of that which is pushed: however sparse it is around the other, it does not throw it about.
const LONGEST_PUSH: f64 = 0.5;
/// The part of its distance by which a neighbour may come nearer in one move: it does not run into the vertex, or through it.
const NEARER: f64 = 0.75;
/// The share of a pull between a vertex and its image behind a wall that the vertex makes, and the share by which the neighbours at the same wall follow it. Behind the wall stand the images of all
/// points, and each pulls as its point does: without them a set under tension comes off its walls.
const TO_WALL: f64 = 0.75;
const ALONG_TO_WALL: f64 = 0.15;

/// The moves that a rule has asked for, in local spacings.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Unrest {
    /// The sum of their squares; 0 if there is nothing wrong.
    pub squares: f64,
    pub longest: f64,
}

impl Unrest {
    fn add(&mut self, other: Self) {
        self.squares += other.squares;
        self.longest = self.longest.max(other.longest);
    }

    fn add_move(&mut self, length: f64) {
        self.add(Self { squares: length * length, longest: length });
    }

    pub fn is_none(&self) -> bool {
        self.squares == 0.0
    }
}

/// What has been done in a cell, or in a pass.
#[derive(Debug, Default)]
pub(super) struct Work {
    pub n_visits: usize,
    /// Points at which the rule had something to do.
    pub n_unstable: usize,
    pub unrest: Unrest,
    pub n_flips: usize,
    /// Points whose visit would have reached out of the cell's territory.
    pub deferred: Vec<u32>,
}

impl Work {
    /// Counts a visit that found so much unrest.
    pub fn count(&mut self, unrest: Unrest) {
        self.n_visits += 1;
        self.n_unstable += usize::from(!unrest.is_none());
        self.unrest.add(unrest);
    }

    pub fn add(&mut self, other: &Self) {
        self.n_visits += other.n_visits;
        self.n_unstable += other.n_unstable;
        self.unrest.add(other.unrest);
        self.n_flips += other.n_flips;
        self.deferred.extend(&other.deferred);
    }
}

/// Visits a point; if the rule finds something wrong there, the point stays dirty.
pub(super) fn visit<G: Ground, R: Rule, const PLAIN: bool>(
    mesh: &G,
    rule: &R,
    v: u32,
    territory: G::Territory,
    buffer: &mut G::Buffer,
) -> Result<Unrest, Outside> {
    let unrest = ask::<G, R, PLAIN>(mesh, rule, v, territory, buffer)?;
    for k in 0..buffer.reading().moves.len() {
        let (point, by) = buffer.reading().moves[k];
        mesh.relocate::<PLAIN>(point, by, territory, buffer)?;
    }
    if unrest.is_none() {
        mesh.clean(v);
    } else if !PLAIN {
        mesh.count_unrest(v);
    }
    Ok(unrest)
}

/// Reads a star, and leaves the moves that the rule asks for in the buffer.
pub(super) fn ask<G: Ground, R: Rule, const PLAIN: bool>(
    mesh: &G,
    rule: &R,
    v: u32,
    territory: G::Territory,
    buffer: &mut G::Buffer,
) -> Result<Unrest, Outside> {
    mesh.read::<PLAIN>(v, territory, buffer)?;
    if R::LOOKS_AROUND {
        mesh.look_around(v, territory, buffer)?;
    }
    let Reading { star, spokes, moves } = buffer.reading();
    moves.clear();
    if !rule.visit(star) {
        return Ok(Unrest::default());
    }
    // What is wrong is unrest, even where nothing can be moved: steps of a rule may undo each other.
    let mut unrest = Unrest::default();
    unrest.add_move(STILL);
    let mut own = spokes.iter().zip(&star.weights).fold(G::Way::default(), |sum, (spoke, &weight)| sum + spoke.way * weight);
    if star.shift != DVec2::ZERO {
        own += mesh.unfolded(v, mesh.spacing() * star.shift);
    }
    // Where points are dense, the same way means more.
    let scale = if PLAIN { 1.0 } else { star.metric.scale };
    // Walls and the like, and what holds points.
    let is_mirror = |spoke: &Spoke<G::Way>| !PLAIN && spoke.vertex == MIRROR;
    let along = |point: u32, by: G::Way| if PLAIN { by } else { mesh.along(point, by) };
    let longest = LONGEST / scale;
    let mut is_pulled_to_wall = false;
    for (spoke, &length) in spokes.iter().zip(&star.lengths) {
        if length == spoke.length || !PLAIN && spoke.is_echo {
            continue;
        }
        let point = match () {
            () if PLAIN => spoke.vertex,
            () if is_mirror(spoke) => v,
            () => mesh.point(spoke.vertex),
        };
        let is_pushed = !PLAIN && mesh.has_density() && !is_mirror(spoke);
        let longest = if is_pushed { LONGEST_PUSH * mesh.local_spacing(point) / mesh.spacing() } else { longest };
        let change = (length - spoke.length).clamp(-longest.min(NEARER * spoke.length), longest);
        if change.abs() * scale <= STILL || spoke.length == 0.0 {
            continue;
        }
        let by = along(point, spoke.way * (change / spoke.length));
        if by == G::Way::default() {
            continue;
        }
        unrest.add_move(change.abs() * scale);
        if is_mirror(spoke) {
            // The image comes nearer, and the vertex goes to meet it.
            own -= by * TO_WALL;
            is_pulled_to_wall |= change < 0.0;
        } else if point != v {
            moves.push((point, by));
        }
    }
    if is_pulled_to_wall {
        follow_to_walls(mesh, star, spokes, moves);
    }
    let own = along(v, own);
    let own_length = own.length() / mesh.spacing() * scale;
    if own_length > STILL {
        unrest.add_move(own_length);
        moves.push((v, own.clamp_length_max(longest * mesh.spacing())));
    }
    if !PLAIN && moves.is_empty() && mesh.holds_points() {
        // What is held here cannot be mended.
        return Ok(Unrest::default());
    }
    Ok(unrest)
}

/// Lets the neighbours that meet a vertex at a wall, and are pulled as it is, come along to the wall.
fn follow_to_walls<G: Ground>(mesh: &G, star: &Star, spokes: &[Spoke<G::Way>], moves: &mut Vec<(u32, G::Way)>) {
    let n = spokes.len();
    // The part of its distance by which a spoke's end is pulled nearer.
    let pull = |k: usize| (1.0 - star.lengths[k] / spokes[k].length).clamp(0.0, NEARER);
    for wall in (0..n).filter(|&k| spokes[k].vertex == MIRROR) {
        for k in [(wall + n - 1) % n, (wall + 1) % n].into_iter().filter(|&k| spokes[k].vertex != MIRROR) {
            let neighbour = mesh.point(spokes[k].vertex);
            let by = mesh.along(neighbour, spokes[wall].way * (ALONG_TO_WALL * pull(wall).min(pull(k))));
            if by != G::Way::default() {
                moves.push((neighbour, by));
            }
        }
    }
}
