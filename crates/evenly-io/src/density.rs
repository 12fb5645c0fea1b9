//! [`DensityFile`]: a picture as a density, and what is made of its tones, as `FILE[:HOW]`.

use std::path::{Path, PathBuf};
use std::str::FromStr;

use evenly::Density;

use crate::error::Error;
use crate::photograph::{Photograph, Tone};

/// A picture, and what is made of its tones: `photo.png:invert,contrast=C,gamma=G,floor=F`.
#[derive(Debug, Clone, PartialEq)]
pub struct DensityFile {
    /// The picture.
    pub path: PathBuf,
    /// What is made of its tones.
    pub tone: Tone,
}

impl DensityFile {
    /// The picture's luma as a density.
    ///
    /// # Errors
    /// As [`Photograph::read`] and [`Photograph::density`].
    pub fn read(&self) -> Result<Density, Error> {
        Photograph::read(&self.path)?.density(&self.tone)
    }
}

impl FromStr for DensityFile {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let known = |options: &str| options.split(',').all(|option| ["invert", "contrast", "gamma", "floor"].contains(&name_of(option)));
        match text.rsplit_once(':') {
            Some((path, options)) if !path.is_empty() && known(options) => Ok(Self { path: path.into(), tone: tone(options)? }),
            Some((path, options)) if Path::new(path).is_file() && !Path::new(text).exists() => {
                Err(format!("{options:?} is none of invert, contrast=C, gamma=G and floor=F, with commas between them"))
            }
            _ if text.is_empty() => Err("it must be a picture's file".into()),
            _ => Ok(Self { path: text.into(), tone: Tone::default() }),
        }
    }
}

fn name_of(option: &str) -> &str {
    option.split_once('=').map_or(option, |(name, _)| name)
}

fn tone(options: &str) -> Result<Tone, String> {
    let mut tone = Tone::default();
    let mut seen = Vec::new();
    for option in options.split(',') {
        if seen.contains(&name_of(option)) {
            return Err(format!("{} is there twice", name_of(option)));
        }
        seen.push(name_of(option));
        let number = |is_good: fn(f64) -> bool, expected: &str| {
            let value = option.split_once('=').and_then(|(_, value)| value.parse::<f64>().ok());
            value.filter(|&value| is_good(value)).ok_or_else(|| format!("{option:?}: {} must be {expected}", name_of(option)))
        };
        match name_of(option) {
            "invert" if option == "invert" => tone.is_inverted = true,
            "invert" => return Err(format!("{option:?}: invert takes no value")),
            "contrast" => tone.contrast = number(|c| (0.0..=100.0).contains(&c), "a number from 0 to 100")?,
            "gamma" => tone.gamma = number(|g| g > 0.0 && g <= 100.0, "a number above 0, and 100 at most")?,
            _ => tone.floor = number(|f| (0.0..=1.0).contains(&f), "a number from 0 to 1")?,
        }
    }
    Ok(tone)
}
