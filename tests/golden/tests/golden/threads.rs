//! Many cloths on many threads; and, with the feature `parallel`, one cloth on several.

use crate::{scenes, written};
use std::sync::atomic::{AtomicUsize, Ordering};

#[test]
fn four_threads_at_once_play_the_same_bits() {
    // Every scene twice, so that a scene also plays beside itself.
    let parts: Vec<_> = scenes().into_iter().flat_map(|part| [part; 2]).collect();
    let next = AtomicUsize::new(0);
    std::thread::scope(|scope| {
        for _ in 0..4 {
            scope.spawn(|| {
                while let Some((scene, hash)) = parts.get(next.fetch_add(1, Ordering::Relaxed)) {
                    assert_eq!(written(&scene.play()), *hash, "{} beside others", scene.name);
                }
            });
        }
    });
}

#[cfg(feature = "parallel")]
#[test]
fn a_cloth_on_several_threads_plays_the_same_bits() {
    for (scene, hash) in scenes() {
        for threads in 1..=3 {
            let trace = scene.play_on(threads);
            assert_eq!(written(&trace), hash, "{} on {threads} threads", scene.name);
        }
    }
}
