//! Shapefiles, by crate `shapefile`: polygons, lines and points of the main file, `.shp`.

use std::io::Cursor;
use std::path::Path;

use evenly::Shape;
use shapefile::{PointZ, ShapeReader};

use super::{Points, Shapes};

/// How a shapefile begins: its code, 9994.
pub(crate) const BEGIN: &[u8] = b"\x00\x00\x27\x0a";

pub(super) fn read(bytes: &[u8]) -> Result<Shapes, String> {
    let told = |e: shapefile::Error| format!("this is no shapefile: {e}");
    let mut reader = ShapeReader::new(Cursor::new(bytes)).map_err(told)?;
    let mut shapes = Shapes::default();
    for shape in reader.iter_shapes() {
        match shape.map_err(told)? {
            shapefile::Shape::Polygon(polygon) => shapes.fill(polygon.rings().iter().map(|ring| flat(ring.points(), |p| [p.x, p.y]))),
            shapefile::Shape::PolygonM(polygon) => shapes.fill(polygon.rings().iter().map(|ring| flat(ring.points(), |p| [p.x, p.y]))),
            shapefile::Shape::PolygonZ(polygon) => shapes.fill(polygon.rings().iter().map(|ring| flat(ring.points(), of_z))),
            shapefile::Shape::Polyline(line) => shapes.lines.extend(line.parts().iter().map(|part| flat(part, |p| [p.x, p.y]))),
            shapefile::Shape::PolylineM(line) => shapes.lines.extend(line.parts().iter().map(|part| flat(part, |p| [p.x, p.y]))),
            shapefile::Shape::PolylineZ(line) => shapes.lines.extend(line.parts().iter().map(|part| flat(part, of_z))),
            shapefile::Shape::Point(p) => shapes.points.push([p.x, p.y]),
            shapefile::Shape::PointM(p) => shapes.points.push([p.x, p.y]),
            shapefile::Shape::PointZ(p) => shapes.points.push([p.x, p.y]),
            shapefile::Shape::Multipoint(points) => shapes.points.extend(points.points().iter().map(|p| [p.x, p.y])),
            shapefile::Shape::MultipointM(points) => shapes.points.extend(points.points().iter().map(|p| [p.x, p.y])),
            shapefile::Shape::MultipointZ(points) => shapes.points.extend(points.points().iter().map(of_z)),
            // Those of no shape, and patches in space.
            shapefile::Shape::NullShape | shapefile::Shape::Multipatch(_) => {}
        }
    }
    Ok(shapes)
}

/// Whether the file beside it, `.prj`, says that coordinates are longitudes and latitudes.
pub(super) fn is_geographic(path: &Path) -> bool {
    let projection = std::fs::read_to_string(path.with_extension("prj")).unwrap_or_default();
    ["GEOGCS", "GEOGCRS"].iter().any(|begin| projection.trim_start().starts_with(begin))
}

impl Shapes {
    /// Adds what the rings of one polygon enclose.
    fn fill(&mut self, rings: impl Iterator<Item = Points>) {
        self.filled.push(Shape { rings: rings.collect(), ..Shape::default() });
    }
}

fn flat<P>(points: &[P], place: impl Fn(&P) -> [f64; 2]) -> Points {
    points.iter().map(place).collect()
}

fn of_z(p: &PointZ) -> [f64; 2] {
    [p.x, p.y]
}

#[cfg(test)]
mod tests {
    use shapefile::record::polygon::GenericPolygon;
    use shapefile::{Point, PolygonRing, ShapeWriter};

    use super::*;

    fn ring(low: f64, high: f64) -> Vec<Point> {
        [[low, low], [low, high], [high, high], [high, low]].map(|[x, y]| Point::new(x, y)).to_vec()
    }

    #[test]
    fn polygons_have_their_holes_and_what_is_cut_short_is_an_error() {
        let polygon = GenericPolygon::with_rings(vec![PolygonRing::Outer(ring(0.0, 10.0)), PolygonRing::Inner(ring(2.0, 4.0))]);
        let mut bytes = Cursor::new(Vec::new());
        let mut writer = ShapeWriter::new(&mut bytes);
        writer.write_shape(&polygon).unwrap();
        drop(writer);
        let bytes = bytes.into_inner();
        assert!(bytes.starts_with(BEGIN));
        let Shapes { filled, .. } = read(&bytes).unwrap();
        assert_eq!(evenly::Polygon::of_shapes(&filled).unwrap().area(), 96.0);
        for length in [4, 50, 99, 120, bytes.len() - 1] {
            assert!(read(&bytes[..length]).is_err(), "{length}");
        }
    }
}
