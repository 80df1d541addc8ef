//! Ticks on several threads allocate no memory once the cloth exists and the pool is warm.
#![cfg(feature = "parallel")]

use muslin::glam::Vec3;
use muslin::{Cloth, GridDesc, MeshDesc, PinMode, Wind};
use std::alloc::{GlobalAlloc, Layout, System};
use std::sync::atomic::{AtomicUsize, Ordering};

/// The system allocator with a count of allocations.
struct CountingAllocator;

/// Number of allocations on all threads.
static COUNT: AtomicUsize = AtomicUsize::new(0);

// SAFETY: every call is forwarded unchanged to the system allocator.
unsafe impl GlobalAlloc for CountingAllocator {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        COUNT.fetch_add(1, Ordering::Relaxed);
        // SAFETY: the caller's guarantees are also those that the system allocator needs.
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
static ALLOCATOR: CountingAllocator = CountingAllocator;

/// Number of allocations on all threads while `work` runs.
fn allocation_count(work: impl FnOnce()) -> usize {
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
fn grid_and_mesh() -> [Cloth; 2] {
    let mut desc =
        GridDesc { columns: 70, rows: 70, pin_mode: PinMode::TopCorners, ..GridDesc::default() };
    desc.settings.tearing = true;
    desc.material.tear_stretch = 1.1;
    let grid = Cloth::grid(&desc).unwrap();
    // Rotate the triangles, or the mesh intake would detect the grid.
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

// A single test, because allocations of tests that run at the same time would count.
#[test]
fn ticks_on_several_threads_allocate_nothing() {
    assert_eq!(
        allocation_count(|| drop(Vec::<u32>::with_capacity(9))),
        1,
        "the counter must count"
    );
    let pool = rayon::ThreadPoolBuilder::new().num_threads(3).build().unwrap();
    for mut cloth in grid_and_mesh() {
        let before = cloth.positions().len();
        pool.install(|| {
            step_and_read(&mut cloth, 20);
            assert_eq!(allocation_count(|| step_and_read(&mut cloth, 100)), 0);
        });
        assert!(cloth.positions().len() > before, "nothing tore");
        // A tick from outside the pool runs on any thread of it, and each has scratch buffers of its own.
        rayon::broadcast(|_| drop(cloth.clone()));
        // A job from outside the pool takes a slot in its queue, which allocates about sixty slots
        // at a time.
        step_and_read(&mut cloth, 20);
        let (job_count, count) = (2 * 150, allocation_count(|| step_and_read(&mut cloth, 150)));
        assert!(
            count <= job_count / 50,
            "{count} allocations in {job_count} jobs from outside the pool"
        );
    }
}
