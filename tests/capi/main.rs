//! The C API, called as a C program calls it.
mod header;
