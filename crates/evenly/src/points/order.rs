//! Hilbert order: neighbours in the plane become neighbours in memory.

use glam::DVec2;
use rayon::prelude::*;

/// The indices of `positions`, all within `size`, along a Hilbert curve. Equal positions stand side by side, by index.
pub(crate) fn hilbert_order(positions: &[DVec2], size: DVec2) -> Vec<u32> {
    // Square curve cells even in a long domain; 2^16 a side are fine enough for locality.
    let scale = 65535.0 / size.max_element();
    let mut keys: Vec<u64> = positions
        .par_iter()
        .enumerate()
        .map(|(index, &p)| {
            let cell = p * scale;
            let key: u32 = fast_hilbert::xy2h(cell.x as u16, cell.y as u16, 16);
            u64::from(key) << 32 | index as u64
        })
        .collect();
    keys.par_sort_unstable();
    for cell in keys.chunk_by_mut(|a, b| a >> 32 == b >> 32).filter(|cell| cell.len() > 1) {
        let at = |key: u64| positions[key as u32 as usize];
        cell.sort_unstable_by(|&a, &b| {
            let (p, q) = (at(a), at(b));
            p.x.total_cmp(&q.x).then(p.y.total_cmp(&q.y)).then(a.cmp(&b))
        });
    }
    keys.into_iter().map(|key| key as u32).collect()
}
