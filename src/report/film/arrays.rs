//! Arrays of a film as bytes: integers whose differences compress well.
//!
//! The viewer (`viewer/arrays.js`) reads them. An array is a list of entries with a fixed number of components. For each
//! component, the differences between successive entries are coded as 0, -1, 1, -2, ... = 0, 1, 2, 3, ...; the bytes
//! contain the lowest bytes of all differences, then the next higher bytes, and so on. Equal and small numbers follow
//! each other in this order, which suits the compression (zlib) of the whole list.

use std::io::Write;

use flate2::{Compression, write::ZlibEncoder};
use serde_json::{Value, json};

use crate::report::base64::base64;

/// Largest integer of a coordinate or value; it stands for the upper end of the range.
const TOP: f32 = 65_535.0;

/// The bytes of all arrays of a film.
#[derive(Debug, Default)]
pub struct Arrays {
    bytes: Vec<u8>,
}

impl Arrays {
    /// Appends integers, `parts` per entry. Returns the description of the array for the viewer.
    ///
    /// # Panics
    /// If the number of integers is not a multiple of `parts`.
    pub fn integers(&mut self, values: &[u32], parts: usize) -> Value {
        assert_eq!(values.len() % parts, 0, "complete entries");
        let (at, count) = (self.bytes.len(), values.len() / parts);
        let coded = |part: usize| {
            let mut last = 0_i64;
            values.iter().skip(part).step_by(parts).map(move |&value| {
                let difference = i64::from(value) - last;
                last = i64::from(value);
                ((difference << 1) ^ (difference >> 63)) as u64
            })
        };
        let largest = (0..parts).flat_map(coded).max().unwrap_or(0);
        let size = (8 - largest.leading_zeros() as usize / 8).max(1);
        for part in 0..parts {
            for byte in 0..size {
                self.bytes.extend(coded(part).map(|code| (code >> (8 * byte)) as u8));
            }
        }
        json!({ "at": at, "count": count, "parts": parts, "size": size })
    }

    /// Appends points [m] as integers from 0 to 65535 in a box. Points outside the box are moved to its surface.
    pub fn points(&mut self, points: &[[f32; 3]], corners: [[f32; 3]; 2]) -> Value {
        self.integers(&scaled(points, corners), 3)
    }

    /// Appends numbers as integers from 0 to 65535 between the lowest and the highest number of each component. Numbers
    /// that are not finite become the lowest number.
    pub fn numbers<const N: usize>(&mut self, values: &[[f32; N]]) -> Value {
        let [low, high] = bounds(values);
        let mut array = self.integers(&scaled(values, [low, high]), N);
        array["low"] = json!(low.to_vec());
        array["high"] = json!(high.to_vec());
        array
    }

    /// Returns the compressed bytes as base64 text.
    pub fn packed(&self) -> String {
        let mut encoder = ZlibEncoder::new(Vec::new(), Compression::new(7));
        // Writing to memory cannot fail.
        let written = encoder.write_all(&self.bytes).and_then(|()| encoder.finish());
        base64(&written.unwrap_or_default())
    }
}

/// Returns the lowest and the highest finite number of each component; 0 without numbers.
pub fn bounds<const N: usize>(values: &[[f32; N]]) -> [[f32; N]; 2] {
    let (mut low, mut high) = ([f32::INFINITY; N], [f32::NEG_INFINITY; N]);
    for value in values {
        for part in (0..N).filter(|part| value[*part].is_finite()) {
            low[part] = low[part].min(value[part]);
            high[part] = high[part].max(value[part]);
        }
    }
    let known = |number: f32| if number.is_finite() { number } else { 0.0 };
    [low.map(known), high.map(known)]
}

fn scaled<const N: usize>(values: &[[f32; N]], [low, high]: [[f32; N]; 2]) -> Vec<u32> {
    let part = |value: &[f32; N], k: usize| {
        let share = (value[k] - low[k]) / (high[k] - low[k]).max(f32::MIN_POSITIVE);
        (TOP * share.clamp(0.0, 1.0)).round() as u32
    };
    values.iter().flat_map(|value| (0..N).map(move |k| part(value, k))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Reads an array back, as the viewer does.
    fn read(arrays: &Arrays, array: &Value) -> Vec<u32> {
        let key = |name: &str| array[name].as_u64().unwrap() as usize;
        let (at, count, parts, size) = (key("at"), key("count"), key("parts"), key("size"));
        let mut values = vec![0; count * parts];
        for part in 0..parts {
            let mut value = 0_i64;
            for entry in 0..count {
                let byte = |k: usize| u64::from(arrays.bytes[at + (part * size + k) * count + entry]) << (8 * k);
                let code = (0..size).map(byte).sum::<u64>();
                value += (code >> 1) as i64 ^ -((code & 1) as i64);
                values[entry * parts + part] = value as u32;
            }
        }
        values
    }

    #[test]
    fn integers_read_back() {
        let mut arrays = Arrays::default();
        let lists: [(&[u32], usize); 4] =
            [(&[], 3), (&[7, 65_535, 0, 8, 0, 65_535], 3), (&[1, 2, 3], 1), (&[4_000_000_000, 0, 1], 1)];
        let described: Vec<Value> = lists.iter().map(|(values, parts)| arrays.integers(values, *parts)).collect();
        for ((values, _), array) in lists.iter().zip(&described) {
            assert_eq!(read(&arrays, array), *values);
        }
        assert_eq!([0, 1, 2, 3].map(|k: usize| described[k]["size"].as_u64().unwrap()), [1, 3, 1, 5]);
    }

    #[test]
    fn points_lie_within_half_a_step_of_their_place() {
        let corners = [[37.0, 0.0, 0.4], [40.5, 0.16, 1.1]];
        let points: Vec<[f32; 3]> = (0..100).map(|i| [37.0 + 0.035 * i as f32, 0.1, 0.4 + 0.007 * i as f32]).collect();
        let mut arrays = Arrays::default();
        let array = arrays.points(&points, corners);
        for (point, place) in points.iter().zip(read(&arrays, &array).chunks(3)) {
            for axis in 0..3 {
                let (low, high) = (corners[0][axis], corners[1][axis]);
                let back = low + (high - low) * place[axis] as f32 / TOP;
                // Half a step, and the rounding of single precision at 40 m.
                assert!((back - point[axis]).abs() <= 0.5 * (high - low) / TOP + 8e-6);
            }
        }
    }

    #[test]
    fn the_text_is_zlib_and_bounds_skip_unknown_numbers() {
        let mut arrays = Arrays::default();
        arrays.numbers(&[[1.0], [f32::NAN]]);
        // The first byte of a zlib stream with a window of 32 KiB is 0x78, so that the text starts with "e".
        assert!(arrays.packed().starts_with('e'));
        assert_eq!(bounds::<2>(&[[1.0, f32::NAN], [-2.0, 5.0]]), [[-2.0, 5.0], [1.0, 5.0]]);
        assert_eq!(bounds::<1>(&[]), [[0.0], [0.0]]);
    }
}
