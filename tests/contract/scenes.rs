//! Every scene of the demo shows what it promises, from its first second on.

use crate::common::crossings::crossing_count;
use muslin_scenes::{
    Curtain, Drapes, Flag, HangingSheet, Receipt, Scene, SceneInstance, SheetOnBall,
};

fn keeps_its_promise<S: Scene>() -> SceneInstance {
    let mut cast = S::build();
    let mut played = 0;
    for seconds in [1, 5, 20] {
        cast.step(60 * seconds - played);
        played = 60 * seconds;
        if let Err(what) = S::check(&cast) {
            panic!("{}, after {seconds} s: {what}", S::NAME);
        }
    }
    cast
}

#[test]
fn the_hanging_sheet_hangs() {
    keeps_its_promise::<HangingSheet>();
}

#[test]
fn the_flag_streams_and_waves() {
    keeps_its_promise::<Flag>();
}

#[test]
fn the_sheet_lies_on_its_ball() {
    keeps_its_promise::<SheetOnBall>();
    // Its folds lie on each other, and not in each other.
    let mut cast = SheetOnBall::build();
    for _ in 0..40 {
        cast.step(15);
        assert_eq!(crossing_count(&cast.cloths[0]), 0);
    }
}

#[test]
fn the_receipt_hangs_from_its_pins() {
    keeps_its_promise::<Receipt>();
}

#[test]
fn three_discs_drape_on_their_pedestals_and_come_to_rest() {
    for cloth in keeps_its_promise::<Drapes>().cloths {
        let speeds = (0..cloth.particle_count()).filter_map(|i| cloth.velocity(i));
        let sum: f32 = speeds.map(|v| v.length_squared()).sum();
        let rms = (sum / cloth.particle_count() as f32).sqrt();
        assert!(rms < 1.0e-3, "after 20 s it moves at {rms} m/s");
    }
}

#[test]
fn the_curtain_lets_its_ball_through() {
    keeps_its_promise::<Curtain>();
    // Sooner or later the ball has been on both sides, and has taken the fabric along to both.
    let mut cast = Curtain::build();
    let (mut front, mut back) = (0.0_f32, 0.0_f32);
    for second in 0..14 {
        cast.step(60);
        Curtain::check(&cast).unwrap_or_else(|what| panic!("after {second} s: {what}"));
        assert_eq!(crossing_count(&cast.cloths[0]), 0, "after {second} s");
        for x in cast.cloths[0].positions() {
            (front, back) = (front.max(x.z), back.min(x.z));
        }
    }
    assert!(front > 0.3 && back < -0.3, "it swings from {back} m to {front} m only");
}

#[test]
fn late_frames_roll_the_ball_as_others_do() {
    let mut even = Curtain::build();
    even.step(12);
    let mut late = Curtain::build();
    for ticks in [1, 4, 2, 5] {
        late.advance(ticks as f32 / 60.0 + 1.0e-5).unwrap();
    }
    assert_eq!(late.cloths[0].positions(), even.cloths[0].positions());
}
