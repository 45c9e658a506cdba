//! Layout of the HTML pages of all reports: style sheet, sections, number formats.

use super::film::FILM_STYLE;
use super::plot::{CHART_STYLE, escape, short};

/// Returns a complete HTML page with style sheet. `title` is plain text, `body` is HTML.
pub fn page(title: &str, body: &str) -> String {
    page_reloading(title, body, None)
}

/// Returns a page as [`page`] does. With `reload_s` [s], a browser loads the page again after this time, unless the
/// film plays.
pub fn page_reloading(title: &str, body: &str, reload_s: Option<u64>) -> String {
    let reload = reload_s.map_or(String::new(), |time| {
        let milliseconds = 1000 * time;
        format!(
            "<script>setInterval(() => {{ if (!window.breakwaterFilm?.isBusy()) location.reload(); }}, \
             {milliseconds});</script>\n"
        )
    });
    let title = escape(title);
    let style = [CHART_STYLE, include_str!("style.css"), include_str!("shades.css"), FILM_STYLE].concat();
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n{reload}<title>{title}</title>\n\
         <style>\n{style}</style>\n</head>\n<body>\n<main>\n{body}</main>\n</body>\n</html>\n"
    )
}

/// Returns an HTML section with its heading, or an empty string if `content` is empty.
pub fn section(heading: &str, content: &str) -> String {
    if content.is_empty() { String::new() } else { format!("<section>\n<h2>{heading}</h2>\n{content}</section>\n") }
}

/// Formats an integer with thin spaces between groups of three digits.
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

/// Formats a duration [s] in seconds, minutes or hours, depending on its length.
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
    fn digits_are_grouped_and_durations_have_a_suitable_unit() {
        assert_eq!(grouped(17541570), "17\u{2009}541\u{2009}570");
        assert_eq!(grouped(999), "999");
        assert_eq!(clock(12.34), "12.3 s");
        assert_eq!(clock(107_640.0), "29.9 h");
    }
}
