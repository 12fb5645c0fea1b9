//! [`Drawing`]: dots and lines on a page, in millimetres, as plotters and printers take them.

use std::fmt::Write as _;

use crate::figure::{Short, sheet};
use crate::{Error, Format, Target, render};

/// A page with layers on it.
pub struct Drawing {
    /// Width and height.
    pub page_mm: [f64; 2],
    /// Drawn one after the other.
    pub layers: Vec<Layer>,
}

/// What one pen draws.
pub struct Layer {
    /// Its name, as drawing programs show it.
    pub name: String,
    /// The pen's colour, as SVG has it.
    pub colour: &'static str,
    /// The width of lines, and of dots that all are of one size.
    pub pen_mm: f64,
    /// In the order in which they are drawn.
    pub marks: Marks,
}

/// Places are from the top left corner of the page.
pub enum Marks {
    /// Touches of the pen: places, and diameters in millimetres.
    Dots(Vec<([f64; 2], f64)>),
    /// The same as circles.
    Circles(Vec<([f64; 2], f64)>),
    /// Strokes from one place to another.
    Lines(Vec<[[f64; 2]; 2]>),
}

/// A touch of the pen is this long: some programs leave out strokes of no length.
const TOUCH: &str = "h.01";
/// Marks in one element at most: programs are slow with millions of elements, and with elements of millions.
const TOGETHER: usize = 1000;
/// Pixels to a millimetre, and the largest side of a picture in pixels.
const SHARPEST: f64 = 600.0 / 25.4;
const COARSEST: f64 = 150.0 / 25.4;
const LARGEST: f64 = 16_000.0;
/// Pixels across the thinnest pen.
const ACROSS: f64 = 4.0;

impl Drawing {
    /// Writes it as the target's format has it, the recipe as a comment.
    ///
    /// # Errors
    /// As [`Target::write`]; [`Error::Format`] for a target that holds points.
    pub fn write(&self, recipe: &str, target: &Target) -> Result<(), Error> {
        let svg = self.svg(recipe);
        let rendered = match target.format() {
            Format::Svg => Ok(svg.into_bytes()),
            Format::Png => render::png_of_page(&svg, self.pixels_per_mm(), recipe),
            Format::Pdf => render::pdf_of_page(&svg, recipe),
            Format::Txt | Format::Csv | Format::Npy | Format::GeoJson => return Err(target.no_figure()),
        };
        target.write(&rendered.map_err(|e| Error::content(target.name(), e))?)
    }

    fn svg(&self, recipe: &str) -> String {
        let mut body = String::new();
        for (number, layer) in self.layers.iter().enumerate() {
            let Layer { name, colour, pen_mm, marks } = layer;
            let style = match marks {
                Marks::Circles(_) => format!("fill=\"{colour}\""),
                _ => format!("fill=\"none\" stroke=\"{colour}\" stroke-width=\"{}\" stroke-linecap=\"round\"", Short(*pen_mm)),
            };
            // Programs for plotters know layers by the number that their name begins with.
            let label = format!("{} {name}", number + 1);
            let _ = writeln!(body, "<g id=\"{name}\" inkscape:groupmode=\"layer\" inkscape:label=\"{label}\" {style}>");
            marks.draw(&mut body, *pen_mm);
            body.push_str("</g>\n");
        }
        sheet(self.page_mm, recipe, &body)
    }

    /// Sharp enough for the thinnest pen, as far as a picture may be.
    fn pixels_per_mm(&self) -> f64 {
        let thinnest = self.layers.iter().map(|layer| layer.pen_mm).fold(f64::INFINITY, f64::min);
        let side = self.page_mm[0].max(self.page_mm[1]);
        (ACROSS / thinnest).clamp(COARSEST, SHARPEST).min(LARGEST / side)
    }
}

impl Marks {
    /// How far the pen goes between dots, from the first to the last; 0 for lines.
    pub fn pen_up_mm(&self) -> f64 {
        match self {
            Self::Dots(dots) | Self::Circles(dots) => {
                dots.windows(2).map(|pair| (pair[1].0[0] - pair[0].0[0]).hypot(pair[1].0[1] - pair[0].0[1])).sum()
            }
            Self::Lines(_) => 0.0,
        }
    }

    fn draw(&self, svg: &mut String, pen_mm: f64) {
        match self {
            Self::Dots(dots) => {
                for group in dots.chunk_by(|a, b| a.1 == b.1).flat_map(|group| group.chunks(TOGETHER)) {
                    let _ = match group[0].1 {
                        diameter if diameter == pen_mm => write!(svg, "<path d=\""),
                        diameter => write!(svg, "<path stroke-width=\"{}\" d=\"", Short(diameter)),
                    };
                    for ([x, y], _) in group {
                        let _ = write!(svg, "M{} {}{TOUCH}", Short(*x), Short(*y));
                    }
                    svg.push_str("\"/>\n");
                }
            }
            Self::Circles(dots) => {
                for ([x, y], diameter) in dots {
                    let _ = writeln!(svg, "<circle cx=\"{}\" cy=\"{}\" r=\"{}\"/>", Short(*x), Short(*y), Short(0.5 * diameter));
                }
            }
            Self::Lines(lines) => {
                for group in lines.chunks(TOGETHER) {
                    svg.push_str("<path d=\"");
                    for [[x, y], [to_x, to_y]] in group {
                        let _ = write!(svg, "M{} {}L{} {}", Short(*x), Short(*y), Short(*to_x), Short(*to_y));
                    }
                    svg.push_str("\"/>\n");
                }
            }
        }
    }
}
