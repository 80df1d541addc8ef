//! A call for many cloths allocates only what it returns.

use crate::counting_allocator::allocation_count;
use muslin::glam::Vec3;
use muslin::{Cloth, GridDesc, Wind};

#[test]
fn many_cloths_in_one_call_allocate_only_the_list_of_ticks() {
    let cloth = Cloth::grid(&GridDesc { columns: 8, rows: 8, ..GridDesc::default() }).unwrap();
    let mut cloths = vec![cloth; 40];
    cloths[0].set_wind(Wind { velocity: Vec3::Z, gust: 0.5, ..Wind::default() }).unwrap();
    let frames = 30;
    // Rayon allocates when a thread outside its pool starts work in it.
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    let count = pool.install(|| {
        // The first tick on a thread allocates the thread's scratch buffers.
        Cloth::advance_many(&mut cloths, 1.0 / 60.0).unwrap();
        allocation_count(|| {
            for _ in 0..frames {
                Cloth::advance_many(&mut cloths, 1.0 / 60.0).unwrap();
            }
        })
    });
    assert_eq!(count, frames);
}
