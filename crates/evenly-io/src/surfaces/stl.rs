//! Stereolithography, binary and as text. It has no vertices of its own: corners at the same place become one.

use std::collections::HashMap;

use super::TrianglesRead;
use super::building::Building;
use super::lines::Text;
use crate::Error;

/// The bytes before the triangles, the last four of which count them, and those of a triangle.
const HEAD: usize = 84;
const EACH: usize = 50;

/// Whether the count of triangles fits the file's length.
pub(super) fn is_binary(bytes: &[u8]) -> bool {
    promised(bytes).is_some_and(|n| n > 0 && n.checked_mul(EACH).and_then(|all| all.checked_add(HEAD)) == Some(bytes.len()))
}

fn promised(bytes: &[u8]) -> Option<usize> {
    bytes.get(HEAD - 4..).and_then(<[u8]>::first_chunk).map(|&count| u32::from_le_bytes(count) as usize)
}

/// Text begins with the word solid; so do some binary files, whose length then fits.
pub(super) fn read(name: &str, bytes: &[u8]) -> Result<TrianglesRead, Error> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let is_text = bytes.trim_ascii_start().get(..5).is_some_and(|word| word.eq_ignore_ascii_case(b"solid"));
    if is_text && !is_binary(bytes) { read_text(name, bytes) } else { read_binary(name, bytes) }
}

fn read_binary(name: &str, bytes: &[u8]) -> Result<TrianglesRead, Error> {
    let n = promised(bytes).ok_or_else(|| Error::content(name, "this is no STL file: it is shorter than the head of one"))?;
    let n_whole = (bytes.len() - HEAD) / EACH;
    if n_whole < n {
        return Err(Error::content(name, format!("its head promises {n} triangles, but there are {n_whole}")));
    }
    let mut welding = Welding::default();
    for (t, triangle) in bytes[HEAD..].chunks_exact(EACH).take(n).enumerate() {
        // The normal comes before the corners; it follows from them.
        for corner in triangle[12..48].chunks_exact(12) {
            let number = |k: usize| corner.get(4 * k..).and_then(<[u8]>::first_chunk).map_or(f32::NAN, |&bytes| f32::from_le_bytes(bytes));
            let position = [number(0), number(1), number(2)];
            if let Some(x) = position.iter().find(|x| !x.is_finite()) {
                return Err(Error::content(name, format!("triangle {} has the coordinate {x}, which is not finite", t + 1)));
            }
            welding.push_corner(position.map(f64::from));
        }
        welding.end_face(t + 1).map_err(|problem| Error::content(name, problem))?;
    }
    let n_more = n_whole - n;
    if n_more > 0 {
        let s = if n_more > 1 { "s" } else { "" };
        welding.building.notes.push(format!("its head promises {n} triangles; {n_more} more triangle{s} after these were left out"));
    }
    welding.building.finish(name, |_| name.to_owned())
}

fn read_text(name: &str, bytes: &[u8]) -> Result<TrianglesRead, Error> {
    let mut welding = Welding::default();
    let mut text = Text::new(name, bytes);
    // The first line is a name.
    text.next_line();
    let mut is_over = false;
    while let Some(mut line) = text.next_line() {
        match line.word().unwrap_or_default().to_ascii_lowercase().as_slice() {
            b"vertex" => welding.push_corner(line.finite_position()?),
            b"endloop" => welding.end_face(line.number).map_err(|problem| line.problem(problem))?,
            b"endsolid" => is_over = true,
            b"facet" | b"outer" | b"endfacet" | b"solid" => is_over = false,
            _ => return Err(line.problem("no line of STL; expected facet, outer loop, vertex, endloop, endfacet or endsolid")),
        }
    }
    if !is_over || !welding.corners.is_empty() {
        return Err(text.cut_short("endsolid"));
    }
    welding.building.finish(name, |line| format!("{name}:{line}"))
}

/// Triangles whose corners become one where they are at the same place.
#[derive(Default)]
struct Welding {
    building: Building,
    known: HashMap<[u64; 3], usize>,
    corners: Vec<usize>,
}

impl Welding {
    fn push_corner(&mut self, position: [f64; 3]) {
        let vertices = &mut self.building.mesh.vertices;
        // Adding 0 makes -0 the same as 0.
        let v = *self.known.entry(position.map(|x| (x + 0.0).to_bits())).or_insert_with(|| {
            vertices.push(position);
            vertices.len() - 1
        });
        self.corners.push(v);
    }

    fn end_face(&mut self, place: usize) -> Result<(), String> {
        let face = std::mem::take(&mut self.corners);
        self.building.push_face(&face, place)
    }
}
