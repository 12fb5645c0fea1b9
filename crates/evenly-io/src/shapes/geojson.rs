//! GeoJSON (RFC 7946): geometries, features and collections of them. All polygons count together.

use geojson::{Feature, GeoJson, GeometryValue, Position};

use super::{Points, Shapes};

pub(super) fn read(text: &str) -> Result<Shapes, String> {
    let document: GeoJson = text.parse().map_err(|e: geojson::Error| format!("this is no GeoJSON: {e}"))?;
    let others = match &document {
        GeoJson::Geometry(geometry) => &geometry.foreign_members,
        GeoJson::Feature(feature) => &feature.foreign_members,
        GeoJson::FeatureCollection(collection) => &collection.foreign_members,
    };
    // Older files name another reference system.
    let is_geographic = !others.as_ref().is_some_and(|members| members.contains_key("crs"));
    let mut shapes = Shapes { is_geographic, ..Shapes::default() };
    match document {
        GeoJson::Geometry(geometry) => add(&mut shapes, &geometry.value)?,
        GeoJson::Feature(feature) => add_feature(&mut shapes, &feature, 1)?,
        GeoJson::FeatureCollection(collection) => {
            (1..).zip(&collection.features).try_for_each(|(number, feature)| add_feature(&mut shapes, feature, number))?;
        }
    }
    Ok(shapes)
}

/// Adds a feature's geometry, and its name for each part.
fn add_feature(shapes: &mut Shapes, feature: &Feature, number: usize) -> Result<(), String> {
    let Some(geometry) = &feature.geometry else { return Ok(()) };
    add(shapes, &geometry.value)?;
    let called = ["name", "NAME", "Name", "id", "ID"].iter().find_map(|key| feature.property(key)).map(|value| match value {
        serde_json::Value::String(name) => name.clone(),
        other => other.to_string(),
    });
    let name = called.filter(|name| !name.is_empty()).unwrap_or_else(|| format!("region {number}"));
    shapes.names.resize(shapes.parts.len(), name);
    Ok(())
}

fn add(shapes: &mut Shapes, geometry: &GeometryValue) -> Result<(), String> {
    match geometry {
        GeometryValue::Polygon { coordinates } => shapes.parts.push(part(coordinates)?),
        GeometryValue::MultiPolygon { coordinates } => {
            for polygon in coordinates {
                shapes.parts.push(part(polygon)?);
            }
        }
        GeometryValue::LineString { coordinates } => shapes.lines.push(points(coordinates)?),
        GeometryValue::MultiLineString { coordinates } => {
            for line in coordinates {
                shapes.lines.push(points(line)?);
            }
        }
        GeometryValue::GeometryCollection { geometries } => geometries.iter().try_for_each(|geometry| add(shapes, &geometry.value))?,
        GeometryValue::Point { coordinates } => shapes.points.extend(points(std::slice::from_ref(coordinates))?),
        GeometryValue::MultiPoint { coordinates } => shapes.points.extend(points(coordinates)?),
    }
    Ok(())
}

fn part(rings: &[Vec<Position>]) -> Result<Vec<Points>, String> {
    rings.iter().map(|ring| points(ring)).collect()
}

fn points(line: &[Position]) -> Result<Points, String> {
    let point = |position: &Position| match position.as_slice() {
        &[x, y, ..] => Ok([x, y]),
        other => Err(format!("a position has {} numbers, expected 2", other.len())),
    };
    line.iter().map(point).collect()
}
