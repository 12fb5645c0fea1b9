//! Points and figures, each as its file's format has it.

use evenly::PointSet;

use crate::figure::{Draw, Subject, figure};
use crate::meshes::map_of_points;
use crate::{Columns, Error, Extent, Format, Target, npy, render, text};

/// Writes points, or a figure of them, as the target's format has it. The recipe goes along where the format has room for a comment, and the domain.
///
/// # Errors
/// As [`Target::write`] and [`figure`].
pub fn write_points(points: &PointSet, draw: &[Draw], recipe: &str, target: &Target) -> Result<(), Error> {
    let positions = points.positions();
    let domain = Extent::of(points.space()).map_or_else(String::new, |extent| format!("\n{extent}"));
    let with_domain = || format!("{recipe}{domain}");
    let bytes = match target.format() {
        Format::Txt => text::write_txt(positions, &with_domain()).into_bytes(),
        Format::Csv => text::write_csv(positions).into_bytes(),
        Format::Npy => npy::write(positions).map_err(Error::io(&target.name()))?,
        Format::GeoJson => map_of_points(positions, &with_domain()).into_bytes(),
        Format::Svg | Format::Png | Format::Pdf => return write_figure(&points.into(), draw, recipe, target),
    };
    target.write(&bytes)
}

/// Writes points as [`write_points`], in `.csv` with the other columns of the file that they come from: a row a point.
///
/// # Errors
/// As [`write_points`].
pub fn write_table(points: &PointSet, columns: &Columns, draw: &[Draw], recipe: &str, target: &Target) -> Result<(), Error> {
    if target.format() != Format::Csv || columns.is_empty() {
        return write_points(points, draw, recipe, target);
    }
    target.write(&columns.csv(points.positions()))
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
        Format::Txt | Format::Csv | Format::Npy | Format::GeoJson => {
            return Err(target.no_figure());
        }
    };
    target.write(&rendered.map_err(|e| Error::content(target.name(), e))?)
}
