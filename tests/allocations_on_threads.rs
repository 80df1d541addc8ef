//! Once a cloth is made and its threads are warm, ticks on several threads allocate nothing either.
#![cfg(feature = "parallel")]

use muslin::glam::Vec3;
use muslin::{Cloth, GridDesc, MeshDesc, PinMode, Wind};
use std::alloc::{GlobalAlloc, Layout, System};
use std::sync::atomic::{AtomicUsize, Ordering};

struct Counting;

/// Allocations of all threads.
static COUNT: AtomicUsize = AtomicUsize::new(0);

// SAFETY: every call is passed on to the system's allocator as it came.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        COUNT.fetch_add(1, Ordering::Relaxed);
        // SAFETY: the caller's promises hold for the system's allocator too.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, at: *mut u8, layout: Layout) {
        // SAFETY: as above.
        unsafe { System.dealloc(at, layout) }
    }

    unsafe fn realloc(&self, at: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        COUNT.fetch_add(1, Ordering::Relaxed);
        // SAFETY: as above.
        unsafe { System.realloc(at, layout, size) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// How often `work` allocates, on whatever threads.
fn allocations(work: impl FnOnce()) -> usize {
    let before = COUNT.load(Ordering::Relaxed);
    work();
    COUNT.load(Ordering::Relaxed) - before
}

fn step_and_read(cloth: &mut Cloth, ticks: u32) {
    for _ in 0..ticks {
        cloth.step(1);
        assert!(!cloth.normals().is_empty());
    }
}

/// A grid and a mesh in the wind, on three threads.
fn cloths() -> [Cloth; 2] {
    let mut desc =
        GridDesc { columns: 70, rows: 70, pin_mode: PinMode::TopCorners, ..GridDesc::default() };
    desc.settings.tearing = true;
    desc.material.tear_stretch = 1.1;
    let grid = Cloth::grid(&desc).unwrap();
    // In another order, or it would be found to be the grid.
    let mut indices = grid.indices().to_vec();
    indices.rotate_left(3);
    let mesh = Cloth::mesh(&MeshDesc {
        positions: grid.positions().to_vec(),
        indices,
        pinned: grid.pinned().collect(),
        material: desc.material.clone(),
        settings: desc.settings.clone(),
        ..MeshDesc::default()
    });
    [grid, mesh.unwrap()].map(|mut cloth| {
        let velocity = Vec3::new(0.5, 0.25, 9.0);
        cloth.set_wind(Wind { velocity, turbulence: 0.5, ..Wind::default() }).unwrap();
        cloth.set_threads_eagerly(3).unwrap();
        cloth
    })
}

// One test, since what others allocate meanwhile would count.
#[test]
fn ticks_on_threads_allocate_nothing() {
    assert_eq!(allocations(|| drop(Vec::<u32>::with_capacity(9))), 1, "the counter counts");
    let pool = rayon::ThreadPoolBuilder::new().num_threads(3).build().unwrap();
    for mut cloth in cloths() {
        let before = cloth.positions().len();
        pool.install(|| {
            step_and_read(&mut cloth, 20);
            assert_eq!(allocations(|| step_and_read(&mut cloth, 100)), 0);
        });
        assert!(cloth.positions().len() > before, "nothing tore");
        // Handing over to the pool from outside takes a place in its queue, which is made sixty or so
        // at a time.
        step_and_read(&mut cloth, 20);
        let (handed_over, count) = (2 * 150, allocations(|| step_and_read(&mut cloth, 150)));
        assert!(
            count <= handed_over / 50,
            "{count} allocations in {handed_over} calls from outside"
        );
    }
}
