//! Polygons and lines from files: GeoJSON, WKT, SVG, shapefiles, and plain rings as text. Units are kept.

mod entities;
mod esri;
mod geographic;
mod geojson;
mod rings;
mod svg;
mod wkt;

use std::path::Path;

use evenly::{Polygon, Shape};

pub(crate) use self::esri::BEGIN as SHAPEFILE;
use self::esri::BEGIN;
use crate::Error;
use crate::file::read_bytes;
use crate::text::plain;

/// A ring or a line: points.
type Points = Vec<[f64; 2]>;

/// What a file holds.
#[derive(Debug, Default, Clone, PartialEq)]
struct Shapes {
    /// Parts of which the first ring is the outer one.
    parts: Vec<Vec<Points>>,
    /// The names of parts, where they have any: one for each.
    names: Vec<String>,
    /// What is filled, where parts are not told apart.
    filled: Vec<Shape>,
    lines: Vec<Points>,
    points: Points,
    /// Whether rings have come as text, where each may be anything.
    is_plain: bool,
    /// Whether coordinates are longitudes and latitudes, as those of GeoJSON are.
    is_geographic: bool,
}

/// Reads a polygon. What is in the file tells the format: GeoJSON, WKT or a shapefile (all polygons together),
/// SVG (what is filled, or where nothing is, closed outlines; in the view box' units, y upwards from
/// its lower side), or text: `x y` a line, a blank line between rings. Curves are flattened so that no
/// place of them is farther off than `tolerance`, in the file's units; `None` for a thousandth of the
/// drawing's size.
///
/// # Errors
/// [`Error::Content`] with the file's name, and what is wrong with it or with the polygon.
pub fn read_polygon(path: &Path, tolerance: Option<f64>) -> Result<Polygon, Error> {
    let (name, shapes) = read(path, tolerance)?;
    let is_geographic = shapes.is_geographic;
    let polygon = match shapes {
        Shapes { parts, .. } if !parts.is_empty() => Polygon::new(parts),
        Shapes { filled, .. } if filled.iter().any(|shape| !shape.rings.is_empty()) => Polygon::of_shapes(&filled),
        _ => return Err(Error::content(name, "there is no polygon in it")),
    };
    let polygon = polygon.map_err(|e| Error::content(name, e.to_string()))?;
    Ok(if is_geographic { geographic::noted(polygon) } else { polygon })
}

/// Reads a polygon as [`read_polygon`], and its parts, each by its name: features of GeoJSON, polygons of WKT,
/// shapes of SVG, rings of text.
///
/// # Errors
/// As [`read_polygon`].
pub fn read_regions(path: &Path, tolerance: Option<f64>) -> Result<(Polygon, Vec<(String, Polygon)>), Error> {
    let whole = read_polygon(path, tolerance)?;
    let (name, Shapes { parts, names, filled, is_plain, .. }) = read(path, tolerance)?;
    let told = |e: evenly::Error| Error::content(name.clone(), e.to_string());
    let mut regions: Vec<(String, Vec<Shape>)> = Vec::new();
    let shape = |rings: Vec<Points>| Shape { rings, ..Shape::default() };
    let separate: Vec<Shape> = match () {
        () if !parts.is_empty() => parts.into_iter().map(shape).collect(),
        () if is_plain => filled.into_iter().flat_map(|whole| whole.rings).map(|ring| shape(vec![ring])).collect(),
        () => filled,
    };
    for (k, part) in separate.into_iter().enumerate() {
        let name = names.get(k).cloned().unwrap_or_else(|| format!("region {}", k + 1));
        match regions.last_mut() {
            Some((last, all)) if k > 0 && names.get(k).is_some() && *last == name => all.push(part),
            _ => regions.push((name, vec![part])),
        }
    }
    let regions = regions.into_iter().map(|(name, shapes)| Ok((name, Polygon::of_shapes(&shapes).map_err(told)?)));
    Ok((whole, regions.collect::<Result<_, Error>>()?))
}

/// Reads lines, in the same formats: polygons give their rings, and text a line for each block
/// between blank lines.
///
/// # Errors
/// As [`read_polygon`].
pub fn read_lines(path: &Path) -> Result<Vec<Vec<[f64; 2]>>, Error> {
    let (name, Shapes { parts, filled, lines, is_plain, .. }) = read(path, None)?;
    // Of a shapefile; those of a drawing and of text are among the lines.
    let filled = filled.into_iter().filter(|_| lines.is_empty() && !is_plain).flat_map(|shape| shape.rings);
    let mut rings: Vec<Points> = parts.into_iter().flatten().chain(filled).collect();
    rings.iter_mut().for_each(close);
    let lines: Vec<Points> = rings.into_iter().chain(lines).filter(|line| line.len() > 1).collect();
    if lines.is_empty() {
        return Err(Error::content(name, "there is no line in it"));
    }
    Ok(lines)
}

/// The points of GeoJSON, or of a shapefile, in the file `name`.
pub(crate) fn read_points_of_map(name: &str, bytes: &[u8]) -> Result<Vec<[f64; 2]>, Error> {
    let Shapes { points, .. } = parse(name, bytes, None)?;
    if points.is_empty() { Err(Error::content(name, "there are no points in it")) } else { Ok(points) }
}

/// Ends a ring where it begins.
fn close(ring: &mut Points) {
    if ring.first() != ring.last() {
        ring.extend(ring.first().copied());
    }
}

fn read(path: &Path, tolerance: Option<f64>) -> Result<(String, Shapes), Error> {
    let (name, bytes) = read_bytes(path)?;
    let mut shapes = parse(&name, &bytes, tolerance)?;
    if bytes.starts_with(BEGIN) {
        shapes.is_geographic = esri::is_geographic(path);
    }
    Ok((name, shapes))
}

fn parse(name: &str, bytes: &[u8], tolerance: Option<f64>) -> Result<Shapes, Error> {
    if bytes.starts_with(BEGIN) {
        return esri::read(bytes).map_err(|problem| Error::content(name, problem));
    }
    let no_text =
        || Error::content(name, "this is not text; polygons are read from GeoJSON, WKT, SVG, shapefiles (.shp), and rings as text");
    let bytes = plain(bytes);
    let whole = std::str::from_utf8(&bytes).map_err(|_| no_text())?.trim_start_matches('\u{feff}');
    let text = whole.trim_start();
    let problem = |text: String| Error::content(name, text);
    match text.chars().next() {
        Some('{') => geojson::read(text).map_err(problem),
        Some('<') => svg::read(text, tolerance).map_err(problem),
        Some(first) if first.is_ascii_alphabetic() => wkt::read(text).map_err(problem),
        _ => rings::read(name, whole),
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn shapes(text: &str) -> Shapes {
        parse("p", text.as_bytes(), Some(1e-3)).unwrap()
    }

    fn area(filled: &[Shape]) -> f64 {
        Polygon::of_shapes(filled).unwrap().area()
    }

    fn message(text: &str) -> String {
        parse("p", text.as_bytes(), None).unwrap_err().to_string()
    }

    #[test]
    fn the_same_square_in_every_format() {
        let square = vec![[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]];
        let mut closed = square.clone();
        closed.push([0.0, 0.0]);
        let geometry = r#"{"type":"Polygon","coordinates":[[[0,0],[2,0],[2,2],[0,2],[0,0]]]}"#;
        let feature = format!(r#"{{"type":"Feature","properties":null,"geometry":{geometry}}}"#);
        let collection = format!(r#"{{"type":"FeatureCollection","features":[{feature}]}}"#);
        for text in [geometry, &feature, &collection, "POLYGON ((0 0, 2 0, 2 2, 0 2, 0 0))", "MULTIPOLYGON(((0 0,2 0,2 2,0 2,0 0)))"] {
            assert_eq!(shapes(text).parts, vec![vec![closed.clone()]], "{text}");
        }
        assert_eq!(shapes("0 0\n2,0 # a comment\n2\t2\n0 2\n").filled[0].rings, vec![square.clone()]);
        let svg = |body: &str| format!("<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 2 2'>{body}</svg>");
        for body in [
            "<path d='M0 2 H2 V0 H0 Z'/>",
            "<polygon points='0,2 2,2 2,0 0,0'/>",
            "<g transform='translate(1 1)'><rect x='-1' y='-1' width='2' height='2'/></g>",
            "<g transform='scale(2)'><path transform='scale(0.5)' d='m0 2 2 0 0-2-2 0z'/></g>",
        ] {
            let filled = shapes(&svg(body)).filled;
            assert_eq!((filled.len(), area(&filled)), (1, 4.0), "{body}");
        }
    }

    #[test]
    fn curves_are_as_near_as_the_tolerance() {
        let circle = shapes("<svg xmlns='http://www.w3.org/2000/svg'><circle cx='5' cy='5' r='3'/></svg>").filled;
        let ring = &circle[0].rings[0];
        assert!(ring.iter().all(|[x, y]| ((x - 5.0).hypot(y - 3.0) - 3.0).abs() < 2e-3), "{ring:?}");
        assert!((area(&circle) - 9.0 * std::f64::consts::PI).abs() < 0.05);
    }

    #[test]
    fn a_drawing_is_read_as_it_is_shown() {
        let near = |body: &str, expected: f64| {
            let text = format!("<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 100 100'>{body}</svg>");
            let found = area(&shapes(&text).filled);
            assert!((found - expected).abs() < 1e-3 * expected, "{found}, expected {expected}: {body}");
        };
        let square = "<rect x='10' y='10' width='40' height='40'/>";
        // What is hidden, or has no colour, is not there.
        for hidden in [
            "style='display:none'",
            "display='none'",
            "visibility='hidden'",
            "class='no'",
            "opacity='0'",
            "fill='none'",
            "fill-opacity='0'",
        ] {
            near(&format!("<style>.no {{ display: none }}</style><g {hidden}><rect width='90' height='90'/></g>{square}"), 1600.0);
        }
        near(&format!("<defs>{square}</defs><rect width='7' height='1'/>"), 7.0);
        near("<defs><rect id='a' width='3' height='2'/></defs><use href='#a' x='5'/><use href='#a' y='9'/>", 12.0);
        // Filled, and drawn once more as an outline.
        near(
            &format!("{square}<rect x='10' y='10' width='40' height='40' fill='none' stroke='red'/><rect x='80' width='9' height='9'/>"),
            1681.0,
        );
        near("<rect width='10' height='10' fill='none' stroke='red'/><circle cx='80' cy='80' r='0.5' stroke='red' fill='none'/>", 100.785);
        // Both rules, and how an outline without a colour is read.
        let star = "M50 10 L73.51 82.36 L11.96 37.64 L88.04 37.64 L26.49 82.36 Z";
        near(&format!("<path d='{star}'/>"), 1796.0);
        near(&format!("<path fill-rule='evenodd' d='{star}'/>"), 1241.0);
        near(&format!("<path style='fill-rule:evenodd' d='{star}'/>"), 1241.0);
        // Clips, drawings in drawings, transforms in styles, corners that are ellipses.
        near(&format!("<clipPath id='c'><rect x='20' width='10' height='100'/></clipPath><g clip-path='url(#c)'>{square}</g>"), 400.0);
        near("<svg x='10' y='10' width='20' height='20' viewBox='0 0 10 10'><rect width='15' height='5'/></svg>", 200.0);
        near("<g style='transform: scale(2)'><rect width='5' height='5'/></g>", 100.0);
        near("<rect width='40' height='20' rx='10' ry='5'/>", 800.0 - (4.0 - std::f64::consts::PI) * 50.0);
        near("<rect width='50%' height='1mm'/>", 50.0 * 96.0 / 25.4);
    }

    #[test]
    fn a_drawing_keeps_its_own_units() {
        let low = |head: &str, body: &str| {
            let text = format!("<svg xmlns='http://www.w3.org/2000/svg' {head}>{body}</svg>");
            *Polygon::of_shapes(&shapes(&text).filled).unwrap().frame()
        };
        let square = "<rect x='10' y='10' width='80' height='10'/>";
        for head in ["width='100' height='100'", "viewBox='0 0 100 100'", "width='3in' height='50mm' viewBox='0 0 100 100'"] {
            assert_eq!(low(head, square), evenly::Rectangle::new([10.0, 80.0], [80.0, 10.0]).unwrap(), "{head}");
        }
        assert_eq!(low("viewBox='-50 -50 100 100'", square), evenly::Rectangle::new([10.0, 30.0], [80.0, 10.0]).unwrap());
    }

    #[test]
    fn rings_and_lines_stand_apart() {
        let two = shapes("0 0\n9 0\n9 9\n\n# a hole\n1 1\n2 1\n2 2\n\n\n");
        assert_eq!(two.lines.iter().map(Vec::len).collect::<Vec<_>>(), [3, 3]);
        assert_eq!(shapes("LINESTRING (0 0, 1 1, 2 0)").lines[0].len(), 3);
        assert_eq!(shapes(r#"{"type":"MultiLineString","coordinates":[[[0,0],[1,1]],[[2,2],[3,3]]]}"#).lines.len(), 2);
    }

    #[test]
    fn what_cannot_be_read_is_said() {
        assert!(message("0 0\n1\n").contains("p:2"));
        assert_eq!(
            read_points_of_map("p", b"{\"type\":\"MultiPoint\",\"coordinates\":[[1,2],[3,4,9]]}").unwrap(),
            [[1.0, 2.0], [3.0, 4.0]]
        );
        assert!(read_points_of_map("p", b"{\"type\":\"LineString\",\"coordinates\":[[1,2],[3,4]]}").is_err());
        assert!(message("{\"type\":\"Nonsense\"}").starts_with("p: "));
        assert!(message("POLYGON ((0 0").starts_with("p: "));
        assert!(message("<svg").starts_with("p: "));
        assert!(message("0 nan\n").contains("not a finite number"));
        assert!(message("\n\n0 0\n1 x\n").contains("p:4"));
        assert!(message("POLYGON((0 0,1 0,1 1,0 0)) POLYGON((0 0,1 0,1 1,0 0))").contains("GEOMETRYCOLLECTION"));
        assert!(message(&"GEOMETRYCOLLECTION(".repeat(100_000)).contains("deep"));
        assert!(message(&format!("<svg>{}</svg>", "<g>".repeat(3000) + &"</g>".repeat(3000))).contains("deep"));
        assert!(parse("p", &[0xff, 0x00, 0xfe], None).unwrap_err().to_string().contains("not text"));
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(500) })]
        /// Broken files are told, whatever is in them.
        #[test]
        fn no_text_makes_a_reader_fall(
            start in prop::sample::select(vec!["{\"type\":\"Polygon\",\"coordinates\":[[", "POLYGON((", "<svg viewBox='0 0 1 1'><path d='M0 0", "0 0\n", "MULTIPOLYGON(", "<svg><g transform='"]),
            rest in "[-0-9eE.,()\\[\\]{}<>'\"/ MLHVCSQTAZmlz\n]{0,60}",
            end in prop::sample::select(vec!["", "]]}", "))", "'/></svg>", "'/></g></svg>"]),
        ) {
            let text = format!("{start}{rest}{end}");
            if let Ok(Shapes { parts, filled, .. }) = parse("p", text.as_bytes(), Some(0.01)) {
                let _ = Polygon::new(parts);
                let _ = Polygon::of_shapes(&filled);
            }
        }
    }
}
