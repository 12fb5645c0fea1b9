//! A range of a mesh's triangles that one thread may change.

use super::half_edges::{BOUNDARY, HalfEdges, next, prev};

/// The half-edges of a range of triangles; they keep their numbers, of which `first` is the first.
pub(crate) struct Patch<'a> {
    pub first: u32,
    pub origin: &'a mut [u32],
    pub twin: &'a mut [u32],
}

impl<'a> Patch<'a> {
    /// All of a mesh.
    pub fn whole(mesh: &'a mut HalfEdges) -> Self {
        Self { first: 0, origin: &mut mesh.origin, twin: &mut mesh.twin }
    }

    /// The place of a half-edge in the patch, if it is in it.
    #[inline]
    pub fn local(&self, h: u32) -> Option<usize> {
        let local = h.wrapping_sub(self.first) as usize;
        (local < self.origin.len()).then_some(local)
    }

    /// The edges that reach out of the patch, each from its smaller half.
    pub fn crossing(&self) -> impl Iterator<Item = u32> {
        let half_edges = (self.first..).zip(&*self.twin);
        half_edges.filter(|&(h, &twin)| twin != BOUNDARY && twin > h && self.local(twin).is_none()).map(|(h, _)| h)
    }

    /// The corners around the edge of `h`, whose twin `t` is in the patch too: its ends p and q, its apex r, and the apex s across.
    #[inline]
    pub fn quadrilateral(&self, h: u32, t: u32) -> [u32; 4] {
        [h, next(h), prev(h), prev(t)].map(|edge| self.origin[(edge - self.first) as usize])
    }

    /// Replaces the edge of `h` by the other diagonal of that quadrilateral: (p q r) and (q p s) become (s q r) and (r p s).
    /// False, and nothing is changed, where that would reach out of the patch, or `h` lies on a boundary.
    pub fn flip(&mut self, h: u32) -> bool {
        let Some(i) = self.local(h) else { return false };
        let t = self.twin[i];
        let Some(j) = self.local(t) else { return false };
        let (r_edge, s_edge) = (prev(h), prev(t));
        let [r, s] = [r_edge, s_edge].map(|edge| (edge - self.first) as usize);
        let (across_h, across_t) = (self.twin[s], self.twin[r]);
        let is_inside = |edge: u32| edge == BOUNDARY || self.local(edge).is_some();
        if !(is_inside(across_h) && is_inside(across_t)) {
            return false;
        }
        self.origin[i] = self.origin[s];
        self.origin[j] = self.origin[r];
        for (place, edge, twin) in [(r, r_edge, s_edge), (s, s_edge, r_edge), (i, h, across_h), (j, t, across_t)] {
            self.twin[place] = twin;
            if let Some(other) = self.local(twin) {
                self.twin[other] = edge;
            }
        }
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn flipping_twice_swaps_the_triangles() {
        // A square 0 1 2 3 cut along 0-2.
        let (mut origin, mut twin) = ([0, 1, 2, 0, 2, 3], [BOUNDARY, BOUNDARY, 3, 2, BOUNDARY, BOUNDARY]);
        let mut patch = Patch { first: 0, origin: &mut origin, twin: &mut twin };
        assert!(!patch.flip(0));
        assert!(patch.flip(2));
        assert_eq!(*patch.origin, [0, 1, 3, 1, 2, 3]);
        let diagonal = (0..6).find(|&h| patch.twin[h as usize] != BOUNDARY).unwrap();
        assert!(patch.flip(diagonal));
        assert_eq!(*patch.origin, [0, 2, 3, 1, 2, 0]);
        let inner: Vec<u32> = (0..6).filter(|&h| patch.twin[h as usize] != BOUNDARY).collect();
        assert_eq!(inner.iter().map(|&h| patch.twin[h as usize]).collect::<Vec<_>>(), [inner[1], inner[0]]);
    }
}
