//! SVG: what is filled in a drawing, and what lines run through it. Styles, units, transforms and
//! references are resolved by `usvg`, whose coordinates have seven digits. y points upwards.
//!
//! Text, pictures and masks are not read.

use evenly::{FillRule, Shape};
use kurbo::{Affine, BezPath, PathEl};
use roxmltree::Document;
use usvg::tiny_skia_path::PathSegment;
use usvg::{ClipPath, Group, Node, Options, Path, Tree};

use super::entities::expanded_length;
use super::{Points, Shapes, close};
use crate::memory::bytes_told;

/// How far off flattened curves may be, in the drawing's size, if nothing else is said.
const TOLERANCE: f64 = 1e-3;
/// And how near they are in any case, in the same.
const FINEST: f64 = 1e-7;
/// A drawing's own entities make no more bytes of it than this, but for doubling it.
const LONGEST: u64 = 50_000_000;
/// Elements in elements go no deeper than this.
const DEEPEST: usize = 1000;

pub(super) fn read(text: &str, tolerance: Option<f64>) -> Result<Shapes, String> {
    let (text, top) = in_own_units(text)?;
    let mut options = Options::default();
    // No picture is looked for in files.
    options.image_href_resolver.resolve_string = Box::new(|_, _| None);
    let tree = Tree::from_str(&text, &options).map_err(|e| format!("this is no SVG: {e}"))?;
    let bounds = tree.root().abs_bounding_box();
    let size = f64::from(bounds.width().max(bounds.height()));
    let tolerance = tolerance.unwrap_or(TOLERANCE * size).max(FINEST * size).max(f64::MIN_POSITIVE);
    // y is 0 on the drawing's lower side.
    let place = Affine::new([1.0, 0.0, 0.0, -1.0, 0.0, top + f64::from(tree.size().height())]);
    let mut drawn = Drawn::default();
    drawn.add(tree.root(), place, &[], tolerance);
    let Drawn { mut filled, closed, lines } = drawn;
    if filled.is_empty() && !closed.is_empty() {
        // Outlines, as of what a laser cuts.
        filled.push(Shape { rings: closed, ..Shape::default() });
    }
    Ok(Shapes { filled, lines, ..Shapes::default() })
}

/// The drawing with a view box that moves and scales nothing, so that all coordinates are the
/// drawing's own; and where it begins in y.
fn in_own_units(text: &str) -> Result<(String, f64), String> {
    let length = expanded_length(text);
    if length > LONGEST.max(2 * text.len() as u64) {
        return Err(format!("its own entities make {} of it; at most {} are read", bytes_told(length), bytes_told(LONGEST)));
    }
    let options = roxmltree::ParsingOptions { allow_dtd: true, ..roxmltree::ParsingOptions::default() };
    let document = Document::parse_with_options(text, options).map_err(|e| format!("this is no SVG: {e}"))?;
    let root = document.root_element();
    if root.tag_name().name() != "svg" {
        return Err(format!("its root is <{}>, expected <svg>", root.tag_name().name()));
    }
    if document.descendants().any(|node| node.ancestors().nth(DEEPEST).is_some()) {
        return Err(format!("elements lie more than {DEEPEST} deep in each other"));
    }
    let view: Option<svgtypes::ViewBox> = root.attribute("viewBox").and_then(|view| view.parse().ok());
    let Some(view) = view else { return Ok((text.to_owned(), 0.0)) };
    let mut attributes: Vec<_> = root.attributes().filter(|a| ["viewBox", "width", "height"].contains(&a.name())).collect();
    attributes.sort_by_key(|attribute| std::cmp::Reverse(attribute.range().start));
    let mut own = text.to_owned();
    for attribute in attributes {
        let instead = if attribute.name() == "viewBox" { format!("viewBox=\"0 0 {} {}\"", view.w, view.h) } else { String::new() };
        own.replace_range(attribute.range(), &instead);
    }
    Ok((own, view.y))
}

/// What a drawing shows.
#[derive(Default)]
struct Drawn {
    filled: Vec<Shape>,
    /// Closed outlines, filled or not.
    closed: Vec<Points>,
    /// All outlines; of closed ones the first point ends them once more.
    lines: Vec<Points>,
}

impl Drawn {
    /// Adds what a group shows inside of all clips.
    fn add(&mut self, group: &Group, place: Affine, clips: &[Vec<Shape>], tolerance: f64) {
        if group.opacity().get() == 0.0 {
            return;
        }
        let mut clips = clips.to_vec();
        let mut clip = group.clip_path();
        while let Some(path) = clip {
            clips.push(shown_by(path, place * affine(group.abs_transform()), tolerance));
            clip = path.clip_path();
        }
        for node in group.children() {
            match node {
                Node::Group(group) => self.add(group, place, &clips, tolerance),
                Node::Path(path) if path.is_visible() => self.add_path(path, place, &clips, tolerance),
                Node::Path(_) | Node::Image(_) | Node::Text(_) => {}
            }
        }
    }

    fn add_path(&mut self, path: &Path, place: Affine, clips: &[Vec<Shape>], tolerance: f64) {
        let outlines = outlines(&(place * affine(path.abs_transform()) * curves(path)), tolerance);
        if let Some(fill) = path.fill().filter(|fill| fill.opacity().get() > 0.0) {
            let rule = match fill.rule() {
                usvg::FillRule::NonZero => FillRule::NonZero,
                usvg::FillRule::EvenOdd => FillRule::EvenOdd,
            };
            self.filled.push(Shape { rings: outlines.clone(), rule, clips: clips.to_vec() });
        }
        self.closed.extend(outlines.iter().filter(|line| line.len() > 3 && line.first() == line.last()).cloned());
        self.lines.extend(outlines);
    }
}

/// What lies inside of a clip.
fn shown_by(clip: &ClipPath, place: Affine, tolerance: f64) -> Vec<Shape> {
    let mut drawn = Drawn::default();
    drawn.add(clip.root(), place * affine(clip.transform()), &[], tolerance);
    drawn.filled
}

fn affine(t: usvg::Transform) -> Affine {
    Affine::new([t.sx, t.ky, t.kx, t.sy, t.tx, t.ty].map(f64::from))
}

fn curves(path: &Path) -> BezPath {
    let point = |p: usvg::tiny_skia_path::Point| (f64::from(p.x), f64::from(p.y));
    let element = |segment| match segment {
        PathSegment::MoveTo(p) => PathEl::MoveTo(point(p).into()),
        PathSegment::LineTo(p) => PathEl::LineTo(point(p).into()),
        PathSegment::QuadTo(p, q) => PathEl::QuadTo(point(p).into(), point(q).into()),
        PathSegment::CubicTo(p, q, r) => PathEl::CurveTo(point(p).into(), point(q).into(), point(r).into()),
        PathSegment::Close => PathEl::ClosePath,
    };
    path.data().segments().map(element).collect()
}

/// The path as lines, one for each of its parts.
fn outlines(path: &BezPath, tolerance: f64) -> Vec<Points> {
    let mut outlines: Vec<Points> = Vec::new();
    kurbo::flatten(path, tolerance, |element| match element {
        PathEl::MoveTo(p) => outlines.push(vec![[p.x, p.y]]),
        PathEl::LineTo(p) => outlines.last_mut().into_iter().for_each(|line| line.push([p.x, p.y])),
        PathEl::ClosePath => outlines.last_mut().into_iter().for_each(close),
        PathEl::QuadTo(..) | PathEl::CurveTo(..) => {}
    });
    outlines.retain(|line| line.len() > 1 && line.iter().flatten().all(|x| x.is_finite()));
    outlines
}
