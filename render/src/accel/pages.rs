//! Memory in large pages.
//!
//! Rays read nodes and triangles in no order. In a large mesh most of these reads also miss the
//! processor's table of pages, which holds few pages. Linux gives pages of 2 MiB instead of 4 KiB to
//! memory for which a program asks.

/// Size and alignment of a large page, in bytes.
#[cfg(target_os = "linux")]
const LARGE: usize = 2 << 20;

/// Returns an empty vector with this capacity. Where the system has large pages, the vector's memory lies
/// in them as far as it fills them.
#[must_use]
pub fn vector<T>(capacity: usize) -> Vec<T> {
    let vector = Vec::with_capacity(capacity);
    #[cfg(target_os = "linux")]
    advise(&vector);
    vector
}

/// Asks for large pages for the memory of an empty vector.
#[cfg(target_os = "linux")]
#[allow(unsafe_code, reason = "the standard library has no advice about memory")]
fn advise<T>(vector: &Vec<T>) {
    let start = vector.as_ptr().addr();
    let end = start + vector.capacity() * size_of::<T>();
    let (first, last) = (start.next_multiple_of(LARGE), end / LARGE * LARGE);
    if first < last {
        let pages = vector.as_ptr().cast::<u8>().wrapping_add(first - start);
        // SAFETY: the range lies in the vector's memory, and the advice changes no contents. An error means
        // that pages stay small.
        unsafe { libc::madvise(pages.cast_mut().cast(), last - first, libc::MADV_HUGEPAGE) };
    }
}

#[cfg(test)]
mod tests {
    #[test]
    fn vectors_of_any_size_are_usable() {
        for count in [0, 1, 1 << 10, 3 << 20] {
            let mut numbers = super::vector(count);
            assert!(numbers.capacity() >= count);
            numbers.extend(0..count as u32);
            assert!(numbers.iter().copied().eq(0..count as u32));
        }
    }
}
