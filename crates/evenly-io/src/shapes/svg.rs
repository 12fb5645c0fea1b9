//! SVG: what paths, polygons, rectangles, circles and ellipses enclose, wherever they stand and however they are drawn. y points upwards.

use kurbo::{Affine, BezPath, Circle, Ellipse, PathEl, Rect, Shape as _};
use roxmltree::{Document, Node};

use super::{Points, Shapes};

/// How far off flattened curves may be, in the drawing's size, if nothing else is said.
const TOLERANCE: f64 = 1e-3;
/// And how near they are in any case, in the same.
const FINEST: f64 = 1e-9;
/// Groups in groups go no deeper than this.
const DEEPEST: usize = 1000;

pub(super) fn read(text: &str, tolerance: Option<f64>) -> Result<Shapes, String> {
    let options = roxmltree::ParsingOptions { allow_dtd: true, ..roxmltree::ParsingOptions::default() };
    let document = Document::parse_with_options(text, options).map_err(|e| format!("this is no SVG: {e}"))?;
    let root = document.root_element();
    if root.tag_name().name() != "svg" {
        return Err(format!("its root is <{}>, expected <svg>", root.tag_name().name()));
    }
    let mut paths = Vec::new();
    collect(root, Affine::IDENTITY, 0, &mut paths)?;
    let bounds = paths.iter().map(BezPath::bounding_box).reduce(|a, b| a.union(b)).unwrap_or_default();
    let size = bounds.width().max(bounds.height());
    let tolerance = tolerance.unwrap_or(TOLERANCE * size).max(FINEST * size).max(f64::MIN_POSITIVE);
    // The view box' lower side is where y is 0.
    let bottom = root.attribute("viewBox").map(numbers).transpose()?.filter(|view| view.len() == 4).map_or(0.0, |view| view[1] + view[3]);
    let mut shapes = Shapes::default();
    for path in paths {
        let mut ring: Points = Vec::new();
        let mut is_closed = false;
        let mut end = |ring: &mut Points, is_closed: bool| {
            let points = std::mem::take(ring);
            let is_ring = is_closed || points.len() > 3 && points.first() == points.last();
            match points.len() {
                0 | 1 => {}
                _ if is_ring => shapes.rings.push(points),
                _ => shapes.lines.push(points),
            }
        };
        kurbo::flatten(path, tolerance, |element| match element {
            PathEl::MoveTo(p) => {
                end(&mut ring, is_closed);
                is_closed = false;
                ring.push([p.x, bottom - p.y]);
            }
            PathEl::LineTo(p) => ring.push([p.x, bottom - p.y]),
            PathEl::ClosePath => is_closed = true,
            PathEl::QuadTo(..) | PathEl::CurveTo(..) => {}
        });
        end(&mut ring, is_closed);
    }
    Ok(shapes)
}

/// Gathers what elements draw, in the drawing's own units.
fn collect(node: Node, outer: Affine, depth: usize, paths: &mut Vec<BezPath>) -> Result<(), String> {
    if depth > DEEPEST {
        return Err(format!("groups lie more than {DEEPEST} deep in each other"));
    }
    if node.attribute("display") == Some("none") {
        return Ok(());
    }
    let own = match node.attribute("transform") {
        Some(text) => {
            let t: svgtypes::Transform = text.parse().map_err(|e| format!("transform {text:?}: {e}"))?;
            Affine::new([t.a, t.b, t.c, t.d, t.e, t.f])
        }
        None => Affine::IDENTITY,
    };
    let place = outer * own;
    let number = |name: &str| node.attribute(name).map_or(Ok(0.0), |text| number(name, text));
    let path = match node.tag_name().name() {
        // What only others refer to is not drawn.
        "defs" | "symbol" | "clipPath" | "mask" | "pattern" | "marker" => return Ok(()),
        "path" => {
            let text = node.attribute("d").unwrap_or_default();
            Some(BezPath::from_svg(text).map_err(|e| format!("a path's d: {e}"))?)
        }
        "polygon" | "polyline" => {
            let numbers = numbers(node.attribute("points").unwrap_or_default())?;
            let mut path = BezPath::new();
            for (k, point) in numbers.chunks_exact(2).enumerate() {
                let point = (point[0], point[1]);
                if k == 0 { path.move_to(point) } else { path.line_to(point) }
            }
            if node.tag_name().name() == "polygon" && numbers.len() > 1 {
                path.close_path();
            }
            Some(path)
        }
        "line" => {
            let mut path = BezPath::new();
            path.move_to((number("x1")?, number("y1")?));
            path.line_to((number("x2")?, number("y2")?));
            Some(path)
        }
        "rect" => {
            let (x, y) = (number("x")?, number("y")?);
            let rect = Rect::new(x, y, x + number("width")?, y + number("height")?);
            let radius = node.attribute("rx").or(node.attribute("ry")).map_or(Ok(0.0), |text| self::number("rx", text))?;
            if radius > 0.0 { Some(rect.to_rounded_rect(radius).to_path(EXACT)) } else { Some(rect.to_path(EXACT)) }
        }
        "use" => return Err("<use> is not read; let your program replace it by what it shows".into()),
        "circle" => Some(Circle::new((number("cx")?, number("cy")?), number("r")?).to_path(EXACT)),
        "ellipse" => Some(Ellipse::new((number("cx")?, number("cy")?), (number("rx")?, number("ry")?), 0.0).to_path(EXACT)),
        _ => None,
    };
    if let Some(path) = path {
        let path = place * path;
        if !path.elements().is_empty() && path.is_finite() {
            paths.push(path);
        }
    }
    node.children().filter(Node::is_element).try_for_each(|child| collect(child, place, depth + 1, paths))
}

/// How near curves come to round shapes, before they are flattened.
const EXACT: f64 = 1e-9;

fn number(name: &str, text: &str) -> Result<f64, String> {
    let length: svgtypes::Length = text.parse().map_err(|_| format!("{name}={text:?} is not a number"))?;
    match length.unit {
        svgtypes::LengthUnit::None | svgtypes::LengthUnit::Px => Ok(length.number),
        _ => Err(format!("{name}={text:?} has a unit; lengths are read in the drawing's own")),
    }
}

fn numbers(text: &str) -> Result<Vec<f64>, String> {
    svgtypes::NumberListParser::from(text).collect::<Result<_, _>>().map_err(|e| format!("{text:?}: {e}"))
}
