//! Joins the files of one field over all starts (restarts) of an OpenFOAM run, `<folder>/<t0>/<file>`.
//!
//! A line that begins with `#` is a comment. Other lines have a time and numbers, with vectors in round brackets.

use std::fs;
use std::path::{Path, PathBuf};

use super::super::error::ExternalError;
use super::super::numbers::as_text;
use super::super::text_file::TextFile;

/// Rows of all starts of a run, in order of time.
pub(super) struct Joined {
    /// Comments without their `#`, the same in every start.
    pub(super) comments: Vec<String>,
    /// Times [s].
    pub(super) times_s: Vec<f64>,
    /// Numbers after the time, one list per time; all lists have the same length.
    pub(super) rows: Vec<Vec<f64>>,
}

impl Joined {
    /// Reads and joins `<folder>/<t0>/<file>` of every start time t0 that has the file.
    pub(super) fn read(folder: &Path, file: &str) -> Result<Self, ExternalError> {
        let mut joined: Option<Self> = None;
        for (_, start) in time_folders(folder)? {
            let path = start.join(file);
            if !path.is_file() {
                continue;
            }
            let run = Self::read_start(&path)?;
            match &mut joined {
                None => joined = Some(run),
                Some(earlier) => earlier.append(run, &path)?,
            }
        }
        joined.ok_or_else(|| {
            ExternalError::file(
                folder,
                format!("no folder of a start time has a file `{file}`"),
                "give the folder `postProcessing/<name>`, and sample this field",
            )
        })
    }

    /// Reads the file of one start.
    fn read_start(path: &Path) -> Result<Self, ExternalError> {
        let text = TextFile::read(path, "check its permissions")?;
        let mut start = Self { comments: vec![], times_s: vec![], rows: vec![] };
        for (line, words) in text.lines() {
            if let Some(comment) = words.strip_prefix('#') {
                start.comments.push(comment.trim().to_owned());
                continue;
            }
            let mut numbers = text.numbers_in_brackets(line, words)?;
            let values = numbers.split_off(1.min(numbers.len()));
            let Some(&time) = numbers.first() else {
                return Err(text.line_error(line, "no numbers", "correct or delete the line"));
            };
            let expected = start.rows.first().map_or(values.len(), Vec::len);
            if values.len() != expected {
                let problem = format!("{} numbers after the time, expected {expected}", values.len());
                return Err(text.line_error(
                    line,
                    problem,
                    "correct or delete the line; a killed run may leave an incomplete line",
                ));
            }
            if let Some(last) = start.times_s.last().filter(|&&last| time <= last) {
                let problem = format!("t = {} s follows t = {} s", as_text(time), as_text(*last));
                return Err(text.line_error(line, problem, "times must increase; delete rows of another run"));
            }
            start.times_s.push(time);
            start.rows.push(values);
        }
        Ok(start)
    }

    /// Appends the rows of a later start. They replace earlier rows from the first time of the later start onwards.
    fn append(&mut self, later: Self, path: &Path) -> Result<(), ExternalError> {
        let width = |start: &Self| start.rows.first().map(Vec::len);
        if later.comments != self.comments || (width(self).zip(width(&later)).is_some_and(|(a, b)| a != b)) {
            let problem = "the heading or number of columns differs from the files of earlier starts";
            return Err(ExternalError::file(path, problem, "delete the folders of runs with other probes"));
        }
        let Some(first) = later.times_s.first() else { return Ok(()) };
        let kept = self.times_s.partition_point(|t| t < first);
        self.times_s.truncate(kept);
        self.rows.truncate(kept);
        self.times_s.extend(later.times_s);
        self.rows.extend(later.rows);
        Ok(())
    }
}

/// Returns the subfolders whose names are times, with the times [s], in order of time.
pub(super) fn time_folders(folder: &Path) -> Result<Vec<(f64, PathBuf)>, ExternalError> {
    let unreadable = |reason: std::io::Error| ExternalError::Read {
        file: folder.to_owned(),
        reason: reason.to_string(),
        advice: "give the folder `postProcessing/<name>`".to_owned(),
    };
    let mut folders = Vec::new();
    for entry in fs::read_dir(folder).map_err(unreadable)? {
        let path = entry.map_err(unreadable)?.path();
        let time = path.file_name().and_then(|name| name.to_str()).and_then(|name| name.parse::<f64>().ok());
        if let Some(time) = time.filter(|time| time.is_finite() && path.is_dir()) {
            folders.push((time, path));
        }
    }
    folders.sort_by(|a, b| a.0.total_cmp(&b.0));
    Ok(folders)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Creates a folder with files `U` at the given starts.
    fn folder(starts: &[(&str, &str)]) -> tempfile::TempDir {
        let folder = tempfile::tempdir().unwrap();
        for (start, text) in starts {
            fs::create_dir(folder.path().join(start)).unwrap();
            fs::write(folder.path().join(start).join("U"), text).unwrap();
        }
        folder
    }

    fn message(starts: &[(&str, &str)]) -> String {
        let folder = folder(starts);
        let text = Joined::read(folder.path(), "U").err().unwrap().to_string();
        text.replace(&format!("{}", folder.path().display()), "probes")
    }

    #[test]
    fn later_start_replaces_the_end_of_the_earlier_start() {
        // Starts are joined in the order of their numbers, not of their names: 10 comes after 2.
        let folder = folder(&[
            ("10", "# a\n11 (5 6 7)\n"),
            ("0", "# a\n1 (1 0 0)\n2 (2 0 0)\n3 (3 0 0)\n"),
            ("2", "# a\n3 (4 0 0)\n"),
        ]);
        let joined = Joined::read(folder.path(), "U").unwrap();
        assert_eq!(joined.comments, ["a"]);
        assert_eq!(joined.times_s, [1.0, 2.0, 3.0, 11.0]);
        assert_eq!(joined.rows[2..], [[4.0, 0.0, 0.0], [5.0, 6.0, 7.0]]);
    }

    #[test]
    fn files_from_other_systems_are_read_or_refused_with_their_line() {
        let read = |bytes: &[u8]| {
            let folder = folder(&[("0", "")]);
            fs::write(folder.path().join("0/U"), bytes).unwrap();
            Joined::read(folder.path(), "U").map_err(|error| error.to_string())
        };
        for text in [
            "# a\n0.5 (1 0 0.25)\n1 (2 0 0)\n",
            "\u{feff}# a\r\n0.5\t(1 0 0.25)\r\n1\t(2 0 0)\r\n\r\n",
            "# a\n 0,5 ( 1 0 0,25 ) \n 1 ( 2 0 0 ) \n \n",
            "# a\n5D-1 (1.0d+00 0 2.5D-01)\n1 (2 0 0)\n",
        ] {
            let joined = read(text.as_bytes()).unwrap();
            assert_eq!(joined.comments, ["a"], "{text}");
            assert_eq!(
                (joined.times_s, joined.rows),
                (vec![0.5, 1.0], vec![vec![1.0, 0.0, 0.25], vec![2.0, 0.0, 0.0]])
            );
        }
        assert!(read(b"# 3 \xb0\n1 (1 0 0)\n").is_ok(), "the degree sign in Windows-1252");
        for (row, problem) in [
            ("1 (0.5 0,25 0)", "line 3: `0.5` has a decimal point, but `0,25` a comma; write decimal points only"),
            ("1 (1,234.5 0 0)", "line 3: `1,234.5` is not a number; write decimal points, and no separators"),
            ("1 (1; 0 0)", "line 3: `1;` is not a number; correct or delete the line"),
            ("1 (1 0 0) (2", "line 3: 4 numbers after the time, expected 3; correct or delete the line"),
        ] {
            let error = read(format!("# a\n0 (1 0 0)\n{row}\n").as_bytes()).err().unwrap();
            assert!(error.contains(problem), "{error}");
        }
    }

    #[test]
    fn error_names_the_wrong_line() {
        assert_eq!(
            message(&[("0", "# a\n1 (1 0 0)\n2 (1 0\n")]),
            "probes/0/U: line 3: 2 numbers after the time, expected 3; correct or delete the line; a killed run may \
             leave an incomplete line"
        );
        assert_eq!(
            message(&[("0", "1 1\n1 2\n")]),
            "probes/0/U: line 2: t = 1 s follows t = 1 s; times must increase; delete rows of another run"
        );
        assert_eq!(
            message(&[("0", "1 one\n")]),
            "probes/0/U: line 1: `one` is not a number; correct or delete the line"
        );
        assert!(message(&[("0", "( )\n")]).starts_with("probes/0/U: line 1: no numbers"));
    }

    #[test]
    fn errors_name_missing_files_and_other_probes() {
        assert!(message(&[]).starts_with("probes: no folder of a start time has a file `U`; give the folder"));
        assert!(message(&[("0", "# a\n1 1\n"), ("1", "# b\n2 1\n")]).starts_with("probes/1/U: the heading or number"));
        let missing = Joined::read(Path::new("no/such"), "U").err().unwrap().to_string();
        assert!(missing.starts_with("no/such: cannot be read: ") && missing.ends_with("`postProcessing/<name>`"));
    }
}
