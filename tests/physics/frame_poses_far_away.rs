//! Poses that are given once per frame take a cloth far away: the origin follows it between the
//! ticks of an `advance`.

use muslin::glam::{Quat, Vec3};
use muslin::{Cloth, ColliderDesc, GridDesc, PinMode, SelfCollision, Settings, Shape};

/// Length of a tick [s]: a power of two, so that frames of whole ticks are exact.
const TICK: f32 = 1.0 / 64.0;
const FRAMES: usize = 100;
const TICKS_PER_FRAME: u32 = 3;
const METRES_PER_TICK: f32 = 2.0;

/// Takes a sheet along X by an attachment, pins, an anchor and a grab, with a sphere below it and a
/// plane beside it, from `place` on. Returns positions after each frame, relative to the attachment,
/// and the number of frames in which the origin moved.
fn ride(place: Vec3, self_collision: SelfCollision) -> (Vec<Vec3>, usize) {
    let settings =
        Settings { tick: TICK, self_collision, max_displacement: 100.0, ..Settings::default() };
    let mut cloth = Cloth::grid(&GridDesc {
        columns: 12,
        rows: 12,
        spacing: 0.0625,
        origin: place,
        down: Vec3::Z,
        pin_mode: PinMode::None,
        settings,
        ..GridDesc::default()
    })
    .unwrap();
    let start = cloth.positions().to_vec();
    let edge: Vec<u32> = (0..9).collect();
    let train = cloth.attach(&edge, place, Quat::IDENTITY).unwrap();
    let (pinned, anchored, grabbed) = (11, 132, 143);
    cloth.pin(pinned, None).unwrap();
    cloth.set_max_distances(&[anchored], &[0.0]).unwrap();
    let grab = cloth.grab_particle(grabbed).unwrap();
    let below = Vec3::new(0.375, -0.25, 0.375);
    let sphere = ColliderDesc {
        shape: Shape::Sphere,
        position: place + below,
        radius: 0.25,
        ..ColliderDesc::default()
    };
    let sphere = cloth.add_collider(&sphere).unwrap();
    let plane = ColliderDesc { position: place + Vec3::NEG_Y * 0.5, ..ColliderDesc::default() };
    let plane = cloth.add_collider(&plane).unwrap();
    let (mut trace, mut moves) = (Vec::new(), 0);
    for frame in 1..=FRAMES {
        let by = Vec3::X * (METRES_PER_TICK * (TICKS_PER_FRAME as usize * frame) as f32);
        let turned = Quat::from_rotation_y(0.0625 * frame as f32);
        cloth.move_attachment(train, place + by, Quat::IDENTITY).unwrap();
        cloth.set_pin_targets(&[pinned], &[start[pinned as usize] + by]).unwrap();
        cloth.set_anchors(&[anchored], &[start[anchored as usize] + by], &[]).unwrap();
        cloth.move_grab(grab, start[grabbed as usize] + by).unwrap();
        cloth.move_collider(sphere, place + below + by, turned).unwrap();
        cloth.move_collider(plane, place + Vec3::NEG_Y * 0.5 + by, turned).unwrap();
        let origin = cloth.origin();
        assert_eq!(cloth.advance(TICK * TICKS_PER_FRAME as f32).unwrap(), TICKS_PER_FRAME);
        moves += usize::from(cloth.origin() != origin);
        for held in edge.iter().chain(&[pinned, anchored, grabbed]) {
            let error = cloth.position(*held).unwrap() - (start[*held as usize] + by);
            assert!(error.length() < 2.0e-6 * (1.0 + place.length()), "{held}: {error} m off");
        }
        let to_pose = cloth.origin() - place - by;
        trace.extend(cloth.relative_positions().iter().map(|x| *x + to_pose));
    }
    (trace, moves)
}

#[test]
fn frames_of_several_ticks_take_a_cloth_along_at_5_km_bit_by_bit_as_near_zero() {
    for self_collision in [SelfCollision::None, SelfCollision::Particles, SelfCollision::Surface] {
        let [(near, near_moves), (far, far_moves)] =
            [0.0, 5000.0].map(|x| ride(Vec3::X * x, self_collision));
        assert!(far_moves >= 20 && near_moves == far_moves, "{near_moves}, {far_moves} moves");
        let first = near.iter().zip(&far).position(|(near, far)| near != far);
        assert_eq!((first, near.len()), (None, far.len()), "{self_collision:?}");
    }
}
