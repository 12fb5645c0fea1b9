//! Stanford's PLY, as text and binary: positions, faces, and all single numbers that vertices have besides.

mod header;
mod values;

use evenly::Attribute;

use self::header::{Element, Header};
use self::values::Values;
use super::TrianglesRead;
use super::building::Building;
use super::lines::{Text, shown};
use crate::Error;
use crate::meshes::COLOURS;

/// The axes' names, and how the list of a face's corners may be called.
const AXES: [&str; 3] = ["x", "y", "z"];
const CORNERS: [&str; 2] = ["vertex_indices", "vertex_index"];
/// The format stands among so many first bytes.
const LONG_HEAD: usize = 10_000;

/// Whether a file says that its numbers are binary.
pub(super) fn is_binary(bytes: &[u8]) -> bool {
    const WORD: &[u8] = b"format binary_";
    bytes.starts_with(b"ply") && bytes.windows(WORD.len()).take(LONG_HEAD).any(|window| window == WORD)
}

/// A file without faces is an error, unless it may be.
pub(super) fn read(name: &str, bytes: &[u8], may_be_points: bool) -> Result<TrianglesRead, Error> {
    let mut text = Text::new(name, bytes);
    let header = Header::read(&mut text)?;
    let number = |kind: &str| header.elements.iter().filter(|element| element.name == kind).count();
    let is_points = may_be_points
        && header.elements.iter().all(|element| !["face", "tristrips"].contains(&element.name.as_str()) || element.count == 0);
    for (kind, wanted) in [("vertex", &AXES[..]), ("face", &CORNERS[..1])] {
        if number(kind) != 1 && !(kind == "face" && (is_points || number("tristrips") == 1)) {
            return Err(Error::content(name, format!("its header should have one element {kind}, with {}", wanted.join(", "))));
        }
    }
    let mut values = Values::new(name, text, header.encoding);
    let mut building = Building::default();
    for element in &header.elements {
        match element.name.as_str() {
            "vertex" => read_vertices(element, &mut values, &mut building)?,
            "face" => read_faces(element, &mut values, &mut building)?,
            "tristrips" => read_strips(element, &mut values, &mut building)?,
            _ => skip(element, &mut values)?,
        }
    }
    if is_points {
        return Ok(TrianglesRead { mesh: building.mesh, notes: building.notes });
    }
    let is_text = values.is_text();
    building.finish(name, |place| if is_text { format!("{name}:{place}") } else { format!("{name}, face {place}") })
}

fn read_vertices(element: &Element, values: &mut Values, building: &mut Building) -> Result<(), Error> {
    if let Some(axis) = AXES.iter().find(|axis| !element.properties.iter().any(|property| property.is_number(axis))) {
        return Err(Error::content(values.name(), format!("its vertices have no {axis}")));
    }
    let extra = element.properties.iter().filter(|property| property.count.is_none() && !AXES.contains(&property.name.as_str()));
    building.mesh.attributes = extra.map(|property| Attribute { name: property.name.clone(), values: Vec::new() }).collect();
    for v in 0..element.count {
        values.begin(element, v)?;
        let mut position = [0.0; 3];
        let mut attributes = building.mesh.attributes.iter_mut();
        for property in &element.properties {
            if property.count.is_some() {
                values.list(property, None)?;
                continue;
            }
            let value = values.number(property.kind)?;
            match AXES.iter().position(|axis| *axis == property.name) {
                Some(axis) => position[axis] = value,
                None => attributes.next().into_iter().for_each(|attribute| attribute.values.push(value)),
            }
        }
        building.push_vertex(position, || values.place_name());
    }
    scale_colours(element, &mut building.mesh.attributes);
    Ok(())
}

/// Brings colours of real numbers from 0 to 1 to 0 to 255, as those of whole numbers are.
fn scale_colours(element: &Element, attributes: &mut [Attribute]) {
    let is_real = |name: &str| {
        let property = element.properties.iter().find(|property| property.name == name);
        property.is_some_and(|property| matches!(property.kind, header::Kind::F32 | header::Kind::F64))
    };
    for Attribute { name, values } in attributes.iter_mut().filter(|attribute| COLOURS.contains(&attribute.name.as_str())) {
        if is_real(name) && values.iter().all(|value| (0.0..=1.0).contains(value)) {
            values.iter_mut().for_each(|value| *value *= 255.0);
        }
    }
}

/// Strips of triangles, which negative numbers end.
fn read_strips(element: &Element, values: &mut Values, building: &mut Building) -> Result<(), Error> {
    let mut numbers = Vec::new();
    for f in 0..element.count {
        values.begin(element, f)?;
        numbers.clear();
        for property in &element.properties {
            match property.count {
                Some(_) => values.list(property, CORNERS.contains(&property.name.as_str()).then_some(&mut numbers))?,
                None => drop(values.number(property.kind)?),
            }
        }
        for strip in numbers.split(|&number| number < 0.0) {
            for (k, t) in strip.windows(3).enumerate() {
                let mut corners = [values.corner(t[0])?, values.corner(t[1])?, values.corner(t[2])?];
                if k % 2 == 1 {
                    corners.swap(0, 1);
                }
                // Triangles without area only join the parts of a strip.
                if corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0] {
                    building.push_face(&corners, values.place()).map_err(|problem| values.problem(problem))?;
                }
            }
        }
    }
    Ok(())
}

fn read_faces(element: &Element, values: &mut Values, building: &mut Building) -> Result<(), Error> {
    let is_corners = |name: &str| CORNERS.contains(&name);
    if !element.properties.iter().any(|property| property.count.is_some() && is_corners(&property.name)) {
        return Err(Error::content(values.name(), "its faces have no list vertex_indices"));
    }
    let others = element.properties.iter().filter(|property| !is_corners(&property.name)).map(|property| property.name.as_str());
    let others: Vec<&str> = others.collect();
    if !others.is_empty() && element.count > 0 {
        building.notes.push(format!("what its faces have besides corners is not kept: {}", shown(others.join(", ").as_bytes())));
    }
    let (mut numbers, mut corners) = (Vec::new(), Vec::new());
    for f in 0..element.count {
        values.begin(element, f)?;
        numbers.clear();
        for property in &element.properties {
            match property.count {
                Some(_) => values.list(property, is_corners(&property.name).then_some(&mut numbers))?,
                None => drop(values.number(property.kind)?),
            }
        }
        corners.clear();
        for &number in &numbers {
            corners.push(values.corner(number)?);
        }
        building.push_face(&corners, values.place()).map_err(|problem| values.problem(problem))?;
    }
    Ok(())
}

fn skip(element: &Element, values: &mut Values) -> Result<(), Error> {
    // Elements of nothing take no room in a file, however many are promised.
    if element.properties.is_empty() {
        return Ok(());
    }
    for k in 0..element.count {
        values.begin(element, k)?;
        for property in &element.properties {
            match property.count {
                Some(_) => values.list(property, None)?,
                None => drop(values.number(property.kind)?),
            }
        }
    }
    Ok(())
}
