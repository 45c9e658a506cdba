//! PNG images that are embedded in an HTML page as data URIs.

use crate::report::base64::base64;

/// Returns an 8-bit RGB image, given row by row, as a PNG data URI.
///
/// # Panics
/// If `rgb` does not have three bytes per pixel.
pub fn data_uri(width: u32, height: u32, rgb: &[u8]) -> String {
    assert_eq!(rgb.len(), 3 * width as usize * height as usize, "three bytes per pixel");
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(png::Compression::High);
    let written = encoder.write_header().and_then(|mut writer| writer.write_image_data(rgb));
    // Writing to memory cannot fail, because `rgb` has the right length.
    debug_assert!(written.is_ok());
    format!("data:image/png;base64,{}", base64(&bytes))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_data_uri_contains_a_png() {
        let uri = data_uri(2, 1, &[255, 0, 0, 0, 0, 255]);
        // The base64 text starts with the signature of a PNG file (8 bytes).
        assert!(uri.starts_with("data:image/png;base64,iVBORw0KGgo"), "{uri}");
    }
}
