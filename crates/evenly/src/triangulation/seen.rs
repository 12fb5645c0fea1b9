//! The triangles of a bounded domain: the dual of its Voronoi diagram, clipped.

use super::half_edges::{HalfEdges, smallest};
use super::live::LiveMesh;
use super::mesh::Triangulation;
use super::spoke::MIRROR;
use super::stars::StarBuffer;
use crate::error::Error;
use crate::star::Senses;

/// The triangles whose circumcentre lies inside; in a polygon of points that see each other, whoever stands behind a boundary. All of them on a torus.
///
/// # Errors
/// [`Error::Degenerate`] where the points cannot be triangulated.
pub(crate) fn clipped(triangulation: &Triangulation) -> Result<HalfEdges, Error> {
    let Triangulation { half_edges, positions, domain, .. } = triangulation;
    if domain.is_periodic {
        return Ok(half_edges.filtered(|_, corners| Some(smallest(corners))));
    }
    if domain.boundary.is_none() {
        return Ok(half_edges.filtered(|_, corners| triangulation.has_centre_inside(corners).then_some(smallest(corners))));
    }
    let n_points = positions.len();
    let order = (0..n_points as u32).collect();
    triangles_seen(&mut LiveMesh::new(domain, None, positions.clone(), order, domain.hex_spacing(n_points))?)
}

/// The triangles of points in a polygon on which all three corners agree.
///
/// # Errors
/// [`Error::Degenerate`] where the points cannot be triangulated.
pub(crate) fn triangles_seen(mesh: &mut LiveMesh) -> Result<HalfEdges, Error> {
    let (domain, n_points) = (mesh.domain().clone(), mesh.n_points());
    let stars = mesh.look(Senses::default(), |mesh, v, StarBuffer { star, spokes, .. }| {
        let pairs = (0..spokes.len()).map(|k| (k, [spokes[k].vertex, spokes[star.after(k)].vertex]));
        let seen = pairs.filter(|&(k, [a, b])| {
            let [along_a, along_b] = star.centre(k);
            let centre = along_a * spokes[k].way + along_b * spokes[star.after(k)].way;
            a != MIRROR && b != MIRROR && domain.contains(mesh.position(v) + centre) && domain.sees(mesh.position(a), mesh.position(b))
        });
        seen.map(|(_, [a, b])| [v, a, b]).collect::<Vec<[u32; 3]>>()
    })?;
    // What all three corners see.
    let turned = |corners: [u32; 3]| {
        let first = smallest(corners);
        [0, 1, 2].map(|k| corners[(first + k) % 3])
    };
    let mut triangles: Vec<[u32; 3]> = stars.into_iter().flatten().map(turned).collect();
    triangles.sort_unstable();
    let agreed = triangles.chunk_by(|a, b| a == b).filter(|same| same.len() == 3).map(|same| same[0]);
    Ok(HalfEdges::of_triangles(n_points, agreed))
}
