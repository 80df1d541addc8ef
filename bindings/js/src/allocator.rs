//! Global allocator of the WebAssembly module: the standard library's allocator behind functions
//! that are not inlined.
//!
//! Inlined, the code that frees memory is repeated wherever a list ends; that is a tenth of the
//! bytes that a page loads. Every call goes to [`System`] unchanged.

use std::alloc::{GlobalAlloc, Layout, System};

struct SmallCodeAllocator;

#[global_allocator]
static ALLOCATOR: SmallCodeAllocator = SmallCodeAllocator;

// SAFETY: every method passes its arguments to `System` unchanged and returns what `System`
// returns, so the guarantees are those of `System`.
unsafe impl GlobalAlloc for SmallCodeAllocator {
    #[inline(never)]
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        // SAFETY: the caller upholds the contract of `GlobalAlloc::alloc`, which is `System`'s.
        unsafe { System.alloc(layout) }
    }

    #[inline(never)]
    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        // SAFETY: the caller upholds the contract of `GlobalAlloc::alloc_zeroed`, which is
        // `System`'s.
        unsafe { System.alloc_zeroed(layout) }
    }

    #[inline(never)]
    unsafe fn realloc(&self, block: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        // SAFETY: the caller upholds the contract of `GlobalAlloc::realloc`, which is `System`'s.
        unsafe { System.realloc(block, layout, size) }
    }

    #[inline(never)]
    unsafe fn dealloc(&self, block: *mut u8, layout: Layout) {
        // SAFETY: the caller upholds the contract of `GlobalAlloc::dealloc`, which is `System`'s.
        unsafe { System.dealloc(block, layout) };
    }
}
