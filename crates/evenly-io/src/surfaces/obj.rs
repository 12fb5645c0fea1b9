//! Wavefront's OBJ: positions, colours of vertices, and faces. All else is skipped.

use std::collections::BTreeSet;

use evenly::Attribute;

use super::TrianglesRead;
use super::building::Building;
use super::lines::{Line, Text, shown};
use crate::Error;
use crate::meshes::COLOURS;
use crate::text::parse;

pub(super) fn read(name: &str, bytes: &[u8]) -> Result<TrianglesRead, Error> {
    let mut building = Building::default();
    let mut colours: Vec<Option<[f64; 3]>> = Vec::new();
    let mut corners = Vec::new();
    // Groups and materials, by what their lines are.
    let mut parts: BTreeSet<(Vec<u8>, Vec<u8>)> = BTreeSet::new();
    let mut text = Text::new(name, bytes).continued();
    while let Some(mut line) = text.next_line() {
        match line.word() {
            Some(b"v") => {
                let position = line.position()?;
                building.push_vertex(position, || line.place());
                colours.push(colour(&mut line)?);
            }
            Some(b"f") => {
                corners.clear();
                while let Some(word) = line.word() {
                    corners.push(index(word, building.mesh.vertices.len()).map_err(|problem| line.problem(problem))?);
                }
                building.push_face(&corners, line.number).map_err(|problem| line.problem(problem))?;
            }
            Some(kind @ (b"g" | b"o" | b"usemtl")) => {
                let kind = kind.to_vec();
                parts.insert((kind, line.word().unwrap_or_default().to_vec()));
            }
            _ => {}
        }
    }
    if parts.len() > 1 {
        building.notes.push(format!("its {} objects, groups and materials are not kept apart", parts.len()));
    }
    building.mesh.attributes = attributes(&colours);
    building.finish(name, |line| format!("{name}:{line}"))
}

/// What stands after a position: a weight, or a colour.
fn colour(line: &mut Line) -> Result<Option<[f64; 3]>, Error> {
    let mut numbers = [0.0; 3];
    let mut n = 0;
    while let Some(word) = line.word() {
        if n < 3 {
            numbers[n] = parse(&String::from_utf8_lossy(word)).map_err(|problem| line.problem(problem))?;
        }
        n += 1;
    }
    Ok(if n < 3 { None } else { Some(numbers) })
}

/// Colours are attributes if all vertices have one.
fn attributes(colours: &[Option<[f64; 3]>]) -> Vec<Attribute> {
    let Some(all) = colours.iter().copied().collect::<Option<Vec<[f64; 3]>>>() else { return Vec::new() };
    // From 0 to 1, as most writers have them, or to 255.
    let scale = if all.iter().flatten().all(|&x| x <= 1.0) { 255.0 } else { 1.0 };
    let names = COLOURS.into_iter().take(3).enumerate();
    names.map(|(k, name)| Attribute { name: name.into(), values: all.iter().map(|colour| scale * colour[k]).collect() }).collect()
}

/// The vertex of a corner such as `7/1/3`: counted from 1, or backwards from the last before this line.
fn index(word: &[u8], n_vertices: usize) -> Result<usize, String> {
    let digits = word.split(|&c| c == b'/').next().unwrap_or_default();
    let number: Option<i64> = std::str::from_utf8(digits).ok().and_then(|digits| digits.parse().ok());
    let number = number.ok_or_else(|| format!("'{}' is no corner, expected a vertex' number", shown(word)))?;
    let before = || n_vertices.checked_sub(usize::try_from(number.unsigned_abs()).ok()?);
    match number {
        0 => Err("a face has vertex 0, but vertices are counted from 1".into()),
        1.. => Ok(usize::try_from(number - 1).unwrap_or(usize::MAX)),
        _ => before().ok_or_else(|| format!("a face has vertex {number}, but there are only {n_vertices} before it")),
    }
}
