//! Tests of the effect of pointers, controls and time on the cloth scenes.

use super::*;
use crate::scene_kind::SceneKind;

fn app() -> App {
    App::new(Settings::default(), || 0.0).unwrap()
}

#[test]
fn a_grabbed_particle_moves_with_its_pointer() {
    let mut app = app();
    let particle = 20 * 40 + 20;
    let from = app.particle_on_screen(particle).unwrap();
    app.press(7, from).unwrap();
    assert_eq!(app.cursor().unwrap(), Cursor::Grabbing);
    let to = from + Vec2::new(80.0, -30.0);
    app.drag(7, to).unwrap();
    for _ in 0..60 {
        app.frame(1.0 / 60.0).unwrap();
    }
    let held = app.particle_on_screen(particle).unwrap();
    assert!(held.distance(to) < 6.0, "held at {held}, pointer at {to}");
    app.lift(7).unwrap();
    for _ in 0..240 {
        app.frame(1.0 / 60.0).unwrap();
    }
    let released = app.particle_on_screen(particle).unwrap();
    assert!(released.distance(to) > 20.0, "still at {released}");
}

#[test]
fn a_drag_beside_the_cloth_orbits_the_camera_and_does_not_move_the_cloth() {
    let mut app = app();
    let (before, hash) = (app.camera.view(), app.state_hash());
    app.press(1, Vec2::new(20.0, 20.0)).unwrap();
    app.drag(1, Vec2::new(220.0, 60.0)).unwrap();
    for _ in 0..30 {
        app.camera.advance(1.0 / 60.0, true);
    }
    assert!(app.camera.view().eye.distance(before.eye) > 0.5);
    assert_eq!(app.state_hash(), hash);
}

#[test]
fn a_second_finger_zooms_and_the_camera_does_not_jump_at_press_or_release() {
    let mut app = app();
    let settle = |app: &mut App| {
        for _ in 0..300 {
            app.camera.advance(1.0 / 60.0, true);
        }
        app.camera.view().eye
    };
    app.press(1, Vec2::new(100.0, 650.0)).unwrap();
    let still = settle(&mut app);
    app.press(2, Vec2::new(1200.0, 650.0)).unwrap();
    assert!(settle(&mut app).distance(still) < 1.0e-4);
    app.drag(2, Vec2::new(700.0, 650.0)).unwrap();
    let pinched = settle(&mut app);
    let centre = crate::render::light::STAGE_CENTRE;
    assert!(pinched.distance(centre) > 1.3 * still.distance(centre));
    app.lift(1).unwrap();
    assert!(settle(&mut app).distance(pinched) < 1.0e-4);
    app.drag(2, Vec2::new(690.0, 650.0)).unwrap();
    let moved = settle(&mut app).distance(pinched);
    assert!(moved > 1.0e-3 && moved < 0.5, "moved {moved} m");
}

#[test]
fn a_new_resolution_rebuilds_the_sheet_and_clears_the_pointers() {
    let mut app = app();
    let at = app.particle_on_screen(820).unwrap();
    app.press(3, at).unwrap();
    app.set("resolution", 2.0).unwrap();
    assert_eq!(app.readout().particles, 56 * 56);
    app.drag(3, at + Vec2::X).unwrap();
    app.lift(3).unwrap();
    app.frame(0.02).unwrap();
}

#[test]
fn with_extreme_settings_the_cloth_does_not_tear_and_stays_in_the_scene() {
    for scene in 0..SceneKind::ALL.len() {
        let mut app = app();
        for (name, value) in [("wind", 3.0), ("gravity", 20.0), ("damping", 0.0)] {
            app.set(name, value).unwrap();
        }
        app.set("scene", scene as f32).unwrap();
        // A flag may tear in this wind; the sheet must not.
        app.set("tearing", f32::from(u8::from(scene == 0))).unwrap();
        for stiffness in [1.0, 12.0] {
            app.set("stiffness", stiffness).unwrap();
            let whole = app.readout();
            for _ in 0..90 {
                app.frame(1.0 / 60.0).unwrap();
            }
            assert_eq!(app.readout().particles, whole.particles, "the wind tore scene {scene}");
            let places = app.scene.cloths.iter().flat_map(|cloth| cloth.positions());
            for at in places {
                assert!(at.is_finite() && at.length() < 4.0, "a particle is at {at}");
            }
        }
    }
}

#[test]
fn pause_stops_the_cloth_and_without_pins_it_falls() {
    let mut app = app();
    app.set("paused", 1.0).unwrap();
    let hash = app.state_hash();
    app.frame(0.1).unwrap();
    assert_eq!(app.state_hash(), hash);
    app.set("paused", 0.0).unwrap();
    let corner = app.particle(0).unwrap();
    app.run_action(Action::DropPins).unwrap();
    app.play(15);
    let fallen = corner.y - app.particle(0).unwrap().y;
    assert!(fallen > 0.15, "fell {fallen} m");
}

/// The discs after one second, and a function that returns the centre of a disc on the screen.
fn discs() -> (App, impl Fn(&App, usize) -> Vec2) {
    let mut app = app();
    app.camera().set_drift(false);
    app.set("scene", 3.0).unwrap();
    app.play(60);
    let middle = |app: &App, disc: usize| {
        let at = app.scene.cloths[disc].positions()[0] / scene::unit(SceneKind::Discs);
        let normal = app.camera.view().project(at, app.screen.aspect()).unwrap();
        app.screen.pixels(normal)
    };
    (app, middle)
}

#[test]
fn a_pointer_grabs_only_the_disc_under_it() {
    let (mut app, middle) = discs();
    let from = [0, 1, 2].map(|disc| middle(&app, disc));
    app.press(1, from[1]).unwrap();
    let to = from[1] - Vec2::new(0.0, 60.0);
    app.drag(1, to).unwrap();
    for _ in 0..60 {
        app.frame(1.0 / 60.0).unwrap();
    }
    let now = [0, 1, 2].map(|disc| middle(&app, disc));
    assert!(now[1].distance(to) < 12.0, "the disc is at {}, the hand at {to}", now[1]);
    for other in [0, 2] {
        assert!(now[other].distance(from[other]) < 4.0, "disc {other} moved to {}", now[other]);
    }
}

#[test]
fn the_blade_cuts_only_the_disc_that_it_crosses() {
    let (mut app, middle) = discs();
    let whole = app.scene.cloths.iter().map(|cloth| cloth.particle_count());
    let whole: Vec<_> = whole.collect();
    let centre = middle(&app, 1);
    app.hold_blade(true);
    app.press(1, centre - Vec2::new(170.0, 0.0)).unwrap();
    for step in 1..=16 {
        app.drag(1, centre + Vec2::new(20.0 * step as f32 - 170.0, 0.0)).unwrap();
    }
    app.lift(1).unwrap();
    let grown = app.scene.cloths.iter().zip(whole).map(|(cloth, n)| cloth.particle_count() - n);
    let grown: Vec<_> = grown.collect();
    assert!(grown[0] == 0 && grown[1] > 10 && grown[2] == 0, "{grown:?} particles more");
}

#[test]
fn a_new_scene_resets_the_camera_to_the_start_of_its_rig() {
    let mut app = app();
    let usual = app.camera.view();
    app.wheel(300.0);
    app.set("fabric", 1.0).unwrap();
    app.frame(1.0).unwrap();
    assert!(app.camera.view().eye.distance(usual.eye) > 0.1, "the same scene jumps back");
    app.set("scene", 3.0).unwrap();
    assert!(app.camera.view().target.distance(usual.target) > 0.3);
    app.set("scene", 0.0).unwrap();
    assert_eq!(app.camera.view().target, usual.target);
}

#[test]
fn the_walker_follows_the_mouse_through_the_curtain_and_a_finger_that_presses_the_floor() {
    let mut app = app();
    app.camera().set_drift(false);
    app.set("scene", SceneKind::ALL.iter().position(|s| *s == SceneKind::Doorway).unwrap() as f32)
        .unwrap();
    let walker = |app: &App| app.scene.walker().unwrap().position();
    let pixel = |app: &App, at: Vec3| {
        let normal = app.camera.view().project(at, app.screen.aspect()).unwrap();
        app.screen.pixels(normal)
    };
    let run = |app: &mut App| (0..180).for_each(|_| app.frame(1.0 / 60.0).unwrap());
    let front = Vec3::new(0.2, walker(&app).y, 0.9);
    let behind = front.with_z(-0.9);
    for goal in [behind, front] {
        let at = pixel(&app, goal);
        app.drag(0, at).unwrap();
        run(&mut app);
        assert!(walker(&app).distance(goal) < 0.05, "at {}, not {goal}", walker(&app));
    }
    app.clear_hover();
    let goal = front.with_x(-0.4);
    let (at, view) = (pixel(&app, goal), app.camera.view());
    app.press(1, at).unwrap();
    run(&mut app);
    assert!(walker(&app).distance(goal) < 0.05, "at {}, not {goal}", walker(&app));
    assert_eq!(app.camera.view(), view, "the finger turned the camera");
    app.lift(1).unwrap();
    // The curtain in front of the walkway is grabbed.
    let cloth = pixel(&app, app.scene.cloths[1].positions()[130]);
    app.press(1, cloth).unwrap();
    app.drag(1, cloth + Vec2::splat(20.0)).unwrap();
    run(&mut app);
    assert!(walker(&app).distance(goal) < 0.05, "it followed a pointer that holds cloth");
}

#[test]
fn arrow_keys_walk_the_person_as_seen_from_the_camera_and_a_short_press_is_a_step() {
    let mut app = app();
    app.camera().set_drift(false);
    assert!(!app.walk(Vec2::X), "a scene without a person has one");
    app.set("scene", SceneKind::ALL.iter().position(|s| *s == SceneKind::Doorway).unwrap() as f32)
        .unwrap();
    app.set_reduced_motion(true).unwrap();
    let run = |app: &mut App| (0..120).for_each(|_| app.frame(1.0 / 60.0).unwrap());
    run(&mut app);
    let ahead = app.camera.view().forward().with_y(0.0).normalize();
    // The mouse rests beside the walkway, and does not lead it back.
    app.drag(0, Vec2::new(300.0, 700.0)).unwrap();
    let start = app.walker().unwrap();
    assert!(app.walk(Vec2::Y));
    app.walk(Vec2::ZERO);
    run(&mut app);
    let step = (app.walker().unwrap() - start).dot(ahead);
    assert!((step - walkway::STEP).abs() < 0.08, "a step of {step} m");
    app.walk(Vec2::Y);
    run(&mut app);
    let far = app.walker().unwrap();
    assert!((far - start).dot(ahead) > 1.5, "it walked from {start} to {far}");
    app.walk(Vec2::ZERO);
    run(&mut app);
    let still = app.walker().unwrap();
    run(&mut app);
    assert!(app.walker().unwrap().distance(still) < 1.0e-3, "it walks on");
    app.set_photo(true).unwrap();
    assert!(!app.walk(Vec2::X));
}

#[test]
fn in_the_photo_mode_time_stands_still_and_a_pointer_on_the_cloth_turns_the_camera() {
    let mut app = app();
    let at = app.particle_on_screen(820).unwrap();
    app.press(1, at).unwrap();
    assert_eq!(app.cursor().unwrap(), Cursor::Grabbing);
    assert!(app.key('o', false).unwrap() && app.is_photo());
    assert_ne!(app.cursor().unwrap(), Cursor::Grabbing, "a hand still holds the cloth");
    let (hash, settings, eye) = (app.state_hash(), app.settings().clone(), app.camera.view().eye);
    assert!(!app.key('f', false).unwrap(), "a key changed the wireframe");
    app.press(1, at).unwrap();
    app.drag(1, at + Vec2::new(150.0, 0.0)).unwrap();
    for _ in 0..900 {
        app.frame(1.0 / 60.0).unwrap();
    }
    let turned = app.camera.view().eye;
    assert!(turned.distance(eye) > 0.5, "the camera did not turn");
    app.lift(1).unwrap();
    for _ in 0..900 {
        app.frame(1.0 / 60.0).unwrap();
    }
    assert!(app.camera.view().eye.distance(turned) < 1.0e-3, "the camera drifts");
    assert_eq!((app.state_hash(), app.settings()), (hash, &settings));
    assert!(app.key('O', false).unwrap() && !app.is_photo());
    app.frame(1.0 / 30.0).unwrap();
    assert_ne!(app.state_hash(), hash, "time still stands");
}

#[test]
fn a_photo_is_upright_on_an_upright_screen() {
    let mut app = app();
    app.resize(Vec2::new(1440.0, 900.0));
    assert_eq!(app.photo_size(), [3840, 2160]);
    app.resize(Vec2::new(390.0, 844.0));
    assert_eq!(app.photo_size(), [2160, 3840]);
}

#[test]
fn the_cloth_yields_to_the_mouse_until_the_first_press() {
    let run = |presses: bool, hovers: bool, is_reduced: bool| {
        let mut app = app();
        app.camera().set_drift(false);
        app.set_reduced_motion(is_reduced).unwrap();
        app.camera().set_drift(false);
        if presses {
            app.press(1, Vec2::new(20.0, 20.0)).unwrap();
            app.lift(1).unwrap();
        }
        let at = app.particle_on_screen(820).unwrap();
        if hovers {
            app.drag(0, at).unwrap();
        }
        for _ in 0..20 {
            app.frame(1.0 / 60.0).unwrap();
        }
        let depth = (app.particle(820).unwrap() - app.camera.view().eye).length();
        (depth, app.state_hash())
    };
    let pushed = run(false, true, false).0 - run(false, false, false).0;
    assert!(pushed > 0.02 && pushed < 0.25, "the mouse pushes the cloth by {pushed} m");
    assert_eq!(run(true, true, false).1, run(true, false, false).1);
    assert_eq!(run(false, true, true).1, run(false, false, true).1);
}
