//! Tests of `move_frame`: which share of a moving body's inertia acts on its clothes.

use muslin::glam::{Quat, Vec3};
use muslin::{
    Attachment, Cloth, Collider, ColliderDesc, Error, GridDesc, Material, PinMode, Preset,
    Settings, Shape,
};

/// Columns and rows of the cape.
const CAPE: (u32, u32) = (12, 18);
/// Length of a tick [s].
const TICK: f32 = 1.0 / 60.0;
/// Centre of the sphere under the cape, in body coordinates [m].
const BACK: Vec3 = Vec3::new(0.0, 1.2, 0.0);

/// A cape attached to the shoulders of a body, over its back.
struct BodyWithCape {
    cloth: Cloth,
    body: Attachment,
    back: Collider,
}

impl BodyWithCape {
    fn new() -> Self {
        let material = Material { drag: 0.0, lift: 0.0, ..Material::preset(Preset::Cotton) };
        let mut cloth = Cloth::grid(&GridDesc {
            columns: CAPE.0,
            rows: CAPE.1,
            spacing: 0.05,
            origin: Vec3::new(-0.275, 1.5, -0.15),
            pin_mode: PinMode::None,
            material,
            ..GridDesc::default()
        })
        .unwrap();
        let shoulders: Vec<u32> = (0..CAPE.0).collect();
        let body = cloth.attach(&shoulders, Vec3::ZERO, Quat::IDENTITY).unwrap();
        let ball = ColliderDesc { radius: 0.12, position: BACK, ..ColliderDesc::default() };
        let back = cloth.add_collider(&ColliderDesc { shape: Shape::Sphere, ..ball }).unwrap();
        cloth.step(60);
        Self { cloth, body, back }
    }

    /// Runs one tick in which the body reaches a pose. Calls `move_frame` if `inertia` is given.
    fn step(&mut self, position: Vec3, rotation: Quat, inertia: Option<f32>) {
        let cloth = &mut self.cloth;
        if let Some(inertia) = inertia {
            cloth.move_frame(position, rotation, inertia).unwrap();
        }
        cloth.move_attachment(self.body, position, rotation).unwrap();
        cloth.move_collider(self.back, position + rotation * BACK, rotation).unwrap();
        cloth.step(1);
    }

    /// Positions in body coordinates.
    fn positions_in_body(&self, position: Vec3, rotation: Quat) -> Vec<Vec3> {
        let to_body = rotation.inverse();
        self.cloth.positions().iter().map(|x| to_body * (*x - position)).collect()
    }
}

/// The pose at a tick of a body with this acceleration [m/s²] and angular speed `spin` [rad/s].
fn pose_at(tick: u32, acceleration: f32, spin: f32) -> (Vec3, Quat) {
    let time = tick as f32 * TICK;
    let position = Vec3::Z * (0.5 * acceleration * time * time);
    (position, Quat::from_rotation_y(spin * time))
}

/// Returns the largest distance between two capes in body coordinates [m]. The first one feels the
/// share `felt` of the inertia of a motion, the second one all inertia of the motion `other`. A
/// motion is an acceleration [m/s²] and an angular speed [rad/s].
fn largest_difference(felt: f32, [acceleration, spin]: [f32; 2], other: [f32; 2]) -> f32 {
    let (mut one, mut two) = (BodyWithCape::new(), BodyWithCape::new());
    let mut worst = 0.0_f32;
    for tick in 1..=30 {
        let (position, rotation) = pose_at(tick, acceleration, spin);
        one.step(position, rotation, Some(felt));
        let (place, turned) = pose_at(tick, other[0], other[1]);
        two.step(place, turned, None);
        let seen = one.positions_in_body(position, rotation);
        let off = seen.iter().zip(two.positions_in_body(place, turned)).map(|(a, b)| a.distance(b));
        worst = off.fold(worst, f32::max);
    }
    worst
}

#[test]
fn a_cape_with_zero_inertia_moves_as_on_a_body_at_rest() {
    // Up to 6 m/s in half a second, at two turns per second. Later, differences in rounding grow.
    let off = largest_difference(0.0, [12.0, 12.0], [0.0, 0.0]);
    println!("off by {off:.1e} m from a cape at rest");
    assert!(off < 5e-4, "the cape felt the body move: {off} m");
    // With full inertia the cape feels the same motion,
    let off = largest_difference(1.0, [12.0, 12.0], [0.0, 0.0]);
    assert!(off > 0.3, "the cape did not feel the body move: {off} m");
    // and moves exactly as without `move_frame`.
    let off = largest_difference(1.0, [12.0, 12.0], [12.0, 12.0]);
    assert!(off == 0.0, "a cape with all of its inertia is off by {off} m");
}

#[test]
fn a_share_of_the_inertia_equals_the_inertia_of_a_proportionally_slower_body() {
    for share in [0.25, 0.5] {
        let off = largest_difference(share, [8.0, 0.0], [8.0 * share, 0.0]);
        println!("acceleration, {share} felt: off by {off:.1e} m");
        assert!(off < 1e-4, "{off} m with {share} of the inertia of an acceleration");
        let off = largest_difference(share, [0.0, 2.0], [0.0, 2.0 * share]);
        println!("rotation, {share} felt: off by {off:.1e} m");
        assert!(off < 1e-3, "{off} m with {share} of the inertia of a rotation");
    }
}

#[test]
fn an_accelerated_cape_tilts_in_proportion_to_its_share_of_inertia() {
    for share in [0.0, 0.5, 1.0] {
        let mut body_with_cape = BodyWithCape::new();
        body_with_cape.cloth.remove_collider(body_with_cape.back).unwrap();
        let settings = Settings { damping: 0.0, ..body_with_cape.cloth.settings().clone() };
        body_with_cape.cloth.set_settings(settings).unwrap();
        let acceleration = 2.0;
        let mut angles = Vec::new();
        for tick in 1..=277 {
            let (position, rotation) = pose_at(tick, acceleration, 0.0);
            body_with_cape.cloth.move_frame(position, rotation, share).unwrap();
            body_with_cape.cloth.move_attachment(body_with_cape.body, position, rotation).unwrap();
            body_with_cape.cloth.step(1);
            let seen = body_with_cape.positions_in_body(position, rotation);
            let [top, bottom] = [0, CAPE.1 - 1].map(|row| {
                (0..CAPE.0).map(|i| seen[(row * CAPE.0 + i) as usize]).sum::<Vec3>() / CAPE.0 as f32
            });
            let hang = bottom - top;
            angles.push(hang.z / hang.y);
        }
        // It swings three times about its equilibrium, which is therefore the mean.
        let mean = angles.iter().sum::<f32>() / angles.len() as f32;
        let exact = share * acceleration / 9.81;
        println!("{share} felt: tilts by {mean:.3}, at rest {exact:.3}");
        assert!((mean - exact).abs() < 0.01, "tilts by {mean}, not {exact}");
    }
}

#[test]
fn pins_and_tight_anchors_follow_the_frame_and_grabs_stay_in_the_world() {
    let mut cloth = Cloth::grid(&GridDesc { columns: 9, rows: 9, ..GridDesc::default() }).unwrap();
    cloth.set_max_distances(&[40], &[0.0]).unwrap();
    let grab = cloth.grab_particle(80).unwrap();
    cloth.step(1);
    let start = cloth.positions().to_vec();
    let target = start[80] + Vec3::X * 0.01;
    cloth.move_grab(grab, target).unwrap();
    let (translation, rotation) = (Vec3::new(0.04, 0.02, -0.03), Quat::from_rotation_z(0.02));
    cloth.move_frame(translation, rotation, 0.5).unwrap();
    cloth.step(1);
    let x = cloth.positions();
    // The pinned top edge and the particle with an anchor of zero maximum distance follow the
    // frame.
    for i in (0..9).chain([40]) {
        let off = (translation + rotation * start[i] - x[i]).length();
        assert!(off < 1e-6, "particle {i} is {off} m off");
    }
    // The grabbed particle is at the grab's target in world coordinates.
    assert!(
        x[80].distance(target) < 1e-6,
        "the grabbed particle is {} m off",
        x[80].distance(target)
    );
}

#[test]
fn invalid_frame_moves_are_refused_and_change_nothing() {
    let mut body_with_cape = BodyWithCape::new();
    let before = body_with_cape.cloth.save();
    let cloth = &mut body_with_cape.cloth;
    let (identity, origin) = (Quat::IDENTITY, Vec3::ZERO);
    let bad = |field, must| Err(Error::BadValue { field, must });
    assert_eq!(cloth.move_frame(Vec3::NAN, identity, 0.5), bad("position", "be finite"));
    let twice = Quat::from_xyzw(0.0, 0.0, 0.0, 2.0);
    assert_eq!(cloth.move_frame(origin, twice, 0.5), bad("rotation", "be a unit quaternion"));
    for inertia in [-0.1, 1.1, f32::NAN, f32::INFINITY] {
        assert_eq!(cloth.move_frame(Vec3::X, identity, inertia), bad("inertia", "be from 0 to 1"));
    }
    assert_eq!(cloth.save(), before);
    // A frame move that is not complete is saved.
    cloth.move_frame(Vec3::X, Quat::from_rotation_y(0.5), 0.5).unwrap();
    let mut restored = Cloth::restore(&cloth.save()).unwrap();
    for cloth in [&mut restored, cloth] {
        cloth.step(10);
    }
    assert_eq!(restored.state_hash(), body_with_cape.cloth.state_hash());
}
