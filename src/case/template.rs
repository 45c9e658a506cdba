//! The case that `breakwater init` writes to start from.

/// Text of a case that loads as it is and says in its assumptions what to change.
pub fn template_text() -> String {
    include_str!("template.json").to_owned()
}
