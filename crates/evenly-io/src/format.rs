//! File formats, and the endings by which they are known.

use std::path::Path;

use crate::Error;

/// A format of points or figures.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// `x y` a line.
    Txt,
    /// `x,y` a line, after a line of names.
    Csv,
    /// A numpy array of shape (n, 2), float64.
    Npy,
    /// A feature a point.
    GeoJson,
    /// A figure, scalable.
    Svg,
    /// A figure, in pixels.
    Png,
    /// A figure, as a page.
    Pdf,
}

impl Format {
    /// All formats, by name.
    pub const ALL: [(&'static str, Self); 7] = [
        ("txt", Self::Txt),
        ("csv", Self::Csv),
        ("npy", Self::Npy),
        ("geojson", Self::GeoJson),
        ("svg", Self::Svg),
        ("png", Self::Png),
        ("pdf", Self::Pdf),
    ];

    /// The format that a name stands for.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.iter().find(|(known, _)| name.eq_ignore_ascii_case(known)).map(|&(_, format)| format)
    }

    /// The format that a file's ending stands for.
    ///
    /// # Errors
    /// [`Error::Format`] for a file without an ending, or one that is not known.
    pub fn of_path(path: &Path) -> Result<Self, Error> {
        let unknown = |problem| Error::Format { name: path.display().to_string(), problem, choices: Self::endings(|_| true) };
        let ending = path.extension().ok_or_else(|| unknown("no ending that tells the format"))?;
        ending.to_str().and_then(Self::from_name).ok_or_else(|| unknown("unknown ending"))
    }

    /// Whether points can be read back from it.
    pub fn holds_points(self) -> bool {
        matches!(self, Self::Txt | Self::Csv | Self::Npy | Self::GeoJson)
    }

    pub(crate) fn endings(is_good: impl Fn(Self) -> bool) -> String {
        let good: Vec<String> = Self::ALL.iter().filter(|&&(_, format)| is_good(format)).map(|(name, _)| format!(".{name}")).collect();
        good.join(" ")
    }
}
