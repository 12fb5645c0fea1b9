//! GeoJSON (RFC 7946): geometries, features and collections of them. All polygons count together; properties do not.

use geojson::{GeoJson, GeometryValue, Position};

use super::{Points, Shapes};

pub(super) fn read(text: &str) -> Result<Shapes, String> {
    let document: GeoJson = text.parse().map_err(|e: geojson::Error| format!("this is no GeoJSON: {e}"))?;
    let mut shapes = Shapes::default();
    match document {
        GeoJson::Geometry(geometry) => add(&mut shapes, &geometry.value)?,
        GeoJson::Feature(feature) => feature.geometry.iter().try_for_each(|geometry| add(&mut shapes, &geometry.value))?,
        GeoJson::FeatureCollection(collection) => {
            let geometries = collection.features.iter().filter_map(|feature| feature.geometry.as_ref());
            { geometries }.try_for_each(|geometry| add(&mut shapes, &geometry.value))?;
        }
    }
    Ok(shapes)
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
        GeometryValue::Point { .. } | GeometryValue::MultiPoint { .. } => {}
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
