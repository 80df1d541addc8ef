//! Every scene of the demo passes its own check after 1, 5 and 20 seconds.

use crate::common::crossings::crossing_count;
use muslin_scenes::{
    Curtain, Drapes, Figure, Flag, HangingSheet, Receipt, Scene, SceneInstance, SheetOnBall,
};

/// Runs a scene, asserts its check after 1, 5 and 20 seconds, and returns it.
fn checked_scene<S: Scene>() -> SceneInstance {
    let mut scene = S::build();
    let mut ticks_run = 0;
    for seconds in [1, 5, 20] {
        scene.step(60 * seconds - ticks_run);
        ticks_run = 60 * seconds;
        if let Err(what) = S::check(&scene) {
            panic!("{}, after {seconds} s: {what}", S::NAME);
        }
    }
    scene
}

#[test]
fn the_hanging_sheet_scene_passes_its_check() {
    checked_scene::<HangingSheet>();
}

#[test]
fn the_flag_scene_passes_its_check() {
    checked_scene::<Flag>();
}

#[test]
fn the_sheet_on_ball_scene_passes_its_check_without_self_intersection() {
    checked_scene::<SheetOnBall>();
    // Folds rest on each other without intersecting.
    let mut scene = SheetOnBall::build();
    for _ in 0..40 {
        scene.step(15);
        assert_eq!(crossing_count(&scene.cloths[0]), 0);
    }
}

#[test]
fn the_receipt_scene_passes_its_check() {
    checked_scene::<Receipt>();
}

#[test]
fn the_drapes_scene_passes_its_check_and_comes_to_rest() {
    for cloth in checked_scene::<Drapes>().cloths {
        let speeds = (0..cloth.particle_count()).filter_map(|i| cloth.velocity(i));
        let sum: f32 = speeds.map(|v| v.length_squared()).sum();
        let rms = (sum / cloth.particle_count() as f32).sqrt();
        assert!(rms < 1.0e-3, "after 20 s the RMS speed is {rms} m/s");
    }
}

#[test]
fn the_ball_of_the_curtain_scene_pushes_the_curtain_to_both_sides() {
    checked_scene::<Curtain>();
    // Within 14 s the ball pushes the fabric to both sides.
    let mut scene = Curtain::build();
    let (mut front, mut back) = (0.0_f32, 0.0_f32);
    for second in 0..14 {
        scene.step(60);
        Curtain::check(&scene).unwrap_or_else(|what| panic!("after {second} s: {what}"));
        assert_eq!(crossing_count(&scene.cloths[0]), 0, "after {second} s");
        for x in scene.cloths[0].positions() {
            (front, back) = (front.max(x.z), back.min(x.z));
        }
    }
    assert!(front > 0.3 && back < -0.3, "the curtain moves only from {back} m to {front} m");
}

#[test]
fn the_ball_of_the_curtain_scene_does_not_depend_on_frame_lengths() {
    let mut even = Curtain::build();
    even.step(12);
    let mut late = Curtain::build();
    for ticks in [1, 4, 2, 5] {
        late.advance(ticks as f32 / 60.0 + 1.0e-5).unwrap();
    }
    assert_eq!(late.cloths[0].positions(), even.cloths[0].positions());
}

#[test]
fn the_figure_scene_passes_its_check_and_its_clothes_do_not_cross() {
    let scene = checked_scene::<Figure>();
    assert_eq!(crossing_count(&scene.cloths[0]), 0);
}

#[test]
fn the_motion_of_the_figure_does_not_depend_on_frame_lengths() {
    let mut even = Figure::build();
    even.step(12);
    let mut late = Figure::build();
    for ticks in [1, 4, 2, 5] {
        late.advance(ticks as f32 / 60.0 + 1.0e-5).unwrap();
    }
    assert_eq!(late.cloths[0].positions(), even.cloths[0].positions());
}
