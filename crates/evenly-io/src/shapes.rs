//! Polygons and lines from files: GeoJSON, WKT, SVG, and plain rings as text. Units are kept.

mod geojson;
mod rings;
mod svg;
mod wkt;

use std::path::Path;

use evenly::Polygon;

use crate::Error;
use crate::file::read_bytes;

/// A ring or a line: points.
type Points = Vec<[f64; 2]>;

/// What a file holds.
#[derive(Debug, Default, Clone, PartialEq)]
struct Shapes {
    /// Parts of which the first ring is the outer one.
    parts: Vec<Vec<Points>>,
    /// Rings that are not said to be outer ones or holes.
    rings: Vec<Points>,
    lines: Vec<Points>,
}

/// Reads a polygon. What is in the file tells the format: GeoJSON (all its polygons together), WKT, SVG (all its closed paths and shapes; y upwards from the view box' lower side), or text: `x y` a
/// line, a blank line between rings. Curves are flattened so that no place of them is farther off than `tolerance`, in the file's units; `None` for a thousandth of the drawing's size.
///
/// # Errors
/// [`Error::Content`] with the file's name, and what is wrong with it or with the polygon.
pub fn read_polygon(path: &Path, tolerance: Option<f64>) -> Result<Polygon, Error> {
    let (name, shapes) = read(path, tolerance)?;
    let polygon = match shapes {
        Shapes { parts, rings, .. } if parts.is_empty() && rings.is_empty() => {
            return Err(Error::content(name, "there is no polygon in it"));
        }
        Shapes { parts, rings, .. } if rings.is_empty() => Polygon::new(parts),
        Shapes { rings, .. } => Polygon::from_rings(rings),
    };
    polygon.map_err(|e| Error::content(name, e.to_string()))
}

/// Reads lines, in the same formats: of text, each block between blank lines is one.
///
/// # Errors
/// As [`read_polygon`].
pub fn read_lines(path: &Path) -> Result<Vec<Vec<[f64; 2]>>, Error> {
    let (name, Shapes { lines, rings, .. }) = read(path, None)?;
    // Blocks of text may be either.
    let lines: Vec<Points> = lines.into_iter().chain(rings).filter(|line| line.len() > 1).collect();
    if lines.is_empty() {
        return Err(Error::content(name, "there is no line in it"));
    }
    Ok(lines)
}

fn read(path: &Path, tolerance: Option<f64>) -> Result<(String, Shapes), Error> {
    let (name, bytes) = read_bytes(path)?;
    let shapes = parse(&name, &bytes, tolerance)?;
    Ok((name, shapes))
}

fn parse(name: &str, bytes: &[u8], tolerance: Option<f64>) -> Result<Shapes, Error> {
    let no_text = || Error::content(name, "this is not text; polygons are read from GeoJSON, WKT, SVG, and rings as text");
    let whole = std::str::from_utf8(bytes).map_err(|_| no_text())?.trim_start_matches('\u{feff}');
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
        assert_eq!(shapes("0 0\n2,0 # a comment\n2\t2\n0 2\n").rings, vec![square.clone()]);
        let svg = |body: &str| format!("<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 2 2'>{body}</svg>");
        for body in [
            "<path d='M0 2 H2 V0 H0 Z'/>",
            "<polygon points='0,2 2,2 2,0 0,0'/>",
            "<g transform='translate(1 1)'><rect x='-1' y='-1' width='2' height='2'/></g>",
            "<g transform='scale(2)'><path transform='scale(0.5)' d='m0 2 2 0 0-2-2 0z'/></g>",
        ] {
            let rings = shapes(&svg(body)).rings;
            assert_eq!((rings.len(), Polygon::from_rings(rings).unwrap().area()), (1, 4.0), "{body}");
        }
    }

    #[test]
    fn curves_are_as_near_as_the_tolerance() {
        let circle = shapes("<svg xmlns='http://www.w3.org/2000/svg'><circle cx='5' cy='5' r='3'/></svg>").rings;
        assert!(circle[0].iter().all(|[x, y]| ((x - 5.0).hypot(y + 5.0) - 3.0).abs() < 2e-3), "{circle:?}");
        let area = Polygon::from_rings(circle).unwrap().area();
        assert!((area - 9.0 * std::f64::consts::PI).abs() < 0.05, "{area}");
    }

    #[test]
    fn rings_and_lines_stand_apart() {
        let two = shapes("0 0\n9 0\n9 9\n\n# a hole\n1 1\n2 1\n2 2\n\n\n");
        assert_eq!(two.rings.iter().map(Vec::len).collect::<Vec<_>>(), [3, 3]);
        assert_eq!(shapes("LINESTRING (0 0, 1 1, 2 0)").lines[0].len(), 3);
        assert_eq!(shapes(r#"{"type":"MultiLineString","coordinates":[[[0,0],[1,1]],[[2,2],[3,3]]]}"#).lines.len(), 2);
    }

    #[test]
    fn what_cannot_be_read_is_said() {
        assert!(message("0 0\n1\n").contains("p:2"));
        assert!(message("{\"type\":\"Nonsense\"}").starts_with("p: "));
        assert!(message("POLYGON ((0 0").starts_with("p: "));
        assert!(message("<svg").starts_with("p: "));
        assert!(message("0 nan\n").contains("not a finite number"));
        assert!(message("\n\n0 0\n1 x\n").contains("p:4"));
        assert!(message("POLYGON((0 0,1 0,1 1,0 0)) POLYGON((0 0,1 0,1 1,0 0))").contains("GEOMETRYCOLLECTION"));
        assert!(message(&"GEOMETRYCOLLECTION(".repeat(100_000)).contains("deep"));
        assert!(message(&format!("<svg>{}</svg>", "<g>".repeat(3000) + &"</g>".repeat(3000))).contains("deep"));
        assert!(message("<svg><rect width='100%' height='1'/></svg>").contains("100%"));
        assert!(message("<svg><use href='#a'/></svg>").contains("<use>"));
        assert!(parse("p", &[0xff, 0xfe, 0x00], None).unwrap_err().to_string().contains("not text"));
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
            if let Ok(Shapes { parts, rings, .. }) = parse("p", text.as_bytes(), Some(0.01)) {
                let _ = Polygon::new(parts);
                let _ = Polygon::from_rings(rings);
            }
        }
    }
}
