//! The example case that `breakwater init` writes.

/// Returns the text of a valid case whose assumptions explain what to change.
pub fn template_text() -> String {
    include_str!("template.json").to_owned()
}
