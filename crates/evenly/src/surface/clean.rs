//! What is done to triangles before anything is asked of them: positions welded, and faces dropped that are none.

use std::collections::{HashMap, HashSet};

use glam::DVec3;

use super::triangle_mesh::TriangleMesh;
use crate::error::Error;

/// Triangles between distinct positions, none twice.
pub(super) struct Clean {
    /// For each vertex the given one.
    pub sources: Vec<usize>,
    pub triangles: Vec<[u32; 3]>,
    /// For each triangle the given one.
    pub faces: Vec<usize>,
    pub notes: Vec<String>,
}

/// Welds equal places, and drops triangles that have two corners in one place or are there twice.
///
/// # Errors
/// [`Error::InvalidMesh`] for corners that do not exist, and where no triangle is left.
pub(super) fn clean(mesh: &TriangleMesh, places: &[DVec3]) -> Result<Clean, Error> {
    let n = mesh.vertices.len();
    if n >= u32::MAX as usize / 8 || mesh.triangles.len() >= u32::MAX as usize / 8 {
        return Err(Error::InvalidMesh(format!("{n} vertices and {} triangles are too many", mesh.triangles.len())));
    }
    if let Some(attribute) = mesh.attributes.iter().find(|attribute| attribute.values.len() != n) {
        let text = format!("the attribute {:?} has {} values for {n} vertices", attribute.name, attribute.values.len());
        return Err(Error::InvalidMesh(text));
    }
    if let Some((t, corners)) = mesh.triangles.iter().enumerate().find(|(_, corners)| corners.iter().any(|&v| v >= n)) {
        return Err(Error::InvalidMesh(format!("triangle {t} has the corners {corners:?}, but there are only {n} vertices")));
    }
    let mut first_at: HashMap<[u64; 3], usize> = HashMap::with_capacity(n);
    // Adding 0 makes one zero of both.
    let bits = |p: &DVec3| p.to_array().map(|x| (x + 0.0).to_bits());
    let welded: Vec<usize> = places.iter().enumerate().map(|(v, p)| *first_at.entry(bits(p)).or_insert(v)).collect();
    let n_welded = n - first_at.len();

    let mut vertex_of = vec![u32::MAX; n];
    let (mut sources, mut triangles, mut faces) = (Vec::new(), Vec::new(), Vec::new());
    let mut seen = HashSet::with_capacity(mesh.triangles.len());
    let (mut n_collapsed, mut n_double) = (0, 0);
    for (t, corners) in mesh.triangles.iter().enumerate() {
        let corners = corners.map(|v| welded[v]);
        let mut sorted = corners;
        sorted.sort_unstable();
        if sorted[0] == sorted[1] || sorted[1] == sorted[2] {
            n_collapsed += 1;
            continue;
        }
        if !seen.insert(sorted) {
            n_double += 1;
            continue;
        }
        triangles.push(corners.map(|v| {
            if vertex_of[v] == u32::MAX {
                vertex_of[v] = sources.len() as u32;
                sources.push(v);
            }
            vertex_of[v]
        }));
        faces.push(t);
    }
    if triangles.is_empty() {
        return Err(Error::InvalidMesh("the mesh has no triangle with three different corners".into()));
    }
    let n_unused = first_at.len() - sources.len();
    let notes = [
        (n_welded, "vertices at the place of another were welded to it"),
        (n_collapsed, "triangles with two corners in one place were dropped"),
        (n_double, "triangles with the same corners as another were dropped"),
        (n_unused, "vertices without a triangle were dropped"),
    ];
    let notes = notes.into_iter().filter(|&(n, _)| n > 0).map(|(n, what)| format!("{n} {what}")).collect();
    Ok(Clean { sources, triangles, faces, notes })
}
