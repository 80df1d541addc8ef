//! An allocator that counts the allocations of each thread, and the bytes that it holds.

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

/// The system allocator with a count of allocations and of allocated bytes per thread.
struct CountingAllocator;

thread_local! {
    static COUNT: Cell<u32> = const { Cell::new(0) };
    /// Bytes that this thread allocated, less those that it freed.
    static BYTES: Cell<i64> = const { Cell::new(0) };
}

/// Adds `bytes` to the bytes of this thread; negative ones are freed.
fn add_bytes(bytes: i64) {
    BYTES.set(BYTES.get() + bytes);
}

// SAFETY: every call is forwarded unchanged to the system allocator.
unsafe impl GlobalAlloc for CountingAllocator {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        COUNT.set(COUNT.get() + 1);
        add_bytes(layout.size() as i64);
        // SAFETY: the caller's guarantees are also those that the system allocator needs.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, at: *mut u8, layout: Layout) {
        add_bytes(-(layout.size() as i64));
        // SAFETY: as above.
        unsafe { System.dealloc(at, layout) }
    }

    unsafe fn realloc(&self, at: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        COUNT.set(COUNT.get() + 1);
        add_bytes(size as i64 - layout.size() as i64);
        // SAFETY: as above.
        unsafe { System.realloc(at, layout, size) }
    }
}

#[global_allocator]
static ALLOCATOR: CountingAllocator = CountingAllocator;

/// Number of allocations on this thread while `work` runs.
pub fn allocation_count(work: impl FnOnce()) -> u32 {
    let before = COUNT.get();
    work();
    COUNT.get() - before
}

/// Runs `work` and returns its result, and the bytes that this thread allocated in it and did not
/// free.
pub fn allocated_bytes<T>(work: impl FnOnce() -> T) -> (T, i64) {
    let before = BYTES.get();
    let result = work();
    (result, BYTES.get() - before)
}

#[test]
fn the_allocation_counter_counts() {
    let made = allocation_count(|| drop(Vec::<u32>::with_capacity(9)));
    assert_eq!(made, 1);
    let (list, bytes) = allocated_bytes(|| Vec::<u32>::with_capacity(9));
    assert_eq!(bytes, 36);
    assert_eq!(allocated_bytes(|| drop(list)).1, -36);
}
