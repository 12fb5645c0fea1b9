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

/// A file without faces is an error, unless it may be.
pub(super) fn read(name: &str, bytes: &[u8], may_be_points: bool) -> Result<TrianglesRead, Error> {
    let mut text = Text::new(name, bytes);
    let header = Header::read(&mut text)?;
    let number = |kind: &str| header.elements.iter().filter(|element| element.name == kind).count();
    let is_points = may_be_points && header.elements.iter().all(|element| element.name != "face" || element.count == 0);
    for (kind, wanted) in [("vertex", &AXES[..]), ("face", &CORNERS[..1])] {
        if number(kind) != 1 && !(kind == "face" && is_points) {
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
