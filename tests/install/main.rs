//! What `make install` installs: the right files in the right places, which foreign projects find, also once moved.
#![cfg(target_os = "linux")]

mod faults;
mod files;
mod foreign;
mod library;
mod prefix;
mod uninstall;
mod versions;
