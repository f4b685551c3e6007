//! What is shipped, and how it behaves in a process that others share: the library as it is built here, and where
//! BESPOKE_DIST names what `make dist` made (the folder or its archive), that too.
//!
//! BESPOKE_TBB names a folder that `tbb.sh` has filled: other versions of TBB, which a host may have loaded already.

mod archive;
mod bare;
mod hosts;
mod needs;
mod plugin;
mod programs;
mod shipped;
mod starved;
mod symbols;
