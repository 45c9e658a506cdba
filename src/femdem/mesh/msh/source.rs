//! Reads the numbers of an MSH file one by one, from text or binary.

use super::error::{FilePosition, MshError};

/// Largest number of characters of the file that a message quotes.
const LONGEST_QUOTE: usize = 40;

/// The content of a file and the current reading position.
pub(super) struct Source<'a> {
    bytes: &'a [u8],
    offset: usize,
    binary: bool,
    section: &'a str,
}

impl<'a> Source<'a> {
    /// Reads the header of a file. The reading position is then at the first section.
    pub(super) fn new(bytes: &'a [u8]) -> Result<Self, MshError> {
        let mut source = Self { bytes, offset: 0, binary: false, section: "MeshFormat" };
        let first = source.line().unwrap_or_default();
        if first.trim_ascii() != b"$MeshFormat" {
            return Err(MshError::NotMsh);
        }
        let header = quote(source.line().ok_or_else(|| source.truncated())?);
        let (version, layout) = header.trim().split_once(' ').unwrap_or((header.trim(), ""));
        if version != "4.1" {
            return Err(MshError::Version(version.to_owned()));
        }
        source.binary = match layout.trim() {
            "0 8" => false,
            "1 8" => true,
            other => return Err(MshError::Header(other.to_owned())),
        };
        // A binary file contains the integer 1 here. Its bytes show the byte order of the file.
        if source.binary && source.take_bytes()? != 1i32.to_le_bytes() {
            return Err(MshError::Header(format!("{layout} (binary, big-endian)")));
        }
        source.end()?;
        Ok(source)
    }

    /// Reads the name of the section that starts at the reading position; `None` at the end of the file.
    pub(super) fn next_section(&mut self) -> Result<Option<&'a str>, MshError> {
        self.skip_space();
        if self.offset == self.bytes.len() {
            return Ok(None);
        }
        let start = self.offset;
        let line = self.line().unwrap_or_default().trim_ascii();
        let name = line.strip_prefix(b"$").and_then(|name| std::str::from_utf8(name).ok());
        self.section = name.ok_or_else(|| self.unexpected(start, "the start of the next section", line))?;
        Ok(Some(self.section))
    }

    /// Reads the line that ends the current section.
    pub(super) fn end(&mut self) -> Result<(), MshError> {
        self.skip_space();
        let start = self.offset;
        let line = self.line().ok_or_else(|| self.truncated())?.trim_ascii();
        if line.strip_prefix(b"$End") == Some(self.section.as_bytes()) {
            return Ok(());
        }
        Err(self.unexpected(start, "the end of the section", line))
    }

    /// Skips the current section.
    pub(super) fn skip_section(&mut self) -> Result<(), MshError> {
        let end = format!("$End{}", self.section).into_bytes();
        let rest = &self.bytes[self.offset..];
        let found = rest.windows(end.len()).position(|window| window == end).ok_or_else(|| self.truncated())?;
        self.offset += found + end.len();
        Ok(())
    }

    /// Reads the rest of the current line, without its line end; `None` at the end of the file.
    pub(super) fn line(&mut self) -> Option<&'a [u8]> {
        let rest = &self.bytes[self.offset..];
        if rest.is_empty() {
            return None;
        }
        let length = rest.iter().position(|byte| *byte == b'\n');
        self.offset += length.map_or(rest.len(), |length| length + 1);
        Some(&rest[..length.unwrap_or(rest.len())])
    }

    /// Reads the next non-blank line as text.
    pub(super) fn text_line(&mut self) -> Result<&'a str, MshError> {
        self.skip_space();
        let start = self.offset;
        let line = self.line().ok_or_else(|| self.truncated())?.trim_ascii();
        std::str::from_utf8(line).map_err(|_| self.unexpected(start, "text in UTF-8", line))
    }

    /// Reads a signed integer: a dimension, an entity number or an element type.
    pub(super) fn int(&mut self) -> Result<i32, MshError> {
        if self.binary { Ok(i32::from_le_bytes(self.take_bytes()?)) } else { self.word("an integer") }
    }

    /// Reads an unsigned integer: a count, or the tag of a node or an element.
    pub(super) fn size(&mut self) -> Result<u64, MshError> {
        if self.binary { Ok(u64::from_le_bytes(self.take_bytes()?)) } else { self.word("a count or a tag") }
    }

    /// Reads a coordinate.
    pub(super) fn real(&mut self) -> Result<f64, MshError> {
        if self.binary { Ok(f64::from_le_bytes(self.take_bytes()?)) } else { self.word("a number") }
    }

    /// Returns the number of bytes read so far.
    pub(super) fn position(&self) -> usize {
        self.offset
    }

    /// Converts a position in bytes to the line (text file) or byte (binary file) for an error message.
    pub(super) fn file_position(&self, position: usize) -> FilePosition {
        if self.binary {
            FilePosition::Byte(position + 1)
        } else {
            let read = &self.bytes[..position];
            let line = 1 + read.iter().filter(|byte| **byte == b'\n').count();
            // If the position is in white space, the function returns the line of the next number.
            let space = self.bytes[position..].iter().take_while(|byte| byte.is_ascii_whitespace());
            FilePosition::Line(line + space.filter(|byte| **byte == b'\n').count())
        }
    }

    /// Creates the error for unexpected content at a position in bytes.
    pub(super) fn unexpected(&self, position: usize, expected: &'static str, found: &[u8]) -> MshError {
        let section = quote(self.section.as_bytes());
        MshError::Unexpected { position: self.file_position(position), section, expected, found: quote(found) }
    }

    fn truncated(&self) -> MshError {
        MshError::Truncated { position: self.file_position(self.bytes.len()), section: quote(self.section.as_bytes()) }
    }

    fn skip_space(&mut self) {
        self.offset += self.bytes[self.offset..].iter().take_while(|byte| byte.is_ascii_whitespace()).count();
    }

    /// Reads the next bytes of a binary file.
    fn take_bytes<const N: usize>(&mut self) -> Result<[u8; N], MshError> {
        let bytes = self.bytes[self.offset..].first_chunk().ok_or_else(|| self.truncated())?;
        self.offset += N;
        Ok(*bytes)
    }

    /// Reads the next word of a text file as a number.
    fn word<T: std::str::FromStr>(&mut self, expected: &'static str) -> Result<T, MshError> {
        self.skip_space();
        let rest = &self.bytes[self.offset..];
        if rest.is_empty() {
            return Err(self.truncated());
        }
        let length = rest.iter().position(u8::is_ascii_whitespace).unwrap_or(rest.len());
        let number = std::str::from_utf8(&rest[..length]).ok().and_then(|word| word.parse().ok());
        let number = number.ok_or_else(|| self.unexpected(self.offset, expected, &rest[..length]))?;
        self.offset += length;
        Ok(number)
    }
}

/// Returns the first characters of a part of the file, as a quote for an error message.
fn quote(bytes: &[u8]) -> String {
    String::from_utf8_lossy(&bytes[..bytes.len().min(4 * LONGEST_QUOTE)]).chars().take(LONGEST_QUOTE).collect()
}
