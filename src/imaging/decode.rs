//! Decoding of photos that strangers send: PNG and JPEG only, size checked before any pixel is decoded.

use std::io::Cursor;

use image::codecs::{jpeg::JpegDecoder, png::PngDecoder};
use image::{DynamicImage, ImageDecoder, Limits, RgbaImage};

/// The bound on width x height that [`decode_image`] is called with unless a caller knows better: 40 Mpx.
pub const DEFAULT_MAX_PIXELS: u64 = 40_000_000;

/// Why bytes cannot be used as an image.
#[derive(Debug, thiserror::Error)]
pub enum DecodeError {
    /// There are no bytes at all.
    #[error("the image is empty (0 bytes)")]
    Empty,
    /// The first bytes are neither PNG's nor JPEG's.
    #[error("the image is neither PNG nor JPEG (its {bytes} bytes start with {start})")]
    UnknownFormat {
        /// How many bytes were given.
        bytes: usize,
        /// The first bytes (at most eight) in hexadecimal.
        start: String,
    },
    /// The header states more pixels than allowed.
    #[error("the image has {width} x {height} = {pixels} pixels, at most {max_pixels} are allowed")]
    TooLarge {
        /// Width in the header.
        width: u32,
        /// Height in the header.
        height: u32,
        /// width x height.
        pixels: u64,
        /// The bound.
        max_pixels: u64,
    },
    /// The format is right, the content is not.
    #[error("the {format} image cannot be decoded: {reason}")]
    Broken {
        /// "PNG" or "JPEG".
        format: &'static str,
        /// What the decoder says.
        reason: String,
    },
}

/// Decodes a PNG or JPEG (told apart by their first bytes, never by a name) to
/// 8-bit sRGB with straight alpha; alpha is 255 everywhere unless a PNG has its own.
///
/// The pixels come as stored: an EXIF orientation is not applied, since intrinsics
/// describe the stored pixels.
///
/// # Errors
/// [`DecodeError`]; an image of more than `max_pixels` is refused from its header,
/// before memory for its pixels is reserved.
pub fn decode_image(bytes: &[u8], max_pixels: u64) -> Result<RgbaImage, DecodeError> {
    const PNG: &[u8] = b"\x89PNG\r\n\x1a\n";
    const JPEG: &[u8] = b"\xff\xd8\xff";
    if bytes.is_empty() {
        Err(DecodeError::Empty)
    } else if bytes.starts_with(PNG) {
        // 16-bit RGBA is the widest a PNG gets; the rest is room for its row buffers.
        let mut limits = Limits::no_limits();
        limits.max_alloc = Some(max_pixels.saturating_mul(8).saturating_add(1 << 20));
        let broken = broken("PNG");
        let decoder = PngDecoder::with_limits(Cursor::new(bytes), limits).map_err(&broken)?;
        finish(decoder, max_pixels, broken)
    } else if bytes.starts_with(JPEG) {
        let broken = broken("JPEG");
        let decoder = JpegDecoder::new(Cursor::new(bytes)).map_err(&broken)?;
        finish(decoder, max_pixels, broken)
    } else {
        let start = bytes.iter().take(8).map(|b| format!("{b:02x}")).collect::<Vec<_>>().join(" ");
        Err(DecodeError::UnknownFormat { bytes: bytes.len(), start })
    }
}

fn broken(format: &'static str) -> impl Fn(image::ImageError) -> DecodeError {
    move |error| DecodeError::Broken { format, reason: error.to_string() }
}

fn finish(
    decoder: impl ImageDecoder,
    max_pixels: u64,
    broken: impl Fn(image::ImageError) -> DecodeError,
) -> Result<RgbaImage, DecodeError> {
    let (width, height) = decoder.dimensions();
    let pixels = u64::from(width) * u64::from(height);
    if pixels > max_pixels {
        return Err(DecodeError::TooLarge { width, height, pixels, max_pixels });
    }
    Ok(DynamicImage::from_decoder(decoder).map_err(broken)?.into_rgba8())
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::{ImageFormat, Rgba};

    fn encoded(image: &DynamicImage, format: ImageFormat) -> Vec<u8> {
        let mut bytes = Vec::new();
        image.write_to(&mut Cursor::new(&mut bytes), format).unwrap();
        bytes
    }

    fn half_clear() -> RgbaImage {
        RgbaImage::from_fn(24, 16, |x, y| Rgba([x as u8 * 9, y as u8 * 9, 77, if x < 12 { 0 } else { 200 }]))
    }

    #[test]
    fn a_png_keeps_its_alpha_and_its_hidden_colours() {
        let bytes = encoded(&half_clear().into(), ImageFormat::Png);
        assert_eq!(decode_image(&bytes, DEFAULT_MAX_PIXELS).unwrap(), half_clear());
    }

    #[test]
    fn a_jpeg_is_opaque() {
        let rgb = DynamicImage::from(half_clear()).into_rgb8();
        let bytes = encoded(&rgb.clone().into(), ImageFormat::Jpeg);
        let decoded = decode_image(&bytes, DEFAULT_MAX_PIXELS).unwrap();
        assert!(decoded.pixels().all(|p| p.0[3] == 255));
        assert!(crate::imaging::psnr(&DynamicImage::from(decoded).into_rgb8(), &rgb) > 25.0);
    }

    #[test]
    fn a_png_header_of_40000_by_40000_pixels_is_refused_with_its_numbers() {
        // The header alone, with its right checksum: decoding pixels would fail differently.
        let mut bytes = b"\x89PNG\r\n\x1a\n\x00\x00\x00\x0dIHDR".to_vec();
        bytes.extend([0, 0, 0x9c, 0x40, 0, 0, 0x9c, 0x40, 8, 2, 0, 0, 0]);
        bytes.extend(crc32(&bytes[12..]).to_be_bytes());
        bytes.extend(b"\x00\x00\x00\x00IDAT\x35\xaf\x06\x1e");
        let error = decode_image(&bytes, DEFAULT_MAX_PIXELS).unwrap_err();
        assert!(
            matches!(
                error,
                DecodeError::TooLarge {
                    width: 40_000,
                    height: 40_000,
                    pixels: 1_600_000_000,
                    max_pixels: 40_000_000
                }
            ),
            "{error}"
        );
    }

    fn crc32(bytes: &[u8]) -> u32 {
        !bytes.iter().fold(!0u32, |crc, b| {
            (0..8).fold(crc ^ u32::from(*b), |c, _| (c >> 1) ^ (0xedb8_8320 & (0u32.wrapping_sub(c & 1))))
        })
    }

    #[test]
    fn truncated_files_are_broken_and_other_formats_unknown() {
        for format in [ImageFormat::Png, ImageFormat::Jpeg] {
            let rgb = DynamicImage::from(half_clear()).into_rgb8();
            let bytes = encoded(&rgb.into(), format);
            let error = decode_image(&bytes[..bytes.len() / 8], DEFAULT_MAX_PIXELS).unwrap_err();
            assert!(matches!(error, DecodeError::Broken { .. }), "{error}");
        }
        assert!(matches!(decode_image(b"", 1), Err(DecodeError::Empty)));
        let error = decode_image(b"GIF89a......", 1).unwrap_err();
        assert!(error.to_string().contains("47 49 46"), "{error}");
    }

    proptest::proptest! {
        #[test]
        fn any_bytes_after_a_valid_start_never_panic(tail in proptest::collection::vec(0u8.., 0..300), png: bool) {
            let mut bytes = if png { b"\x89PNG\r\n\x1a\n".to_vec() } else { b"\xff\xd8\xff".to_vec() };
            bytes.extend(tail);
            let _ = decode_image(&bytes, 10_000);
        }
    }
}
