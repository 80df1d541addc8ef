//! Another Rust library, for a program that links two of them statically.

/// Panics and catches the panic, so that the panic runtime is linked. Returns 7.
#[unsafe(no_mangle)]
pub extern "C" fn other_catches() -> i32 {
    std::panic::set_hook(Box::new(|_| {}));
    let caught = std::panic::catch_unwind(|| -> i32 { panic!("on purpose") });
    if caught.is_err() { 7 } else { 0 }
}
