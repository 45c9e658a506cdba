//! A page in Markdown with figures beside it.

use crate::report::plot::standalone;

/// A number of per cent with its sign.
pub fn signed(percent: f64) -> String {
    format!("{percent:+.1}").replace('-', "\u{2212}")
}

/// A page as it grows.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Page {
    text: String,
    figures: Vec<(String, String)>,
}

impl Page {
    /// A page under a title.
    pub fn new(title: &str) -> Self {
        Self { text: format!("# {title}\n"), figures: Vec::new() }
    }

    /// The text of the page.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// File names and contents of its figures.
    pub fn figures(&self) -> &[(String, String)] {
        &self.figures
    }

    /// A heading; those under the title have level 2.
    pub fn heading(&mut self, level: usize, words: &str) {
        self.text += &format!("\n{} {words}\n", "#".repeat(level));
    }

    /// A paragraph.
    pub fn paragraph(&mut self, words: &str) {
        self.text += &format!("\n{words}\n");
    }

    /// A command.
    pub fn code(&mut self, command: &str) {
        self.text += &format!("\n    {command}\n");
    }

    /// A list.
    pub fn list(&mut self, items: impl IntoIterator<Item = String>) {
        self.text += "\n";
        items.into_iter().for_each(|item| self.text += &format!("* {item}\n"));
    }

    /// A table; the first column stands left, the others right.
    pub fn table(&mut self, head: &[String], rows: &[Vec<String>]) {
        let line = |cells: &[String]| {
            let cells: Vec<String> = cells.iter().map(|cell| cell.replace('|', "\\|").replace('\n', " ")).collect();
            format!("| {} |\n", cells.join(" | "))
        };
        let rule = (0..head.len()).map(|column| if column == 0 { " --- " } else { " ---: " }.to_owned());
        self.text += &format!("\n{}|{}|\n", line(head), rule.collect::<Vec<_>>().join("|"));
        rows.iter().for_each(|row| self.text += &line(row));
    }

    /// A chart, `<svg>`, as a file beside the page, with words under it, of which the first stand for it where it cannot be
    /// shown, and the command that makes it again.
    pub fn figure(&mut self, file: &str, chart: &str, caption: &str, command: &str) {
        let words = caption.replace(['[', ']', '`'], "");
        let end = [". ", ";", "(", ", "].into_iter().filter_map(|sign| words.find(sign)).min().unwrap_or(words.len());
        self.text += &format!("\n![{}]({file})\n\n{caption}\n", words[..end].trim().trim_end_matches('.'));
        self.code(command);
        self.figures.push((file.to_owned(), standalone(chart)));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_keeps_its_columns() {
        let mut page = Page::new("Title");
        let words = |cells: [&str; 2]| cells.map(str::to_owned).to_vec();
        page.table(&words(["a", "b"]), &[words(["x|y", "1"])]);
        assert_eq!(page.text(), "# Title\n\n| a | b |\n| --- | ---: |\n| x\\|y | 1 |\n");
    }
}
