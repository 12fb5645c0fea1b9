//! Well-known text, as databases have it.

use std::str::FromStr as _;

use wkt::Wkt;
use wkt::types::{LineString, Polygon};

use super::{Points, Shapes};

pub(super) fn read(text: &str) -> Result<Shapes, String> {
    // A reference system may stand before it.
    let text = text.trim();
    let text = text.split_once(';').filter(|(before, _)| before.to_ascii_uppercase().starts_with("SRID")).map_or(text, |(_, after)| after);
    check_parentheses(text)?;
    let geometry = Wkt::<f64>::from_str(text).map_err(|e| format!("this is no WKT: {e}"))?;
    let mut shapes = Shapes::default();
    add(&mut shapes, &geometry);
    Ok(shapes)
}

fn add(shapes: &mut Shapes, geometry: &Wkt<f64>) {
    match geometry {
        Wkt::Polygon(polygon) => shapes.parts.push(part(polygon)),
        Wkt::MultiPolygon(polygons) => shapes.parts.extend(polygons.polygons().iter().map(part)),
        Wkt::LineString(line) => shapes.lines.push(points(line)),
        Wkt::MultiLineString(lines) => shapes.lines.extend(lines.line_strings().iter().map(points)),
        Wkt::GeometryCollection(all) => all.geometries().iter().for_each(|geometry| add(shapes, geometry)),
        Wkt::Point(_) | Wkt::MultiPoint(_) => {}
    }
}

fn part(polygon: &Polygon<f64>) -> Vec<Points> {
    polygon.rings().iter().map(points).collect()
}

fn points(line: &LineString<f64>) -> Points {
    line.coords().iter().map(|coord| [coord.x, coord.y]).collect()
}

/// Geometries in geometries go no deeper than this.
const DEEPEST: usize = 64;

/// One geometry, not too deep.
fn check_parentheses(text: &str) -> Result<(), String> {
    let mut depth = 0usize;
    for (k, c) in text.char_indices() {
        match c {
            '(' => depth += 1,
            ')' => depth = depth.saturating_sub(1),
            _ => continue,
        }
        if depth > DEEPEST {
            return Err(format!("geometries lie more than {DEEPEST} deep in each other"));
        }
        if depth == 0 && !text[k + 1..].trim_matches([';', ' ', '\n', '\r', '\t']).is_empty() {
            return Err("there is more after the first geometry; put several into a GEOMETRYCOLLECTION".into());
        }
    }
    Ok(())
}
