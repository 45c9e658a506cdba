//! Mutates text files with lines and words, and binary files.

use crate::random::Random;

/// Words that replace numbers and keywords.
const WORDS: [&str; 30] = [
    "0",
    "-0",
    "1",
    "-1",
    "2",
    "3",
    "7",
    "1e308",
    "-1e308",
    "1e-308",
    "5e-324",
    "1e400",
    "1e9",
    "-1e9",
    "1e-9",
    "1e18",
    "nan",
    "inf",
    "-inf",
    "4294967295",
    "4294967296",
    "2147483648",
    "18446744073709551615",
    "-9223372036854775808",
    "1,5",
    "********",
    "é漢",
    "\"",
    "(",
    "x",
];

/// Numbers that are written over the bytes of a binary file.
const NUMBERS: [u64; 12] = [
    0,
    1,
    2,
    0xFF,
    0xFFFF,
    0x7FFF_FFFF,
    0xFFFF_FFFF,
    0x7F80_0000,
    0x7FC0_0000,
    u64::MAX,
    0x7FF0_0000_0000_0000,
    0x7FEF_FFFF_FFFF_FFFF,
];

/// Returns a mutated copy of a file.
pub fn mutate(content: &[u8], random: &mut Random) -> Vec<u8> {
    let mut content = content.to_vec();
    for _ in 0..1 + random.below(3) {
        if content.is_empty() {
            break;
        }
        let binary = content.contains(&0) || random.below(8) == 0;
        content = if binary { with_changed_bytes(content, random) } else { with_changed_words(&content, random) };
    }
    content
}

fn with_changed_bytes(mut content: Vec<u8>, random: &mut Random) -> Vec<u8> {
    let at = random.below(content.len());
    match random.below(8) {
        0 => content[at] ^= 1 << random.below(8),
        1 => content[at] = random.below(256) as u8,
        2 => content.truncate(at),
        3 => drop(content.remove(at)),
        4 => content.insert(at, random.below(256) as u8),
        5 | 6 => {
            let bytes = random.pick(&NUMBERS).to_le_bytes();
            let width = [1, 2, 4, 8][random.below(4)];
            content.iter_mut().skip(at).zip(&bytes[..width]).for_each(|(old, new)| *old = *new);
        }
        _ => {
            let end = (at + 1 + random.below(64)).min(content.len());
            let copied = content[at..end].to_vec();
            let to = random.below(content.len());
            content.iter_mut().skip(to).zip(copied).for_each(|(old, new)| *old = new);
        }
    }
    content
}

fn with_changed_words(content: &[u8], random: &mut Random) -> Vec<u8> {
    let mut lines: Vec<Vec<u8>> = content.split(|byte| *byte == b'\n').map(<[u8]>::to_vec).collect();
    let (line, other) = (random.below(lines.len()), random.below(lines.len()));
    match random.below(12) {
        0 => drop(lines.remove(line)),
        1 => lines.insert(line, lines[other].clone()),
        2 => lines.swap(line, other),
        3 => lines[line] = lines[other].clone(),
        4 => lines.truncate(line),
        5 => {
            let last = (line + 1 + random.below(20)).min(lines.len());
            let copied = lines[line..last].to_vec();
            lines.splice(other..other, copied);
        }
        6 => {
            let last = (line + 1 + random.below(20)).min(lines.len());
            lines.drain(line..last);
        }
        _ => lines[line] = with_changed_word(&lines[line], random),
    }
    lines.join(&b'\n')
}

fn with_changed_word(line: &[u8], random: &mut Random) -> Vec<u8> {
    let separator = *random.pick(b"   ,");
    let mut words: Vec<Vec<u8>> = line.split(|byte| *byte == separator).map(<[u8]>::to_vec).collect();
    let (word, other) = (random.below(words.len()), random.below(words.len()));
    match random.below(10) {
        0 => drop(words.remove(word)),
        1 => words.insert(word, words[other].clone()),
        2 => words.swap(word, other),
        3..=5 => words[word] = changed_number(&words[word], random),
        _ => words[word] = random.pick(&WORDS).as_bytes().to_vec(),
    }
    words.join(&separator)
}

/// Returns a number near the written one, or scaled; another word stays as it is.
fn changed_number(word: &[u8], random: &mut Random) -> Vec<u8> {
    let number = std::str::from_utf8(word).ok().and_then(|word| word.trim().parse::<f64>().ok());
    number.map_or_else(|| word.to_vec(), |number| change(number, random).to_string().into_bytes())
}

/// Returns a number near another one, or scaled.
pub fn change(number: f64, random: &mut Random) -> f64 {
    match random.below(8) {
        0 => -number,
        1 => number + 1.0,
        2 => number - 1.0,
        3 => number * 2.0,
        4 => number * 0.5,
        5 => number * (1.0 + 1e-12),
        _ => number * 10f64.powi(random.below(25) as i32 - 12),
    }
}
