//! The memory of a cloth, as the allocator counts it.

use crate::common::irregular_mesh;
use crate::counting_allocator::{allocated_bytes, allocation_count};
use muslin::glam::Vec3;
use muslin::{Cloth, ColliderDesc, GridDesc, SelfCollision, Shape, Wind};

/// Heap memory of a default cloth of side × side particles after its first ticks [bytes]. These
/// numbers may only fall.
const MOST_BYTES: [(u32, i64); 3] = [(16, 235_302), (40, 1_489_446), (128, 14_620_918)];

/// Likewise of 16 × 16 particles with a sphere, and of a clone of that one [bytes].
const MOST_BYTES_WITH_SPHERE: i64 = 246_498;
const MOST_BYTES_OF_CLONE: i64 = 105_686;

/// A default cloth of side × side particles.
fn default_cloth(side: u32) -> Cloth {
    Cloth::grid(&GridDesc { columns: side, rows: side, ..GridDesc::default() }).unwrap()
}

/// Runs `make` and ten ticks; returns the cloth and its heap memory [bytes]. A cloth before it makes
/// the scratch buffers of the thread as large as needed, which are not part of the memory of a cloth.
fn measured(make: impl Fn() -> Cloth) -> (Box<Cloth>, i64) {
    let run = || {
        let mut cloth = Box::new(make());
        cloth.step(10);
        cloth
    };
    drop(run());
    allocated_bytes(run)
}

/// A default cloth with `count` spheres.
fn collided_cloth(side: u32, count: u32) -> Cloth {
    let mut cloth = default_cloth(side);
    let ball = ColliderDesc { shape: Shape::Sphere, radius: 0.2, ..ColliderDesc::default() };
    for _ in 0..count {
        cloth.add_collider(&ball).unwrap();
    }
    cloth
}

#[test]
fn the_memory_of_a_small_cloth_with_a_sphere_and_of_a_clone_only_falls() {
    let (cloth, bytes) = measured(|| collided_cloth(16, 1));
    let clone = measured(|| (*cloth).clone()).1;
    let most = [MOST_BYTES_WITH_SPHERE, MOST_BYTES_OF_CLONE];
    assert!(bytes <= most[0] && clone <= most[1], "{bytes} and {clone}, at most {most:?}");
}

#[test]
fn the_memory_of_a_default_cloth_only_falls() {
    let measured = MOST_BYTES.map(|(side, _)| (side, measured(|| default_cloth(side)).1));
    let within = measured.iter().zip(MOST_BYTES).all(|((_, bytes), (_, most))| *bytes <= most);
    assert!(within, "{measured:?}, at most {MOST_BYTES:?}");
}

/// Returns how many allocations ten ticks of a cloth make.
fn allocations_of_ticks(cloth: &mut Cloth) -> u32 {
    allocation_count(|| cloth.step(10))
}

#[test]
fn the_first_tear_of_a_cloth_allocates_the_reserve_and_later_ones_do_not() {
    let mut cloth = default_cloth(16);
    let (mut clone, mut restored) = (cloth.clone(), Cloth::restore(&cloth.save()).unwrap());
    for cloth in [&mut cloth, &mut clone, &mut restored] {
        assert_eq!(allocations_of_ticks(cloth), 0);
        assert!(allocation_count(|| assert!(cloth.tear_edge(100, 101).unwrap())) > 0);
        assert_eq!(allocation_count(|| assert!(cloth.tear_edge(150, 151).unwrap())), 0);
        assert_eq!(allocations_of_ticks(cloth), 0);
    }
    assert_eq!(cloth.state_hash(), clone.state_hash());
    assert_eq!(cloth.state_hash(), restored.state_hash());
}

#[test]
fn a_cloth_that_may_tear_from_now_on_tears_without_allocating() {
    for self_collision in [SelfCollision::None, SelfCollision::Particles] {
        let mut desc = GridDesc { columns: 16, rows: 16, ..GridDesc::default() };
        (desc.material.tear_stretch, desc.settings.self_collision) = (1.2, self_collision);
        let mut cloth = Cloth::grid(&desc).unwrap();
        desc.settings.tearing = true;
        let mut reserved = Cloth::grid(&desc).unwrap();
        cloth.set_settings(desc.settings).unwrap();
        for cloth in [&mut cloth, &mut reserved] {
            assert_eq!(allocation_count(|| drag_and_view(cloth, 136)), 0);
            assert!(cloth.particle_count() > 256, "nothing tore");
        }
        assert_eq!(cloth.state_hash(), reserved.state_hash());
    }
}

/// Drags a particle for 60 ticks until edges tear, and reads the view after each.
fn drag_and_view(cloth: &mut Cloth, particle: u32) {
    let grab = cloth.grab_particle(particle).unwrap();
    let from = cloth.positions()[particle as usize];
    for tick in 1..=60 {
        cloth.move_grab(grab, from + Vec3::new(0.03, 0.0, 0.05) * tick as f32).unwrap();
        cloth.step(1);
        cloth.view();
    }
}

/// Asserts that the statistics of a cloth name the bytes that the allocator gave, up to `tolerance`
/// of them.
fn assert_bytes_are_true(name: &str, tolerance: f64, (cloth, bytes): &(Box<Cloth>, i64)) {
    let told = cloth.stats().bytes;
    let error = told as f64 / *bytes as f64 - 1.0;
    assert!(error.abs() <= tolerance, "{name}: {told} instead of {bytes} bytes");
}

#[test]
fn the_bytes_of_the_statistics_are_those_that_the_allocator_gave() {
    type Change = fn(&mut GridDesc);
    let changes: [(&str, f64, Change); 5] = [
        ("default", 0.0, |_| ()),
        ("tearing", 0.0, |desc| desc.settings.tearing = true),
        ("particles", 0.0, |desc| desc.settings.self_collision = SelfCollision::Particles),
        ("surface", 0.03, |desc| desc.settings.self_collision = SelfCollision::Surface),
        ("bounded", 0.0, |desc| {
            desc.settings.max_stretch = 0.1;
            desc.material.stretch_damping = 0.01;
            desc.material.yield_angle = 0.1;
        }),
    ];
    for (name, tolerance, change) in changes {
        let mut desc = GridDesc { columns: 16, rows: 16, ..GridDesc::default() };
        change(&mut desc);
        let made = measured(|| Cloth::grid(&desc).unwrap());
        let restored = measured(|| Cloth::restore(&made.0.save()).unwrap());
        assert_bytes_are_true(name, tolerance, &made);
        assert_bytes_are_true(&format!("{name}, restored"), tolerance, &restored);
        // A clone shares rest data: each of both counts half of it, rounded down.
        let clone = measured(|| (*made.0).clone());
        let told = [&made.0, &clone.0].map(|cloth| cloth.stats().bytes).iter().sum::<u64>();
        let error = told as f64 / (made.1 + clone.1) as f64 - 1.0;
        assert!(error.abs() <= tolerance + 1.0e-4, "{name}, cloned: {told}");
    }
    let mesh = measured(|| Cloth::mesh(&irregular_mesh()).unwrap());
    assert_bytes_are_true("mesh", 0.0, &mesh);
    for count in [1, 3, 10] {
        let collided = measured(|| collided_cloth(16, count));
        assert_bytes_are_true(&format!("{count} colliders"), 0.1, &collided);
    }
    let read = measured(|| {
        let mut cloth = default_cloth(16);
        cloth.set_wind(Wind { velocity: Vec3::Z, ..Wind::default() }).unwrap();
        assert_eq!(cloth.relative_positions().len(), 256);
        cloth.view();
        cloth.raycast(Vec3::ZERO, Vec3::NEG_Z, 9.0).unwrap();
        cloth.cut(Vec3::new(0.1, -9.0, -1.0), Vec3::new(0.1, 9.0, -1.0), Vec3::Z * 2.0).unwrap();
        cloth
    });
    assert_bytes_are_true("read and cut", 0.01, &read);
}
