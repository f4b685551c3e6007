//! Rigs of real characters.

mod names;
