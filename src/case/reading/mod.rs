//! Reads input files: JSON, keys, types, and what is the same for every section.
//!
//! | file | what it holds |
//! | --- | --- |
//! | [`document`] | the text of an input file and its kind |
//! | [`parse`] | keys and types, with the path of a wrong one |
//! | [`check`] | collects errors and warnings of the validation |
//! | [`error`] | errors and their messages |
//! | [`hash`] | fingerprint of a case |
//! | [`schema`] | JSON schemas of all kinds of files |
//! | [`template`] | the example case of `breakwater init` |

pub mod check;
pub mod document;
pub mod error;
pub mod hash;
pub mod parse;
pub mod schema;
pub mod template;
