//! Reads the triangles of an STL file, text or binary.
//!
//! A text file contains any number of solids; all of them are read. Keywords may be in upper or lower case. Indents,
//! line ends and the names of the solids do not matter. A file with anything that is not understood is refused, so no
//! triangle is left out without a message.

use glam::DVec3;

/// Corners of a triangle, in the unit of length of the file.
pub type Triangle = [DVec3; 3];

/// Size of the header of a binary file: 80 bytes of text and the number of triangles.
const HEADER: usize = 84;
/// Size of a triangle in a binary file: normal and corners as twelve 32-bit numbers, and two bytes of attributes.
const RECORD: usize = 50;

/// Returns the triangles of all solids in the content of an STL file.
///
/// # Errors
/// The reason why the content is not a complete STL file.
pub fn triangles(bytes: &[u8]) -> Result<Vec<Triangle>, String> {
    if bytes.is_empty() {
        return Err("the file is empty".to_owned());
    }
    let announced = announced_triangles(bytes);
    // The size of the file decides, because the header of a binary file may begin with "solid" too.
    if announced.is_some_and(|count| bytes.len() == HEADER + RECORD * count) {
        return binary(&bytes[HEADER..]);
    }
    if bytes.contains(&0) {
        return Err(match announced {
            Some(count) => format!(
                "as a binary file with {count} triangles, it must have {} bytes, but it has {}",
                HEADER + RECORD * count,
                bytes.len()
            ),
            None => format!("a binary file has at least {HEADER} bytes, but it has {}", bytes.len()),
        });
    }
    let mut words = Words::new(bytes);
    text(&mut words).map_err(|reason| format!("line {}: {reason}", words.line))
}

/// Returns the number of triangles in the header of a binary file; `None` if the file is too short for a header.
fn announced_triangles(bytes: &[u8]) -> Option<usize> {
    let count = bytes.get(HEADER - 4..HEADER)?;
    Some(u32::from_le_bytes(count.try_into().ok()?) as usize)
}

fn binary(records: &[u8]) -> Result<Vec<Triangle>, String> {
    let number = |record: &[u8], k: usize| {
        let bytes = [record[4 * k], record[4 * k + 1], record[4 * k + 2], record[4 * k + 3]];
        f64::from(f32::from_le_bytes(bytes))
    };
    // The first three numbers are the normal, which follows from the order of the corners.
    let corner = |record: &[u8], k: usize| DVec3::from_array([0, 1, 2].map(|axis| number(record, 3 * k + axis)));
    let triangles = records.chunks_exact(RECORD).map(|record| [1, 2, 3].map(|k| corner(record, k)));
    triangles.enumerate().map(|(index, triangle)| finite(triangle).ok_or_else(|| not_finite(index))).collect()
}

fn finite(triangle: Triangle) -> Option<Triangle> {
    triangle.iter().all(|corner| corner.is_finite()).then_some(triangle)
}

fn not_finite(index: usize) -> String {
    format!("triangle {} has a coordinate that is not a finite number", index + 1)
}

/// The words of a text file, with the line of the last word.
struct Words<'a> {
    bytes: &'a [u8],
    line: usize,
}

impl<'a> Words<'a> {
    fn new(bytes: &'a [u8]) -> Self {
        // Some editors write a byte order mark at the start of a UTF-8 file.
        Self { bytes: bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes), line: 1 }
    }

    /// Returns the next word in lower case; `None` at the end of the file.
    fn next(&mut self) -> Option<String> {
        while let Some((first, rest)) = self.bytes.split_first().filter(|(first, _)| first.is_ascii_whitespace()) {
            self.line += usize::from(*first == b'\n');
            self.bytes = rest;
        }
        let end = self.bytes.iter().position(u8::is_ascii_whitespace).unwrap_or(self.bytes.len());
        let (word, rest) = self.bytes.split_at(end);
        self.bytes = rest;
        (!word.is_empty()).then(|| String::from_utf8_lossy(word).to_ascii_lowercase())
    }

    /// Leaves out the rest of the line, which contains the name of a solid in any character set.
    fn skip_line(&mut self) {
        let end = self.bytes.iter().position(|byte| matches!(byte, b'\n' | b'\r')).unwrap_or(self.bytes.len());
        self.bytes = &self.bytes[end..];
    }

    fn expect(&mut self, expected: &str) -> Result<(), String> {
        match self.next() {
            Some(word) if word == expected => Ok(()),
            found => Err(unexpected(found, &format!("`{expected}`"))),
        }
    }

    /// Reads `endloop` or `end loop`, or the same with another noun.
    fn expect_end_of(&mut self, noun: &str) -> Result<(), String> {
        match self.next() {
            Some(word) if word == "end" => self.expect(noun),
            Some(word) if word.strip_prefix("end") == Some(noun) => Ok(()),
            found => Err(unexpected(found, &format!("`end{noun}`"))),
        }
    }

    fn number(&mut self) -> Result<f64, String> {
        let word = self.next();
        match word.as_deref().map(str::parse::<f64>) {
            Some(Ok(number)) if number.is_finite() => Ok(number),
            _ => Err(unexpected(word, "a number with a decimal point")),
        }
    }

    fn vector(&mut self) -> Result<DVec3, String> {
        Ok(DVec3::new(self.number()?, self.number()?, self.number()?))
    }
}

fn unexpected(found: Option<String>, expected: &str) -> String {
    match found {
        Some(word) => {
            let shown: String = word.chars().take(30).collect();
            format!("found `{shown}` instead of {expected}")
        }
        None => format!("the file ends before {expected}"),
    }
}

/// Reads all solids of a text file.
fn text(words: &mut Words) -> Result<Vec<Triangle>, String> {
    let mut triangles = Vec::new();
    let mut next = words.next();
    while next.is_some() {
        if next.as_deref() != Some("solid") {
            return Err(unexpected(next, "`solid`"));
        }
        words.skip_line();
        while read_facet(words, &mut triangles)? {}
        next = words.next();
    }
    Ok(triangles)
}

/// Reads a triangle or the end of a solid; returns false at the end of the solid.
fn read_facet(words: &mut Words, triangles: &mut Vec<Triangle>) -> Result<bool, String> {
    match words.next().as_deref() {
        Some("facet") => {}
        Some("endsolid") => {
            words.skip_line();
            return Ok(false);
        }
        Some("end") => {
            words.expect("solid")?;
            words.skip_line();
            return Ok(false);
        }
        found => return Err(unexpected(found.map(str::to_owned), "`facet` or `endsolid`")),
    }
    words.expect("normal")?;
    // The normal follows from the order of the corners. Some programs write zeros or `nan` here.
    for _ in 0..3 {
        let word = words.next();
        if word.as_deref().is_none_or(|word| word.parse::<f64>().is_err()) {
            return Err(unexpected(word, "a component of the normal"));
        }
    }
    words.expect("outer")?;
    words.expect("loop")?;
    let mut triangle = [DVec3::ZERO; 3];
    for corner in &mut triangle {
        words.expect("vertex")?;
        *corner = words.vector()?;
    }
    words.expect_end_of("loop")?;
    words.expect_end_of("facet")?;
    triangles.push(triangle);
    Ok(true)
}

#[cfg(test)]
mod tests {
    use super::*;

    const FACET: &str = "facet normal 0 0 1\n outer loop\n  vertex 0 0 0\n  vertex 1 0 0\n  vertex 0 1.5 0\n endloop\n\
        endfacet\n";

    /// A binary file with a header and triangles.
    fn binary_file(header: &[u8], triangles: &[[f32; 9]]) -> Vec<u8> {
        let mut bytes = header.to_vec();
        bytes.resize(80, b' ');
        bytes.extend(u32::try_from(triangles.len()).unwrap().to_le_bytes());
        for corners in triangles {
            bytes.extend([0; 12]);
            bytes.extend(corners.iter().flat_map(|c| c.to_le_bytes()));
            bytes.extend([0; 2]);
        }
        bytes
    }

    #[test]
    fn all_solids_of_a_text_file_are_read_in_any_layout() {
        let two = format!("solid toe\n{FACET}endsolid toe\nsolid\n{FACET}{FACET}endsolid\n");
        let latin_1 = [b"solid D\xe4mm\n", FACET.as_bytes(), b"endsolid D\xe4mm"].concat();
        let layouts: [(Vec<u8>, usize); 9] = [
            (two.clone().into_bytes(), 3),
            (two.to_uppercase().into_bytes(), 3),
            (two.replace('\n', "\r\n").into_bytes(), 3),
            (two.replace('\n', "\r").into_bytes(), 3),
            (two.replace("endloop", "end loop").replace("endsolid", "end solid").into_bytes(), 3),
            (format!("\u{feff}  \n\t{two}\n\n").into_bytes(), 3),
            (two.replace("normal 0 0 1", "normal nan -0 1e0").into_bytes(), 3),
            (latin_1, 1),
            (b"solid empty\nendsolid empty\n".to_vec(), 0),
        ];
        for (bytes, count) in layouts {
            let found = triangles(&bytes).unwrap_or_else(|e| panic!("{e}: {}", String::from_utf8_lossy(&bytes)));
            assert_eq!(found.len(), count);
            assert!(found.iter().all(|triangle| triangle[2] == DVec3::new(0.0, 1.5, 0.0)));
        }
    }

    #[test]
    fn a_binary_file_may_begin_with_solid() {
        let corners = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.5, 0.0];
        for header in [&b"solid made by a program"[..], b"binary", b"\xef\xbb\xbfSOLID"] {
            let bytes = binary_file(header, &[corners, corners]);
            assert_eq!(triangles(&bytes).unwrap()[1][2], DVec3::new(0.0, 1.5, 0.0));
        }
    }

    #[test]
    fn text_coordinates_keep_double_precision() {
        let bytes = format!("solid\n{}endsolid\n", FACET.replace("vertex 1 0 0", "vertex 501234.567891 0 0"));
        assert_eq!(triangles(bytes.as_bytes()).unwrap()[0][1].x, 501_234.567_891);
    }

    #[test]
    fn broken_files_are_refused_with_line_and_reason() {
        let whole = binary_file(b"", &[[1.0; 9]; 3]);
        let mut too_long = whole.clone();
        too_long.extend([0; 7]);
        let mut not_a_number = whole.clone();
        not_a_number[HEADER + 12..HEADER + 16].copy_from_slice(&f32::NAN.to_le_bytes());
        let text = format!("solid a\n{FACET}endsolid a\n");
        let broken: [(Vec<u8>, &str); 13] = [
            (Vec::new(), "empty"),
            (b"garbage".to_vec(), "line 1: found `garbage` instead of `solid`"),
            (whole[..whole.len() - 1].to_vec(), "with 3 triangles, it must have 234 bytes, but it has 233"),
            (whole[..90].to_vec(), "but it has 90"),
            (too_long, "but it has 241"),
            (not_a_number, "triangle 1 has a coordinate"),
            (text.replace("endsolid a\n", "").into_bytes(), "line 9: the file ends before `facet` or `endsolid`"),
            (format!("{text}facet").into_bytes(), "line 10: found `facet` instead of `solid`"),
            (text.replace("1.5", "1,5").into_bytes(), "line 6: found `1,5` instead of a number"),
            (text.replace("1.5", "inf").into_bytes(), "line 6: found `inf` instead of a number"),
            (text.replace("1.5 0", "1.5").into_bytes(), "line 7: found `endloop` instead of a number"),
            (text.replace(" endloop", "vertex 1 1 0 endloop").into_bytes(), "found `vertex` instead of `endloop`"),
            (b"solid x\nfacet normal".to_vec(), "line 2: the file ends before a component of the normal"),
        ];
        for (bytes, reason) in broken {
            let error = triangles(&bytes).unwrap_err();
            assert!(error.contains(reason), "{error}, expected {reason}");
        }
    }
}
