//! Stanford's PLY, as text and binary: positions, faces, and all single numbers that vertices have besides.

mod header;
mod values;

use evenly::Attribute;

use self::header::{Element, Header};
use self::values::Values;
use super::TrianglesRead;
use super::building::Building;
use super::lines::Text;
use crate::Error;

/// The axes' names, and how the list of a face's corners may be called.
const AXES: [&str; 3] = ["x", "y", "z"];
const CORNERS: [&str; 2] = ["vertex_indices", "vertex_index"];

pub(super) fn read(name: &str, bytes: &[u8]) -> Result<TrianglesRead, Error> {
    let (building, is_text) = read_elements(name, bytes, &[("vertex", &AXES[..]), ("face", &CORNERS[..1])])?;
    building.finish(name, |place| if is_text { format!("{name}:{place}") } else { format!("{name}, face {place}") })
}

/// The vertices alone, whether there are faces or not.
pub(super) fn read_vertices_of(name: &str, bytes: &[u8]) -> Result<Vec<[f64; 3]>, Error> {
    Ok(read_elements(name, bytes, &[("vertex", &AXES[..])])?.0.mesh.vertices)
}

/// What is in the file, which must have each of these elements once; and whether it is text.
fn read_elements(name: &str, bytes: &[u8], needed: &[(&str, &[&str])]) -> Result<(Building, bool), Error> {
    let mut text = Text::new(name, bytes);
    let header = Header::read(&mut text)?;
    for (kind, wanted) in needed {
        if header.elements.iter().filter(|element| element.name == *kind).count() != 1 {
            return Err(Error::content(name, format!("its header should have one element {kind}, with {}", wanted.join(", "))));
        }
    }
    let mut values = Values::new(name, text, header.encoding);
    let mut building = Building::default();
    for element in &header.elements {
        match element.name.as_str() {
            "vertex" => read_vertices(element, &mut values, &mut building)?,
            "face" => read_faces(element, &mut values, &mut building)?,
            _ => skip(element, &mut values)?,
        }
    }
    Ok((building, values.is_text()))
}

fn read_vertices(element: &Element, values: &mut Values, building: &mut Building) -> Result<(), Error> {
    if let Some(axis) = AXES.iter().find(|axis| !element.properties.iter().any(|property| property.is_number(axis))) {
        return Err(Error::content(values.name(), format!("its vertices have no {axis}")));
    }
    let mesh = &mut building.mesh;
    let extra = element.properties.iter().filter(|property| property.count.is_none() && !AXES.contains(&property.name.as_str()));
    mesh.attributes = extra.map(|property| Attribute { name: property.name.clone(), values: Vec::new() }).collect();
    for v in 0..element.count {
        values.begin(element, v)?;
        let mut position = [0.0; 3];
        let mut attributes = mesh.attributes.iter_mut();
        for property in &element.properties {
            if property.count.is_some() {
                values.list(property, None)?;
                continue;
            }
            let value = values.number(property.kind)?;
            match AXES.iter().position(|axis| *axis == property.name) {
                Some(_) if !value.is_finite() => return Err(values.problem(format!("{} is {value}, which is not finite", property.name))),
                Some(axis) => position[axis] = value,
                None => attributes.next().into_iter().for_each(|attribute| attribute.values.push(value)),
            }
        }
        mesh.vertices.push(position);
    }
    Ok(())
}

fn read_faces(element: &Element, values: &mut Values, building: &mut Building) -> Result<(), Error> {
    let is_corners = |name: &str| CORNERS.contains(&name);
    if !element.properties.iter().any(|property| property.count.is_some() && is_corners(&property.name)) {
        return Err(Error::content(values.name(), "its faces have no list vertex_indices"));
    }
    let mut corners = Vec::new();
    for f in 0..element.count {
        values.begin(element, f)?;
        corners.clear();
        for property in &element.properties {
            match property.count {
                Some(_) => values.list(property, is_corners(&property.name).then_some(&mut corners))?,
                None => drop(values.number(property.kind)?),
            }
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
