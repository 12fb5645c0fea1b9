//! Numpy arrays in one archive.

use std::io::{Cursor, Write as _};

use npyz::{AutoSerialize, WriterBuilder as _};
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

use super::cells::Cells;

/// Vertices (n, 2) or (n, 3), triangles (m, 3), edges (k, 2) and their tags (k) where there are any, the region of each triangle (m), -1 for none, and an array for each attribute (n).
pub(super) fn npz<const N: usize>(vertices: &[[f64; N]], cells: &Cells) -> std::io::Result<Vec<u8>> {
    let mut archive = Archive(ZipWriter::new(Cursor::new(Vec::new())));
    let number = |number: usize| number as i64;
    archive.add("vertices", &[vertices.len(), N], vertices.iter().flatten().copied())?;
    archive.add("triangles", &[cells.triangles.len(), 3], cells.triangles.iter().flatten().copied().map(number))?;
    if !cells.regions.is_empty() {
        archive.add("regions", &[cells.regions.len()], cells.regions.iter().map(|&region| i64::from(region as i32)))?;
    }
    if !cells.edges.is_empty() {
        let n = cells.edges.len();
        archive.add("edges", &[n, 2], cells.edges.iter().flat_map(|&(_, ends)| ends).map(number))?;
        archive.add("edge_tags", &[n], cells.edges.iter().map(|&(tag, _)| number(tag)))?;
    }
    for (name, values) in &cells.attributes {
        archive.add(name, &[values.len()], values.iter().copied())?;
    }
    Ok(archive.0.finish()?.into_inner())
}

/// An archive that is written; the same arrays give the same bytes.
struct Archive(ZipWriter<Cursor<Vec<u8>>>);

impl Archive {
    fn add<T: AutoSerialize>(&mut self, name: &str, shape: &[usize], numbers: impl Iterator<Item = T>) -> std::io::Result<()> {
        let shape: Vec<u64> = shape.iter().map(|&n| n as u64).collect();
        let mut bytes = Vec::new();
        let mut array = npyz::WriteOptions::new().default_dtype().shape(&shape).writer(&mut bytes).begin_nd()?;
        array.extend(numbers)?;
        array.finish()?;
        let is_large = bytes.len() as u64 >= u64::from(u32::MAX);
        let options = SimpleFileOptions::default().compression_method(CompressionMethod::Deflated).large_file(is_large);
        self.0.start_file(format!("{name}.npy"), options)?;
        self.0.write_all(&bytes)
    }
}
