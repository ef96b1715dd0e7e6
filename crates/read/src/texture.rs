//! Pictures that meshes refer to: PNG and JPEG.

use super::ColourError;
use crate::painting::Texture;
use png::{ColorType, Decoder, Transformations};
use std::io::Cursor;
use tatamu_core::colour::Rgb;
use zune_jpeg::JpegDecoder;
use zune_jpeg::zune_core::bytestream::ZCursor;
use zune_jpeg::zune_core::colorspace::ColorSpace;
use zune_jpeg::zune_core::options::DecoderOptions;

/// Most pixels of a texture, so that a small file cannot fill the memory.
const MOST_PIXELS: usize = 1 << 27;

/// Decodes a picture, whose format its first bytes show.
pub(super) fn decode(name: &str, bytes: &[u8]) -> Result<Texture, ColourError> {
    let failed = |reason: String| ColourError::Texture { name: name.to_owned(), reason };
    let texture = if bytes.starts_with(b"\x89PNG") {
        decode_png(bytes).map_err(failed)?
    } else if bytes.starts_with(b"\xff\xd8") {
        decode_jpeg(bytes).map_err(failed)?
    } else {
        return Err(failed("it is neither PNG nor JPEG; save it as one of them".to_owned()));
    };
    texture.ok_or_else(|| failed("it has no pixels, or too many".to_owned()))
}

fn decode_png(bytes: &[u8]) -> Result<Option<Texture>, String> {
    let mut decoder = Decoder::new(Cursor::new(bytes));
    decoder.set_transformations(Transformations::EXPAND | Transformations::STRIP_16);
    let mut reader = decoder.read_info().map_err(|error| error.to_string())?;
    let size = reader.output_buffer_size().filter(|&size| size / 4 <= MOST_PIXELS);
    let Some(size) = size else { return Ok(None) };
    let mut buffer = vec![0; size];
    let frame = reader.next_frame(&mut buffer).map_err(|error| error.to_string())?;
    let parts = frame.color_type.samples();
    let is_grey = matches!(frame.color_type, ColorType::Grayscale | ColorType::GrayscaleAlpha);
    let pixel = |p: &[u8]| if is_grey { Rgb(p[0], p[0], p[0]) } else { Rgb(p[0], p[1], p[2]) };
    let pixels = buffer[..frame.buffer_size()].chunks_exact(parts).map(pixel).collect();
    Ok(Texture::new(frame.width as usize, frame.height as usize, pixels))
}

fn decode_jpeg(bytes: &[u8]) -> Result<Option<Texture>, String> {
    let options = DecoderOptions::default().jpeg_set_out_colorspace(ColorSpace::RGB);
    let mut decoder = JpegDecoder::new_with_options(ZCursor::new(bytes), options);
    let buffer = decoder.decode().map_err(|error| error.to_string())?;
    let Some((width, height)) = decoder.dimensions() else { return Ok(None) };
    let pixels = buffer.chunks_exact(3).map(|p| Rgb(p[0], p[1], p[2])).collect();
    Ok(Texture::new(width, height, pixels))
}
