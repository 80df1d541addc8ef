//! Tests: what hands leave of a sheet.

#[path = "../../../../tests/common/crossings.rs"]
mod crossings;

use super::*;
use crate::Sheet;

const TICK: f32 = 1.0 / 120.0;

/// Paper that is squeezed after so many ticks and let fall.
fn squeezed(small: bool, after: u32) -> Cloth {
    let mut cloth = Sheet::Paper.hang(small).unwrap();
    cloth.step(after);
    cloth.unpin_all();
    let mut squeeze = Squeeze::new(&mut cloth, Sheet::Paper.unit()).unwrap();
    while squeeze.tick(TICK, &mut cloth).unwrap() {
        cloth.step(1);
    }
    cloth
}

fn triangles(cloth: &Cloth) -> Vec<[u32; 3]> {
    cloth.indices().chunks_exact(3).map(|t| [t[0], t[1], t[2]]).collect()
}

#[test]
fn what_was_squeezed_is_a_ball_and_comes_to_rest() {
    // On small screens or others, squeezed after so many ticks.
    for (small, after) in [(false, 60), (true, 60), (true, 75), (true, 90)] {
        let mut cloth = squeezed(small, after);
        cloth.step(600);
        let before = cloth.positions().to_vec();
        cloth.step(120);
        let unit = Sheet::Paper.unit();
        let moved = cloth.positions().iter().zip(&before).map(|(x, at)| x.distance(*at));
        let most = moved.fold(0.0, f32::max) / unit;
        assert!(most < 0.03, "{small}, {after}: within a second one moves by {most} units");
        let x = cloth.positions();
        let middle = x.iter().sum::<Vec3>() / x.len() as f32;
        // Flat, its corners are 4.2 away.
        let reach = x.iter().map(|at| at.distance(middle) / unit).fold(0.0, f32::max);
        assert!(reach < 1.9, "{small}, {after}: it reaches {reach} units from its middle");
        let low = x.iter().fold(Vec3::MAX, |low, at| low.min(*at));
        let size = x.iter().fold(Vec3::MIN, |high, at| high.max(*at)) - low;
        let round = size.min_element() / size.max_element();
        assert!(round > 0.6, "{small}, {after}: it lies in a box of {size} m");
        assert_eq!(crossings::crossings(&cloth), 0, "{small}, {after}");
    }
}
