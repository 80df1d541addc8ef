//! Tests of the orbit camera.

use super::*;

fn settle(camera: &mut Camera) -> (f32, f32) {
    for _ in 0..600 {
        camera.advance(1.0 / 60.0, true);
    }
    let view = camera.view();
    let arm = view.eye - view.target;
    (arm.length(), (arm.y / arm.length()).acos())
}

#[test]
fn orbit_and_zoom_stop_at_the_limits_of_the_rig() {
    let mut camera = Camera::default();
    let CameraRig { polar: polars, radius: radii, .. } = CameraRig::default();
    camera.orbit(Vec2::new(0.3, 100.0));
    camera.zoom(1.0e6);
    let (radius, polar) = settle(&mut camera);
    assert!((radius - radii.end()).abs() < 1.0e-3, "radius {radius}");
    assert!((polar - polars.start()).abs() < 1.0e-3, "polar {polar}");
    camera.orbit(Vec2::new(0.3, -100.0));
    camera.zoom(1.0e-6);
    let (radius, polar) = settle(&mut camera);
    assert!((radius - radii.start()).abs() < 1.0e-3, "radius {radius}");
    assert!((polar - polars.end()).abs() < 1.0e-3, "polar {polar}");
}

#[test]
fn invalid_input_does_not_move_the_camera() {
    let mut camera = Camera::default();
    let before = camera.view();
    camera.orbit(Vec2::new(f32::NAN, f32::INFINITY));
    camera.zoom(f32::NAN);
    camera.zoom(-2.0);
    camera.fit_to_aspect(0.0);
    camera.advance(1.0 / 60.0, true);
    assert_eq!(camera.view(), before);
}

#[test]
fn the_camera_eases_to_its_goal_without_overshoot() {
    let mut camera = Camera::default();
    let start = camera.view().eye.distance(STAGE_CENTRE);
    camera.zoom(0.7);
    let mut last = start;
    for _ in 0..120 {
        camera.advance(1.0 / 60.0, true);
        let radius = camera.view().eye.distance(STAGE_CENTRE);
        assert!(radius <= last + 1.0e-5 && last - radius < 0.3 * start);
        last = radius;
    }
    assert!((last - 0.7 * start).abs() < 1.0e-3);
}

#[test]
fn the_camera_drifts_slowly_until_the_first_input_and_not_where_drift_is_off() {
    let azimuth = |camera: &Camera| camera.goal.azimuth;
    let second = |camera: &mut Camera| (0..60).for_each(|_| camera.advance(1.0 / 60.0, false));
    let mut camera = Camera::default();
    let start = azimuth(&camera);
    second(&mut camera);
    second(&mut camera);
    let drifted = (azimuth(&camera) - start).abs();
    assert!(drifted > 0.03 && drifted < 0.1, "it turned by {drifted} rad");
    camera.note_input();
    let still = azimuth(&camera);
    (0..5).for_each(|_| second(&mut camera));
    assert_eq!(azimuth(&camera), still);
    (0..3).for_each(|_| second(&mut camera));
    assert_ne!(azimuth(&camera), still, "it does not drift again");
    let mut camera = Camera::default();
    camera.set_drift(false);
    second(&mut camera);
    assert_eq!(azimuth(&camera), start);
}

#[test]
fn a_ray_through_a_projected_point_hits_the_point() {
    let shift = Vec2::new(0.2, 0.1);
    let view = CameraView { shift, ..Camera::default().view() };
    let at = Vec3::new(0.7, 0.6, -0.2);
    let screen = view.project(at, 1.6).unwrap();
    let ray = view.ray(screen, 1.6);
    let miss = (at - view.eye).cross(ray).length();
    assert!(miss < 1.0e-4, "missed by {miss} m");
}

#[test]
fn a_narrow_screen_still_shows_the_whole_sheet() {
    let mut camera = Camera::default();
    let aspect = 390.0 / 844.0;
    camera.fit_to_aspect(aspect);
    for x in [-1.0, 1.0] {
        let at = camera.view().project(Vec3::new(x, STAGE_CENTRE.y, 0.0), aspect).unwrap();
        assert!(at.x.abs() < 1.0, "edge lands at {at}");
    }
}

#[test]
fn the_sheet_is_in_the_free_area_of_wide_and_tall_screens() {
    for (size, insets) in [
        (Vec2::new(1440.0, 900.0), [300.0, 0.0, 0.0, 104.0]),
        (Vec2::new(390.0, 844.0), [0.0, 0.0, 0.0, 200.0]),
    ] {
        let mut camera = Camera::default();
        let free = FreeArea::from_insets(insets, size);
        camera.set_free_area(free);
        let aspect = size.x / size.y;
        camera.fit_to_aspect(aspect);
        let corners = [(-1.0, 1.0), (1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)];
        for (x, y) in corners {
            let at = camera.view().project(Vec3::new(x, y, 0.0), aspect).unwrap();
            let at = 0.5 + 0.5 * at * Vec2::new(1.0, -1.0);
            let is_inside = at.cmpgt(free.min).all() && at.cmplt(free.max).all();
            assert!(is_inside, "a corner lands at {at} in {free:?}");
        }
    }
}

#[test]
fn an_upright_screen_has_its_own_start_pose() {
    let upright = UprightView { start: [1.0, 0.9], half_width: 0.8 };
    let rig = CameraRig { upright: Some(upright), ..CameraRig::default() };
    let mut camera = Camera::new(rig.clone());
    let mut pose_at = |aspect| {
        camera.fit_to_aspect(aspect);
        [camera.now.azimuth, camera.now.polar]
    };
    assert_eq!(pose_at(1.6), rig.start[..2]);
    assert_eq!(pose_at(0.5), upright.start);
    assert_eq!(pose_at(1.6), rig.start[..2]);
    camera.orbit(Vec2::new(0.1, 0.0));
    let turned = camera.goal.azimuth;
    camera.fit_to_aspect(1.5);
    assert_eq!(camera.goal.azimuth, turned, "a resize turns the camera");
}

#[test]
fn an_upright_screen_follows_and_a_wide_one_does_not() {
    let upright = UprightView { start: [0.3, 1.3], half_width: 0.6 };
    let rig = CameraRig { upright: Some(upright), ..CameraRig::default() };
    for (aspect, followed) in [(0.5, 0.4), (1.6, 0.0)] {
        let mut camera = Camera::new(rig.clone());
        camera.fit_to_aspect(aspect);
        let before = camera.view().target;
        camera.follow(before + Vec3::new(0.4, 0.7, 0.0));
        settle(&mut camera);
        let moved = camera.view().target - before;
        assert!(moved.distance(Vec3::X * followed) < 1.0e-3, "{moved} at {aspect}");
    }
}

#[test]
fn a_new_free_area_moves_the_picture_and_not_the_eye() {
    let mut camera = Camera::default();
    let eye = camera.view().eye;
    let insets = [400.0, 0.0, 0.0, 0.0];
    camera.set_free_area(FreeArea::from_insets(insets, Vec2::new(1000.0, 600.0)));
    settle(&mut camera);
    let view = camera.view();
    assert!(view.eye.distance(eye) < 1.0e-4);
    let target = view.project(view.target, 1.5).unwrap();
    assert!(target.distance(Vec2::new(0.4, 0.0)) < 1.0e-3, "{target}");
}
