//! A fixed division of a triangulation into chunks, so that threads can share the work and the result not depend on them.
//!
//! A chunk is a range of vertices and the range of triangles whose smallest vertex was among them when it was made. Both are
//! neighbours in the plane, since vertices stand in Hilbert order. How many chunks there are depends on the mesh alone.

use std::ops::Range;

use super::half_edges::HalfEdges;
use super::patch::Patch;

/// Vertices in a chunk: its positions, triangles and sums fit a core's own cache together.
const CHUNK: usize = 1 << 14;

#[derive(Debug, Clone)]
pub(crate) struct Chunks {
    vertices: Vec<Range<usize>>,
    triangles: Vec<Range<usize>>,
}

impl Chunks {
    /// Divides a mesh whose triangles are ordered by their smallest vertex.
    pub fn new(half_edges: &HalfEdges, n_vertices: usize) -> Self {
        let mut chunks = Self { vertices: Vec::new(), triangles: Vec::new() };
        let mut first = 0;
        for start in (0..n_vertices).step_by(CHUNK) {
            let end = (start + CHUNK).min(n_vertices);
            let mine = half_edges.origin[3 * first..].chunks_exact(3).take_while(|t| t.iter().any(|&v| (v as usize) < end));
            let last = first + mine.count();
            chunks.vertices.push(start..end);
            chunks.triangles.push(first..last);
            first = last;
        }
        chunks
    }

    pub fn n_chunks(&self) -> usize {
        self.vertices.len()
    }

    pub fn vertices(&self) -> &[Range<usize>] {
        &self.vertices
    }

    pub fn triangles(&self) -> &[Range<usize>] {
        &self.triangles
    }

    /// Cuts a slice that holds an item a vertex.
    pub fn split_vertices<'a, T>(&self, slice: &'a mut [T]) -> Vec<&'a mut [T]> {
        split(slice, &self.vertices, 1)
    }

    /// Cuts a slice that holds an item a triangle.
    pub fn split_triangles<'a, T>(&self, slice: &'a mut [T]) -> Vec<&'a mut [T]> {
        split(slice, &self.triangles, 1)
    }

    /// Cuts a mesh.
    pub fn patches<'a>(&self, mesh: &'a mut HalfEdges) -> Vec<Patch<'a>> {
        let origins = split(&mut mesh.origin, &self.triangles, 3);
        let twins = split(&mut mesh.twin, &self.triangles, 3);
        let starts = self.triangles.iter().map(|range| 3 * range.start as u32);
        starts.zip(origins).zip(twins).map(|((first, origin), twin)| Patch { first, origin, twin }).collect()
    }
}

fn split<'a, T>(mut slice: &'a mut [T], ranges: &[Range<usize>], each: usize) -> Vec<&'a mut [T]> {
    let mut parts = Vec::with_capacity(ranges.len());
    for range in ranges {
        let (part, rest) = slice.split_at_mut(each * range.len());
        parts.push(part);
        slice = rest;
    }
    parts
}
