//! The host's floating-point modes, set aside while Muslin computes.
//!
//! A host may flush denormals to zero or round another way; both would change bits.

use core::hint::black_box;

/// Holds the default modes while it lives, then gives the host's back.
pub(crate) struct FloatEnv {
    #[cfg(all(any(target_arch = "x86_64", target_arch = "aarch64"), not(miri)))]
    host: register::Modes,
}

#[cfg(all(target_arch = "x86_64", not(miri)))]
mod register {
    use core::arch::asm;

    pub type Modes = u32;

    /// Round to nearest, denormals kept, all exceptions masked.
    pub const DEFAULT: Modes = 0x1f80;

    pub fn read() -> Modes {
        let mut modes = 0;
        // SAFETY: `stmxcsr` writes four bytes to the address it is given, which is `modes`.
        unsafe { asm!("stmxcsr [{}]", in(reg) &raw mut modes, options(nostack, preserves_flags)) };
        modes
    }

    pub fn write(modes: Modes) {
        // SAFETY: `ldmxcsr` reads four bytes from `modes`; the value came from the register itself
        // or is `DEFAULT`, so no reserved bit is set.
        unsafe {
            asm!("ldmxcsr [{}]", in(reg) &raw const modes, options(nostack, preserves_flags));
        }
    }
}

#[cfg(all(target_arch = "aarch64", not(miri)))]
mod register {
    use core::arch::asm;

    pub type Modes = u64;

    /// Round to nearest, denormals kept, no traps.
    pub const DEFAULT: Modes = 0;

    pub fn read() -> Modes {
        let modes: Modes;
        // SAFETY: reading FPCR has no effect but on `modes`.
        unsafe { asm!("mrs {}, fpcr", out(reg) modes, options(nomem, nostack, preserves_flags)) };
        modes
    }

    pub fn write(modes: Modes) {
        // SAFETY: the value came from the register itself or is `DEFAULT`.
        unsafe { asm!("msr fpcr, {}", in(reg) modes, options(nostack, preserves_flags)) };
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
    use super::register::{self, DEFAULT, Modes};
    use std::cell::Cell;

    thread_local! {
        /// The host's modes while they are set aside.
        pub static HOST: Cell<Option<Modes>> = const { Cell::new(None) };
    }

    /// Holds the host's modes while it lives, then the default ones again.
    pub struct HostEnv(Option<Modes>);

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

/// Where there are no modes to set aside.
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

/// Runs `work` under the modes that were set aside last on this thread, if any were: while it waits
/// for other threads, this one may do the host's work.
#[cfg(feature = "parallel")]
pub(crate) fn with_host_float_env<T>(work: impl FnOnce() -> T) -> T {
    let _env = HostEnv::enter();
    black_box(black_box(work)())
}

/// Runs `work` under the default floating-point modes.
pub(crate) fn with_float_env<T>(work: impl FnOnce() -> T) -> T {
    let _env = FloatEnv::enter();
    // Compilers take arithmetic as free of modes and would move it past their change, unless they
    // cannot see what goes in and what comes out.
    black_box(black_box(work)())
}

#[cfg(all(test, target_arch = "x86_64", not(miri)))]
mod tests {
    use super::*;

    #[test]
    fn the_hosts_modes_are_set_aside_and_given_back() {
        let flush_and_round_up = 0x9fc0 | 0x4000;
        register::write(flush_and_round_up);
        let inside = with_float_env(register::read);
        let after = register::read();
        register::write(register::DEFAULT);
        assert_eq!(inside & !0x3f, register::DEFAULT);
        assert_eq!(after & !0x3f, flush_and_round_up & !0x3f);
    }
}
