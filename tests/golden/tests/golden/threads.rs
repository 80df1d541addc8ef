//! Many cloths on many threads and, with the feature `parallel`, one cloth on several threads.

use crate::{hash_text, scenes_with_golden_hashes};
use std::sync::atomic::{AtomicUsize, Ordering};

#[test]
fn scenes_that_run_concurrently_on_four_threads_give_the_golden_hashes() {
    // Every scene twice, so that a scene also runs at the same time as itself.
    let parts: Vec<_> =
        scenes_with_golden_hashes().into_iter().flat_map(|part| [part; 2]).collect();
    let next = AtomicUsize::new(0);
    std::thread::scope(|scope| {
        for _ in 0..4 {
            scope.spawn(|| {
                while let Some((scene, hash)) = parts.get(next.fetch_add(1, Ordering::Relaxed)) {
                    assert_eq!(
                        hash_text(&scene.play()),
                        *hash,
                        "{} beside other scenes",
                        scene.name
                    );
                }
            });
        }
    });
}

#[cfg(feature = "parallel")]
#[test]
fn a_cloth_split_over_several_threads_gives_the_golden_hashes() {
    for (scene, hash) in scenes_with_golden_hashes() {
        for threads in 1..=3 {
            let trace = scene.play_on(threads);
            assert_eq!(hash_text(&trace), hash, "{} on {threads} threads", scene.name);
        }
    }
}
