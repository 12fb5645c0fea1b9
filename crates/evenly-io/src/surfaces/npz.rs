//! Numpy's archive as it is written here: `vertices` (n, 2) or (n, 3), and `triangles` (m, 3).

use std::io::{Cursor, Read as _};

use zip::ZipArchive;

use super::TrianglesRead;
use super::building::Building;
use crate::memory::memory_limit;
use crate::{Error, npy};

pub(super) fn read(name: &str, bytes: &[u8]) -> Result<TrianglesRead, Error> {
    let mut archive = ZipArchive::new(Cursor::new(bytes)).map_err(|e| Error::content(name, format!("this is no .npz file: {e}")))?;
    let mut array = |array: &str| {
        let wrong = |problem: String| Error::content(name, format!("{array}: {problem}"));
        let entry = archive.by_name(&format!("{array}.npy")).map_err(|_| wrong("there is no such array in it".into()))?;
        let mut bytes = Vec::new();
        entry.take(memory_limit() / 4).read_to_end(&mut bytes).map_err(|e| wrong(e.to_string()))?;
        npy::read_table(&format!("{name}: {array}"), &bytes)
    };
    let ([_, columns], vertices) = array("vertices")?;
    let ([_, sides], triangles) = array("triangles")?;
    if !(2..=3).contains(&columns) || sides != 3 {
        return Err(Error::content(name, format!("its vertices have {columns} columns and its triangles {sides}, expected 2 or 3, and 3")));
    }
    let mut building = Building::default();
    for (k, position) in vertices.chunks_exact(columns).enumerate() {
        building.push_vertex([position[0], position[1], position.get(2).copied().unwrap_or(0.0)], || format!("vertex {k}"));
    }
    for (k, corners) in triangles.as_chunks::<3>().0.iter().enumerate() {
        if let Some(corner) = corners.iter().find(|&&corner| !(corner >= 0.0 && corner.fract() == 0.0)) {
            return Err(Error::content(name, format!("triangle {k} has the vertex {corner}")));
        }
        let face = corners.map(|corner| corner as usize);
        building.push_face(&face, k).map_err(|problem| Error::content(name, format!("triangle {k}: {problem}")))?;
    }
    building.finish(name, |number| format!("{name}: triangle {number}"))
}
