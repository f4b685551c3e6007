//! How many threads a session has.

use std::thread::available_parallelism;

use bespoke::control::Stage;
use bespoke::options::Options;
use glam::DVec3;

use crate::small::session;

/// More threads than cores only wait for each other: a session does not start them, and says how many it has.
#[test]
fn there_are_no_more_threads_than_cores() {
    let cores = available_parallelism().expect("this system says how many cores there are").get();
    for (wanted, threads) in [(0, cores), (1, 1), (cores as u32, cores), (1000, cores)] {
        let mut session = session(1.0, DVec3::ZERO);
        session.set_options(Options { threads: wanted, ..Options::default() }).unwrap();
        assert_eq!(session.run().unwrap(), Stage::Done);
        assert_eq!(session.report().threads, threads, "{wanted} threads were asked for");
    }
}
