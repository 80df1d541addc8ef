//! Hosts with other floating-point modes: flush-to-zero and rounding up. The library must neither
//! let them change a bit nor leave its own modes behind.

use crate::{hash_text, scenes_with_golden_hashes};
use muslin::glam::{Quat, Vec3};
use muslin::{Cloth, ColliderDesc, GridDesc, Material, Settings, Wind};
use std::hint::black_box;

#[cfg(target_arch = "x86_64")]
mod register {
    use core::arch::asm;

    /// A host's modes: flush-to-zero with denormals-are-zero, rounding up, both at once.
    pub const MODES: [(&str, u64); 3] =
        [("flush to zero", 0x9fc0), ("round up", 0x5f80), ("flush and round up", 0xdfc0)];
    /// The mode bits; the other bits are exception flags.
    pub const MASK: u64 = 0xffc0;

    pub fn read() -> u64 {
        let mut modes = 0u32;
        // SAFETY: `stmxcsr` writes four bytes to the address it is given, which is `modes`.
        unsafe { asm!("stmxcsr [{}]", in(reg) &raw mut modes, options(nostack, preserves_flags)) };
        u64::from(modes)
    }

    pub fn write(modes: u64) {
        let modes = modes as u32;
        // SAFETY: `ldmxcsr` reads four bytes from `modes`, which came from the register itself or
        // from `MODES`: no reserved bit is set and no exception is unmasked. Code that runs under
        // these modes computes only with numbers that are exact in any mode.
        unsafe {
            asm!("ldmxcsr [{}]", in(reg) &raw const modes, options(nostack, preserves_flags));
        }
    }
}

#[cfg(target_arch = "aarch64")]
mod register {
    use core::arch::asm;

    /// A host's modes: flush-to-zero, rounding up, both at once.
    pub const MODES: [(&str, u64); 3] = [
        ("flush to zero", 1 << 24),
        ("round up", 1 << 22),
        ("flush and round up", 1 << 24 | 1 << 22),
    ];
    /// The bits that are modes.
    pub const MASK: u64 = 0x07c0_0000;

    pub fn read() -> u64 {
        let modes: u64;
        // SAFETY: reading FPCR has no effect but on `modes`.
        unsafe { asm!("mrs {}, fpcr", out(reg) modes, options(nomem, nostack, preserves_flags)) };
        modes
    }

    pub fn write(modes: u64) {
        // SAFETY: the value came from the register itself or from `MODES`: nothing traps. Code
        // that runs under these modes computes only with numbers that are exact in any mode.
        unsafe { asm!("msr fpcr, {}", in(reg) modes, options(nostack, preserves_flags)) };
    }
}

/// Guard that sets a host's floating-point modes and restores the previous ones on drop.
struct HostModes {
    previous: u64,
    set: u64,
}

impl HostModes {
    fn enter(set: u64) -> Self {
        let previous = register::read();
        register::write(set);
        Self { previous, set }
    }

    /// Whether the modes still have the values that were set.
    fn is_unchanged(&self) -> bool {
        register::read() & register::MASK == self.set & register::MASK
    }
}

impl Drop for HostModes {
    fn drop(&mut self) {
        register::write(self.previous);
    }
}

#[test]
fn the_modes_of_this_test_take_effect() {
    for (name, modes) in register::MODES {
        let host = HostModes::enter(modes);
        let (tiny, one) = black_box((f32::MIN_POSITIVE, 1.0_f32));
        let (half, sum) = black_box((tiny * 0.5, one + tiny));
        drop(host);
        assert_eq!(half == 0.0, name.contains("flush"), "{name}");
        assert_eq!(sum > 1.0, name.contains("up"), "{name}");
    }
}

#[test]
fn host_floating_point_modes_change_no_bit_and_are_restored() {
    let parts = scenes_with_golden_hashes();
    for (name, modes) in register::MODES {
        for (scene, hash) in &parts {
            let host = HostModes::enter(modes);
            let trace = scene.play();
            let is_unchanged = host.is_unchanged();
            drop(host);
            assert_eq!(hash_text(&trace), *hash, "{} under {name}", scene.name);
            assert!(is_unchanged, "{} changed the host's modes: {name}", scene.name);
        }
    }
}

/// Cloths are split over the host's own threads, which run with its modes and also do other work. A
/// thread that waits for its part of a cloth may execute either kind of job.
#[cfg(feature = "parallel")]
#[test]
fn host_thread_modes_change_no_bit_and_are_restored_for_other_jobs() {
    let parts = scenes_with_golden_hashes();
    for (name, modes) in register::MODES {
        let is_unchanged = move || register::read() & register::MASK == modes & register::MASK;
        let threads = rayon::ThreadPoolBuilder::new().num_threads(3);
        let pool = threads.start_handler(move |_| register::write(modes)).build().unwrap();
        pool.in_place_scope(|scope| {
            for (scene, hash) in &parts {
                scope.spawn(move |_| {
                    let trace = scene.play_on(3);
                    assert_eq!(hash_text(&trace), *hash, "{} under {name}", scene.name);
                    assert!(is_unchanged(), "{} changed the host's modes: {name}", scene.name);
                });
                for _ in 0..500 {
                    scope.spawn(move |_| assert!(is_unchanged(), "a host job ran without {name}"));
                }
            }
        });
    }
}

type Call = fn(&mut Cloth);

/// Every call that computes, with its name.
const CALLS: &[(&str, Call)] = &[
    ("grid", |cloth| *cloth = Cloth::grid(&GridDesc::default()).unwrap()),
    ("set_settings", |cloth| {
        cloth
            .set_settings(Settings { iterations: 1, max_stretch: 0.1, ..Settings::default() })
            .unwrap();
    }),
    ("set_material", |cloth| {
        cloth.set_material(Material { density: 0.25, ..Material::default() }).unwrap();
    }),
    ("set_wind", |cloth| {
        cloth.set_wind(Wind { velocity: Vec3::Z, turbulence: 0.5, ..Wind::default() }).unwrap();
    }),
    ("step", |cloth| cloth.step(2)),
    ("advance", |cloth| assert!(cloth.advance(0.0625).unwrap() > 0)),
    ("blend", |cloth| assert!(cloth.blend() < 1.0)),
    ("pin", |cloth| cloth.pin(900, Some(Vec3::ONE)).unwrap()),
    ("unpin", |cloth| cloth.unpin(900).unwrap()),
    ("set_pin_targets", |cloth| cloth.set_pin_targets(&[3, 4], &[Vec3::X; 2]).unwrap()),
    ("set_position", |cloth| cloth.set_position(800, Vec3::NEG_Y).unwrap()),
    ("set_velocity", |cloth| cloth.set_velocity(801, Vec3::Y).unwrap()),
    ("grab_ray, move_grab, release", |cloth| {
        let (eye, ahead) = (Vec3::new(1.0, -1.0, 5.0), Vec3::NEG_Z);
        let (grab, _) = cloth.grab_ray(eye, ahead, 0.5).unwrap().unwrap();
        cloth.move_grab(grab, Vec3::new(1.0, -1.0, 0.5)).unwrap();
        cloth.step(1);
        cloth.release(grab).unwrap();
    }),
    ("raycast", |cloth| {
        let hit = cloth.raycast(Vec3::new(1.0, -1.0, 5.0), Vec3::NEG_Z, f32::INFINITY);
        assert!(hit.unwrap().is_some());
    }),
    ("add_collider, move_collider", |cloth| {
        let floor = cloth.add_collider(&ColliderDesc::default()).unwrap();
        cloth.move_collider(floor, Vec3::NEG_Y, Quat::IDENTITY).unwrap();
        cloth.step(1);
        cloth.remove_collider(floor).unwrap();
    }),
    ("tear_edge", |cloth| assert!(cloth.tear_edge(820, 860).unwrap())),
    ("normals", |cloth| assert!(!cloth.normals().is_empty())),
    ("stats", |cloth| assert!(cloth.stats().particles > 0)),
    ("save, restore", |cloth| *cloth = Cloth::restore(&cloth.save()).unwrap()),
    ("clone", |cloth| *cloth = cloth.clone()),
    ("unpin_all", Cloth::unpin_all),
    ("a refused call", |cloth| assert!(cloth.advance(-1.0).is_err())),
    ("reset", Cloth::reset),
];

#[test]
fn every_call_restores_the_host_modes_and_gives_the_same_bits_under_them() {
    let start = Cloth::grid(&GridDesc::default()).unwrap();
    let plain: Vec<_> = hashes_after_calls(&mut start.clone(), |_| ());
    for (name, modes) in register::MODES {
        let host = HostModes::enter(modes);
        let mut changed_by = None;
        let hashes = hashes_after_calls(&mut start.clone(), |call| {
            if changed_by.is_none() && !host.is_unchanged() {
                changed_by = Some(call);
            }
        });
        drop(host);
        assert_eq!(changed_by, None, "a call changed the host's modes: {name}");
        for ((call, _), (hash, plain)) in CALLS.iter().zip(hashes.iter().zip(&plain)) {
            assert_eq!(hash, plain, "after {call} under {name}");
        }
    }
}

/// Makes all calls in order and returns the state hash after each.
fn hashes_after_calls(cloth: &mut Cloth, mut after: impl FnMut(&'static str)) -> Vec<u64> {
    let mut hashes = Vec::new();
    for (name, call) in CALLS {
        call(cloth);
        after(name);
        hashes.push(cloth.state_hash());
    }
    hashes
}
