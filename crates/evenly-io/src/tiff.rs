//! TIFFs of measured numbers and of palettes, which the picture library does not read: floats and integers of any size as
//! geographers' tools write them, and indices into a table of colours.

use std::borrow::Cow;
use std::io::Cursor;

use image::{DynamicImage, ImageBuffer};
use tiff::TiffError;
use tiff::decoder::{Decoder, DecodingResult, Limits};
use tiff::tags::{PhotometricInterpretation, SampleFormat, Tag};

/// Of which sort the samples are: tag 262 of TIFF 6.0.
const PHOTOMETRIC: u16 = 262;
/// Which number stands for "no number here", as text; GDAL's tag.
const NO_DATA: Tag = Tag::Unknown(42113);
/// Bytes of memory that a pixel takes while it is read.
const OF_PIXEL: u64 = 32;

/// A TIFF that only this module reads.
pub(crate) struct Numbers<'a> {
    decoder: Decoder<Cursor<Cow<'a, [u8]>>>,
    palette: Option<Vec<u16>>,
    bits: u32,
    no_data: Option<f64>,
    is_white_zero: bool,
    pub width: u32,
    pub height: u32,
}

impl<'a> Numbers<'a> {
    /// `None` where the bytes are no TIFF, or one of 8- or 16-bit tones or colours.
    pub fn of(bytes: &'a [u8]) -> Option<Self> {
        let mut decoder = Decoder::new(Cursor::new(Cow::Borrowed(bytes))).ok()?;
        let sort = decoder.find_tag_unsigned::<u16>(Tag::PhotometricInterpretation).ok()??;
        let sort = PhotometricInterpretation::from_u16(sort)?;
        let tags = |decoder: &mut Decoder<_>, tag| decoder.find_tag_unsigned_vec::<u16>(tag).ok().flatten().unwrap_or_default();
        let bits = u32::from(tags(&mut decoder, Tag::BitsPerSample).first().copied().unwrap_or(1));
        let format = tags(&mut decoder, Tag::SampleFormat).first().copied().unwrap_or(SampleFormat::Uint.to_u16());
        let n_samples = tags(&mut decoder, Tag::SamplesPerPixel).first().copied().unwrap_or(1);
        let palette = match sort {
            PhotometricInterpretation::RGBPalette => Some(tags(&mut decoder, Tag::ColorMap)),
            PhotometricInterpretation::BlackIsZero | PhotometricInterpretation::WhiteIsZero => {
                let is_tone = format == SampleFormat::Uint.to_u16() && n_samples == 1 && matches!(bits, 1 | 8 | 16);
                if is_tone {
                    return None;
                }
                None
            }
            _ => return None,
        };
        let no_data = decoder.get_tag_ascii_string(NO_DATA).ok().and_then(|text| text.trim_matches(['\0', ' ']).parse().ok());
        let is_white_zero = sort == PhotometricInterpretation::WhiteIsZero;
        if palette.is_some() {
            // The library reads no palettes, but indices as if they were greys.
            decoder = Decoder::new(Cursor::new(Cow::Owned(as_greys(bytes)?))).ok()?;
        }
        let (width, height) = decoder.dimensions().ok()?;
        Some(Self { decoder, palette, bits, no_data, is_white_zero, width, height })
    }

    /// How many bytes reading it takes.
    pub fn needed(&self) -> u64 {
        u64::from(self.width) * u64::from(self.height) * OF_PIXEL
    }

    /// Its colours; or its first numbers as greys: negative ones and what is no number as 0, divided by the largest where that is above 1.
    pub fn read(mut self) -> Result<DynamicImage, TiffError> {
        let mut limits = Limits::default();
        limits.decoding_buffer_size = usize::try_from(self.needed()).unwrap_or(usize::MAX);
        self.decoder = self.decoder.with_limits(limits);
        let samples = self.decoder.read_image()?;
        let is_signed = matches!(samples, DecodingResult::I8(_) | DecodingResult::I16(_) | DecodingResult::I32(_) | DecodingResult::I64(_));
        let is_float = matches!(samples, DecodingResult::F16(_) | DecodingResult::F32(_) | DecodingResult::F64(_));
        let (width, height) = (self.width as usize, self.height as usize);
        let numbers = match samples {
            DecodingResult::U8(packed) if self.bits < 8 => unpacked(&packed, self.bits as usize, width),
            DecodingResult::U8(numbers) => numbers.into_iter().map(f64::from).collect(),
            DecodingResult::U16(numbers) => numbers.into_iter().map(f64::from).collect(),
            DecodingResult::U32(numbers) => numbers.into_iter().map(f64::from).collect(),
            DecodingResult::U64(numbers) => numbers.into_iter().map(|number| number as f64).collect(),
            DecodingResult::I8(numbers) => numbers.into_iter().map(f64::from).collect(),
            DecodingResult::I16(numbers) => numbers.into_iter().map(f64::from).collect(),
            DecodingResult::I32(numbers) => numbers.into_iter().map(f64::from).collect(),
            DecodingResult::I64(numbers) => numbers.into_iter().map(|number| number as f64).collect(),
            DecodingResult::F16(numbers) => numbers.into_iter().map(f64::from).collect(),
            DecodingResult::F32(numbers) => numbers.into_iter().map(f64::from).collect(),
            DecodingResult::F64(numbers) => numbers,
        };
        // Of several samples a pixel the first counts.
        let n_each = (numbers.len() / (width * height).max(1)).max(1);
        let firsts = numbers.iter().step_by(n_each).copied();
        let colours: Vec<f32> = match &self.palette {
            Some(palette) => firsts.flat_map(|index| colour(palette, index)).collect(),
            None => {
                let value = |x: f64| if x.is_finite() && Some(x) != self.no_data { x.max(0.0) } else { 0.0 };
                let largest = firsts.clone().map(value).fold(0.0, f64::max);
                // Few bits are tones, of which the largest is white.
                let is_tone = self.bits <= 16 && !is_signed && !is_float && self.no_data.is_none();
                let whole = if is_tone { 2f64.powi(self.bits as i32) - 1.0 } else { largest.max(1.0) };
                let tone = |x: f64| (value(x) / whole) as f32;
                let tone = |x: f64| if self.is_white_zero && is_tone { 1.0 - tone(x) } else { tone(x) };
                firsts.flat_map(|x| [tone(x); 3]).collect()
            }
        };
        let short = || TiffError::FormatError(tiff::TiffFormatError::InconsistentSizesEncountered);
        let pixels = ImageBuffer::from_raw(self.width, self.height, colours).ok_or_else(short)?;
        Ok(DynamicImage::ImageRgb32F(pixels))
    }
}

/// The same file, its samples called greys.
fn as_greys(bytes: &[u8]) -> Option<Vec<u8>> {
    let is_little = bytes.starts_with(b"II");
    let number = |at: usize, size: usize| {
        let mut slice = bytes.get(at..at.checked_add(size)?)?.to_vec();
        if is_little {
            slice.reverse();
        }
        Some(slice.into_iter().fold(0u64, |sum, byte| sum << 8 | u64::from(byte)))
    };
    let is_big = number(2, 2)? == 43;
    let (at, size, of_count, of_entry, of_value) = if is_big { (8, 8, 8, 20, 12) } else { (4, 4, 2, 12, 8) };
    let directory = usize::try_from(number(at, size)?).ok()?;
    let n_entries = usize::try_from(number(directory, of_count)?).ok()?;
    let first = directory + of_count;
    let entry = (0..n_entries.min(1 << 16)).map(|k| first + k * of_entry).find(|&at| number(at, 2) == Some(u64::from(PHOTOMETRIC)))?;
    let grey = PhotometricInterpretation::BlackIsZero.to_u16();
    let mut greys = bytes.to_vec();
    let value = greys.get_mut(entry + of_value..entry + of_value + 2)?;
    value.copy_from_slice(&if is_little { grey.to_le_bytes() } else { grey.to_be_bytes() });
    Some(greys)
}

/// Numbers of fewer than eight bits; each row begins with a byte.
fn unpacked(packed: &[u8], bits: usize, width: usize) -> Vec<f64> {
    let mask = (1u16 << bits) - 1;
    let rows = packed.chunks_exact((width * bits).div_ceil(8).max(1));
    let number = |row: &[u8], k: usize| {
        let (byte, shift) = (k * bits / 8, k * bits % 8);
        let two = u16::from(row[byte]) << 8 | u16::from(row.get(byte + 1).copied().unwrap_or(0));
        f64::from(two >> (16 - bits - shift) & mask)
    };
    rows.flat_map(|row| (0..width).map(move |k| number(row, k))).collect()
}

/// Red, green and blue of an index; the table has all reds first. What is not in it is black.
fn colour(palette: &[u16], index: f64) -> [f32; 3] {
    let n = palette.len() / 3;
    let k = index as usize;
    [0, 1, 2].map(|channel| if k < n { f32::from(palette[channel * n + k]) / 65535.0 } else { 0.0 })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What a file says of its four pixels in a row.
    struct Sort {
        photometric: u16,
        format: SampleFormat,
        bits: u16,
        palette: Vec<u16>,
        no_data: &'static str,
    }

    const FLOATS: Sort = Sort { photometric: 1, format: SampleFormat::IEEEFP, bits: 32, palette: Vec::new(), no_data: "" };

    /// A TIFF of one row, most significant bytes first if it says so.
    fn file(sort: &Sort, samples: &[u8], is_big_endian: bool) -> Vec<u8> {
        let two = |number: u16| if is_big_endian { number.to_be_bytes() } else { number.to_le_bytes() };
        let four = |number: usize| if is_big_endian { (number as u32).to_be_bytes() } else { (number as u32).to_le_bytes() };
        let shorts = |numbers: &[u16]| numbers.iter().flat_map(|&number| two(number)).collect::<Vec<u8>>();
        let mut entries = vec![
            (256, 3, shorts(&[4])),
            (257, 3, shorts(&[1])),
            (258, 3, shorts(&[sort.bits])),
            (259, 3, shorts(&[1])),
            (262, 3, shorts(&[sort.photometric])),
            (273, 3, shorts(&[8])),
            (277, 3, shorts(&[1])),
            (278, 3, shorts(&[1])),
            (279, 3, shorts(&[samples.len() as u16])),
            (320, 3, shorts(&sort.palette)),
            (339, 3, shorts(&[sort.format.to_u16()])),
            (42113, 2, sort.no_data.bytes().collect()),
        ];
        entries.retain(|(.., value)| !value.is_empty());
        let directory = 8 + samples.len();
        let beyond = directory + 2 + 12 * entries.len() + 4;
        let mut bytes = Vec::from(if is_big_endian { b"MM" } else { b"II" });
        bytes.extend(two(42).into_iter().chain(four(directory)).chain(samples.iter().copied()));
        bytes.extend(two(entries.len() as u16));
        let mut more = Vec::new();
        for (tag, kind, mut value) in entries {
            bytes.extend(two(tag).into_iter().chain(two(kind)).chain(four(value.len() / if kind == 3 { 2 } else { 1 })));
            if value.len() > 4 {
                bytes.extend(four(beyond + more.len()));
                more.append(&mut value);
            } else {
                value.resize(4, 0);
                bytes.append(&mut value);
            }
        }
        bytes.extend([0; 4]);
        bytes.append(&mut more);
        bytes
    }

    fn reds(bytes: &[u8]) -> Vec<f32> {
        let picture = Numbers::of(bytes).expect("numbers").read().expect("readable");
        picture.to_rgb32f().pixels().map(|pixel| pixel[0]).collect()
    }

    #[test]
    fn floats_are_tones_or_parts_of_the_largest() {
        let floats = |numbers: [f32; 4], of: fn(f32) -> [u8; 4]| numbers.into_iter().flat_map(of).collect::<Vec<u8>>();
        let tones = [0.0, 0.25, 0.5, 0.75];
        assert_eq!(reds(&file(&FLOATS, &floats(tones, f32::to_le_bytes), false)), tones);
        assert_eq!(reds(&file(&FLOATS, &floats(tones, f32::to_be_bytes), true)), tones);
        let heights = floats([-3.0, f32::NAN, 100.0, 400.0], f32::to_le_bytes);
        assert_eq!(reds(&file(&FLOATS, &heights, false)), [0.0, 0.0, 0.25, 1.0]);
    }

    #[test]
    fn integers_have_places_without_a_number() {
        let sort = Sort { format: SampleFormat::Int, bits: 16, no_data: "1000\0", ..FLOATS };
        let numbers: Vec<u8> = [-1i16, 1000, 20, 40].into_iter().flat_map(i16::to_le_bytes).collect();
        assert_eq!(reds(&file(&sort, &numbers, false)), [0.0, 0.0, 0.5, 1.0]);
        let sort = Sort { format: SampleFormat::Uint, bits: 32, ..FLOATS };
        let numbers: Vec<u8> = [0u32, 1, 2, 4_000_000_000].into_iter().flat_map(u32::to_be_bytes).collect();
        assert_eq!(reds(&file(&sort, &numbers, true))[3], 1.0);
    }

    #[test]
    fn a_palette_gives_colours_of_eight_and_of_four_bits() {
        let palette =
            |n: u16| [0, 1, 2].into_iter().flat_map(|k| (0..n).map(move |i| if k == 0 { i * (65535 / (n - 1)) } else { 0 })).collect();
        let sort = Sort { photometric: 3, format: SampleFormat::Uint, bits: 8, palette: palette(256), ..FLOATS };
        for is_big_endian in [false, true] {
            assert_eq!(reds(&file(&sort, &[0, 51, 102, 255], is_big_endian)), [0.0, 0.2, 0.4, 1.0]);
        }
        let sort = Sort { bits: 4, palette: palette(16), ..sort };
        assert_eq!(reds(&file(&sort, &[0x03, 0x6f], false)), [0.0, 0.2, 0.4, 1.0]);
    }

    #[test]
    fn tones_are_left_to_the_picture_library_and_nothing_panics() {
        let tones = file(&Sort { format: SampleFormat::Uint, bits: 8, ..FLOATS }, &[1, 2, 3, 4], false);
        assert!(Numbers::of(&tones).is_none());
        assert!(Numbers::of(b"II").is_none());
        let whole = file(&FLOATS, &[0; 16], false);
        for cut in 0..whole.len() {
            let _ = Numbers::of(&whole[..cut]).map(Numbers::read);
        }
    }
}
