//! Tests of crumpling: the sheet becomes a ball that comes to rest and does not intersect itself.

#[allow(dead_code)]
#[path = "../../../../tests/common/crossings.rs"]
mod crossings;

use super::*;
use crate::Sheet;

const TICK: f32 = 1.0 / 120.0;

/// Returns paper that was crumpled after `ticks` ticks.
fn crumpled(small: bool, ticks: u32) -> Cloth {
    let mut cloth = Sheet::Paper.hang(small).unwrap();
    cloth.step(ticks);
    cloth.unpin_all();
    let mut squeeze = Squeeze::new(&mut cloth, Sheet::Paper.unit()).unwrap();
    while squeeze.tick(TICK, &mut cloth).unwrap() {
        cloth.step(1);
    }
    cloth
}

/// Returns how far the particle that moves farthest is from its start after `ticks` ticks [m].
fn largest_motion(cloth: &mut Cloth, ticks: u32) -> f32 {
    let before = cloth.positions().to_vec();
    cloth.step(ticks);
    cloth.positions().iter().zip(&before).map(|(x, old)| x.distance(*old)).fold(0.0, f32::max)
}

fn triangles(cloth: &Cloth) -> Vec<[u32; 3]> {
    cloth.indices().chunks_exact(3).map(|t| [t[0], t[1], t[2]]).collect()
}

#[test]
fn crumpled_paper_is_a_ball_and_comes_to_rest() {
    // A sheet that hangs a little differently becomes another ball, so there are several. The grid is
    // that of small screens or the full one, and crumpling starts at this tick.
    let starts = [(false, 60), (true, 90)];
    let mut sum = 0.0;
    for (small, ticks) in starts {
        let mut cloth = crumpled(small, ticks);
        cloth.step(480);
        let unit = Sheet::Paper.unit();
        let mut motion = [(); 3].map(|()| largest_motion(&mut cloth, 120) / unit);
        motion.sort_by(f32::total_cmp);
        // One layer may still slip off another; then the ball is at rest again.
        assert!(
            motion[1] < 0.01 && motion[2] < 0.1,
            "{small}, {ticks}: a particle moves {motion:?} units in a second"
        );
        let x = cloth.positions();
        let centre = x.iter().sum::<Vec3>() / x.len() as f32;
        // The corners of the flat sheet are 4.2 units away.
        let radius = x.iter().map(|x| x.distance(centre) / unit).fold(0.0, f32::max);
        assert!(
            radius < 2.0,
            "{small}, {ticks}: the farthest particle is {radius} units from the centre"
        );
        let low = x.iter().fold(Vec3::MAX, |low, x| low.min(*x));
        let size = x.iter().fold(Vec3::MIN, |high, x| high.max(*x)) - low;
        let roundness = size.min_element() / size.max_element();
        assert!(roundness > 0.5, "{small}, {ticks}: the bounding box is {size} m");
        sum += roundness;
        assert_eq!(crossings::crossing_count(&cloth), 0, "{small}, {ticks}");
    }
    let mean = sum / starts.len() as f32;
    assert!(mean > 0.6, "the mean ratio of the sides of the bounding boxes is {mean}");
}
