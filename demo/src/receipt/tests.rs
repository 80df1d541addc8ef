//! Tests of the effect of pointers, gestures and time on the receipt.

use super::gestures::{ReceiptGesture, ReceiptGesturePlayer};
use super::*;
use crate::crossings::crossing_count;
use muslin_scenes::receipt::FLOOR;
use std::sync::atomic::{AtomicU32, Ordering};

const FRAME: f32 = 1.0 / 60.0;

fn receipt_app(sheet: Sheet) -> ReceiptApp {
    ReceiptApp::new(ReceiptSettings { sheet, ..ReceiptSettings::default() }, true, || 0.0).unwrap()
}

fn played(gesture: ReceiptGesture, sheet: Sheet) -> ReceiptApp {
    played_for(gesture, sheet, gesture.ticks())
}

/// Plays a gesture with a sheet of paper, which must not cross itself.
fn played_without_crossing(name: &str, gesture: ReceiptGesture) -> ReceiptApp {
    let mut app = receipt_app(Sheet::Paper);
    app.play(60).unwrap();
    let mut play = ReceiptGesturePlayer::new(gesture);
    for tick in 1..=gesture.ticks() {
        play.step(&mut app).unwrap();
        if tick % 30 == 0 {
            assert_eq!(crossing_count(app.cloth()), 0, "{name}, at tick {tick}");
        }
    }
    app
}

fn played_for(gesture: ReceiptGesture, sheet: Sheet, ticks: u32) -> ReceiptApp {
    let mut app = receipt_app(sheet);
    app.play(60).unwrap();
    let mut play = ReceiptGesturePlayer::new(gesture);
    for _ in 0..ticks {
        play.step(&mut app).unwrap();
    }
    app
}

/// Mean speed of all particles, in units per second.
fn mean_speed(app: &ReceiptApp) -> f32 {
    let count = app.cloth().positions().len() as u32;
    let speeds = (0..count).filter_map(|i| app.cloth().velocity(i)).map(|v| v.length());
    speeds.sum::<f32>() / count as f32 / app.settings().sheet.unit()
}

/// Least and greatest height of all particles, in units.
fn heights(app: &ReceiptApp) -> [f32; 2] {
    let unit = app.settings().sheet.unit();
    let y = app.cloth().positions().iter().map(|at| at.y / unit);
    y.fold([f32::MAX, f32::MIN], |[low, high], y| [low.min(y), high.max(y)])
}

/// Greatest distance of a particle from its initial position, in units.
fn greatest_offset(app: &ReceiptApp) -> f32 {
    let desc = app.settings().sheet.desc(true);
    let places = ReturnAnimation::new(app.cloth(), &desc);
    places.greatest_distance(app.cloth()) / app.settings().sheet.unit()
}

#[test]
fn a_pointer_grabs_within_half_a_unit_of_its_ray_only() {
    for sheet in Sheet::ALL {
        let mut app = receipt_app(sheet);
        let edge = 0.5 * app.span().x;
        for (beside, holds) in [(0.42, true), (0.7, false)] {
            let at = app.on_screen(Vec3::new(edge + beside, 0.0, 0.0)).unwrap();
            app.press(1, at, PressKind::Main).unwrap();
            assert_eq!(app.pointers.holds_cloth(), holds, "{sheet:?}, {beside} units beside it");
            app.lift(1).unwrap();
        }
    }
}

#[test]
fn a_grabbed_particle_moves_in_the_plane_parallel_to_the_screen() {
    for sheet in Sheet::ALL {
        let mut app = receipt_app(sheet);
        let [columns, rows] = app.grid_size();
        let particle = (rows - 1) * columns + columns / 2;
        let from = app.particle(particle).unwrap();
        let view = app.camera().view();
        let at = app.on_screen(from).unwrap();
        app.press(7, at, PressKind::Main).unwrap();
        let to = at + Vec2::new(40.0, -10.0);
        app.drag(7, to);
        for _ in 0..60 {
            app.frame(FRAME).unwrap();
        }
        let held = app.particle(particle).unwrap();
        let now = app.on_screen(held).unwrap();
        assert!(now.distance(to) < 2.0, "{sheet:?}: held at {now}, pointer at {to}");
        let depth = (held - from).dot(view.forward());
        assert!(depth.abs() < 0.01, "{sheet:?}: it came {depth} units nearer or farther");
        app.lift(7).unwrap();
        assert!(!app.pointers.is_any_down());
    }
}

#[test]
fn the_right_button_orbits_and_two_fingers_beside_the_paper_pinch() {
    let mut app = receipt_app(Sheet::Paper);
    let settled = |app: &mut ReceiptApp| {
        for _ in 0..300 {
            app.camera.advance(FRAME, true);
        }
        app.camera.view().eye
    };
    let middle = app.on_screen(Vec3::ZERO).unwrap();
    let before = settled(&mut app);
    app.press(1, middle, PressKind::Turn).unwrap();
    app.drag(1, middle + Vec2::X * 150.0);
    app.lift(1).unwrap();
    let fold_angle = settled(&mut app);
    assert!(fold_angle.distance(before) > 2.0);
    assert!((fold_angle.distance(TARGET) - before.distance(TARGET)).abs() < 1.0e-3);
    app.press(1, Vec2::new(60.0, 600.0), PressKind::Main).unwrap();
    app.press(2, Vec2::new(1200.0, 600.0), PressKind::Main).unwrap();
    app.drag(2, Vec2::new(800.0, 600.0));
    let pinched = settled(&mut app);
    assert!(pinched.distance(TARGET) > 1.2 * fold_angle.distance(TARGET));
}

#[test]
fn two_fingers_grab_two_points_and_a_key_leaves_a_grab_in_place() {
    let mut app = receipt_app(Sheet::Paper);
    let half = 0.5 * app.span();
    let low = |x: f32| Vec3::new(x * half.x, -half.y, 0.0);
    let [left, right] = [-0.9, 0.9].map(|x| app.on_screen(low(x)).unwrap());
    app.press(1, left, PressKind::Main).unwrap();
    app.press(2, right, PressKind::Main).unwrap();
    assert_eq!(app.pointers.grabs().count(), 2);
    app.lift(2).unwrap();
    app.set_leave_in_place(true).unwrap();
    app.lift(1).unwrap();
    assert_eq!(app.pointers.grabs().count(), 1);
    let kept = app.pointers.grabs().next().unwrap();
    app.press(1, right, PressKind::Main).unwrap();
    app.drag(1, right - Vec2::Y * 60.0);
    for _ in 0..30 {
        app.frame(FRAME).unwrap();
    }
    assert_eq!(app.pointers.grabs().count(), 2);
    assert!(app.pointers.grabs().any(|held| held.1.distance(kept.1) < 1.0e-4));
    app.lift(1).unwrap();
    app.set_leave_in_place(false).unwrap();
    assert!(!app.pointers.holds_cloth());
}

#[test]
fn pause_stops_the_paper_and_reduced_motion_stops_the_wind() {
    for sheet in Sheet::ALL {
        let mut app = receipt_app(sheet);
        app.run_action(ReceiptAction::Pause).unwrap();
        let hash = app.cloth().state_hash();
        app.frame(0.03).unwrap();
        assert_eq!(app.cloth().state_hash(), hash);
        app.run_action(ReceiptAction::Pause).unwrap();
        let swing = |app: &mut ReceiptApp| {
            app.play(240).unwrap();
            mean_speed(app)
        };
        let still = swing(&mut app);
        app.key('w').unwrap();
        let blown = swing(&mut app);
        assert!(blown > 2.0 * still && blown > 0.05, "{sheet:?}: {still}, then {blown} units/s");
        app.set_reduced_motion(true).unwrap();
        assert_eq!(app.cloth().wind().velocity, Vec3::ZERO);
    }
}

#[test]
fn reduced_motion_selects_the_smaller_sheet() {
    let mut app = ReceiptApp::new(ReceiptSettings::default(), false, || 0.0).unwrap();
    assert_eq!(app.readout().particles, 40 * 60);
    app.set_reduced_motion(true).unwrap();
    assert_eq!(app.readout().particles, 24 * 36);
}

#[test]
fn a_long_frame_runs_no_more_than_the_longest_frame_time() {
    let mut app = receipt_app(Sheet::Paper);
    let before = app.cloth().time();
    app.frame(5.0).unwrap();
    let ran = app.cloth().time() - before;
    assert!(ran < 0.034, "{ran} s ran");
}

#[test]
fn slow_ticks_run_in_slow_motion_and_drop_the_backlog() {
    // A clock that advances by 20 ms at every call.
    fn slow() -> f64 {
        static ASKED: AtomicU32 = AtomicU32::new(0);
        0.02 * f64::from(ASKED.fetch_add(1, Ordering::Relaxed))
    }
    let mut app = ReceiptApp::new(ReceiptSettings::default(), true, slow).unwrap();
    app.frame(0.03).unwrap();
    assert_eq!(app.cloth().stats().ticks, 2);
    app.frame(0.0).unwrap();
    assert_eq!(app.cloth().stats().ticks, 2);
}

#[test]
fn no_gesture_moves_paper_through_itself() {
    for (name, gesture) in ReceiptGesture::ALL {
        // Crumpled paper has a test of its own, which also counts crossings.
        if gesture != ReceiptGesture::Crumple {
            played_without_crossing(name, gesture);
        }
    }
}

/// Angle between the upper and the lower half of the sheet [rad].
fn fold_angle(app: &ReceiptApp) -> f32 {
    let [columns, rows] = app.grid_size();
    let row = |row: u32| {
        let places = (0..columns).map(|column| app.particle(row * columns + column).unwrap());
        places.sum::<Vec3>() / columns as f32
    };
    (row(10) - row(4)).angle_between(row(rows - 5) - row(rows - 11))
}

#[test]
fn a_crease_stays_after_the_sheet_is_released() {
    let flat = fold_angle(&receipt_app(Sheet::Paper));
    let mut app = played(ReceiptGesture::Fold, Sheet::Paper);
    assert!(app.cloth().pinned().count() == 2, "it fell");
    let folded = fold_angle(&app);
    // Gravity opens the fold partly.
    assert!(folded > flat + 0.35, "it is folded by {folded} rad");
    app.play(360).unwrap();
    let later = fold_angle(&app);
    assert!((later - folded).abs() < 0.1, "three seconds later it is folded by {later} rad");
    assert!(mean_speed(&app) < 0.1, "it still moves at {} units/s", mean_speed(&app));
}

/// Angles between neighbouring quarters of the length of the sheet [rad].
fn fold_angles(app: &ReceiptApp) -> [f32; 3] {
    let [columns, rows] = app.grid_size();
    let middle = |share: f32| {
        let row = (share * (rows - 1) as f32).round() as u32;
        let places = (0..columns).map(|column| app.particle(row * columns + column).unwrap());
        places.sum::<Vec3>() / columns as f32
    };
    let quarter = |i: usize| middle(0.25 * i as f32 + 0.22) - middle(0.25 * i as f32 + 0.03);
    [0, 1, 2].map(|i| quarter(i).angle_between(quarter(i + 1)))
}

#[test]
fn a_letter_stays_on_the_screen_and_keeps_its_creases_after_release() {
    let mut app = receipt_app(Sheet::Paper);
    app.play(60).unwrap();
    let before = fold_angles(&app);
    assert!(before.iter().all(|fold_angle| *fold_angle < 0.4), "it hangs folded by {before:?}");
    let mut play = ReceiptGesturePlayer::new(ReceiptGesture::Letter);
    for tick in 0..ReceiptGesture::Letter.ticks() {
        play.step(&mut app).unwrap();
        let corners = [0, 23, 35 * 24, 36 * 24 - 1].map(|i| app.particle(i).unwrap());
        for at in corners.into_iter().map(|at| app.on_screen(at).unwrap()) {
            let is_seen = at.x > 0.0 && at.x < 1280.0 && at.y > 0.0 && at.y < 720.0;
            assert!(is_seen, "at tick {tick} a corner is at {at}");
        }
    }
    assert!(!app.pointers.is_any_down() && app.letter_fold.is_none(), "hands still hold it");
    app.play(240).unwrap();
    let creased = fold_angles(&app);
    assert!(creased.iter().all(|fold_angle| *fold_angle > 2.6), "it is folded by {creased:?}");
    let [low, high] = heights(&app);
    assert!(low > FLOOR - 1.0e-3 && high < FLOOR + 0.8, "it lies from {low} to {high} units");
    assert!(mean_speed(&app) < 0.1, "it still moves at {} units/s", mean_speed(&app));
    // Without gravity the creases do not open far either.
    let mut settings = app.cloth.settings().clone();
    settings.gravity = Vec3::ZERO;
    app.cloth.set_settings(settings).unwrap();
    app.play(360).unwrap();
    let alone = fold_angles(&app);
    assert!(alone.iter().all(|fold_angle| *fold_angle > 2.0), "alone it is folded by {alone:?}");
}

#[test]
fn a_tossed_receipt_lands_and_comes_to_rest_on_the_floor() {
    for sheet in Sheet::ALL {
        let mut app = played(ReceiptGesture::Toss, sheet);
        let middle = |app: &ReceiptApp| {
            let x = app.cloth().positions();
            x.iter().sum::<Vec3>() / x.len() as f32 / app.settings().sheet.unit()
        };
        let flown = middle(&app).x;
        let wanted = if sheet == Sheet::Paper { 1.0 } else { 0.5 };
        assert!(flown > wanted, "{sheet:?} came {flown} units far");
        app.play(120).unwrap();
        let [low, high] = heights(&app);
        assert!(low > FLOOR - 1.0e-3, "{sheet:?} is {} units under the floor", FLOOR - low);
        assert!(high < FLOOR + 4.0, "{sheet:?} stands {} units high", high - FLOOR);
        assert!(mean_speed(&app) < 0.3, "{sheet:?} still moves at {} units/s", mean_speed(&app));
    }
}

#[test]
fn crumpled_paper_keeps_the_shape_of_a_ball_and_does_not_cross_itself() {
    let mut app = played_without_crossing("crumple", ReceiptGesture::Crumple);
    app.play(120).unwrap();
    let unit = Sheet::Paper.unit();
    let x = app.cloth().positions();
    let middle = x.iter().sum::<Vec3>() / x.len() as f32;
    let widest = x.iter().map(|at| at.distance(middle) / unit).fold(0.0, f32::max);
    // On a flat sheet the corners are 4.2 units away.
    assert!(widest < 1.9, "it reaches {widest} units from its middle");
    let size = x.iter().fold(Vec3::MIN, |high, at| high.max(*at))
        - x.iter().fold(Vec3::MAX, |low, at| low.min(*at));
    let round = size.min_element() / size.max_element();
    assert!(round > 0.6, "it lies in a box of {size} m");
    assert!(heights(&app)[0] > FLOOR - 1.0e-3);
    assert!(mean_speed(&app) < 0.05, "it still moves at {} units/s", mean_speed(&app));
    assert_eq!(crossing_count(app.cloth()), 0);
}

#[test]
fn reset_returns_the_receipt_in_half_a_second_with_an_ease_out() {
    for sheet in Sheet::ALL {
        // Folded and grabbed, a letter, crumpled on the floor, in the air.
        for (gesture, ticks) in [
            (ReceiptGesture::Fold, 180),
            (ReceiptGesture::Letter, 620),
            (ReceiptGesture::Crumple, 240),
            (ReceiptGesture::Toss, 170),
        ] {
            assert_reset_returns(&mut played_for(gesture, sheet, ticks));
        }
        let mut torn = receipt_app(sheet);
        let cut = Vec3::new(-3.0, 0.4, -1.0) * sheet.unit();
        torn.cloth.cut(cut, cut.with_x(-cut.x), Vec3::Z * (2.0 * sheet.unit())).unwrap();
        torn.play(60).unwrap();
        assert!(torn.readout().particles > 24 * 36 && torn.readout().pieces > 1);
        assert_reset_returns(&mut torn);
    }
}

fn assert_reset_returns(app: &mut ReceiptApp) {
    // The animation also runs while the simulation is paused.
    app.run_action(ReceiptAction::Pause).unwrap();
    app.run_action(ReceiptAction::Reset).unwrap();
    let mut tracks = vec![greatest_offset(app)];
    while app.is_returning() {
        app.frame(FRAME).unwrap();
        tracks.push(greatest_offset(app));
        assert!(tracks.len() < 40, "it does not arrive: {tracks:?}");
    }
    assert_eq!(tracks.len(), 31, "it took {} frames", tracks.len() - 1);
    let steps: Vec<f32> = tracks.windows(2).map(|two| two[0] - two[1]).collect();
    assert!(steps.windows(2).all(|two| two[1] <= two[0] + 1.0e-3), "no ease-out: {steps:?}");
    assert!(tracks[30] < 1.0e-3, "it is {} units off", tracks[30]);
    let fresh = {
        let mut fresh = ReceiptApp::new(app.settings().clone(), true, || 0.0).unwrap();
        fresh.run_action(ReceiptAction::Pause).unwrap();
        fresh.play(30).unwrap();
        fresh.cloth().positions().to_vec()
    };
    app.play(30).unwrap();
    assert_eq!(app.readout().pieces, 1);
    assert_eq!(app.cloth().positions(), fresh, "it is not as new");
}
