//! Points in space as files, with what belongs to each: a line a point.

use std::fmt::Write as _;
use std::path::Path;

use evenly::TriangleMesh;

use crate::meshes::ply;
use crate::text::Shortest;
use crate::{Error, Target};

/// A format of points in space.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CloudFormat {
    /// Stanford's, binary.
    Ply,
    /// Stanford's, as text.
    PlyText,
    /// Numbers with commas, after a line of names.
    Csv,
    /// Numbers with blanks, after a comment of names.
    Txt,
}

impl CloudFormat {
    /// All formats, by name.
    pub const ALL: [(&'static str, Self); 3] = [("ply", Self::Ply), ("csv", Self::Csv), ("txt", Self::Txt)];

    /// The format that a name stands for.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.iter().find(|(known, _)| name.eq_ignore_ascii_case(known)).map(|&(_, format)| format)
    }

    /// The format that a file's ending stands for.
    ///
    /// # Errors
    /// [`Error::Format`] for a file without an ending, or one that is not known.
    pub fn of_path(path: &Path) -> Result<Self, Error> {
        let unknown = |problem| {
            let choices = Self::ALL.iter().map(|(name, _)| format!(".{name}")).collect::<Vec<_>>().join(" ");
            Error::Format { name: path.display().to_string(), problem, choices }
        };
        let ending = path.extension().ok_or_else(|| unknown("no ending that tells the format"))?;
        ending.to_str().and_then(Self::from_name).ok_or_else(|| unknown("unknown ending"))
    }
}

/// Writes the vertices of a mesh and their attributes; the recipe goes along but in `.csv`.
///
/// # Errors
/// As [`Target::write`].
pub fn write_cloud(points: &TriangleMesh, format: CloudFormat, recipe: &str, target: &Target) -> Result<(), Error> {
    let recipe = recipe.replace(['\n', '\r'], " ");
    let names = || ["x", "y", "z"].into_iter().chain(points.attributes.iter().map(|attribute| attribute.name.as_str()));
    let text = match format {
        CloudFormat::Ply | CloudFormat::PlyText => return target.write(&ply(points, &recipe, format == CloudFormat::PlyText)),
        CloudFormat::Csv => rows(points, names().collect::<Vec<_>>().join(",") + "\n", ","),
        CloudFormat::Txt => rows(points, format!("# {recipe}\n# {}\n", names().collect::<Vec<_>>().join(" ")), " "),
    };
    target.write(text.as_bytes())
}

fn rows(points: &TriangleMesh, mut text: String, separator: &str) -> String {
    for (v, position) in points.vertices.iter().enumerate() {
        let numbers = position.iter().copied().chain(points.attributes.iter().map(|attribute| attribute.values[v]));
        for (k, number) in numbers.enumerate() {
            let before = if k > 0 { separator } else { "" };
            let _ = write!(text, "{before}{}", Shortest(number));
        }
        text.push('\n');
    }
    text
}
