//! VTK's unstructured grid: points, triangles, quadrangles and polygons, as text or as base64 in place.

use std::io::Read as _;

use base64::Engine as _;
use base64::prelude::BASE64_STANDARD;
use flate2::read::ZlibDecoder;
use roxmltree::{Document, Node};

use super::TrianglesRead;
use super::building::Building;
use crate::Error;
use crate::memory::memory_limit;

/// Kinds of cells with triangles: triangle, polygon, quadrangle. Vertices and lines bound what is read.
const FACES: [u8; 3] = [5, 7, 9];
const BOUNDS: [u8; 4] = [1, 2, 3, 4];

pub(super) fn read(name: &str, bytes: &[u8]) -> Result<TrianglesRead, Error> {
    let wrong = |problem: String| Error::content(name, problem);
    let text = std::str::from_utf8(bytes)
        .map_err(|_| wrong("it has data appended in binary; save it as text, or with the data in place".into()))?;
    let document = Document::parse(text).map_err(|e| wrong(format!("this is no XML: {e}")))?;
    let file = Arrays::of(document.root_element()).map_err(wrong)?;
    let mut building = Building::default();
    let mut n_others = 0;
    for piece in document.descendants().filter(|node| node.has_tag_name("Piece")) {
        let first = building.mesh.vertices.len();
        let child = |name: &str| piece.children().find(|node| node.has_tag_name(name));
        let points = child("Points").and_then(|points| points.children().find(|node| node.has_tag_name("DataArray")));
        let points = file.numbers(points.ok_or_else(|| wrong("a piece has no points".into()))?).map_err(wrong)?;
        for (k, position) in points.as_chunks::<3>().0.iter().enumerate() {
            building.push_vertex(*position, || format!("point {k}"));
        }
        let cells = child("Cells").ok_or_else(|| wrong("a piece has no cells".into()))?;
        let array = |name: &str| {
            let node = cells.children().find(|node| node.attribute("Name") == Some(name));
            file.numbers(node.ok_or_else(|| format!("a piece has no {name}"))?)
        };
        let [corners, ends, kinds] = [array("connectivity"), array("offsets"), array("types")];
        let (corners, ends, kinds) = (corners.map_err(wrong)?, ends.map_err(wrong)?, kinds.map_err(wrong)?);
        let mut begin = 0;
        for (k, (&end, &kind)) in ends.iter().zip(&kinds).enumerate() {
            let (end, kind) = (end as usize, kind as u8);
            let cell = corners.get(begin..end).ok_or_else(|| wrong(format!("cell {k} reaches beyond its corners")))?;
            begin = end;
            if FACES.contains(&kind) {
                let face: Vec<usize> = cell.iter().map(|&corner| first.saturating_add(corner.max(0.0) as usize)).collect();
                building.push_face(&face, k).map_err(|problem| wrong(format!("cell {k}: {problem}")))?;
            } else if !BOUNDS.contains(&kind) {
                n_others += 1;
            }
        }
    }
    if n_others > 0 {
        building.notes.push(format!("{n_others} cells of three dimensions or of higher order were left out"));
    }
    building.finish(name, |number| format!("{name}: cell {number}"))
}

/// How a file's arrays are written.
struct Arrays {
    is_large_header: bool,
    is_compressed: bool,
}

impl Arrays {
    fn of(root: Node) -> Result<Self, String> {
        if root.attribute("type") != Some("UnstructuredGrid") {
            return Err(format!("it is a {:?} of VTK, expected UnstructuredGrid", root.attribute("type").unwrap_or_default()));
        }
        if root.attribute("byte_order").is_some_and(|order| order != "LittleEndian") {
            return Err("its bytes are in another order than usual; save it as text".into());
        }
        let is_compressed = match root.attribute("compressor") {
            None => false,
            Some("vtkZLibDataCompressor") => true,
            Some(other) => return Err(format!("its data are compressed by {other}; save it as text or with zlib")),
        };
        Ok(Self { is_large_header: root.attribute("header_type") == Some("UInt64"), is_compressed })
    }

    /// The numbers of an array.
    fn numbers(&self, array: Node) -> Result<Vec<f64>, String> {
        let text = array.text().unwrap_or_default();
        match array.attribute("format") {
            Some("ascii") => text.split_whitespace().map(|word| word.parse().map_err(|_| format!("{word:?} is no number"))).collect(),
            Some("binary") => {
                let bytes = self.bytes(text)?;
                numbers_of(&bytes, array.attribute("type").unwrap_or_default())
            }
            other => Err(format!("its data are {:?}; save it as text, or with the data in place", other.unwrap_or("without a format"))),
        }
    }

    /// The bytes of an array in base64, after a header that tells how many there are.
    fn bytes(&self, text: &str) -> Result<Vec<u8>, String> {
        let text: String = text.split_whitespace().collect();
        let size = if self.is_large_header { 8 } else { 4 };
        let decode = |text: &str| BASE64_STANDARD.decode(text).map_err(|e| format!("its data are no base64: {e}"));
        let word = |bytes: &[u8]| bytes.iter().rev().fold(0_usize, |all, &byte| all << 8 | usize::from(byte));
        if !self.is_compressed {
            let whole = decode(&text)?;
            return whole.get(size..).map(<[u8]>::to_vec).ok_or_else(|| "its data are cut short".into());
        }
        // A header by itself: the number of blocks, their size, that of the last, and how long each is compressed.
        let coded = |n: usize| n.div_ceil(3) * 4;
        let begin = decode(text.get(..coded(size)).unwrap_or_default())?;
        let n_blocks = word(begin.get(..size).unwrap_or_default());
        let length =
            coded(n_blocks.checked_add(3).and_then(|n| n.checked_mul(size)).filter(|&n| n <= text.len()).ok_or("its data are cut short")?);
        let header = decode(text.get(..length).ok_or("its data are cut short")?)?;
        let data = decode(&text[length..])?;
        let mut bytes = Vec::new();
        let mut at = 0_usize;
        for k in 0..n_blocks {
            let n = word(header.get((3 + k) * size..(4 + k) * size).ok_or("its data are cut short")?);
            let block = data.get(at..at.saturating_add(n)).ok_or("its data are cut short")?;
            at += n;
            let most = (memory_limit() / 4).saturating_sub(bytes.len() as u64);
            ZlibDecoder::new(block).take(most).read_to_end(&mut bytes).map_err(|e| format!("its data cannot be unpacked: {e}"))?;
        }
        Ok(bytes)
    }
}

/// Numbers of a type of VTK, the lowest byte first.
fn numbers_of(bytes: &[u8], kind: &str) -> Result<Vec<f64>, String> {
    fn of<const N: usize>(bytes: &[u8], number: fn([u8; N]) -> f64) -> Vec<f64> {
        bytes.as_chunks::<N>().0.iter().map(|&chunk| number(chunk)).collect()
    }
    Ok(match kind {
        "Float64" => of(bytes, f64::from_le_bytes),
        "Float32" => of(bytes, |chunk| f64::from(f32::from_le_bytes(chunk))),
        "Int64" => of(bytes, |chunk| i64::from_le_bytes(chunk) as f64),
        "UInt64" => of(bytes, |chunk| u64::from_le_bytes(chunk) as f64),
        "Int32" => of(bytes, |chunk| f64::from(i32::from_le_bytes(chunk))),
        "UInt32" => of(bytes, |chunk| f64::from(u32::from_le_bytes(chunk))),
        "UInt8" | "Int8" => bytes.iter().map(|&byte| f64::from(byte)).collect(),
        other => return Err(format!("its data are of type {other:?}, which is not read")),
    })
}
