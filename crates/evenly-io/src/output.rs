//! Points and figures, each as its file's format has it.

use evenly::PointSet;

use crate::figure::{Draw, Subject, figure};
use crate::{Error, Format, Target, npy, render, text};

/// Writes points, or a figure of them, as the target's format has it. The recipe goes along where the format has room for a comment.
///
/// # Errors
/// As [`Target::write`] and [`figure`].
pub fn write_points(points: &PointSet, draw: &[Draw], recipe: &str, target: &Target) -> Result<(), Error> {
    let positions = points.positions();
    let bytes = match target.format() {
        Format::Txt => text::write_txt(positions, recipe).into_bytes(),
        Format::Csv => text::write_csv(positions).into_bytes(),
        Format::Npy => npy::write(positions).map_err(Error::io(&target.name()))?,
        Format::Svg | Format::Png | Format::Pdf => return write_figure(&points.into(), draw, recipe, target),
    };
    target.write(&bytes)
}

/// Writes a figure. The recipe goes along as a comment.
///
/// # Errors
/// As [`Target::write`] and [`figure`]; [`Error::Format`] for a target that holds points.
pub fn write_figure(subject: &Subject, draw: &[Draw], recipe: &str, target: &Target) -> Result<(), Error> {
    write_svg(figure(subject, draw, recipe)?, recipe, target)
}

/// Writes a drawing, as the target's format has it.
pub(crate) fn write_svg(svg: String, recipe: &str, target: &Target) -> Result<(), Error> {
    let rendered = match target.format() {
        Format::Png => render::png(&svg, recipe),
        Format::Pdf => render::pdf(&svg, recipe),
        Format::Svg => Ok(svg.into_bytes()),
        Format::Txt | Format::Csv | Format::Npy => {
            return Err(target.no_figure());
        }
    };
    target.write(&rendered.map_err(|e| Error::content(target.name(), e))?)
}
