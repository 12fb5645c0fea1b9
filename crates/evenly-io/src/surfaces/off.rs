//! Geomview's OFF, as text. What stands after positions and corners, such as normals and colours, is skipped.

use super::TrianglesRead;
use super::building::Building;
use super::lines::{Text, shown};
use crate::Error;

/// Letters that may stand before OFF: texture coordinates, colours and normals, which come after the position.
const HEADS: [&[u8]; 8] = [b"OFF", b"COFF", b"NOFF", b"CNOFF", b"STOFF", b"STCOFF", b"STNOFF", b"STCNOFF"];

pub(super) fn read(name: &str, bytes: &[u8]) -> Result<TrianglesRead, Error> {
    let mut text = Text::new(name, bytes);
    let mut line = text.expect_line(|| "the word OFF".into())?;
    let word = line.expect("the word OFF")?;
    // Some writers leave no blank before the number of vertices.
    let (head, digits) = word.split_at(word.iter().position(u8::is_ascii_digit).unwrap_or(word.len()));
    if !HEADS.contains(&head) {
        return Err(line.problem(format!("it begins with '{}', expected OFF, COFF or NOFF", shown(word))));
    }
    let first = match Some(digits).filter(|digits| !digits.is_empty()).or_else(|| line.word()) {
        Some(b"BINARY") => return Err(line.problem("this is binary OFF; convert it to text or to .ply")),
        Some(word) => word,
        None => {
            line = text.expect_line(|| "the numbers of vertices and faces".into())?;
            line.expect("the number of vertices")?
        }
    };
    let n_vertices: Option<usize> = std::str::from_utf8(first).ok().and_then(|word| word.parse().ok());
    let n_vertices = n_vertices.ok_or_else(|| line.problem(format!("'{}' is no number of vertices", shown(first))))?;
    let n_faces = line.count("the number of faces")?;
    let mut building = Building::default();
    for v in 0..n_vertices {
        let mut line = text.expect_line(|| format!("vertex {} of {n_vertices}", v + 1))?;
        let position = line.position()?;
        building.push_vertex(position, || line.place());
    }
    let mut corners = Vec::new();
    for f in 0..n_faces {
        let mut line = text.expect_line(|| format!("face {} of {n_faces}", f + 1))?;
        corners.clear();
        for _ in 0..line.count("the number of corners")? {
            corners.push(line.count("a corner")?);
        }
        building.push_face(&corners, line.number).map_err(|problem| line.problem(problem))?;
    }
    building.finish(name, |line| format!("{name}:{line}"))
}
