//! Numpy arrays in one archive.

use std::io::Write as _;

use npyz::WriterBuilder as _;

use super::cells::Cells;

/// Vertices (n, 2) or (n, 3), triangles (m, 3), edges (k, 2) and their tags (k) where there are any, the region of each triangle (m), -1 for none, and an array for each attribute (n).
pub(super) fn npz<const N: usize>(vertices: &[[f64; N]], cells: &Cells) -> std::io::Result<Vec<u8>> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    let mut archive = npyz::npz::NpzWriter::new(&mut bytes);
    let numbers = |all: &mut dyn Iterator<Item = usize>| all.map(|number| number as i64).collect::<Vec<i64>>();
    let n_edges = cells.edges.len() as u64;
    let mut whole = vec![("triangles", vec![cells.triangles.len() as u64, 3], numbers(&mut cells.triangles.iter().flatten().copied()))];
    if !cells.regions.is_empty() {
        whole.push(("regions", vec![cells.regions.len() as u64], cells.regions.iter().map(|&region| i64::from(region as i32)).collect()));
    }
    if n_edges > 0 {
        whole.push(("edges", vec![n_edges, 2], numbers(&mut cells.edges.iter().flat_map(|&(_, ends)| ends))));
        whole.push(("edge_tags", vec![n_edges], numbers(&mut cells.edges.iter().map(|&(tag, _)| tag))));
    }
    {
        let shape = [vertices.len() as u64, N as u64];
        let mut array = archive.array("vertices", Default::default())?.default_dtype().shape(&shape).begin_nd()?;
        array.extend(vertices.iter().flatten())?;
        array.finish()?;
    }
    for (name, shape, numbers) in whole {
        let mut array = archive.array(name, Default::default())?.default_dtype().shape(&shape).begin_nd()?;
        array.extend(numbers)?;
        array.finish()?;
    }
    for (name, values) in &cells.attributes {
        let mut array = archive.array(name, Default::default())?.default_dtype().shape(&[values.len() as u64]).begin_nd()?;
        array.extend(values.iter())?;
        array.finish()?;
    }
    drop(archive);
    bytes.flush()?;
    Ok(bytes.into_inner())
}
