//! A page of PDF from a tree of SVG, by crate `pdf-writer`: what our figures are made of, and an error for all else.
//!
//! These are paths, filled and stroked in plain colours, pictures, and rectangles that clip. Text is drawn as outlines, so that no font is embedded.

use std::io::Write as _;

use flate2::Compression;
use flate2::write::ZlibEncoder;
use image::{DynamicImage, ImageFormat, load_from_memory_with_format};
use pdf_writer::types::{LineCapStyle, LineJoinStyle};
use pdf_writer::{Content, Filter, Finish as _, Name, Pdf, Rect, Ref, TextStr};
use resvg::tiny_skia::{self, PathSegment};
use resvg::usvg::{
    BlendMode, ClipPath, Color, Fill, FillRule, Group, Image, ImageKind, LineCap, LineJoin, Node, Opacity, Paint, Path, Stroke, Transform,
    Tree,
};

/// A document of one page, so many points to a unit; the recipe becomes its subject.
pub(crate) fn document(tree: &Tree, scale: f32, recipe: &str) -> Result<Vec<u8>, String> {
    let (width, height) = (scale * tree.size().width(), scale * tree.size().height());
    let mut page = Page { content: Content::new(), pictures: Vec::new() };
    // PDF counts upwards.
    page.content.transform([scale, 0.0, 0.0, -scale, 0.0, height]);
    page.group(tree.root())?;
    let content = compressed(&page.content.finish())?;

    let mut free = Ref::new(1);
    let mut reference = || free.bump();
    let (catalog, pages, own, contents, info) = (reference(), reference(), reference(), reference(), reference());
    let mut pdf = Pdf::new();
    pdf.catalog(catalog).pages(pages);
    pdf.pages(pages).kids([own]).count(1);
    pdf.document_info(info).creator(TextStr("evenly")).subject(TextStr(recipe));
    let pictures: Vec<(Ref, String)> = (0..page.pictures.len()).map(|k| (reference(), name(k))).collect();
    let mut of_page = pdf.page(own);
    of_page.media_box(Rect::new(0.0, 0.0, width, height)).parent(pages).contents(contents);
    let mut resources = of_page.resources();
    let mut objects = resources.x_objects();
    for (reference, name) in &pictures {
        objects.pair(Name(name.as_bytes()), *reference);
    }
    objects.finish();
    resources.finish();
    of_page.finish();
    pdf.stream(contents, &content).filter(Filter::FlateDecode);
    for (picture, (reference, _)) in page.pictures.iter().zip(&pictures) {
        let data = compressed(picture.as_bytes())?;
        let mut object = pdf.image_xobject(*reference, &data);
        object.width(picture.width() as i32).height(picture.height() as i32).bits_per_component(8).filter(Filter::FlateDecode);
        match picture {
            DynamicImage::ImageLuma8(_) => object.color_space().device_gray(),
            _ => object.color_space().device_rgb(),
        }
    }
    Ok(pdf.finish())
}

/// What a page's pictures are called.
fn name(picture: usize) -> String {
    format!("P{picture}")
}

fn compressed(bytes: &[u8]) -> Result<Vec<u8>, String> {
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::default());
    encoder.write_all(bytes).and_then(|()| encoder.finish()).map_err(|e| e.to_string())
}

struct Page {
    content: Content,
    /// In grey or colours, eight bits each.
    pictures: Vec<DynamicImage>,
}

impl Page {
    fn group(&mut self, group: &Group) -> Result<(), String> {
        let is_plain = group.opacity() == Opacity::ONE && group.blend_mode() == BlendMode::Normal;
        if !is_plain || group.mask().is_some() || !group.filters().is_empty() {
            return Err("it has parts that are seen through, masked or filtered".into());
        }
        self.content.save_state().transform(matrix(group.transform()));
        if let Some(clip) = group.clip_path() {
            self.clip(clip)?;
        }
        for node in group.children() {
            match node {
                Node::Group(group) => self.group(group)?,
                Node::Path(path) => self.path(path)?,
                Node::Image(image) => self.image(image)?,
                Node::Text(text) => self.group(text.flattened())?,
            }
        }
        self.content.restore_state();
        Ok(())
    }

    fn clip(&mut self, clip: &ClipPath) -> Result<(), String> {
        if let Some(clip) = clip.clip_path() {
            self.clip(clip)?;
        }
        for node in clip.root().children() {
            let Node::Path(path) = node else { return Err("it is clipped by more than paths".into()) };
            let data = path.data().clone().transform(clip.transform()).ok_or("a clip has no size")?;
            self.outline(&data);
        }
        self.content.clip_nonzero().end_path();
        Ok(())
    }

    fn path(&mut self, path: &Path) -> Result<(), String> {
        if !path.is_visible() {
            return Ok(());
        }
        if let Some(fill) = path.fill() {
            let [red, green, blue] = colour(fill.paint(), fill.opacity())?;
            self.content.set_fill_rgb(red, green, blue);
        }
        if let Some(stroke) = path.stroke() {
            let [red, green, blue] = colour(stroke.paint(), stroke.opacity())?;
            self.content.set_stroke_rgb(red, green, blue);
            self.pen(stroke);
        }
        self.outline(path.data());
        match (path.fill().map(Fill::rule), path.stroke().is_some()) {
            (Some(FillRule::NonZero), true) => self.content.fill_nonzero_and_stroke(),
            (Some(FillRule::EvenOdd), true) => self.content.fill_even_odd_and_stroke(),
            (Some(FillRule::NonZero), false) => self.content.fill_nonzero(),
            (Some(FillRule::EvenOdd), false) => self.content.fill_even_odd(),
            (None, true) => self.content.stroke(),
            (None, false) => self.content.end_path(),
        };
        Ok(())
    }

    fn pen(&mut self, stroke: &Stroke) {
        let cap = match stroke.linecap() {
            LineCap::Butt => LineCapStyle::ButtCap,
            LineCap::Round => LineCapStyle::RoundCap,
            LineCap::Square => LineCapStyle::ProjectingSquareCap,
        };
        let join = match stroke.linejoin() {
            LineJoin::Miter | LineJoin::MiterClip => LineJoinStyle::MiterJoin,
            LineJoin::Round => LineJoinStyle::RoundJoin,
            LineJoin::Bevel => LineJoinStyle::BevelJoin,
        };
        let dashes = stroke.dasharray().unwrap_or_default().iter().copied();
        self.content
            .set_line_width(stroke.width().get())
            .set_line_cap(cap)
            .set_line_join(join)
            .set_miter_limit(stroke.miterlimit().get())
            .set_dash_pattern(dashes, stroke.dashoffset());
    }

    fn outline(&mut self, path: &tiny_skia::Path) {
        let mut last = tiny_skia::Point::zero();
        for segment in path.segments() {
            match segment {
                PathSegment::MoveTo(p) => self.content.move_to(p.x, p.y),
                PathSegment::LineTo(p) => self.content.line_to(p.x, p.y),
                PathSegment::QuadTo(c, p) => {
                    // As a cubic curve, which is all that PDF has.
                    let towards = |end: tiny_skia::Point| [end.x + 2.0 / 3.0 * (c.x - end.x), end.y + 2.0 / 3.0 * (c.y - end.y)];
                    let ([x1, y1], [x2, y2]) = (towards(last), towards(p));
                    self.content.cubic_to(x1, y1, x2, y2, p.x, p.y)
                }
                PathSegment::CubicTo(a, b, p) => self.content.cubic_to(a.x, a.y, b.x, b.y, p.x, p.y),
                PathSegment::Close => self.content.close_path(),
            };
            if let PathSegment::MoveTo(p) | PathSegment::LineTo(p) | PathSegment::QuadTo(_, p) | PathSegment::CubicTo(_, _, p) = segment {
                last = p;
            }
        }
    }

    fn image(&mut self, image: &Image) -> Result<(), String> {
        let ImageKind::PNG(data) = image.kind() else { return Err("it has pictures that are no PNG".into()) };
        let picture = load_from_memory_with_format(data, ImageFormat::Png).map_err(|e| e.to_string())?;
        if picture.color().has_alpha() {
            return Err("it has pictures that are seen through".into());
        }
        let picture = match picture {
            DynamicImage::ImageLuma8(_) => picture,
            other => other.into_rgb8().into(),
        };
        let (width, height) = (image.size().width(), image.size().height());
        self.content.save_state().transform([width, 0.0, 0.0, -height, 0.0, height]);
        self.content.x_object(Name(name(self.pictures.len()).as_bytes())).restore_state();
        self.pictures.push(picture);
        Ok(())
    }
}

fn matrix(transform: Transform) -> [f32; 6] {
    [transform.sx, transform.ky, transform.kx, transform.sy, transform.tx, transform.ty]
}

/// A plain colour, each part up to 1.
fn colour(paint: &Paint, opacity: Opacity) -> Result<[f32; 3], String> {
    match *paint {
        Paint::Color(Color { red, green, blue }) if opacity == Opacity::ONE => Ok([red, green, blue].map(|part| f32::from(part) / 255.0)),
        _ => Err("it has paint that is no plain colour".into()),
    }
}

#[cfg(test)]
mod tests {
    use crate::render::{pdf, pdf_of_page};

    fn drawn(body: &str) -> String {
        format!("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"210mm\" height=\"297mm\" viewBox=\"0 0 210 297\">{body}</svg>")
    }

    #[test]
    fn a_page_is_as_large_as_its_paper() {
        let page = pdf_of_page(&drawn("<path d=\"M1 1h10v10z\"/>"), "a recipe").unwrap();
        let text = String::from_utf8_lossy(&page);
        assert!(text.starts_with("%PDF") && text.trim_end().ends_with("%%EOF"), "{text}");
        assert!(text.contains("/MediaBox [0 0 595.27"), "{text}");
        assert!(text.contains("/Subject (a recipe)"), "{text}");
    }

    #[test]
    fn what_figures_are_not_made_of_is_an_error() {
        for body in [
            "<path d=\"M1 1h10v10z\" fill-opacity=\"0.5\"/>",
            "<g opacity=\"0.5\"><path d=\"M1 1h10v10z\"/><path d=\"M2 2h10v10z\"/></g>",
            "<linearGradient id=\"a\"><stop offset=\"0\"/><stop offset=\"1\" stop-color=\"red\"/></linearGradient><path d=\"M1 1h10v10z\" fill=\"url(#a)\"/>",
        ] {
            assert!(pdf(&drawn(body), "").is_err(), "{body}");
        }
    }
}
