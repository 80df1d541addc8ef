//! Clothes on a body that runs and turns: how much of its inertia they feel.

use muslin::glam::{Quat, Vec3};
use muslin::{
    Attachment, Cloth, Collider, ColliderDesc, Error, GridDesc, Material, PinMode, Preset,
    Settings, Shape,
};

/// Columns and rows of the cape.
const CAPE: (u32, u32) = (12, 18);
/// A tick [s].
const TICK: f32 = 1.0 / 60.0;
/// What it hangs over, as the body sees it.
const BACK: Vec3 = Vec3::new(0.0, 1.2, 0.0);

/// A cape on the shoulders of a body, over its back.
struct Worn {
    cloth: Cloth,
    body: Attachment,
    back: Collider,
}

impl Worn {
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

    /// One tick in which the body gets to a pose.
    fn step(&mut self, position: Vec3, rotation: Quat, inertia: Option<f32>) {
        let cloth = &mut self.cloth;
        if let Some(inertia) = inertia {
            cloth.move_frame(position, rotation, inertia).unwrap();
        }
        cloth.move_attachment(self.body, position, rotation).unwrap();
        cloth.move_collider(self.back, position + rotation * BACK, rotation).unwrap();
        cloth.step(1);
    }

    /// Positions as the body sees them.
    fn seen_from(&self, position: Vec3, rotation: Quat) -> Vec<Vec3> {
        let inward = rotation.inverse();
        self.cloth.positions().iter().map(|x| inward * (*x - position)).collect()
    }
}

/// A run that speeds up by `acceleration` [m/s²] and turns at `spin` [rad/s].
fn run_at(tick: u32, acceleration: f32, spin: f32) -> (Vec3, Quat) {
    let time = tick as f32 * TICK;
    let way = Vec3::Z * (0.5 * acceleration * time * time);
    (way, Quat::from_rotation_y(spin * time))
}

/// How far the clothes are at most from each other as their bodies see them, of which one feels a share of a
/// run, and the other all of another run.
fn compare(felt: f32, [acceleration, spin]: [f32; 2], other: [f32; 2]) -> f32 {
    let (mut one, mut two) = (Worn::new(), Worn::new());
    let mut worst = 0.0_f32;
    for tick in 1..=30 {
        let (position, rotation) = run_at(tick, acceleration, spin);
        one.step(position, rotation, Some(felt));
        let (place, turned) = run_at(tick, other[0], other[1]);
        two.step(place, turned, None);
        let seen = one.seen_from(position, rotation);
        let off = seen.iter().zip(two.seen_from(place, turned)).map(|(a, b)| a.distance(b));
        worst = off.fold(worst, f32::max);
    }
    worst
}

#[test]
fn what_is_not_felt_is_as_if_the_body_stood_still() {
    // To 6 m/s in half a second, at two turns a second. Later on what differs in the last digit swings apart.
    let off = compare(0.0, [12.0, 12.0], [0.0, 0.0]);
    println!("off by {off:.1e} m from a cape at rest");
    assert!(off < 5e-4, "the cape felt the body move: {off} m");
    // The same run is felt if nobody says otherwise, …
    let off = compare(1.0, [12.0, 12.0], [0.0, 0.0]);
    assert!(off > 0.3, "the cape did not feel the body move: {off} m");
    // … and with all of the inertia it is as if nobody had said anything.
    let off = compare(1.0, [12.0, 12.0], [12.0, 12.0]);
    assert!(off == 0.0, "a cape with all of its inertia is off by {off} m");
}

#[test]
fn a_share_of_the_inertia_is_that_of_a_body_so_much_slower() {
    for share in [0.25, 0.5] {
        let off = compare(share, [8.0, 0.0], [8.0 * share, 0.0]);
        println!("speeding up, {share} felt: off by {off:.1e} m");
        assert!(off < 1e-4, "{off} m with {share} of the inertia of speeding up");
        let off = compare(share, [0.0, 2.0], [0.0, 2.0 * share]);
        println!("turning, {share} felt: off by {off:.1e} m");
        assert!(off < 1e-3, "{off} m with {share} of the inertia of a turn");
    }
}

#[test]
fn a_cape_leans_by_what_it_feels() {
    for share in [0.0, 0.5, 1.0] {
        let mut worn = Worn::new();
        worn.cloth.remove_collider(worn.back).unwrap();
        let settings = Settings { damping: 0.0, ..worn.cloth.settings().clone() };
        worn.cloth.set_settings(settings).unwrap();
        let acceleration = 2.0;
        let mut angles = Vec::new();
        for tick in 1..=277 {
            let (position, rotation) = run_at(tick, acceleration, 0.0);
            worn.cloth.move_frame(position, rotation, share).unwrap();
            worn.cloth.move_attachment(worn.body, position, rotation).unwrap();
            worn.cloth.step(1);
            let seen = worn.seen_from(position, rotation);
            let [top, bottom] = [0, CAPE.1 - 1].map(|row| {
                (0..CAPE.0).map(|i| seen[(row * CAPE.0 + i) as usize]).sum::<Vec3>() / CAPE.0 as f32
            });
            let hang = bottom - top;
            angles.push(hang.z / hang.y);
        }
        // It swings about where it would rest, three times.
        let mean = angles.iter().sum::<f32>() / angles.len() as f32;
        let exact = share * acceleration / 9.81;
        println!("{share} felt: leans by {mean:.3}, at rest {exact:.3}");
        assert!((mean - exact).abs() < 0.01, "leans by {mean}, not {exact}");
    }
}

#[test]
fn what_the_body_has_goes_along_and_what_the_world_has_stays() {
    let mut cloth = Cloth::grid(&GridDesc { columns: 9, rows: 9, ..GridDesc::default() }).unwrap();
    cloth.set_max_distances(&[40], &[0.0]).unwrap();
    let grab = cloth.grab_particle(80).unwrap();
    cloth.step(1);
    let start = cloth.positions().to_vec();
    let hand = start[80] + Vec3::X * 0.01;
    cloth.move_grab(grab, hand).unwrap();
    let (way, turned) = (Vec3::new(0.04, 0.02, -0.03), Quat::from_rotation_z(0.02));
    cloth.move_frame(way, turned, 0.5).unwrap();
    cloth.step(1);
    let x = cloth.positions();
    // The pinned top edge and what is on a leash of no length got to where the body has them …
    for i in (0..9).chain([40]) {
        let off = (way + turned * start[i] - x[i]).length();
        assert!(off < 1e-6, "particle {i} is {off} m off");
    }
    // … and the hand holds what it holds where it was told to, off the body.
    assert!(x[80].distance(hand) < 1e-6, "the hand is {} m off", x[80].distance(hand));
}

#[test]
fn what_cannot_be_is_refused_and_changes_nothing() {
    let mut worn = Worn::new();
    let before = worn.cloth.save();
    let cloth = &mut worn.cloth;
    let (still, at) = (Quat::IDENTITY, Vec3::ZERO);
    let bad = |field, must| Err(Error::BadValue { field, must });
    assert_eq!(cloth.move_frame(Vec3::NAN, still, 0.5), bad("position", "be finite"));
    let twice = Quat::from_xyzw(0.0, 0.0, 0.0, 2.0);
    assert_eq!(cloth.move_frame(at, twice, 0.5), bad("rotation", "be a unit quaternion"));
    for inertia in [-0.1, 1.1, f32::NAN, f32::INFINITY] {
        assert_eq!(cloth.move_frame(Vec3::X, still, inertia), bad("inertia", "be from 0 to 1"));
    }
    assert_eq!(cloth.save(), before);
    // What is on its way is saved.
    cloth.move_frame(Vec3::X, Quat::from_rotation_y(0.5), 0.5).unwrap();
    let mut restored = Cloth::restore(&cloth.save()).unwrap();
    for cloth in [&mut restored, cloth] {
        cloth.step(10);
    }
    assert_eq!(restored.state_hash(), worn.cloth.state_hash());
}
