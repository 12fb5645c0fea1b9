//! What files of meshes hold, flat or in space.

use std::borrow::Cow;

use evenly::{Attribute, EdgeKind, Mesh, TriangleMesh};

/// Names that an attribute may not take, since files have them already.
const TAKEN: [&str; 8] = ["x", "y", "z", "vertices", "triangles", "edges", "edge_tags", "regions"];

/// Vertices, triangles, edges, and what vertices carry along.
pub(crate) struct Cells<'a> {
    pub vertices: Cow<'a, [[f64; 3]]>,
    pub triangles: &'a [[usize; 3]],
    /// Edges of the boundary, of lines and between regions, after their tags: of the boundary 1 and up, of lines
    /// after that, and one for all between regions.
    pub edges: Vec<(usize, [usize; 2])>,
    /// The last tag of the boundary, and that of edges between regions.
    pub n_segments: usize,
    pub between: usize,
    /// The region of each triangle, where there are any, and their names.
    pub regions: &'a [u32],
    pub region_names: &'a [String],
    /// Names that every format can take, and a value a vertex.
    pub attributes: Vec<(String, &'a [f64])>,
}

impl<'a> From<&'a Mesh> for Cells<'a> {
    fn from(mesh: &'a Mesh) -> Self {
        let segments = mesh.edges.iter().filter_map(|edge| match edge.kind {
            EdgeKind::Boundary { segment } => Some(segment + 1),
            EdgeKind::Line { .. } | EdgeKind::Between => None,
        });
        let lines = mesh.edges.iter().filter_map(|edge| if let EdgeKind::Line { line } = edge.kind { Some(line + 1) } else { None });
        let n_lines = lines.max().unwrap_or(0);
        let n_segments = segments.max().unwrap_or(0);
        let between = n_segments + n_lines + 1;
        let tag = |kind| match kind {
            EdgeKind::Boundary { segment } => segment + 1,
            EdgeKind::Line { line } => n_segments + line + 1,
            EdgeKind::Between => between,
        };
        Self {
            vertices: mesh.vertices.iter().map(|&[x, y]| [x, y, 0.0]).collect(),
            triangles: &mesh.triangles,
            edges: mesh.edges.iter().map(|edge| (tag(edge.kind), edge.ends)).collect(),
            n_segments,
            between,
            regions: &mesh.regions,
            region_names: &mesh.region_names,
            attributes: if mesh.sizes.is_empty() { Vec::new() } else { vec![("edge_length".into(), &mesh.sizes[..])] },
        }
    }
}

impl<'a> From<&'a TriangleMesh> for Cells<'a> {
    fn from(mesh: &'a TriangleMesh) -> Self {
        Self {
            vertices: Cow::Borrowed(&mesh.vertices),
            triangles: &mesh.triangles,
            edges: Vec::new(),
            n_segments: 0,
            between: 1,
            regions: &[],
            region_names: &[],
            attributes: named(&mesh.attributes),
        }
    }
}

/// Attributes under names without blanks and signs, each another.
fn named(attributes: &[Attribute]) -> Vec<(String, &[f64])> {
    let mut all: Vec<(String, &[f64])> = Vec::new();
    for attribute in attributes {
        let is_plain = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
        let plain: String = attribute.name.chars().map(|c| if is_plain(c) { c } else { '_' }).collect();
        let plain = if plain.is_empty() { "attribute".into() } else { plain };
        let is_taken = |name: &str| TAKEN.contains(&name) || all.iter().any(|(other, _)| other == name);
        let mut name = plain.clone();
        let mut number = 2;
        while is_taken(&name) {
            name = format!("{plain}_{number}");
            number += 1;
        }
        all.push((name, &attribute.values));
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_plain_and_differ() {
        let attributes = ["a b", "a b", "x", "", "a_b"].map(|name| Attribute { name: name.into(), values: Vec::new() });
        let names: Vec<String> = named(&attributes).into_iter().map(|(name, _)| name).collect();
        assert_eq!(names, ["a_b", "a_b_2", "x_2", "attribute", "a_b_3"]);
    }
}
