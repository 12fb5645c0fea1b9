//! Pictures: PNG, JPEG, TIFF, WebP, GIF and BMP in, PNG out.

use std::io::Cursor;
use std::path::Path;

use evenly::Image;
use image::{DynamicImage, ImageDecoder as _, ImageReader, Limits};

use crate::file::read_bytes;
use crate::memory::require;
use crate::pixels::{bytes, colour, encode};
use crate::tiff::Numbers;
use crate::{Error, Target};

/// What a picture has besides pixels, such as a colour profile, takes no more bytes than this.
const MOST_BESIDES: u64 = 100_000_000;
/// So many times the decoded pixels are in memory while a picture is read.
const COPIES: u64 = 3;

/// Reads a PNG, JPEG, TIFF, WebP, GIF or BMP, grey or in colour; what is transparent lies on white. `-` is stdin.
///
/// Floats and integers of a TIFF that are no tones are divided by the largest where that is above 1; negative ones, and what is no
/// number or marked as none, are 0.
///
/// # Errors
/// [`Error`] with the file's name, for what is no such picture, and for more than [`Image::MOST_PIXELS`].
pub fn read_image(path: &Path) -> Result<Image, Error> {
    let (name, picture) = decode(path, Image::MOST_PIXELS)?;
    let (width, height) = (picture.width(), picture.height());
    let (n_channels, values) = values(picture);
    Image::new(width as usize, height as usize, n_channels, values).map_err(|e| Error::content(&name, e.to_string()))
}

/// A picture's file name for messages, and its pixels as they are meant to be seen.
pub(crate) fn decode(path: &Path, most_pixels: usize) -> Result<(String, DynamicImage), Error> {
    let (name, bytes) = read_bytes(path)?;
    let unreadable = |e: image::ImageError| Error::content(&name, format!("not a readable PNG, JPEG, TIFF, WebP, GIF or BMP ({e})"));
    if bytes.starts_with(b"\xff\xd8") && !is_whole_jpeg(&bytes) {
        return Err(Error::content(&name, "not a whole JPEG: its end is missing"));
    }
    if let Some(numbers) = Numbers::of(&bytes) {
        refuse_large(&name, numbers.width, numbers.height, most_pixels)?;
        require(&name, numbers.needed())?;
        let picture = numbers.read().map_err(|e| Error::content(&name, format!("not a readable TIFF ({e})")))?;
        return Ok((name, picture));
    }
    let mut reader = ImageReader::new(Cursor::new(&bytes));
    reader.limits(limits(MOST_BESIDES));
    let mut decoder = reader.with_guessed_format().map_err(|e| unreadable(e.into()))?.into_decoder().map_err(unreadable)?;
    let (width, height) = decoder.dimensions();
    refuse_large(&name, width, height, most_pixels)?;
    let needed = decoder.total_bytes();
    require(&name, needed.saturating_mul(COPIES))?;
    decoder.set_limits(limits(needed.saturating_mul(COPIES).saturating_add(MOST_BESIDES))).map_err(unreadable)?;
    // Cameras turn the picture, not the pixels.
    let orientation = decoder.orientation().map_err(unreadable)?;
    let mut picture = DynamicImage::from_decoder(decoder).map_err(unreadable)?;
    picture.apply_orientation(orientation);
    Ok((name, picture))
}

fn refuse_large(name: &str, width: u32, height: u32, most_pixels: usize) -> Result<(), Error> {
    if u64::from(width) * u64::from(height) > most_pixels as u64 {
        let problem = format!("{width} x {height} pixels; at most {most_pixels} are possible: make it smaller");
        return Err(Error::content(name, problem));
    }
    Ok(())
}

/// At most so many bytes for a decoder.
fn limits(bytes: u64) -> Limits {
    let mut limits = Limits::no_limits();
    limits.max_alloc = Some(bytes);
    limits
}

/// Whether the end is marked after the last scan: decoders make grey of what is missing. Neither mark is found in a scan.
fn is_whole_jpeg(bytes: &[u8]) -> bool {
    let last = |mark: [u8; 2]| bytes.windows(2).rposition(|pair| pair == mark);
    last([0xff, 0xd9]) > last([0xff, 0xda])
}

/// One number or three a pixel.
fn values(picture: DynamicImage) -> (usize, Vec<f64>) {
    let is_grey = |p: &DynamicImage| p.as_rgb32f().is_some_and(|p| p.pixels().all(|p| p[0] == p[1] && p[1] == p[2]));
    let has_colour = picture.color().has_color() && !is_grey(&picture);
    if !picture.color().has_alpha() {
        return match has_colour {
            true => (3, picture.into_rgb32f().into_raw().into_iter().map(f64::from).collect()),
            false if picture.as_rgb32f().is_some() => (1, picture.into_rgb32f().pixels().map(|p| f64::from(p[0])).collect()),
            false => (1, picture.into_luma16().into_raw().into_iter().map(|grey| f64::from(grey) / 65535.0).collect()),
        };
    }
    let on_white = |value: f32, alpha: f32| f64::from(value * alpha + 1.0 - alpha);
    let pixels = picture.into_rgba32f().into_raw();
    let n_channels = if has_colour { 3 } else { 1 };
    (n_channels, pixels.chunks_exact(4).flat_map(|p| p[..n_channels].iter().map(|&value| on_white(value, p[3]))).collect())
}

/// Writes a picture to a [`Target::picture`], as PNG of 8 bits a channel; values below 0 and above 1 are cut off. The recipe becomes its comment.
///
/// # Errors
/// As [`Target::write`].
pub fn write_image(image: &Image, recipe: &str, target: &Target) -> Result<(), Error> {
    let bytes = encode(&bytes(image), image.width() as u32, image.height() as u32, colour(image), recipe);
    target.write(&bytes.map_err(|e| Error::content(target.name(), e.to_string()))?)
}
