//! A plugin over the crate: it exports what its host asks for, and nothing of the library's C API.

use bespoke::session::{Session, Stage};

/// What the host of this plugin asks for: whether a session, of which everything is linked in, can be had.
#[unsafe(no_mangle)]
pub extern "C" fn plugin_is_ready() -> bool {
    let mut session = Session::new();
    // Nothing was handed in.
    session.run().is_err() && session.stage() == Stage::Setup
}
