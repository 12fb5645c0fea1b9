//! Gmsh 4.1, as text.

use std::fmt::Write as _;

use super::cells::Cells;
use super::plain::{push_position, push_row};

/// The physical groups: the inside, the border, the lines.
const GROUPS: [(usize, usize, &str); 3] = [(2, 1, "domain"), (1, 1, "border"), (1, 2, "lines")];

/// Nodes that no element needs do not exist here, so one surface entity holds them all; each segment of the border, and each line, is a curve entity of its own.
pub(super) fn msh(cells: &Cells, recipe: &str) -> String {
    let n_segments = cells.n_segments;
    let mut curves: Vec<(usize, Vec<[usize; 2]>)> = Vec::new();
    let mut edges = cells.edges.clone();
    edges.sort_by_key(|&(tag, _)| tag);
    for (tag, ends) in edges {
        match curves.last_mut() {
            Some((last, all)) if *last == tag => all.push(ends),
            _ => curves.push((tag, vec![ends])),
        }
    }
    let groups = if curves.is_empty() { &GROUPS[..1] } else { &GROUPS[..] };
    let mut text = format!("$Comments\n{recipe}\n$EndComments\n$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n{}\n", groups.len());
    for (dimension, number, name) in groups {
        let _ = writeln!(text, "{dimension} {number} \"{name}\"");
    }
    text.push_str("$EndPhysicalNames\n");
    let _ = writeln!(text, "$Entities\n0 {} 1 0", curves.len());
    for (tag, edges) in &curves {
        let group = if *tag > n_segments { 2 } else { 1 };
        let _ = writeln!(text, "{tag} {} 1 {group} 0", bounds(cells, &mut edges.iter().flatten().copied()));
    }
    let border: Vec<String> = curves.iter().filter(|(tag, _)| *tag <= n_segments).map(|(tag, _)| tag.to_string()).collect();
    let n = cells.vertices.len();
    let _ = writeln!(text, "1 {} 1 1 {} {}\n$EndEntities", bounds(cells, &mut (0..n)), border.len(), border.join(" "));
    let _ = writeln!(text, "$Nodes\n1 {n} 1 {n}\n2 1 0 {n}");
    (1..=n).for_each(|v| push_row(&mut text, "", [v]));
    for &position in &*cells.vertices {
        push_position(&mut text, "", position);
    }
    let n_elements = cells.edges.len() + cells.triangles.len();
    let _ = writeln!(text, "$EndNodes\n$Elements\n{} {n_elements} 1 {n_elements}", curves.len() + 1);
    let mut number = 0;
    for (tag, edges) in &curves {
        let _ = writeln!(text, "1 {tag} 1 {}", edges.len());
        for [a, b] in edges {
            number += 1;
            push_row(&mut text, "", [number, a + 1, b + 1]);
        }
    }
    let _ = writeln!(text, "2 1 2 {}", cells.triangles.len());
    for [a, b, c] in cells.triangles {
        number += 1;
        push_row(&mut text, "", [number, a + 1, b + 1, c + 1]);
    }
    text.push_str("$EndElements\n");
    text
}

/// The box around some vertices.
fn bounds(cells: &Cells, some: &mut dyn Iterator<Item = usize>) -> String {
    let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    for v in some {
        for axis in 0..3 {
            (low[axis], high[axis]) = (low[axis].min(cells.vertices[v][axis]), high[axis].max(cells.vertices[v][axis]));
        }
    }
    format!("{} {} {} {} {} {}", low[0], low[1], low[2], high[0], high[1], high[2])
}
