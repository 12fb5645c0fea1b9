//! A pass in which nobody moves before all have been asked.

use glam::DVec2;
use rayon::prelude::*;

use super::visit::{Work, ask};
use crate::star::Rule;
use crate::triangulation::{LiveMesh, StarBuffer, Territory};

/// Points that are asked in one go.
const CHUNK: usize = 1 << 12;

/// Asks the rule at all dirty points, and then moves every point by the sum of what was asked of it.
pub(super) fn summed_pass(mesh: &mut LiveMesh, rule: &impl Rule) -> Work {
    let mut total = Work { n_flips: mesh.legalize(), ..Work::default() };
    let dirty: Vec<u32> = (0..mesh.n_points() as u32).filter(|&v| mesh.is_dirty(v)).collect();
    // All edges are legal, so nothing is flipped while stars are read.
    let asked: Vec<(Work, Vec<(u32, DVec2)>)> = dirty
        .par_chunks(CHUNK)
        .map_init(
            || StarBuffer::sensing(rule.senses()),
            |buffer, chunk| {
                let (mut work, mut moves) = (Work::default(), Vec::new());
                for &v in chunk {
                    // With everything free, nothing lies outside.
                    let unrest = ask(mesh, rule, v, Territory::EVERYTHING, buffer).unwrap_or_default();
                    if unrest.is_none() {
                        mesh.clean(v);
                    }
                    work.count(unrest);
                    moves.extend_from_slice(&buffer.moves);
                }
                (work, moves)
            },
        )
        .collect();
    let mut sums = vec![DVec2::ZERO; mesh.n_points()];
    for (work, moves) in &asked {
        total.add(work);
        moves.iter().for_each(|&(point, by)| sums[point as usize] += by);
    }
    let mut buffer = StarBuffer::default();
    for (point, by) in (0..).zip(sums).filter(|&(_, by)| by != DVec2::ZERO) {
        // Nor here: as far as it gets.
        let _ = mesh.relocate(point, by.clamp_length_max(mesh.local_spacing(point)), Territory::EVERYTHING, &mut buffer);
    }
    total.n_flips += buffer.n_flips;
    total
}
