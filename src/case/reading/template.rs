//! The example case that `breakwater init` writes.

/// Returns the text of a valid flume case. Its assumptions explain which values the user should change.
pub fn template_text() -> String {
    include_str!("template.json").to_owned()
}
