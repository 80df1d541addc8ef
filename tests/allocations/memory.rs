//! The memory of a cloth, as the allocator counts it.

use crate::counting_allocator::allocated_bytes;
use muslin::{Cloth, GridDesc};

/// Heap memory of a default cloth of side × side particles after its first ticks [bytes]. These
/// numbers may only fall.
const MOST_BYTES: [(u32, i64); 3] = [(16, 778_616), (40, 4_529_048), (128, 45_023_432)];

/// A default cloth of side × side particles.
fn default_cloth(side: u32) -> Cloth {
    Cloth::grid(&GridDesc { columns: side, rows: side, ..GridDesc::default() }).unwrap()
}

/// Runs `make` and ten ticks; returns the cloth and its heap memory [bytes].
fn measured(make: impl FnOnce() -> Cloth) -> (Box<Cloth>, i64) {
    allocated_bytes(|| {
        let mut cloth = Box::new(make());
        cloth.step(10);
        cloth
    })
}

#[test]
fn the_memory_of_a_default_cloth_only_falls() {
    let measured = MOST_BYTES.map(|(side, _)| (side, measured(|| default_cloth(side)).1));
    let within = measured.iter().zip(MOST_BYTES).all(|((_, bytes), (_, most))| *bytes <= most);
    assert!(within, "{measured:?}, at most {MOST_BYTES:?}");
}
