//! Saves and restores the floating-point environment of the host.
//!
//! A host may flush denormals to zero or use another rounding mode; both would change results.
//! Muslin therefore writes the default mode to the control register (MXCSR on x86-64, FPCR on
//! aarch64) while it computes, and restores the mode of the host afterwards. WebAssembly has only
//! the default mode.
//!
//! Reads and writes the control register of the current thread.
//! Invariant: all arithmetic of the library runs inside [`with_float_env`]: round to nearest,
//! denormals kept, no traps.

use core::hint::black_box;

/// A guard: the default mode is set while it lives, and the mode of the host is restored when it is
/// dropped.
pub(crate) struct FloatEnv {
    #[cfg(all(any(target_arch = "x86_64", target_arch = "aarch64"), not(miri)))]
    host: register::ControlWord,
}

#[cfg(all(target_arch = "x86_64", not(miri)))]
mod register {
    use core::arch::asm;

    pub type ControlWord = u32;

    /// Round to nearest, denormals kept, all exceptions masked.
    pub const DEFAULT: ControlWord = 0x1f80;

    pub fn read() -> ControlWord {
        let mut word = 0;
        // SAFETY: `stmxcsr` writes four bytes to the given address, which is that of `word`.
        unsafe { asm!("stmxcsr [{}]", in(reg) &raw mut word, options(nostack, preserves_flags)) };
        word
    }

    pub fn write(word: ControlWord) {
        // SAFETY: `ldmxcsr` reads four bytes from `word`; the value came from the register itself
        // or is `DEFAULT`, so no reserved bit is set.
        unsafe {
            asm!("ldmxcsr [{}]", in(reg) &raw const word, options(nostack, preserves_flags));
        }
    }
}

#[cfg(all(target_arch = "aarch64", not(miri)))]
mod register {
    use core::arch::asm;

    pub type ControlWord = u64;

    /// Round to nearest, denormals kept, no traps.
    pub const DEFAULT: ControlWord = 0;

    pub fn read() -> ControlWord {
        let word: ControlWord;
        // SAFETY: reading FPCR has no side effects.
        unsafe { asm!("mrs {}, fpcr", out(reg) word, options(nomem, nostack, preserves_flags)) };
        word
    }

    pub fn write(word: ControlWord) {
        // SAFETY: the value came from the register itself or is `DEFAULT`.
        unsafe { asm!("msr fpcr, {}", in(reg) word, options(nostack, preserves_flags)) };
    }
}

#[cfg(all(any(target_arch = "x86_64", target_arch = "aarch64"), not(miri)))]
impl FloatEnv {
    pub fn enter() -> Self {
        let host = register::read();
        if host != register::DEFAULT {
            register::write(register::DEFAULT);
            #[cfg(feature = "parallel")]
            HOST.set(Some(host));
        }
        Self { host }
    }
}

#[cfg(all(any(target_arch = "x86_64", target_arch = "aarch64"), not(miri)))]
impl Drop for FloatEnv {
    fn drop(&mut self) {
        if self.host != register::DEFAULT {
            #[cfg(feature = "parallel")]
            HOST.set(None);
            register::write(self.host);
        }
    }
}

#[cfg(all(
    feature = "parallel",
    any(target_arch = "x86_64", target_arch = "aarch64"),
    not(miri)
))]
use host::{HOST, HostEnv};

#[cfg(all(feature = "parallel", any(target_arch = "x86_64", target_arch = "aarch64"), not(miri)))]
mod host {
    use super::register::{self, ControlWord, DEFAULT};
    use std::cell::Cell;

    thread_local! {
        /// The mode of the host while the default mode is set on this thread.
        pub static HOST: Cell<Option<ControlWord>> = const { Cell::new(None) };
    }

    /// A guard: the mode of the host is set while it lives, and the default mode again afterwards.
    pub struct HostEnv(Option<ControlWord>);

    impl HostEnv {
        pub fn enter() -> Self {
            let host = HOST.take();
            if let Some(host) = host {
                register::write(host);
            }
            Self(host)
        }
    }

    impl Drop for HostEnv {
        fn drop(&mut self) {
            if self.0.is_some() {
                register::write(DEFAULT);
                HOST.set(self.0);
            }
        }
    }
}

#[cfg(not(all(any(target_arch = "x86_64", target_arch = "aarch64"), not(miri))))]
impl FloatEnv {
    pub fn enter() -> Self {
        Self {}
    }
}

/// Does nothing: this target has no control register, or it is not accessible.
#[cfg(all(
    feature = "parallel",
    not(all(any(target_arch = "x86_64", target_arch = "aarch64"), not(miri)))
))]
struct HostEnv;

#[cfg(all(
    feature = "parallel",
    not(all(any(target_arch = "x86_64", target_arch = "aarch64"), not(miri)))
))]
impl HostEnv {
    fn enter() -> Self {
        Self
    }
}

/// Runs `work` in the floating-point mode of the host, if this thread is in the default mode now.
/// While a thread waits for others, its pool may run work of the host on it.
#[cfg(feature = "parallel")]
pub(crate) fn with_host_float_env<T>(work: impl FnOnce() -> T) -> T {
    let _env = HostEnv::enter();
    black_box(black_box(work)())
}

/// Runs `work` in the default floating-point mode, and restores the mode of the host afterwards.
pub(crate) fn with_float_env<T>(work: impl FnOnce() -> T) -> T {
    let _env = FloatEnv::enter();
    // Compilers assume that arithmetic does not depend on the mode and could move it across the
    // change of mode. `black_box` hides the inputs and outputs from them.
    black_box(black_box(work)())
}

#[cfg(all(test, target_arch = "x86_64", not(miri)))]
mod tests {
    use super::*;

    #[test]
    fn the_mode_of_the_host_is_restored() {
        let flush_and_round_up = 0x9fc0 | 0x4000;
        register::write(flush_and_round_up);
        let inside = with_float_env(register::read);
        let after = register::read();
        register::write(register::DEFAULT);
        assert_eq!(inside & !0x3f, register::DEFAULT);
        assert_eq!(after & !0x3f, flush_and_round_up & !0x3f);
    }
}
