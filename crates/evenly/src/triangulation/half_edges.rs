//! Flat half-edges: topology alone, no positions.
//!
//! Triangle `t` owns the half-edges `3t`, `3t + 1`, `3t + 2`, in counter-clockwise order. A half-edge knows the vertex it
//! leaves and the half-edge that runs the other way, in the neighbouring triangle; on a boundary there is none.

use std::collections::HashSet;

/// The twin of a half-edge on a boundary.
pub(crate) const BOUNDARY: u32 = u32::MAX;

/// A triangulated surface, closed or with boundaries.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct HalfEdges {
    pub origin: Vec<u32>,
    pub twin: Vec<u32>,
}

/// The half-edge that follows `h` in its triangle.
#[inline]
pub(crate) fn next(h: u32) -> u32 {
    if h % 3 == 2 { h - 2 } else { h + 1 }
}

/// The half-edge before `h` in its triangle.
#[inline]
pub(crate) fn prev(h: u32) -> u32 {
    if h.is_multiple_of(3) { h + 2 } else { h - 1 }
}

impl HalfEdges {
    pub fn n_triangles(&self) -> usize {
        self.origin.len() / 3
    }

    /// The three vertices of a triangle, counter-clockwise.
    #[inline]
    pub fn triangle(&self, t: usize) -> [u32; 3] {
        [self.origin[3 * t], self.origin[3 * t + 1], self.origin[3 * t + 2]]
    }

    pub fn triangles(&self) -> impl Iterator<Item = [u32; 3]> {
        self.origin.chunks_exact(3).map(|t| [t[0], t[1], t[2]])
    }

    /// The vertex at which `h` arrives.
    #[inline]
    pub fn target(&self, h: u32) -> u32 {
        self.origin[next(h) as usize]
    }

    pub fn is_boundary(&self, h: u32) -> bool {
        self.twin[h as usize] == BOUNDARY
    }

    /// All half-edges that leave the origin of `h`, once round it, counter-clockwise; at a boundary both sides of the gap are visited.
    pub fn around(&self, h: u32) -> impl Iterator<Item = u32> {
        let mut first = h;
        // Turn clockwise to the boundary, if there is one, and start there.
        loop {
            let twin = self.twin[first as usize];
            if twin == BOUNDARY {
                break;
            }
            first = next(twin);
            if first == h {
                break;
            }
        }
        let mut at = Some(first);
        std::iter::from_fn(move || {
            let current = at?;
            let turned = self.twin[prev(current) as usize];
            at = (turned != BOUNDARY && turned != first).then_some(turned);
            Some(current)
        })
    }

    /// For each vertex a half-edge that leaves it; at a boundary vertex the one on the boundary. `BOUNDARY` for a vertex without triangles.
    pub fn outgoing(&self, n_vertices: usize) -> Vec<u32> {
        let mut outgoing = vec![BOUNDARY; n_vertices];
        for (h, &v) in self.origin.iter().enumerate() {
            let best = &mut outgoing[v as usize];
            if *best == BOUNDARY || self.twin[h] == BOUNDARY {
                *best = h as u32;
            }
        }
        outgoing
    }

    /// Keeps the triangles for which `first`, given a triangle's number and corners, names a corner, and sorts them by the vertex there, with which each then begins.
    /// Edges to the others become boundaries.
    pub fn filtered(&self, first: impl Fn(usize, [u32; 3]) -> Option<usize>) -> Self {
        // A counting sort.
        let n_vertices = self.origin.iter().max().map_or(0, |&v| v as usize + 1);
        let mut start = vec![0u32; n_vertices + 1];
        for (t, corners) in self.triangles().enumerate() {
            if let Some(first) = first(t, corners) {
                start[corners[first] as usize + 1] += 1;
            }
        }
        for v in 0..n_vertices {
            start[v + 1] += start[v];
        }
        let n_kept = start[n_vertices] as usize;
        let mut kept = Self { origin: vec![0; 3 * n_kept], twin: vec![BOUNDARY; 3 * n_kept] };
        let mut slots = vec![BOUNDARY; self.n_triangles()];
        for (t, corners) in self.triangles().enumerate() {
            let Some(first) = first(t, corners) else { continue };
            let slot = &mut start[corners[first] as usize];
            for k in 0..3 {
                let h = 3 * t + (first + k) % 3;
                kept.origin[3 * *slot as usize + k] = self.origin[h];
                // For now the triangle across.
                kept.twin[3 * *slot as usize + k] = self.twin[h] / 3;
            }
            slots[t] = *slot;
            *slot += 1;
        }
        // A twin lies in the triangle across, and leaves the vertex at which its half-edge arrives.
        for h in 0..kept.origin.len() {
            let slot = slots.get(kept.twin[h] as usize).copied().unwrap_or(BOUNDARY);
            kept.twin[h] = if slot == BOUNDARY { BOUNDARY } else { kept.leaving(slot, kept.target(h as u32)) };
        }
        kept
    }

    /// Triangles of so many vertices, counter-clockwise, with boundaries where none stands on the other side. Of two on the same side of an edge the second is left out.
    pub fn of_triangles(n_vertices: usize, triangles: impl Iterator<Item = [u32; 3]>) -> Self {
        let mut all = Self::default();
        // The last half-edge that leaves each vertex, and for each the one before it.
        let (mut last, mut before) = (vec![BOUNDARY; n_vertices], Vec::new());
        for corners in triangles {
            let sides = [0, 1, 2].map(|k| [corners[k], corners[(k + 1) % 3]]);
            let find = |all: &Self, [from, to]: [u32; 2]| {
                let is_one = |&h: &u32| h != BOUNDARY;
                let leaving = std::iter::successors(Some(last[from as usize]).filter(is_one), |&h| Some(before[h as usize]).filter(is_one));
                { leaving }.find(|&h| all.target(h) == to)
            };
            if sides.iter().any(|&side| find(&all, side).is_some()) {
                continue;
            }
            let twins = sides.map(|[from, to]| find(&all, [to, from]));
            for ([from, _], twin) in sides.into_iter().zip(twins) {
                let h = all.origin.len() as u32;
                if let Some(twin) = twin {
                    all.twin[twin as usize] = h;
                }
                all.origin.push(from);
                all.twin.push(twin.unwrap_or(BOUNDARY));
                before.push(std::mem::replace(&mut last[from as usize], h));
            }
        }
        all
    }

    /// For each triangle the number of the part in which it lies; parts hang together by edges. They are numbered in the order of their first triangles.
    pub fn components(&self) -> Vec<u32> {
        let mut component = vec![u32::MAX; self.n_triangles()];
        let mut n_found = 0;
        for first in 0..component.len() {
            if component[first] != u32::MAX {
                continue;
            }
            let mut stack = vec![first];
            component[first] = n_found;
            while let Some(t) = stack.pop() {
                for &twin in self.twin[3 * t..3 * t + 3].iter().filter(|&&twin| twin != BOUNDARY) {
                    let across = twin as usize / 3;
                    if component[across] == u32::MAX {
                        component[across] = n_found;
                        stack.push(across);
                    }
                }
            }
            n_found += 1;
        }
        component
    }

    /// Proves that the triangles make a manifold: twins belong together, no half-edge is there twice, and each of so many vertices has one fan.
    pub fn check_manifold(&self, n_vertices: usize) -> Result<(), String> {
        let mut seen = HashSet::new();
        for h in 0..self.origin.len() as u32 {
            let ends = [self.origin[h as usize], self.target(h)];
            if ends[0] == ends[1] || !seen.insert(ends) {
                return Err(format!("half-edge {h} from {} to {} is there twice", ends[0], ends[1]));
            }
            let twin = self.twin[h as usize];
            if twin != BOUNDARY
                && (self.twin.get(twin as usize) != Some(&h) || self.origin[twin as usize] != ends[1] || self.target(twin) != ends[0])
            {
                return Err(format!("half-edges {h} and {twin} are no twins"));
            }
        }
        let mut n_leaving = vec![0; n_vertices];
        self.origin.iter().for_each(|&v| n_leaving[v as usize] += 1);
        let outgoing = self.outgoing(n_vertices);
        match (0..n_vertices).find(|&v| outgoing[v] == BOUNDARY || self.around(outgoing[v]).count() != n_leaving[v]) {
            Some(v) => Err(format!("vertex {v} has no triangles, or more than one fan")),
            None => Ok(()),
        }
    }

    /// The half-edge of triangle `t` that leaves vertex `v`, one of its corners.
    #[inline]
    fn leaving(&self, t: u32, v: u32) -> u32 {
        let [a, b, _] = self.triangle(t as usize);
        3 * t
            + if v == a {
                0
            } else if v == b {
                1
            } else {
                2
            }
    }
}

/// The position of the smallest of a triangle's vertices.
pub(crate) fn smallest([a, b, c]: [u32; 3]) -> usize {
    if a < b && a < c {
        0
    } else if b < c {
        1
    } else {
        2
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A square 0 1 2 3 cut along 0-2.
    fn square() -> HalfEdges {
        HalfEdges { origin: vec![0, 1, 2, 0, 2, 3], twin: vec![BOUNDARY, BOUNDARY, 3, 2, BOUNDARY, BOUNDARY] }
    }

    #[test]
    fn walking_around_a_boundary_vertex_meets_every_triangle_once() {
        let mesh = square();
        assert_eq!(mesh.around(3).collect::<Vec<_>>(), [0, 3]);
        assert_eq!(mesh.around(1).collect::<Vec<_>>(), [1]);
        assert_eq!(mesh.outgoing(5), [0, 1, 4, 5, BOUNDARY]);
    }

    #[test]
    fn filtering_orders_triangles_and_opens_boundaries() {
        let mesh = square();
        let all = mesh.filtered(|_, t| Some(smallest(t)));
        assert_eq!(all.twin.iter().filter(|&&t| t != BOUNDARY).count(), 2);
        let one = mesh.filtered(|_, t| t.contains(&3).then_some(0));
        assert_eq!(one, HalfEdges { origin: vec![0, 2, 3], twin: vec![BOUNDARY; 3] });
    }
}
