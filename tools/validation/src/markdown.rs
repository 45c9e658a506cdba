//! A Markdown page and its figures, which are separate files.

use breakwater::report::plot::standalone;

/// A percentage as text with its sign and one decimal.
pub fn signed(percent: f64) -> String {
    format!("{percent:+.1}").replace('-', "\u{2212}")
}

/// A list in words: `a, b and c`.
pub fn joined(words: &[String]) -> String {
    match words {
        [] => String::new(),
        [one] => one.clone(),
        [first @ .., last] => format!("{} and {last}", first.join(", ")),
    }
}

/// A page under construction.
#[derive(Default)]
pub struct Page {
    text: String,
    figures: Vec<(String, String)>,
}

impl Page {
    /// The text of the page.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// File names and contents of the figures.
    pub fn figures(&self) -> &[(String, String)] {
        &self.figures
    }

    /// Adds a heading, a paragraph or code, with an empty line before it.
    pub fn add(&mut self, words: &str) {
        let gap = if self.text.is_empty() { "" } else { "\n" };
        self.text += &format!("{gap}{words}\n");
    }

    /// Adds a table; the first column is aligned left, the others right.
    pub fn table(&mut self, head: &[String], rows: &[Vec<String>]) {
        let line = |cells: &[String]| format!("| {} |\n", cells.join(" | "));
        let rule: Vec<String> = (0..head.len()).map(|k| if k == 0 { "---" } else { "---:" }.to_owned()).collect();
        let rows: String = rows.iter().map(|row| line(row)).collect();
        self.add((line(head) + &line(&rule) + &rows).trim_end());
    }

    /// Adds a chart (an `<svg>` element) as the figure `file`, with a caption of one sentence below the figure.
    pub fn figure(&mut self, file: &str, chart: &str, caption: &str) {
        self.add(&format!("![{}]({file})\n\n{caption}", caption.trim_end_matches('.')));
        self.figures.push((file.to_owned(), standalone(chart)));
    }
}
