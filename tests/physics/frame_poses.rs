//! Poses that are given once per frame: `advance` reaches them evenly over its ticks.

use core::cell::Cell;
use muslin::glam::{Quat, Vec3};
use muslin::{
    Attachment, Attribute, Cloth, Collider, ColliderDesc, Grab, GridDesc, Material, PinMode,
    Settings, Shape, Stream, VertexFormat, WriteDesc,
};

/// Length of a tick [s]: a power of two, so that frames of whole ticks are exact.
const TICK: f32 = 1.0 / 64.0;
/// Columns and rows of the sheet.
const SIZE: u32 = 12;
/// Every way to hold the top edge of a sheet.
const HOLDS: [HoldKind; 4] =
    [HoldKind::Attachment, HoldKind::PinTargets, HoldKind::Anchors, HoldKind::Grabs];

#[derive(Clone, Copy, Debug, PartialEq)]
enum HoldKind {
    Attachment,
    PinTargets,
    Anchors,
    Grabs,
}

/// A sheet whose top edge is held in one of the ways, and where that edge was at first [m].
struct HeldSheet {
    cloth: Cloth,
    kind: HoldKind,
    attachment: Option<Attachment>,
    grabs: Vec<Grab>,
    start: Vec<Vec3>,
}

fn edge() -> Vec<u32> {
    (0..SIZE).collect()
}

fn sheet(settings: Settings) -> Cloth {
    let material = Material { drag: 0.0, lift: 0.0, ..Material::default() };
    Cloth::grid(&GridDesc {
        columns: SIZE,
        rows: SIZE,
        spacing: 0.05,
        pin_mode: PinMode::None,
        material,
        settings: Settings { damping: 0.0, ..settings },
        ..GridDesc::default()
    })
    .unwrap()
}

impl HeldSheet {
    fn new(kind: HoldKind, tick: f32) -> Self {
        let mut cloth = sheet(Settings { tick, ..Settings::default() });
        let (edge, start) = (edge(), cloth.positions()[..SIZE as usize].to_vec());
        let (mut attachment, mut grabs) = (None, Vec::new());
        match kind {
            HoldKind::Attachment => {
                attachment = Some(cloth.attach(&edge, Vec3::ZERO, Quat::IDENTITY).unwrap());
            }
            HoldKind::PinTargets => cloth.set_pin_targets(&edge, &start).unwrap(),
            HoldKind::Anchors => {
                cloth.set_max_distances(&edge, &vec![0.0; edge.len()]).unwrap();
            }
            HoldKind::Grabs => {
                grabs.extend(edge.iter().map(|i| cloth.grab_particle(*i).unwrap()));
            }
        }
        Self { cloth, kind, attachment, grabs, start }
    }

    /// Sets the pose of the edge for the end of the frame.
    fn set_pose(&mut self, position: Vec3, rotation: Quat) {
        let cloth = &mut self.cloth;
        let targets: Vec<Vec3> = self.start.iter().map(|x| position + rotation * *x).collect();
        match self.kind {
            HoldKind::Attachment => {
                cloth.move_attachment(self.attachment.unwrap(), position, rotation).unwrap();
            }
            HoldKind::PinTargets => cloth.set_pin_targets(&edge(), &targets).unwrap(),
            HoldKind::Anchors => cloth.set_anchors(&edge(), &targets, &[]).unwrap(),
            HoldKind::Grabs => {
                for (grab, target) in self.grabs.iter().zip(targets) {
                    cloth.move_grab(*grab, target).unwrap();
                }
            }
        }
    }

    /// Largest distance of the edge from its place on the pose [m].
    fn error(&self, position: Vec3, rotation: Quat) -> f32 {
        let x = self.cloth.positions();
        let places = self.start.iter().map(|x| position + rotation * *x);
        places.zip(x).map(|(place, x)| x.distance(place)).fold(0.0, f32::max)
    }
}

/// Positions at the start of the last tick [m].
fn positions_before(cloth: &mut Cloth) -> Vec<Vec3> {
    let mut buffer = vec![0_u8; 12 * cloth.positions().len()];
    let bytes = Cell::from_mut(&mut buffer[..]).as_slice_of_cells();
    let format = VertexFormat::F32;
    let streams = [Stream { attribute: Attribute::Position, format, stride: 12, bytes }];
    cloth.write_vertices(&streams, &WriteDesc { blend: 0.0, ..WriteDesc::default() }).unwrap();
    let number = |bytes: &[u8]| f32::from_ne_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]);
    let point =
        |bytes: &[u8]| Vec3::new(number(&bytes[..4]), number(&bytes[4..8]), number(&bytes[8..12]));
    buffer.chunks_exact(12).map(point).collect()
}

/// Displacement of each particle in the last tick [m].
fn last_displacements(cloth: &mut Cloth) -> Vec<Vec3> {
    let before = positions_before(cloth);
    cloth.positions().iter().zip(before).map(|(x, before)| *x - before).collect()
}

/// Range of x of a list of vectors.
fn range_of_x(list: &[Vec3]) -> [f32; 2] {
    list.iter()
        .fold([f32::INFINITY, f32::NEG_INFINITY], |[low, high], v| [low.min(v.x), high.max(v.x)])
}

/// Carries a hung sheet along x at 1 m/s, with a pose for each frame of 1/24 s and ticks of 1/60 s.
/// `run` runs the ticks of a frame and returns how many those were; `check` gets this number and
/// the velocities of all particles in the last of them [m/s].
fn carry_at_24_frames_per_second(
    kind: HoldKind,
    mut run: impl FnMut(&mut Cloth) -> u32,
    mut check: impl FnMut(u32, &[Vec3]),
) {
    let mut held = HeldSheet::new(kind, 1.0 / 60.0);
    let count = held.cloth.positions().len() as u32;
    (0..count).for_each(|i| held.cloth.set_velocity(i, Vec3::X).unwrap());
    for frame in 1..=48 {
        let position = Vec3::X * (frame as f32 / 24.0);
        held.set_pose(position, Quat::IDENTITY);
        let ticks = run(&mut held.cloth);
        let error = held.error(position, Quat::IDENTITY);
        assert!(error < 1.0e-6, "{kind:?}: {error} m from the pose");
        let mut velocities = last_displacements(&mut held.cloth);
        velocities.iter_mut().for_each(|x| *x *= 60.0);
        check(ticks, &velocities);
    }
}

#[test]
fn cloth_carried_at_a_steady_speed_moves_forward_at_24_frames_per_second() {
    for kind in HOLDS {
        let mut all = [f32::INFINITY, f32::NEG_INFINITY];
        let run = |cloth: &mut Cloth| cloth.advance(1.0 / 24.0).unwrap();
        carry_at_24_frames_per_second(kind, run, |ticks, velocities| {
            assert!(ticks == 2 || ticks == 3, "{ticks} ticks");
            // The edge goes 1/24 m in `ticks` ticks of 1/60 s: 0.83 or 1.25 m/s.
            let right = 2.5 / ticks as f32;
            let edge = range_of_x(&velocities[..SIZE as usize]);
            assert!(edge.iter().all(|v| (v - right).abs() < 1.0e-3), "{kind:?}: edge {edge:?}");
            let [low, high] = range_of_x(velocities);
            all = [all[0].min(low), all[1].max(high)];
        });
        println!("{kind:?}: {:.2} to {:.2} m/s", all[0], all[1]);
        // The sheet has no damping and no drag; when the first tick of a frame took the whole
        // motion, its particles moved at −0.6 to 3 m/s.
        assert!(all[0] > 0.1 && all[1] < 1.7, "{kind:?}: {all:?} m/s");
    }
}

#[test]
fn cloth_carried_at_a_steady_speed_keeps_it_at_20_frames_per_second() {
    for kind in HOLDS {
        let mut held = HeldSheet::new(kind, 1.0 / 60.0);
        let count = held.cloth.positions().len() as u32;
        (0..count).for_each(|i| held.cloth.set_velocity(i, Vec3::X).unwrap());
        let mut all = [f32::INFINITY, f32::NEG_INFINITY];
        for frame in 1..=40 {
            held.set_pose(Vec3::X * (frame as f32 / 20.0), Quat::IDENTITY);
            let ticks = held.cloth.advance(3.0 / 60.0).unwrap();
            // In f32 the frame is slightly shorter than three ticks, so the first one runs two.
            assert_eq!(ticks, if frame == 1 { 2 } else { 3 }, "frame {frame}");
            let mut velocities = last_displacements(&mut held.cloth);
            velocities.iter_mut().for_each(|x| *x *= 60.0);
            let edge = range_of_x(&velocities[..SIZE as usize]);
            let right = 3.0 / ticks as f32;
            assert!(edge.iter().all(|v| (v - right).abs() < 1.0e-3), "{kind:?}: edge {edge:?}");
            if frame > 20 {
                let [low, high] = range_of_x(&velocities);
                all = [all[0].min(low), all[1].max(high)];
            }
        }
        assert!(all[0] > 0.5 && all[1] < 1.5, "{kind:?}: {all:?} m/s");
    }
}

#[test]
fn step_reaches_poses_in_its_first_tick() {
    for kind in HOLDS {
        let run = |cloth: &mut Cloth| {
            cloth.step(3);
            3
        };
        carry_at_24_frames_per_second(kind, run, |_, velocities| {
            let edge = range_of_x(&velocities[..SIZE as usize]);
            assert!(edge.iter().all(|v| v.abs() < 1.0e-3), "{kind:?}: edge {edge:?}");
        });
    }
}

#[test]
fn an_advance_of_several_ticks_equals_steps_with_poses_in_between() {
    for kind in HOLDS {
        for ticks in 1..=5_u32 {
            let (mut frames, mut steps) = (HeldSheet::new(kind, TICK), HeldSheet::new(kind, TICK));
            let turn = if kind == HoldKind::Attachment { 0.3 } else { 0.0 };
            for frame in 0..3 {
                let pose = |share: f32| {
                    let time = (frame as f32 + share) * 0.1;
                    (Vec3::new(time, 0.3 * time, 0.5 * time), Quat::from_rotation_z(turn * time))
                };
                let (position, rotation) = pose(1.0);
                frames.set_pose(position, rotation);
                assert_eq!(frames.cloth.advance(TICK * ticks as f32).unwrap(), ticks);
                for tick in 1..=ticks {
                    let (position, rotation) = pose(tick as f32 / ticks as f32);
                    steps.set_pose(position, rotation);
                    steps.cloth.step(1);
                }
            }
            let pairs = frames.cloth.positions().iter().zip(steps.cloth.positions());
            let worst = pairs.map(|(a, b)| a.distance(*b)).fold(0.0, f32::max);
            println!("{kind:?}, {ticks} ticks: {worst:.1e} m");
            assert!(worst < 2.0e-4, "{kind:?}, {ticks} ticks: {worst} m apart");
            if ticks == 1 {
                assert_eq!(frames.cloth.state_hash(), steps.cloth.state_hash(), "{kind:?}");
            }
        }
    }
}

#[test]
fn resting_poses_keep_the_bits_of_single_steps() {
    for kind in HOLDS {
        let (mut frames, mut steps) = (HeldSheet::new(kind, TICK), HeldSheet::new(kind, TICK));
        let ball = ColliderDesc {
            shape: Shape::Sphere,
            radius: 0.2,
            position: Vec3::new(0.3, -0.4, 0.15),
            ..ColliderDesc::default()
        };
        for held in [&mut frames, &mut steps] {
            held.cloth.add_collider(&ball).unwrap();
        }
        for _ in 0..12 {
            frames.cloth.advance(5.0 * TICK).unwrap();
            steps.cloth.step(5);
        }
        assert_eq!(frames.cloth.state_hash(), steps.cloth.state_hash(), "{kind:?}");
    }
}

#[test]
fn a_pose_set_before_an_advance_without_a_tick_is_reached_in_the_next() {
    for kind in HOLDS {
        let mut held = HeldSheet::new(kind, TICK);
        let position = Vec3::new(0.2, 0.0, 0.1);
        held.set_pose(position, Quat::IDENTITY);
        assert_eq!(held.cloth.advance(0.5 * TICK).unwrap(), 0);
        assert!(held.error(Vec3::ZERO, Quat::IDENTITY) == 0.0, "{kind:?} moved without a tick");
        let saved = Cloth::restore(&held.cloth.save()).unwrap();
        for mut cloth in [saved, held.cloth] {
            assert_eq!(cloth.advance(3.5 * TICK).unwrap(), 4);
            for displacement in &last_displacements(&mut cloth)[..SIZE as usize] {
                let error = displacement.distance(position * 0.25);
                assert!(error < 1.0e-6, "{kind:?}: {displacement} m in the last tick");
            }
        }
    }
}

#[test]
fn a_large_rotation_is_divided_into_equal_angles() {
    let mut held = HeldSheet::new(HoldKind::Attachment, TICK);
    // 160° per frame, about the origin.
    for turn in [160.0_f32, 320.0] {
        let rotation = Quat::from_rotation_z(turn.to_radians());
        held.set_pose(Vec3::ZERO, rotation);
        held.cloth.advance(5.0 * TICK).unwrap();
        let [last, now] = [positions_before(&mut held.cloth)[1], held.cloth.positions()[1]];
        let angle = last.angle_between(now).to_degrees();
        assert!((angle - 32.0).abs() < 0.01, "{angle}° in the last tick");
        assert!(held.error(Vec3::ZERO, rotation) < 1.0e-5);
    }
}

#[test]
fn a_released_particle_returns_to_its_moving_pin_evenly() {
    for (kind, speed) in
        [(HoldKind::Attachment, 0.0), (HoldKind::Attachment, 2.0), (HoldKind::PinTargets, 2.0)]
    {
        let mut held = HeldSheet::new(kind, TICK);
        let pull = Vec3::new(0.0, 0.0, 0.12);
        let grab = held.cloth.grab_particle(5).unwrap();
        let start = held.start[5];
        held.cloth.move_grab(grab, start + pull).unwrap();
        held.cloth.step(4);
        assert!(held.cloth.positions()[5].distance(start + pull) < 1.0e-6);
        held.cloth.release(grab).unwrap();
        let motion = Vec3::X * (speed * 4.0 * TICK);
        held.set_pose(motion, Quat::IDENTITY);
        held.cloth.advance(4.0 * TICK).unwrap();
        let displacement = last_displacements(&mut held.cloth)[5];
        let error = displacement.distance((motion - pull) * 0.25);
        assert!(error < 1.0e-5, "{kind:?}: {displacement} m in the last tick");
        assert!(held.error(motion, Quat::IDENTITY) < 1.0e-6);
    }
}

#[test]
fn the_part_of_a_frame_move_that_is_felt_is_reached_evenly() {
    for kind in [HoldKind::Attachment, HoldKind::PinTargets, HoldKind::Anchors] {
        for inertia in [0.0, 0.25, 1.0] {
            let mut held = HeldSheet::new(kind, TICK);
            let position = Vec3::new(0.4, 0.2, 0.0);
            // Pins, attachments and anchors move with the frame.
            held.cloth.move_frame(position, Quat::IDENTITY, inertia).unwrap();
            held.cloth.advance(4.0 * TICK).unwrap();
            let displacements = last_displacements(&mut held.cloth);
            for displacement in &displacements[..SIZE as usize] {
                let error = displacement.distance(position * (inertia * 0.25));
                assert!(error < 1.0e-6, "{kind:?}, {inertia}: {displacement} m in the last tick");
            }
            assert!(held.error(position, Quat::IDENTITY) < 1.0e-6, "{kind:?}, {inertia}");
        }
    }
}

/// A free sheet in front of a ball that moves along z towards it.
fn sheet_and_ball() -> (Cloth, Collider) {
    let mut cloth = sheet(Settings { tick: TICK, gravity: Vec3::ZERO, ..Settings::default() });
    let ball = ColliderDesc {
        shape: Shape::Sphere,
        radius: 0.15,
        position: BALL_START,
        ..ColliderDesc::default()
    };
    let ball = cloth.add_collider(&ball).unwrap();
    (cloth, ball)
}

/// Centre of the ball at the start [m].
const BALL_START: Vec3 = Vec3::new(0.275, -0.275, -0.2);
/// Speed of the ball [m/s].
const BALL_SPEED: f32 = 2.0;

/// Position of the ball after a number of ticks [m].
fn ball_at(ticks: f32) -> Vec3 {
    BALL_START + Vec3::Z * (BALL_SPEED * TICK * ticks)
}

#[test]
fn a_collider_moved_once_per_frame_of_four_ticks_pushes_a_sheet_evenly() {
    let ((mut frames, ball), (mut steps, same_ball)) = (sheet_and_ball(), sheet_and_ball());
    let (mut fastest, mut deepest) = (0.0_f32, f32::INFINITY);
    for frame in 0..8 {
        let ticks = 4.0 * frame as f32;
        frames.move_collider(ball, ball_at(ticks + 4.0), Quat::IDENTITY).unwrap();
        frames.advance(4.0 * TICK).unwrap();
        for tick in 1..=4 {
            steps.move_collider(same_ball, ball_at(ticks + tick as f32), Quat::IDENTITY).unwrap();
            steps.step(1);
        }
        for displacement in last_displacements(&mut frames) {
            fastest = fastest.max(displacement.length() / TICK);
        }
        for x in frames.positions() {
            deepest = deepest.min(x.distance(ball_at(ticks + 4.0)) - 0.15);
        }
        if frame < 3 {
            let pairs = frames.positions().iter().zip(steps.positions());
            let worst = pairs.map(|(a, b)| a.distance(*b)).fold(0.0, f32::max);
            assert!(worst < 1.0e-3, "frame {frame}: {worst} m apart");
        }
    }
    println!("{fastest:.2} m/s, nearest {deepest:.1e} m");
    // A jump of a whole frame in one tick would take it to 8 m/s.
    assert!(fastest < 2.0 * BALL_SPEED, "{fastest} m/s");
    assert!(deepest > -1.0e-4, "{deepest} m inside the ball");
}

#[test]
fn a_turning_collider_carries_cloth_evenly() {
    // A sheet lies on a box that turns about the vertical by 12° per frame of four ticks.
    let mut cloth = Cloth::grid(&GridDesc {
        columns: SIZE,
        rows: SIZE,
        spacing: 0.05,
        origin: Vec3::new(-0.275, 0.005, -0.275),
        down: Vec3::Z,
        pin_mode: PinMode::None,
        material: Material { friction: 2.0, ..Material::default() },
        settings: Settings { tick: TICK, ..Settings::default() },
        ..GridDesc::default()
    })
    .unwrap();
    let table = ColliderDesc {
        shape: Shape::Box,
        half_extents: Vec3::new(0.5, 0.1, 0.5),
        position: Vec3::new(0.0, -0.1, 0.0),
        friction: 2.0,
        ..ColliderDesc::default()
    };
    let table = cloth.add_collider(&table).unwrap();
    cloth.step(32);
    let (mut slowest, mut fastest) = (f32::INFINITY, 0.0_f32);
    for frame in 1..=12 {
        let angle = (12.0 * frame as f32).to_radians();
        let position = Vec3::new(0.0, -0.1, 0.0);
        cloth.move_collider(table, position, Quat::from_rotation_y(angle)).unwrap();
        cloth.advance(4.0 * TICK).unwrap();
        let (before, now) = (positions_before(&mut cloth)[0], cloth.positions()[0]);
        let angle = before.with_y(0.0).angle_between(now.with_y(0.0)).to_degrees();
        if frame > 4 {
            (slowest, fastest) = (slowest.min(angle), fastest.max(angle));
        }
    }
    println!("{slowest:.2}° to {fastest:.2}° per tick");
    assert!(slowest > 2.0 && fastest < 4.0, "{slowest}° to {fastest}° where 3° is right");
}
