//! The coupled loop.
