//! PNG images that are embedded in an HTML page as data URIs.

/// The 64 characters of base64 (RFC 4648).
const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

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

fn base64(bytes: &[u8]) -> String {
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for group in bytes.chunks(3) {
        let bits = group.iter().fold(0u32, |bits, byte| bits << 8 | u32::from(*byte)) << (8 * (3 - group.len()));
        for place in 0..4 {
            let letter = LETTERS[(bits >> (18 - 6 * place) & 63) as usize];
            text.push(if place > group.len() { '=' } else { char::from(letter) });
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_agrees_with_the_rfc_examples() {
        let cases = [("", ""), ("f", "Zg=="), ("fo", "Zm8="), ("foo", "Zm9v"), ("foobar", "Zm9vYmFy")];
        cases.into_iter().for_each(|(text, expected)| assert_eq!(base64(text.as_bytes()), expected));
    }

    #[test]
    fn the_data_uri_contains_a_png() {
        let uri = data_uri(2, 1, &[255, 0, 0, 0, 0, 255]);
        // The base64 text starts with the signature of a PNG file (8 bytes).
        assert!(uri.starts_with("data:image/png;base64,iVBORw0KGgo"), "{uri}");
    }
}
