//! The frame of every page: style sheet, sections, numbers as people read them.

use super::plot::{CHART_STYLE, escape, short};

/// A whole page with the style sheet in it.
pub fn page(title: &str, body: &str) -> String {
    let title = escape(title);
    let style = [CHART_STYLE, include_str!("style.css"), include_str!("shades.css")].concat();
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{title}</title>\n\
         <style>\n{style}</style>\n</head>\n<body>\n<main>\n{body}</main>\n</body>\n</html>\n"
    )
}

/// A section with its heading; nothing if there is no content.
pub fn section(heading: &str, content: &str) -> String {
    if content.is_empty() { String::new() } else { format!("<section>\n<h2>{heading}</h2>\n{content}</section>\n") }
}

/// A whole number with thin spaces between groups of three figures.
pub fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (index, digit) in digits.chars().enumerate() {
        if index > 0 && (digits.len() - index).is_multiple_of(3) {
            text.push('\u{2009}');
        }
        text.push(digit);
    }
    text
}

/// A duration [s] in the unit that suits it.
pub fn clock(seconds: f64) -> String {
    match seconds {
        s if s < 100.0 => format!("{} s", short(s, 1)),
        s if s < 5400.0 => format!("{} min", short(s / 60.0, 1)),
        s => format!("{} h", short(s / 3600.0, 2)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_grouped_and_times_readable() {
        assert_eq!(grouped(17541570), "17\u{2009}541\u{2009}570");
        assert_eq!(grouped(999), "999");
        assert_eq!(clock(12.34), "12.3 s");
        assert_eq!(clock(107_640.0), "29.9 h");
    }
}
