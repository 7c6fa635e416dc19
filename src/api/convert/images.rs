//! Photos out of base64.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use image::RgbaImage;

use crate::api::errors::decode_problem;
use crate::api::problem::Problem;
use crate::imaging::decode_image;
use crate::plan::MAX_PHOTOS;

/// Most pixels of a photo: decoded, five of them fill half a gigabyte.
pub const MAX_IMAGE_PIXELS: u64 = 25_000_000;

/// Decodes the photos of `images`.
///
/// # Errors
/// 422 naming the image: too many, no base64, no PNG or JPEG, too many pixels.
pub fn images(texts: &[String]) -> Result<Vec<RgbaImage>, Problem> {
    if !(1..=MAX_PHOTOS).contains(&texts.len()) {
        return Err(Problem::field(
            "image_count",
            "images",
            texts.len(),
            format!("1 to {MAX_PHOTOS} images"),
        ));
    }
    let decode = |(index, text): (usize, &String)| {
        let field = format!("images[{index}]");
        let bytes = base64_bytes(&field, text)?;
        decode_image(&bytes, MAX_IMAGE_PIXELS).map_err(|error| decode_problem(&field, &error))
    };
    texts.iter().enumerate().map(decode).collect()
}

/// The bytes of a base64 text; a data URL's head and white space (line breaks of `base64`) are
/// left out.
///
/// # Errors
/// 422 naming `field`.
pub fn base64_bytes(field: &str, text: &str) -> Result<Vec<u8>, Problem> {
    let body = match text.split_once(";base64,") {
        Some((head, body)) if head.starts_with("data:") => body,
        _ => text,
    };
    let decoded = if body.bytes().any(|byte| byte.is_ascii_whitespace()) {
        let dense: Vec<u8> = body.bytes().filter(|byte| !byte.is_ascii_whitespace()).collect();
        STANDARD.decode(dense)
    } else {
        STANDARD.decode(body)
    };
    decoded.map_err(|error| {
        let mut problem = Problem::field("not_base64", field, text, "standard base64");
        problem.detail.push_str(&format!(" ({error})"));
        problem
    })
}
