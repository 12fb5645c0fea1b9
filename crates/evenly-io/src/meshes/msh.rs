//! Gmsh 4.1, as text.

use std::collections::{BTreeMap, HashMap};
use std::fmt::Write as _;

use super::cells::Cells;
use super::plain::{push_position, push_row};

/// The physical groups: the inside, the boundary, the lines. Regions have the numbers after them, of their
/// triangles and of the edges around them.
const GROUPS: [(usize, usize, &str); 3] = [(2, 1, "domain"), (1, 1, "boundary"), (1, 2, "lines")];
const FIRST_REGION: usize = 3;

/// An entity: what it is made of, and its physical groups.
struct Entity<const N: usize> {
    elements: Vec<[usize; N]>,
    groups: Vec<usize>,
}

/// Nodes that no element needs do not exist here, so the first surface entity holds them all. Each segment of
/// the boundary, and each line, is a curve entity of its own, between two regions as many as there are pairs;
/// each region is a surface.
pub(super) fn msh(cells: &Cells, recipe: &str) -> String {
    let surfaces = surfaces(cells);
    let curves = curves(cells);
    let mut groups: Vec<(usize, usize, String)> =
        GROUPS.iter().map(|&(dimension, number, name)| (dimension, number, name.into())).collect();
    groups.truncate(if curves.is_empty() { 1 } else { GROUPS.len() });
    for (number, name) in (FIRST_REGION..).zip(cells.region_names) {
        let name = name.replace(['"', '\n', '\r'], " ");
        groups.extend([(2, number, name.clone()), (1, number, format!("around {name}"))]);
    }
    let mut text = format!("$Comments\n{recipe}\n$EndComments\n$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n{}\n", groups.len());
    for (dimension, number, name) in groups {
        let _ = writeln!(text, "{dimension} {number} \"{name}\"");
    }
    text.push_str("$EndPhysicalNames\n");
    let _ = writeln!(text, "$Entities\n0 {} {} 0", curves.len(), surfaces.len());
    for (tag, Entity { elements, groups }) in (1..).zip(&curves) {
        let _ = writeln!(text, "{tag} {} {} 0", bounds(cells, &mut elements.iter().flatten().copied()), listed(groups));
    }
    let boundary: Vec<usize> = (1..).zip(&curves).filter(|(_, curve)| curve.groups.contains(&1)).map(|(tag, _)| tag).collect();
    let n = cells.vertices.len();
    for (tag, Entity { elements, groups }) in (1..).zip(&surfaces) {
        let (around, bounding) = if tag == 1 {
            (bounds(cells, &mut (0..n)), &boundary[..])
        } else {
            (bounds(cells, &mut elements.iter().flatten().copied()), &[][..])
        };
        let _ = writeln!(text, "{tag} {around} {} {}", listed(groups), listed(bounding));
    }
    let _ = writeln!(text, "$EndEntities\n$Nodes\n1 {n} 1 {n}\n2 1 0 {n}");
    (1..=n).for_each(|v| push_row(&mut text, "", [v]));
    for &position in &*cells.vertices {
        push_position(&mut text, "", position);
    }
    let n_elements = cells.edges.len() + cells.triangles.len();
    let _ = writeln!(text, "$EndNodes\n$Elements\n{} {n_elements} 1 {n_elements}", curves.len() + surfaces.len());
    let mut number = 0;
    for (tag, Entity { elements, .. }) in (1..).zip(&curves) {
        let _ = writeln!(text, "1 {tag} 1 {}", elements.len());
        for [a, b] in elements {
            number += 1;
            push_row(&mut text, "", [number, a + 1, b + 1]);
        }
    }
    for (tag, Entity { elements, .. }) in (1..).zip(&surfaces) {
        let _ = writeln!(text, "2 {tag} 2 {}", elements.len());
        for [a, b, c] in elements {
            number += 1;
            push_row(&mut text, "", [number, a + 1, b + 1, c + 1]);
        }
    }
    text.push_str("$EndElements\n");
    text
}

/// The triangles by region: all in one where there are none.
fn surfaces(cells: &Cells) -> Vec<Entity<3>> {
    let mut surfaces: BTreeMap<u32, Vec<[usize; 3]>> = BTreeMap::new();
    for (t, &triangle) in cells.triangles.iter().enumerate() {
        surfaces.entry(cells.regions.get(t).copied().unwrap_or(u32::MAX)).or_default().push(triangle);
    }
    let groups = |region: u32| [1].into_iter().chain((region != u32::MAX).then_some(FIRST_REGION + region as usize)).collect();
    surfaces.into_iter().map(|(region, elements)| Entity { elements, groups: groups(region) }).collect()
}

/// The edges by tag, and by the regions beside them.
fn curves(cells: &Cells) -> Vec<Entity<2>> {
    let sorted = |[a, b]: [usize; 2]| [a.min(b), a.max(b)];
    let mut beside: HashMap<[usize; 2], Vec<u32>> = HashMap::new();
    for (corners, &region) in cells.triangles.iter().zip(cells.regions).filter(|&(_, &region)| region != u32::MAX) {
        for k in 0..3 {
            beside.entry(sorted([corners[k], corners[(k + 1) % 3]])).or_default().push(region);
        }
    }
    let mut curves: BTreeMap<(usize, Vec<u32>), Vec<[usize; 2]>> = BTreeMap::new();
    for &(tag, ends) in &cells.edges {
        let mut regions = beside.get(&sorted(ends)).cloned().unwrap_or_default();
        regions.sort_unstable();
        // A line inside of a region is not around it.
        if let [one, other] = regions[..]
            && one == other
        {
            regions.clear();
        }
        curves.entry((tag, regions)).or_default().push(ends);
    }
    let entity = |((tag, regions), elements): ((usize, Vec<u32>), Vec<[usize; 2]>)| {
        let own = match () {
            () if tag <= cells.n_segments => Some(1),
            () if tag < cells.between => Some(2),
            () => None,
        };
        let groups = own.into_iter().chain(regions.iter().map(|&region| FIRST_REGION + region as usize)).collect();
        Entity { elements, groups }
    };
    curves.into_iter().map(entity).collect()
}

/// How many numbers, and the numbers.
fn listed(numbers: &[usize]) -> String {
    let all: Vec<String> = std::iter::once(numbers.len()).chain(numbers.iter().copied()).map(|number| number.to_string()).collect();
    all.join(" ")
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
