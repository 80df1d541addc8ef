//! Every scene of the demo passes its own check after 1, 5 and 10 or more seconds.

use crate::common::crossings::crossing_count;
use muslin_scenes::{
    Curtain, Doorway, Drapes, Figure, Flag, GlassBalls, HangingSheet, Receipt, Scene,
    SceneInstance, SheetOnBall, TornFlag,
};

/// Runs a scene for `last` seconds, asserts its check after 1, 5 and `last` seconds, and returns it.
fn checked_scene<S: Scene>(last: u32) -> SceneInstance {
    let mut scene = S::build();
    let mut ticks_run = 0;
    for seconds in [1, 5, last] {
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
    checked_scene::<HangingSheet>(20);
}

#[test]
fn the_flag_scene_passes_its_check() {
    checked_scene::<Flag>(20);
}

#[test]
fn the_sheet_on_ball_scene_passes_its_check_without_self_intersection() {
    // Folds rest on each other without intersecting.
    let mut scene = SheetOnBall::build();
    for quarters in 1..=40 {
        scene.step(15);
        assert_eq!(crossing_count(&scene.cloths[0]), 0);
        if [4, 20, 40].contains(&quarters) {
            SheetOnBall::check(&scene)
                .unwrap_or_else(|what| panic!("after {quarters} / 4 s: {what}"));
        }
    }
}

#[test]
fn the_receipt_scene_passes_its_check() {
    checked_scene::<Receipt>(10);
}

#[test]
fn the_drapes_scene_passes_its_check_and_comes_to_rest() {
    for cloth in checked_scene::<Drapes>(20).cloths {
        let speeds = (0..cloth.particle_count()).filter_map(|i| cloth.velocity(i));
        let sum: f32 = speeds.map(|v| v.length_squared()).sum();
        let rms = (sum / cloth.particle_count() as f32).sqrt();
        assert!(rms < 1.0e-3, "after 20 s the RMS speed is {rms} m/s");
    }
}

#[test]
fn the_ball_of_the_curtain_scene_pushes_the_curtain_to_both_sides() {
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
    let scene = checked_scene::<Figure>(10);
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

#[test]
fn the_glass_balls_scene_passes_its_check_without_self_intersection() {
    let scene = checked_scene::<GlassBalls>(12);
    assert_eq!(crossing_count(&scene.cloths[0]), 0);
}

#[test]
fn the_torn_flag_scene_passes_its_check() {
    checked_scene::<TornFlag>(20);
}

#[test]
fn the_panels_of_the_doorway_scene_part_around_the_walker_and_close_behind_it() {
    let mut scene = Doorway::build();
    // The distance between the inner edges at half height, largest in a round and at its end.
    let [columns, rows] = Doorway::grid_size(40);
    let gap = |scene: &SceneInstance| {
        let row = rows / 2 * columns;
        let left = scene.cloths[0].positions()[(row + columns - 1) as usize];
        left.distance(scene.cloths[1].positions()[row as usize])
    };
    let mut widest = 0.0_f32;
    for tick in 0..540 {
        scene.step(1);
        widest = widest.max(gap(&scene));
        Doorway::check(&scene).unwrap_or_else(|what| panic!("after {tick} ticks: {what}"));
    }
    assert!(widest > 0.3, "the panels part by {widest} m at most");
    scene.walker_mut().unwrap().walk_to(glam::Vec3::Z);
    scene.step(300);
    assert!(gap(&scene) < 0.15, "they stay {} m apart", gap(&scene));
}

#[test]
fn the_walker_of_the_doorway_scene_does_not_depend_on_frame_lengths() {
    let mut even = Doorway::build();
    even.step(12);
    let mut late = Doorway::build();
    for ticks in [1, 4, 2, 5] {
        late.advance(ticks as f32 / 60.0 + 1.0e-5).unwrap();
    }
    for (even, late) in even.cloths.iter().zip(&late.cloths) {
        assert_eq!(late.positions(), even.positions());
    }
}
