//! Leashes: particles stay near where animation has them, and out of their backstops.

use crate::common::bare_grid;
use muslin::glam::{Quat, Vec3};
use muslin::{Cloth, ColliderDesc, Error, GridDesc, Material, PinMode, Preset, Shape, Wind};

const COLUMNS: u32 = 20;
const ROWS: u32 = 30;

/// A cape on the back of a body, and all that says how it is worn.
struct Worn {
    cloth: Cloth,
    all: Vec<u32>,
    rest: Vec<Vec3>,
    distances: Vec<f32>,
}

/// How far behind its anchor each backstop begins [m], and its radius.
const BACKSTOP: (f32, f32) = (0.01, 0.3);

/// From 0 at the top edge to 0.3 m at the hem.
fn worn(change: impl FnOnce(&mut GridDesc)) -> Worn {
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
    Worn { cloth, all, rest, distances }
}

impl Worn {
    /// The body is somewhere else, and the animation of the cape with it.
    fn pose(&mut self, position: Vec3, rotation: Quat) -> (Vec<Vec3>, Vec3) {
        let anchors: Vec<Vec3> = self.rest.iter().map(|x| position + rotation * *x).collect();
        let normal = rotation * -Vec3::Z;
        self.cloth.set_anchors(&self.all, &anchors, &vec![normal; self.all.len()]).unwrap();
        (anchors, normal)
    }

    /// How far past its end the worst leash is, and how deep in its backstop the worst particle is [m].
    fn worst(&self, anchors: &[Vec3], normal: Vec3) -> (f32, f32) {
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
fn nothing_is_past_its_leash_or_in_its_backstop_on_a_body_that_runs_and_turns() {
    for max_stretch in [0.0, 0.05] {
        let mut worn = worn(|desc| desc.settings.max_stretch = max_stretch);
        let velocity = Vec3::new(3.0, 0.0, 12.0);
        worn.cloth
            .set_wind(Wind { velocity, gust: 1.0, turbulence: 0.5, ..Wind::default() })
            .unwrap();
        let shape = Shape::Sphere;
        let ball = ColliderDesc { shape, radius: 0.2, ..ColliderDesc::default() };
        let ball = worn.cloth.add_collider(&ball).unwrap();
        let (mut far, mut deep, mut at_end, mut at_back) = (f32::MIN, f32::MIN, 0, 0);
        let mut over = 0;
        for tick in 1..=300 {
            let time = tick as f32 / 60.0;
            let position = Vec3::new(10.0 * time, 0.1 * (tick % 7) as f32, 0.0);
            let rotation = Quat::from_rotation_y(core::f32::consts::TAU * 2.0 * time);
            let (anchors, normal) = worn.pose(position, rotation);
            // It runs into the cape again and again, and may not push it off the leash.
            let toward = rotation * Vec3::new(0.0, 0.9, -0.45 + 0.2 * (tick % 3) as f32);
            worn.cloth.move_collider(ball, position + toward, Quat::IDENTITY).unwrap();
            worn.cloth.step(1);
            over += u32::from(worn.cloth.stats().over_stretched > 0);
            let worst = worn.worst(&anchors, normal);
            (far, deep) = (far.max(worst.0), deep.max(worst.1));
            at_end += u32::from(worst.0 > -1e-4);
            at_back += u32::from(worst.1 > -1e-4);
        }
        println!("past the end by {far:.1e} m, in the backstop by {deep:.1e} m, {over} ticks over");
        assert!(far < 1e-4 && deep < 1e-4, "{far} m past the end, {deep} m in the backstop");
        assert!(at_end == 300 && at_back > 200, "the leashes hold nothing: {at_end}, {at_back}");
    }
}

#[test]
fn a_sheet_that_falls_to_the_end_of_its_leash_stays_there() {
    let mut desc = bare_grid(8, 8, 0.05, PinMode::None);
    desc.settings.damping = 0.0;
    let mut cloth = Cloth::grid(&desc).unwrap();
    let start = cloth.positions().to_vec();
    let all: Vec<u32> = (0..64).collect();
    cloth.set_max_distances(&all, &[0.25; 64]).unwrap();
    // Half a second after it got there, which takes 0.226 s.
    cloth.step(12);
    assert!(cloth.positions()[20].y > start[20].y - 0.25 + 1e-3, "it is there already");
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
fn a_backstop_bears_a_sheet_that_lies_on_it() {
    // Flat, with backstops of a metre below: on each its particle cannot slide, for it is right above.
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
fn leashes_outlive_saving_and_cloning_but_not_a_reset() {
    let mut worn = worn(|_| ());
    worn.cloth.step(20);
    worn.pose(Vec3::new(0.1, 0.0, 0.0), Quat::from_rotation_y(0.2));
    let mut others = [Cloth::restore(&worn.cloth.save()).unwrap(), worn.cloth.clone()];
    assert_eq!(others[0].save(), worn.cloth.save());
    worn.cloth.step(10);
    for other in &mut others {
        other.step(10);
        assert_eq!(other.state_hash(), worn.cloth.state_hash());
    }
    let before = worn.cloth.state_hash();
    others[1].set_max_distances(&[5], &[0.02]).unwrap();
    assert_ne!(others[1].state_hash(), before, "a leash is of the state");
    worn.cloth.reset();
    worn.cloth.step(30);
    let fallen = worn.rest[300].y - worn.cloth.positions()[300].y;
    assert!(fallen > 1.0, "nothing holds it after a reset, but it fell {fallen} m");
}

#[test]
fn cuts_leave_both_sides_on_their_leashes_and_lead_new_vertices_too() {
    let mut worn = worn(|_| ());
    let from = Vec3::new(0.003, 1.2, -2.0);
    assert!(worn.cloth.cut(from, from - Vec3::Y * 2.0, Vec3::Z * 4.0).unwrap() > 10);
    let count = worn.cloth.positions().len();
    assert!(count > 620);
    let (anchors, normal) = worn.pose(Vec3::X * 0.05, Quat::IDENTITY);
    for _ in 0..240 {
        worn.cloth.step(1);
        let _ = (&anchors, normal);
        // Every vertex was within 0.3 m of a place on the cape, and that moved by 0.05 m.
        let low = worn.cloth.positions().iter().map(|x| x.y).fold(f32::MAX, f32::min);
        assert!(low > 1.5 - 0.87 - 0.301, "one fell to {low} m");
    }
}

#[test]
fn an_anchor_on_its_way_and_a_new_leash_wake_a_sleeping_cloth() {
    let asleep = || {
        let mut worn = worn(|desc| {
            (desc.settings.sleep_speed, desc.settings.damping) = (0.005, 3.0);
        });
        worn.cloth.step(3000);
        assert!(worn.cloth.stats().asleep);
        worn
    };
    let mut moved = asleep();
    moved.pose(Vec3::ZERO, Quat::IDENTITY);
    moved.cloth.step(1);
    assert!(moved.cloth.stats().asleep, "to where it is, is no move");
    moved.pose(Vec3::X * 0.01, Quat::IDENTITY);
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
fn what_cannot_be_is_refused_and_changes_nothing() {
    let mut cloth = worn(|_| ()).cloth;
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
