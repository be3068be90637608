//! A writer that counts and sums up what goes through it.

use std::io::{self, Write};

use xxhash_rust::xxh3::Xxh3Default;

/// Hands everything on to `inner`.
pub struct Hashed<W> {
    /// Where it goes.
    pub inner: W,
    length: u64,
    sum: Xxh3Default,
}

impl<W> Hashed<W> {
    /// Nothing has gone through yet.
    pub fn new(inner: W) -> Self {
        Hashed { inner, length: 0, sum: Xxh3Default::new() }
    }

    /// Takes bytes into account that are there already.
    pub fn count(&mut self, bytes: &[u8]) {
        self.length += bytes.len() as u64;
        self.sum.update(bytes);
    }

    /// Bytes so far.
    pub fn length(&self) -> u64 {
        self.length
    }

    /// XXH3 of the bytes so far.
    pub fn digest(&self) -> u64 {
        self.sum.digest()
    }
}

impl<W: Write> Write for Hashed<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let count = self.inner.write(bytes)?;
        self.count(&bytes[..count]);
        Ok(count)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.inner.flush()
    }
}
