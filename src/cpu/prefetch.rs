//! Memory that is asked for before it is needed.
//!
//! A pass reads nineteen arrays side by side. Processors foresee a few such streams, not so many: with each of them asked
//! for some lines ahead, one thread updates 300 million cells a second where it updated 170 (AVX-512, 128³ cells, single
//! precision). This is the only file with unsafe code (`tests/suite/tidy.rs`).

#![expect(unsafe_code, reason = "the instruction has no safe form")]

/// How far ahead, in bytes.
const AHEAD: usize = 512;

/// Vectors shorter than this come many to a line: asking for each would cost more than it gives.
const LEAST: usize = 32;

/// Asks for the memory of `values` some way behind number `at`, which may lie beyond their end.
#[inline(always)]
pub(super) fn ask_ahead<V>(values: &[V], at: usize) {
    if ahead_of::<V>() > 0 {
        ask(values.as_ptr().wrapping_add(at + ahead_of::<V>()));
    }
}

/// How many numbers of type `V` lie that far ahead; 0 for those that are not asked for ahead.
pub(super) const fn ahead_of<V>() -> usize {
    if size_of::<V>() >= LEAST { AHEAD / size_of::<V>() } else { 0 }
}

/// Asks for the memory of the first of `values`.
#[inline(always)]
pub(super) fn ask_first<V>(values: &[V]) {
    ask(values.as_ptr());
}

/// Asks for the line of memory at an address, whatever it is.
#[inline(always)]
fn ask<V>(address: *const V) {
    #[cfg(all(target_arch = "x86_64", not(miri)))]
    {
        use std::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
        // SAFETY: it needs SSE, which every processor of this kind has. It neither reads nor writes: an address that is
        // not mapped is let be (Intel 64 and IA-32 Architectures Software Developer's Manual, PREFETCHh), so that nothing
        // need be known of the pointer, which is not turned into a reference either.
        unsafe { _mm_prefetch::<_MM_HINT_T0>(address.cast::<i8>()) };
    }
    #[cfg(not(all(target_arch = "x86_64", not(miri))))]
    let _ = address;
}
