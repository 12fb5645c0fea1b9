//! A pass in which nobody moves before all have been asked.

use rayon::prelude::*;

use super::ground::{Buffer, Ground, Way};
use super::visit::{Work, ask};
use crate::star::Rule;

/// Points that are asked in one go.
const CHUNK: usize = 1 << 12;

/// What has been done in a chunk, and what was asked of which point.
type Asked<W> = (Work, Vec<(u32, W)>);

/// Asks the rule at all dirty points, and then moves every point by the sum of what was asked of it.
pub(super) fn summed_pass<G: Ground>(mesh: &mut G, rule: &impl Rule) -> Work {
    let mut total = Work { n_flips: mesh.legalize(), ..Work::default() };
    let dirty: Vec<u32> = (0..mesh.n_points() as u32).filter(|&v| mesh.is_dirty(v)).collect();
    // All edges are legal, so nothing is flipped while stars are read.
    let shared = &*mesh;
    let asked: Vec<Asked<G::Way>> = dirty
        .par_chunks(CHUNK)
        .map_init(
            || G::Buffer::sensing(rule.senses()),
            |buffer, chunk| {
                let (mut work, mut moves) = (Work::default(), Vec::new());
                for &v in chunk {
                    // With everything free, nothing lies outside.
                    let unrest = ask::<_, _, false>(shared, rule, v, G::EVERYTHING, buffer).unwrap_or_default();
                    if unrest.is_none() {
                        shared.clean(v);
                    }
                    work.count(unrest);
                    moves.extend_from_slice(buffer.reading().moves);
                }
                (work, moves)
            },
        )
        .collect();
    let still = G::Way::default();
    let mut sums = vec![still; mesh.n_points()];
    for (work, moves) in &asked {
        total.add(work);
        moves.iter().for_each(|&(point, by)| sums[point as usize] += by);
    }
    let mut buffer = G::Buffer::default();
    for (point, by) in (0..).zip(sums).filter(|&(_, by)| by != still) {
        // Nor here: as far as it gets.
        let _ = mesh.relocate::<false>(point, by.clamp_length_max(mesh.local_spacing(point)), G::EVERYTHING, &mut buffer);
    }
    total.n_flips += buffer.n_flips();
    total
}
