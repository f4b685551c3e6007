//! What is shipped for Windows, built on Linux and run by Wine: BESPOKE_WINDOWS names the folder that `make dist-windows`
//! made. Wine is not Windows; what is the same with both are the bits, the names and the calls.

mod hosts;
mod paths;
mod program;
mod projects;
mod shipped;
mod stops;
mod symbols;
mod wine;
