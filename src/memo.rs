//! What several sessions need is computed by the first of them and shared with the others.
//!
//! A value is known by all that it is computed from, compared bit by bit, so that who takes one that is there gets what he would
//! have computed.

use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use glam::DVec3;

use crate::control::Cancel;
use crate::error::Result;
use crate::geometry::mesh::TriangleMesh;

/// How often one that waits for another's value looks whether it was cancelled.
const LOOK: Duration = Duration::from_millis(5);

/// The latest few values by their keys, for any number of threads.
pub struct Memo<K, V> {
    entries: Mutex<Vec<Arc<Entry<K, V>>>>,
    most: usize,
}

struct Entry<K, V> {
    key: K,
    state: Mutex<State<V>>,
    changed: Condvar,
}

enum State<V> {
    /// Nobody computes it.
    Unknown,
    UnderWay,
    Known(Arc<V>),
}

impl<K: PartialEq, V> Memo<K, V> {
    /// An empty one that keeps `most` values, at least one; another one takes the place of the oldest.
    pub fn new(most: usize) -> Self {
        Self { entries: Mutex::default(), most: most.max(1) }
    }

    /// The value for `key`, by `make` where it is not known. Where another thread is at it, waits for that, unless `cancel` is
    /// set; where that one fails, computes it itself.
    ///
    /// # Errors
    /// Those of `make`, which nobody else gets, and `Cancelled`.
    pub fn get(&self, key: K, cancel: &Cancel, make: impl FnOnce() -> Result<V>) -> Result<Arc<V>> {
        let entry = self.entry(key);
        let mut state = entry.lock();
        loop {
            match &*state {
                State::Known(value) => return Ok(value.clone()),
                State::Unknown => break,
                State::UnderWay => {
                    cancel.check()?;
                    let waited = entry.changed.wait_timeout(state, LOOK);
                    state = waited.unwrap_or_else(PoisonError::into_inner).0;
                }
            }
        }
        *state = State::UnderWay;
        drop(state);
        let at_work = AtWork(&entry);
        let value = Arc::new(make()?);
        *entry.lock() = State::Known(value.clone());
        drop(at_work);
        Ok(value)
    }

    fn entry(&self, key: K) -> Arc<Entry<K, V>> {
        let mut entries = self.entries.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(entry) = entries.iter().find(|entry| entry.key == key) {
            return entry.clone();
        }
        if entries.len() == self.most {
            entries.remove(0);
        }
        let entry = Arc::new(Entry { key, state: Mutex::new(State::Unknown), changed: Condvar::new() });
        entries.push(entry.clone());
        entry
    }
}

impl<K, V> Entry<K, V> {
    fn lock(&self) -> MutexGuard<'_, State<V>> {
        // It is whole at any time: no lock is held while a value is computed.
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Computes a value. Those that wait for it are woken when this is dropped, also by an error or a panic.
struct AtWork<'a, K, V>(&'a Entry<K, V>);

impl<K, V> Drop for AtWork<'_, K, V> {
    fn drop(&mut self) {
        let mut state = self.0.lock();
        if let State::UnderWay = *state {
            *state = State::Unknown;
        }
        drop(state);
        self.0.changed.notify_all();
    }
}

/// A mesh as a key: the same where all of its numbers have the same bits.
#[derive(Clone)]
pub struct MeshBits(pub Arc<TriangleMesh>);

/// Points as a key, likewise.
#[derive(Clone)]
pub struct PointBits(pub Vec<DVec3>);

impl PartialEq for MeshBits {
    fn eq(&self, other: &Self) -> bool {
        let (a, b) = (&*self.0, &*other.0);
        Arc::ptr_eq(&self.0, &other.0) || a.triangles == b.triangles && are_same(&a.positions, &b.positions)
    }
}

impl PartialEq for PointBits {
    fn eq(&self, other: &Self) -> bool {
        are_same(&self.0, &other.0)
    }
}

/// Whether all numbers have the same bits.
fn are_same(a: &[DVec3], b: &[DVec3]) -> bool {
    let same_bits = |(p, q): (&DVec3, &DVec3)| p.to_array().map(f64::to_bits) == q.to_array().map(f64::to_bits);
    a.len() == b.len() && a.iter().zip(b).all(same_bits)
}
