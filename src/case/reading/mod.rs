//! Reads input files: JSON, keys, types, and the error handling that all sections share.
//!
//! | file | contents |
//! | --- | --- |
//! | [`document`] | text and kind of an input file |
//! | [`parse`] | checks keys and types; errors name the path of the wrong key |
//! | [`check`] | collects the errors and warnings of the validation |
//! | [`error`] | errors in case files and their messages |
//! | [`hash`] | fingerprint of a case |
//! | [`identity`] | identity of a case in a checkpoint |
//! | [`schema`] | JSON schemas of all kinds of files |
//! | [`template`] | the example case of `breakwater init` |

pub mod check;
pub mod document;
pub mod error;
pub mod hash;
pub mod identity;
pub mod parse;
pub mod schema;
pub mod template;
