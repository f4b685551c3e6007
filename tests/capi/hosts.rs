//! Hosts as they are: thread pools, small stacks, other floating-point modes, processes that fork.

use std::collections::VecDeque;
use std::sync::{Arc, Mutex};
use std::thread;

use bespoke::capi::options::bespoke_session_set_options;
use bespoke::capi::results::bespoke_session_read_garment_vertices;
use bespoke::capi::running::*;
use bespoke::capi::session::*;
use bespoke::capi::status::BespokeStatus;
use bespoke::capi::view::{BespokeBuffer, BespokeComponent};

use testing::caller::{Caller, no_options};

use BespokeStatus::Ok;

/// A session in the hands of one thread after the other.
struct Job {
    caller: Caller,
    vertices: usize,
    stepped_by: Vec<thread::ThreadId>,
}
// SAFETY: the functions that are called with it say that any thread may, one at a time.
unsafe impl Send for Job {}

impl Job {
    /// A session with the sample, for one thread of the library's.
    fn new() -> Self {
        let (caller, sample) = Caller::with_sample();
        let mut options = no_options();
        options.threads = 1;
        // SAFETY: the session is alive.
        caller.accepted(unsafe { bespoke_session_set_options(caller.session, &options) });
        Self { caller, vertices: sample.garment.0.len(), stepped_by: Vec::new() }
    }

    /// One iteration; whether that was the last one.
    fn step(&mut self) -> bool {
        self.stepped_by.push(thread::current().id());
        let mut stage = 0;
        // SAFETY: the session is alive.
        self.caller.accepted(unsafe { bespoke_session_step(self.caller.session, 1, 0, &mut stage) });
        stage == BespokeStage::Done as u32
    }

    fn prepare(&mut self) {
        // SAFETY: the session is alive.
        self.caller.accepted(unsafe { bespoke_session_prepare(self.caller.session) });
    }

    /// The result, bit by bit.
    fn result(&self) -> Vec<u32> {
        let mut points = vec![[0u32; 3]; self.vertices];
        let buffer = BespokeBuffer {
            data: points.as_mut_ptr().cast(),
            capacity: points.len(),
            stride: 0,
            component: BespokeComponent::F32 as u32,
        };
        // SAFETY: the session is alive, and the buffer is as large as it says.
        self.caller.accepted(unsafe {
            bespoke_session_read_garment_vertices(self.caller.session, &buffer, std::ptr::null_mut())
        });
        points.concat()
    }

    /// The whole way, where nothing is special.
    fn run(mut self) -> Vec<u32> {
        self.prepare();
        while !self.step() {}
        self.result()
    }
}

#[test]
fn a_host_steps_sessions_in_whichever_thread_is_free() {
    const THREADS: usize = 4;
    const SESSIONS: usize = 10;
    let expected = Job::new().run();
    let waiting: VecDeque<_> = (0..SESSIONS).map(|_| Job::new()).collect();
    let queue = Arc::new(Mutex::new((waiting, 0)));
    let done = Arc::new(Mutex::new(Vec::new()));
    let workers: Vec<_> = (0..THREADS)
        .map(|_| {
            let (queue, done) = (queue.clone(), done.clone());
            thread::spawn(move || {
                loop {
                    let next = {
                        let (waiting, ended) = &mut *queue.lock().expect("no thread of the test fails");
                        if *ended == SESSIONS {
                            return;
                        }
                        waiting.pop_front()
                    };
                    let Some(mut job) = next else {
                        thread::yield_now();
                        continue;
                    };
                    let is_done = if job.stepped_by.is_empty() {
                        job.prepare();
                        job.step()
                    } else {
                        job.step()
                    };
                    if is_done {
                        done.lock().expect("no thread of the test fails").push(job);
                        queue.lock().expect("no thread of the test fails").1 += 1;
                    } else {
                        queue.lock().expect("no thread of the test fails").0.push_back(job);
                    }
                }
            })
        })
        .collect();
    for worker in workers {
        worker.join().expect("no thread of the test fails");
    }
    let done = done.lock().expect("no thread of the test fails");
    let moved = |job: &&Job| job.stepped_by.iter().any(|thread| *thread != job.stepped_by[0]);
    assert!(done.iter().filter(moved).count() > SESSIONS / 2, "the sessions wander from thread to thread");
    for job in done.iter() {
        assert!(job.result() == expected, "a session that wandered has another result");
    }
}

#[test]
fn a_small_stack_is_enough_for_the_calling_thread() {
    let expected = Job::new().run();
    let host = thread::Builder::new().stack_size(64 << 10).spawn(|| Job::new().run()).expect("a thread");
    assert!(host.join().expect("the stack was enough") == expected);
}

/// `work` with another mode in this thread's register, which it must leave as it is. Gives what `work` gave and the mode
/// that was found after it.
#[cfg(target_arch = "x86_64")]
fn in_mode<R>(mode: u32, work: impl FnOnce() -> R) -> (R, u32) {
    use std::arch::asm;
    let (mut before, mut after) = (0u32, 0u32);
    // SAFETY: every x86-64 processor has the register. `work` is one call of the library, which sets its own mode, and
    // nothing is computed in between.
    unsafe {
        asm!("stmxcsr [{}]", in(reg) &raw mut before);
        asm!("ldmxcsr [{}]", in(reg) &raw const mode);
        let result = work();
        asm!("stmxcsr [{}]", in(reg) &raw mut after);
        asm!("ldmxcsr [{}]", in(reg) &raw const before);
        (result, after)
    }
}

#[test]
#[cfg(target_arch = "x86_64")]
fn the_mode_of_the_calling_thread_changes_no_bit_and_is_left_alone() {
    const DEFAULT: u32 = 0x1F80;
    const FLUSH_RESULTS_AND_OPERANDS: u32 = 0x8040;
    const ROUND_UP: u32 = 0x4000;
    const ROUND_TO_ZERO: u32 = 0x6000;
    /// Traps for all but the inexact and the subnormal, which the test's own code may meet.
    const TRAP_INVALID_DIVISION_OVERFLOW: u32 = 0x0680;
    const INEXACT_HAPPENED: u32 = 0x0020;
    let expected = Job::new().run();
    for mode in [
        DEFAULT | FLUSH_RESULTS_AND_OPERANDS,
        DEFAULT | ROUND_UP,
        DEFAULT | ROUND_TO_ZERO | FLUSH_RESULTS_AND_OPERANDS | INEXACT_HAPPENED,
        DEFAULT & !TRAP_INVALID_DIVISION_OVERFLOW,
    ] {
        let mut job = Job::new();
        let mut set = |work: &mut dyn FnMut(&mut Job)| {
            let ((), after) = in_mode(mode, || work(&mut job));
            assert_eq!(after, mode, "the mode {mode:#x} was {after:#x} after a call");
        };
        set(&mut |job| job.prepare());
        let mut is_done = false;
        while !is_done {
            set(&mut |job| is_done = job.step());
        }
        let mut result = Vec::new();
        set(&mut |job| result = job.result());
        assert!(result == expected, "another result with the mode {mode:#x}");
    }
}

#[test]
fn a_forked_process_is_refused_and_the_parent_goes_on() {
    let mut job = Job::new();
    job.prepare();
    assert!(!job.step(), "there is something left to do");
    let session = job.caller.session;
    // SAFETY: the child makes calls that take no lock and allocate nothing, and ends.
    let child = unsafe { libc::fork() };
    assert!(child >= 0, "a process can be forked");
    if child == 0 {
        let mut sentence = [0u8; 200];
        // SAFETY: the memory of the session is there, and the calls look at nothing but whose it is.
        unsafe {
            let refused = [
                bespoke_session_step(session, 0, 0, std::ptr::null_mut()),
                bespoke_session_reset(session),
                bespoke_session_destroy(session),
            ];
            bespoke_session_last_message(session, sentence.as_mut_ptr().cast(), 200, std::ptr::null_mut());
            let is_explained = sentence.windows(6).any(|word| word == b"forked");
            libc::_exit(if is_explained && refused == [BespokeStatus::InvalidState; 3] { 42 } else { 1 });
        }
    }
    let mut status = 0;
    // SAFETY: the child is ours, and there is room for its status.
    assert_eq!(unsafe { libc::waitpid(child, &mut status, 0) }, child);
    assert!(libc::WIFEXITED(status));
    assert_eq!(libc::WEXITSTATUS(status), 42, "the child was refused with a message");
    while !job.step() {}
    assert!(job.result() == Job::new().run());
    // SAFETY: the session is alive.
    assert_eq!(unsafe { bespoke_session_reset(session) }, Ok);
}
