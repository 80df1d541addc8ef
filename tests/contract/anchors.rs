//! Anchors: particles stay within the max distance of their animated targets and outside their
//! backstops.

use crate::common::bare_grid;
use muslin::glam::{Quat, Vec3};
use muslin::{Cloth, ColliderDesc, Error, GridDesc, Material, PinMode, Preset, Shape, Wind};

const COLUMNS: u32 = 20;
const ROWS: u32 = 30;

/// A cape with an anchor, a max distance and a backstop for every particle.
struct AnchoredCape {
    cloth: Cloth,
    all: Vec<u32>,
    rest: Vec<Vec3>,
    distances: Vec<f32>,
}

/// Distance of each backstop behind its anchor and radius of its sphere [m].
const BACKSTOP: (f32, f32) = (0.01, 0.3);

/// A cape whose max distances grow from 0 at the top edge to 0.3 m at the hem.
fn anchored_cape(change: impl FnOnce(&mut GridDesc)) -> AnchoredCape {
    let mut desc = GridDesc {
        columns: COLUMNS,
        rows: ROWS,
        spacing: 0.03,
        origin: Vec3::new(-0.285, 1.5, -0.15),
        pin_mode: PinMode::None,
        material: Material::preset(Preset::Cotton),
        ..GridDesc::default()
    };
    change(&mut desc);
    let mut cloth = Cloth::grid(&desc).unwrap();
    let rest = cloth.positions().to_vec();
    let all: Vec<u32> = (0..rest.len() as u32).collect();
    let distances: Vec<f32> =
        all.iter().map(|i| 0.3 * (i / COLUMNS) as f32 / (ROWS - 1) as f32).collect();
    cloth.set_max_distances(&all, &distances).unwrap();
    let behind = vec![BACKSTOP.0; rest.len()];
    cloth.set_backstops(&all, &behind, &vec![BACKSTOP.1; rest.len()]).unwrap();
    cloth.set_anchors(&all, &rest, &vec![-Vec3::Z; rest.len()]).unwrap();
    AnchoredCape { cloth, all, rest, distances }
}

impl AnchoredCape {
    /// Sets the anchors to the rest positions moved with the body; returns them and their normal.
    fn set_anchors_for_pose(&mut self, position: Vec3, rotation: Quat) -> (Vec<Vec3>, Vec3) {
        let anchors: Vec<Vec3> = self.rest.iter().map(|x| position + rotation * *x).collect();
        let normal = rotation * -Vec3::Z;
        self.cloth.set_anchors(&self.all, &anchors, &vec![normal; self.all.len()]).unwrap();
        (anchors, normal)
    }

    /// Largest excess over a max distance and largest depth in a backstop [m]; negative is allowed.
    fn largest_violations(&self, anchors: &[Vec3], normal: Vec3) -> (f32, f32) {
        let (behind, radius) = BACKSTOP;
        let mut worst = (f32::MIN, f32::MIN);
        for (at, x) in self.cloth.positions().iter().enumerate() {
            let center = anchors[at] - normal * (behind + radius);
            worst.0 = worst.0.max(x.distance(anchors[at]) - self.distances[at]);
            worst.1 = worst.1.max(radius - x.distance(center));
        }
        worst
    }
}

#[test]
fn max_distances_and_backstops_hold_on_a_body_that_moves_and_rotates() {
    for max_stretch in [0.0, 0.05] {
        let mut cape = anchored_cape(|desc| desc.settings.max_stretch = max_stretch);
        let velocity = Vec3::new(3.0, 0.0, 12.0);
        cape.cloth
            .set_wind(Wind { velocity, gust: 1.0, turbulence: 0.5, ..Wind::default() })
            .unwrap();
        let shape = Shape::Sphere;
        let ball = ColliderDesc { shape, radius: 0.2, ..ColliderDesc::default() };
        let ball = cape.cloth.add_collider(&ball).unwrap();
        let (mut far, mut deep, mut at_end, mut at_back) = (f32::MIN, f32::MIN, 0, 0);
        let mut over = 0;
        for tick in 1..=300 {
            let time = tick as f32 / 60.0;
            let position = Vec3::new(10.0 * time, 0.1 * (tick % 7) as f32, 0.0);
            let rotation = Quat::from_rotation_y(core::f32::consts::TAU * 2.0 * time);
            let (anchors, normal) = cape.set_anchors_for_pose(position, rotation);
            // The ball hits the cape repeatedly and must not push it past the max distance.
            let toward = rotation * Vec3::new(0.0, 0.9, -0.45 + 0.2 * (tick % 3) as f32);
            cape.cloth.move_collider(ball, position + toward, Quat::IDENTITY).unwrap();
            cape.cloth.step(1);
            over += u32::from(cape.cloth.stats().over_stretched > 0);
            let worst = cape.largest_violations(&anchors, normal);
            (far, deep) = (far.max(worst.0), deep.max(worst.1));
            at_end += u32::from(worst.0 > -1e-4);
            at_back += u32::from(worst.1 > -1e-4);
        }
        println!("excess {far:.1e} m, depth {deep:.1e} m, {over} ticks over-stretched");
        assert!(
            far < 1e-4 && deep < 1e-4,
            "excess {far} m over the max distance, {deep} m in the backstop"
        );
        assert!(
            at_end == 300 && at_back > 200,
            "the limits are rarely reached: {at_end}, {at_back} ticks"
        );
    }
}

#[test]
fn a_falling_sheet_stops_at_the_max_distance_and_stays_there() {
    let mut desc = bare_grid(8, 8, 0.05, PinMode::None);
    desc.settings.damping = 0.0;
    let mut cloth = Cloth::grid(&desc).unwrap();
    let start = cloth.positions().to_vec();
    let all: Vec<u32> = (0..64).collect();
    cloth.set_max_distances(&all, &[0.25; 64]).unwrap();
    // It reaches the max distance after 0.226 s; check from half a second after that.
    cloth.step(12);
    assert!(
        cloth.positions()[20].y > start[20].y - 0.25 + 1e-3,
        "the sheet is already at the max distance"
    );
    cloth.step(32);
    for tick in 0..120 {
        cloth.step(1);
        for (x, start) in cloth.positions().iter().zip(&start) {
            assert!((start.y - x.y - 0.25).abs() < 1e-4, "{x} in tick {tick} from {start}");
        }
    }
    assert!(cloth.stats().max_speed < 1e-2, "{} m/s", cloth.stats().max_speed);
}

#[test]
fn a_backstop_supports_a_sheet_that_lies_on_it() {
    // Each particle is exactly above the centre of its backstop sphere, so it does not slide off.
    let mut desc = bare_grid(10, 10, 0.05, PinMode::None);
    desc.down = Vec3::Z;
    let mut cloth = Cloth::grid(&desc).unwrap();
    let (start, all) = (cloth.positions().to_vec(), (0..100).collect::<Vec<u32>>());
    cloth.set_backstops(&all, &[0.1; 100], &[1.0; 100]).unwrap();
    cloth.step(10);
    assert!(cloth.positions()[50].y < start[50].y - 0.05, "without a normal there is no backstop");
    cloth.set_anchors(&all, &start, &[Vec3::Y * 3.0; 100]).unwrap();
    for _ in 0..200 {
        cloth.step(1);
        for (x, start) in cloth.positions().iter().zip(&start) {
            let depth = 1.0 - x.distance(*start - Vec3::Y * 1.1);
            assert!(depth < 1e-5, "{depth} m deep");
        }
    }
    assert!((start[50].y - cloth.positions()[50].y - 0.1).abs() < 1e-3);
}

#[test]
fn anchors_survive_save_and_clone_but_not_reset() {
    let mut cape = anchored_cape(|_| ());
    cape.cloth.step(20);
    cape.set_anchors_for_pose(Vec3::new(0.1, 0.0, 0.0), Quat::from_rotation_y(0.2));
    let mut others = [Cloth::restore(&cape.cloth.save()).unwrap(), cape.cloth.clone()];
    assert_eq!(others[0].save(), cape.cloth.save());
    cape.cloth.step(10);
    for other in &mut others {
        other.step(10);
        assert_eq!(other.state_hash(), cape.cloth.state_hash());
    }
    let before = cape.cloth.state_hash();
    others[1].set_max_distances(&[5], &[0.02]).unwrap();
    assert_ne!(others[1].state_hash(), before, "a max distance must change the state hash");
    cape.cloth.reset();
    cape.cloth.step(30);
    let fallen = cape.rest[300].y - cape.cloth.positions()[300].y;
    assert!(fallen > 1.0, "reset must remove the anchors, but the cape fell only {fallen} m");
}

#[test]
fn cuts_keep_max_distances_on_both_sides_and_give_them_to_new_vertices() {
    let mut cape = anchored_cape(|_| ());
    let from = Vec3::new(0.003, 1.2, -2.0);
    assert!(cape.cloth.cut(from, from - Vec3::Y * 2.0, Vec3::Z * 4.0).unwrap() > 10);
    let count = cape.cloth.positions().len();
    assert!(count > 620);
    let (anchors, normal) = cape.set_anchors_for_pose(Vec3::X * 0.05, Quat::IDENTITY);
    for _ in 0..240 {
        cape.cloth.step(1);
        let _ = (&anchors, normal);
        // Every vertex stays within 0.3 m of its anchor on the cape, which moved by 0.05 m.
        let low = cape.cloth.positions().iter().map(|x| x.y).fold(f32::MAX, f32::min);
        assert!(low > 1.5 - 0.87 - 0.301, "one fell to {low} m");
    }
}

#[test]
fn moving_anchors_and_changed_max_distances_wake_a_sleeping_cloth() {
    let asleep = || {
        let mut cape = anchored_cape(|desc| {
            (desc.settings.sleep_speed, desc.settings.damping) = (0.005, 3.0);
        });
        cape.cloth.step(3000);
        assert!(cape.cloth.stats().asleep);
        cape
    };
    let mut moved = asleep();
    moved.set_anchors_for_pose(Vec3::ZERO, Quat::IDENTITY);
    moved.cloth.step(1);
    assert!(moved.cloth.stats().asleep, "an unchanged anchor must not wake the cloth");
    moved.set_anchors_for_pose(Vec3::X * 0.01, Quat::IDENTITY);
    moved.cloth.step(1);
    assert!(!moved.cloth.stats().asleep);
    let mut longer = asleep();
    longer.cloth.set_max_distances(&[590], &[0.5]).unwrap();
    longer.cloth.step(1);
    assert!(!longer.cloth.stats().asleep);
    let mut free = asleep();
    free.cloth.clear_leashes();
    free.cloth.step(30);
    assert!(free.cloth.positions()[300].y < 0.5);
}

#[test]
fn invalid_anchor_calls_are_refused_and_change_nothing() {
    let mut cloth = anchored_cape(|_| ()).cloth;
    let before = cloth.save();
    let bad = |field, must| Err(Error::BadValue { field, must });
    let as_many = "have as many entries as `particles`";
    assert_eq!(cloth.set_max_distances(&[1, 2], &[0.1]), bad("distances", as_many));
    for distance in [-0.1, f32::NAN] {
        let refused = cloth.set_max_distances(&[1, 2], &[0.1, distance]);
        assert_eq!(refused, bad("distances", "be at least 0"));
    }
    let index = Err(Error::BadIndex { field: "particles", index: 600, count: 600 });
    assert_eq!(cloth.set_max_distances(&[1, 600], &[0.1; 2]), index);
    assert_eq!(cloth.set_backstops(&[1, 600], &[0.1; 2], &[0.1; 2]), index);
    assert_eq!(cloth.set_anchors(&[1, 600], &[Vec3::ZERO; 2], &[]), index);
    assert_eq!(cloth.set_backstops(&[1], &[], &[0.1]), bad("distances", as_many));
    assert_eq!(cloth.set_backstops(&[1], &[0.1], &[]), bad("radii", as_many));
    for length in [-0.1, f32::NAN, f32::INFINITY] {
        let must = "be at least 0 and finite";
        assert_eq!(cloth.set_backstops(&[1], &[length], &[0.1]), bad("distances", must));
        assert_eq!(cloth.set_backstops(&[1], &[0.1], &[length]), bad("radii", must));
    }
    assert_eq!(cloth.set_anchors(&[1], &[], &[]), bad("positions", as_many));
    let normals = cloth.set_anchors(&[1, 2], &[Vec3::ZERO; 2], &[Vec3::Y]);
    assert_eq!(normals, bad("normals", "have as many entries as `particles`, or none"));
    assert_eq!(cloth.set_anchors(&[1], &[Vec3::NAN], &[]), bad("positions", "be finite"));
    assert_eq!(cloth.set_anchors(&[1], &[Vec3::ONE], &[Vec3::NAN]), bad("normals", "be finite"));
    let zero = cloth.set_anchors(&[1], &[Vec3::ONE], &[Vec3::ZERO]);
    assert_eq!(zero, bad("normals", "have a length above 0"));
    assert_eq!(cloth.save(), before);
}
