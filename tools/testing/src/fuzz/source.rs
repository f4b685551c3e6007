//! Numbers out of a fuzzer's bytes.

/// A reader of bytes that goes on with zeros at their end, so that every input is a whole program.
pub struct Source<'a> {
    bytes: &'a [u8],
}

/// Values at which arithmetic is known to stumble.
const ODD: [f64; 16] = [
    0.0,
    -0.0,
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
    f64::MIN_POSITIVE,
    5e-324,
    1e-45,
    1e30,
    -1e30,
    1.000_001e30,
    f64::MAX,
    3.5e38,
    16_777_217.0,
    1e-12,
    -1.0,
];

impl<'a> Source<'a> {
    pub fn new(bytes: &'a [u8]) -> Self {
        Self { bytes }
    }

    pub fn is_empty(&self) -> bool {
        self.bytes.is_empty()
    }

    pub fn byte(&mut self) -> u8 {
        let Some((&first, rest)) = self.bytes.split_first() else { return 0 };
        self.bytes = rest;
        first
    }

    pub fn u32(&mut self) -> u32 {
        u32::from_le_bytes(std::array::from_fn(|_| self.byte()))
    }

    pub fn u64(&mut self) -> u64 {
        u64::from_le_bytes(std::array::from_fn(|_| self.byte()))
    }

    /// Below `end`, which is at most 256.
    pub fn below(&mut self, end: usize) -> usize {
        usize::from(self.byte()) % end
    }

    /// From `low` to `high`, both included, at most 256 values.
    pub fn between(&mut self, low: usize, high: usize) -> usize {
        low + self.below(high - low + 1)
    }

    /// True for one byte in `n`, and not at the end of the bytes.
    pub fn one_in(&mut self, n: u8) -> bool {
        self.byte() % n == n - 1
    }

    /// In [-1, 1).
    pub fn signed(&mut self) -> f64 {
        f64::from(self.byte() as i8) / 128.0
    }

    /// In [low, high).
    pub fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * f64::from(self.byte()) / 256.0
    }

    /// Any number: a sensible one, one of the odd ones, or any bits.
    pub fn number(&mut self) -> f64 {
        match self.byte() {
            0..128 => 2.0 * self.signed(),
            128..192 => ODD[self.below(ODD.len())],
            192..224 => 10f64.powf(40.0 * self.signed()),
            224.. => f64::from_bits(self.u64()),
        }
    }

    /// Any size: mostly small, else near a power of two.
    pub fn size(&mut self) -> usize {
        match self.byte() {
            0..192 => self.below(48),
            192..224 => usize::MAX - self.below(16),
            224.. => (1usize << (self.byte() % 64)).wrapping_add(self.below(3)).wrapping_sub(1),
        }
    }
}
