//! Tests of the clothes on the figure.

use super::body::winding_number;
use super::motion::LOOP_TICKS;
use super::*;
use crate::scene::play;

#[test]
fn over_a_lap_the_clothes_stay_outside_the_body_and_do_not_stretch() {
    let mut instance = play::<Figure>(0);
    let mut fastest = 0.0_f32;
    for tick in 0..LOOP_TICKS {
        instance.step(1);
        if let Err(what) = Figure::check(&instance) {
            panic!("after {tick} ticks: {what}");
        }
        assert_eq!(instance.cloths[0].stats().crossings, 0, "after {tick} ticks");
        fastest = fastest.max(instance.cloths[0].stats().max_speed);
    }
    assert!(fastest > 1.5, "the clothes move at {fastest} m/s at most");
}

#[test]
fn no_skin_is_inside_the_drawn_body() {
    let mut instance = play::<Figure>(0);
    // In the swings of the kicks, and in walking between them.
    for tick in [30, 90, 128, 136, 144, 152, 160, 176, 240, 340, 372, 380, 388, 396, 420, 470] {
        let ticks = tick - instance.cloths[0].stats().ticks;
        instance.step(ticks);
        instance.update_drawn().unwrap();
        let body = instance.figure().unwrap();
        let vertices = body.skins().iter().flat_map(|skin| skin.positions());
        for x in vertices.filter(|x| body.depth_inside(**x) > -0.004) {
            let turns = winding_number(body.drawn(), *x);
            assert!(turns < 0.5, "after {tick} ticks a vertex at {x} is inside the body");
        }
    }
}
