//! The host's floating-point modes, set aside while Muslin computes.
//!
//! A host may flush denormals to zero or round another way; both would change bits.

use core::hint::black_box;

/// Holds the default modes while it lives, then gives the host's back.
pub(crate) struct FloatEnv {
    #[cfg(all(target_arch = "x86_64", not(miri)))]
    host: u32,
    #[cfg(all(target_arch = "aarch64", not(miri)))]
    host: u64,
}

#[cfg(all(target_arch = "x86_64", not(miri)))]
mod register {
    use core::arch::asm;

    /// Round to nearest, denormals kept, all exceptions masked.
    pub const DEFAULT: u32 = 0x1f80;

    pub fn read() -> u32 {
        let mut modes = 0u32;
        // SAFETY: `stmxcsr` writes four bytes to the address it is given, which is `modes`.
        unsafe { asm!("stmxcsr [{}]", in(reg) &raw mut modes, options(nostack, preserves_flags)) };
        modes
    }

    pub fn write(modes: u32) {
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

    /// Round to nearest, denormals kept, no traps.
    pub const DEFAULT: u64 = 0;

    pub fn read() -> u64 {
        let modes: u64;
        // SAFETY: reading FPCR has no effect but on `modes`.
        unsafe { asm!("mrs {}, fpcr", out(reg) modes, options(nomem, nostack, preserves_flags)) };
        modes
    }

    pub fn write(modes: u64) {
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
        }
        Self { host }
    }
}

#[cfg(all(any(target_arch = "x86_64", target_arch = "aarch64"), not(miri)))]
impl Drop for FloatEnv {
    fn drop(&mut self) {
        if self.host != register::DEFAULT {
            register::write(self.host);
        }
    }
}

#[cfg(not(all(any(target_arch = "x86_64", target_arch = "aarch64"), not(miri))))]
impl FloatEnv {
    pub fn enter() -> Self {
        Self {}
    }
}

/// Runs `work` under the default floating-point modes.
pub(crate) fn guarded<T>(work: impl FnOnce() -> T) -> T {
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
        let inside = guarded(register::read);
        let after = register::read();
        register::write(register::DEFAULT);
        assert_eq!(inside & !0x3f, register::DEFAULT);
        assert_eq!(after & !0x3f, flush_and_round_up & !0x3f);
    }
}
