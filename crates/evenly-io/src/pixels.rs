//! Pixels as the bytes of a PNG.

use evenly::Image;

/// 8 bits a channel.
pub(crate) fn bytes(image: &Image) -> Vec<u8> {
    image.values().iter().map(|value| (255.0 * value.clamp(0.0, 1.0)).round() as u8).collect()
}

pub(crate) fn colour(image: &Image) -> png::ColorType {
    if image.n_channels() == 3 { png::ColorType::Rgb } else { png::ColorType::Grayscale }
}

/// A PNG of 8 bits a channel, with a comment.
pub(crate) fn encode(pixels: &[u8], width: u32, height: u32, colour: png::ColorType, comment: &str) -> Result<Vec<u8>, png::EncodingError> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(colour);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(png::Compression::High);
    encoder.add_itxt_chunk("Comment".into(), comment.into())?;
    let mut writer = encoder.write_header()?;
    writer.write_image_data(pixels)?;
    writer.finish()?;
    Ok(bytes)
}
