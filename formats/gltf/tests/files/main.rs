//! Reading and writing files: over small ones that the tests make, and over real ones where there are any.

mod animations;
mod broken;
mod everything;
mod rigs;
mod saving;
mod strips;
