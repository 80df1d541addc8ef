//! Momentum and energy over random scenes: grids and irregular meshes in one or several pieces, of
//! random fabric, steps and velocities.

use crate::common::bare_grid;
use muslin::glam::{DVec3, Vec3};
use muslin::{Cloth, MeshDesc, PinMode, SelfCollision, Settings};
use proptest::prelude::*;
use proptest::test_runner::{RngAlgorithm, TestRng, TestRunner};

/// Half the distance between 1 and the next f32: the largest relative error of a rounding.
const ROUNDING: f64 = 1.0 / 16_777_216.0;

/// Tests `property` with `cases` scenes, the same ones in every run.
fn for_scenes<S: Strategy>(
    cases: u32,
    scenes: S,
    property: impl Fn(S::Value) -> Result<(), TestCaseError>,
) {
    let config = ProptestConfig { cases, failure_persistence: None, ..ProptestConfig::default() };
    let random = TestRng::from_seed(RngAlgorithm::ChaCha, &[7; 32]);
    TestRunner::new_with_rng(config, random).run(&scenes, property).unwrap();
}

/// Mass per area of all scenes [kg/m²].
const DENSITY: f32 = 0.15;

/// How the mesh is made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// A grid; the first cut goes through a column, the second through a row.
    CutGrid,
    /// Separate sheets of a mesh with uneven cells, in layers.
    Layers,
}

/// A cloth with random velocities.
#[derive(Clone, Debug)]
pub struct Scene {
    pub kind: Kind,
    pub columns: u32,
    pub rows: u32,
    pub pieces: u32,
    pub spacing: f32,
    /// Distance of layers [spacings].
    pub layer_distance: f32,
    /// Largest component of the velocity of a particle [m/s].
    pub speed: f32,
    pub stretch_stiffness: Option<f32>,
    pub bend_stiffness: f32,
    pub iterations: u32,
    pub substeps: u32,
    /// Lengths of the ticks [s], used in turn.
    pub ticks: Vec<f32>,
    pub tethers: bool,
    pub gravity: f32,
    pub collision: SelfCollision,
    /// Particles of the first row that are pinned, from the left.
    pub pins: u32,
    pub seed: u32,
}

/// Numbers from −1 to 1 that look random.
fn random(seed: u32) -> impl FnMut() -> f32 {
    let mut state = seed;
    move || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (state >> 8) as f32 / 8_388_608.0 - 1.0
    }
}

/// 10 to the power of a uniform number.
fn log_uniform(from: f32, to: f32) -> impl Strategy<Value = f32> {
    (from.log10()..to.log10()).prop_map(|exponent| 10.0_f32.powf(exponent))
}

/// One tick length, or three in turn.
fn tick_lengths() -> impl Strategy<Value = Vec<f32>> {
    let tick = || log_uniform(1.0e-4, 1.0 / 30.0);
    prop_oneof![tick().prop_map(|tick| vec![tick]), prop::collection::vec(tick(), 3)]
}

prop_compose! {
    fn scene(collision: impl Strategy<Value = SelfCollision>)(
        (kind, columns, rows, pieces) in (
            prop_oneof![Just(Kind::CutGrid), Just(Kind::Layers)], 3u32..9, 3u32..9, 1u32..4,
        ),
        (spacing, layer_distance, speed) in (log_uniform(0.004, 0.1), 0.3f32..3.0, 0.05f32..1.5),
        stretch_stiffness in prop::option::of(log_uniform(1.0e2, 1.0e5)),
        bend_stiffness in log_uniform(1.0e-6, 1.0e-2),
        (iterations, substeps, ticks) in (1u32..4, 1u32..7, tick_lengths()),
        (tethers, gravity) in (any::<bool>(), prop_oneof![Just(0.0f32), Just(-9.81)]),
        collision in collision,
        seed in any::<u32>(),
    ) -> Scene {
        Scene {
            kind, columns, rows, pieces, spacing, layer_distance, speed, stretch_stiffness,
            bend_stiffness, iterations, substeps, ticks, tethers, gravity, collision, pins: 0, seed,
        }
    }
}

impl Scene {
    pub fn build(&self) -> Cloth {
        let mut grid = bare_grid(self.columns, self.rows, self.spacing, PinMode::None);
        let settings = &mut grid.settings;
        settings.gravity = Vec3::Y * self.gravity;
        settings.iterations = self.iterations;
        settings.substeps = self.substeps;
        settings.tick = self.ticks[0];
        settings.tethers = self.tethers;
        settings.self_collision = self.collision;
        grid.extra_particles = 200;
        if let Some(stiffness) = self.stretch_stiffness {
            grid.material.stretch_stiffness_warp = stiffness;
            grid.material.stretch_stiffness_weft = stiffness;
        }
        grid.material.density = DENSITY;
        grid.material.bend_stiffness = self.bend_stiffness;
        let mut cloth = match self.kind {
            Kind::CutGrid => Cloth::grid(&grid).unwrap(),
            Kind::Layers => {
                let (settings, material) = (grid.settings, grid.material);
                Cloth::mesh(&MeshDesc { settings, material, ..self.layers() }).unwrap()
            }
        };
        if self.kind == Kind::CutGrid {
            self.cut(&mut cloth);
        }
        for i in 0..self.pins {
            cloth.pin(i, None).unwrap();
        }
        cloth
    }

    /// Gives each particle that nothing holds a random velocity.
    pub fn push(&self, cloth: &mut Cloth) {
        let mut next = random(self.seed);
        for i in self.pins..cloth.particle_count() {
            let v = Vec3::new(next(), next(), next()) * self.speed;
            cloth.set_velocity(i, v).unwrap();
        }
    }

    /// Flat sheets of uneven cells, one behind the other.
    fn layers(&self) -> MeshDesc {
        let mut next = random(self.seed ^ 0x5bd1_e995);
        let mut desc = MeshDesc::default();
        for layer in 0..self.pieces {
            let first = desc.positions.len() as u32;
            for at in 0..self.columns * self.rows {
                let (column, row) = (at % self.columns, at / self.columns);
                let x = column as f32 + 0.25 * next();
                let y = row as f32 + 0.25 * next();
                let z = layer as f32 * self.layer_distance;
                desc.positions.push(Vec3::new(x, -y, z) * self.spacing);
            }
            for row in 0..self.rows - 1 {
                for column in 0..self.columns - 1 {
                    let a = first + row * self.columns + column;
                    let c = a + self.columns;
                    desc.indices.extend([a, c, a + 1, a + 1, c, c + 1]);
                }
            }
        }
        desc
    }

    /// Cuts a grid into as many pieces as the scene has.
    fn cut(&self, cloth: &mut Cloth) {
        let size = Vec3::new(self.columns as f32, self.rows as f32, 0.0) * self.spacing;
        let column = (self.columns / 2) as f32 * self.spacing - 0.45 * self.spacing;
        let row = (self.rows / 2) as f32 * self.spacing - 0.45 * self.spacing;
        let lines = [
            [Vec3::new(column, size.y, 0.0), Vec3::new(column, -2.0 * size.y, 0.0)],
            [Vec3::new(-size.x, -row, 0.0), Vec3::new(column, -row, 0.0)],
        ];
        for [from, to] in lines.into_iter().take(self.pieces as usize - 1) {
            let back = Vec3::Z * self.spacing;
            cloth.cut(from - back, to - back, back * 2.0).unwrap();
        }
    }

    /// Steps one tick of the next length, and returns that length [s].
    fn step(&self, cloth: &mut Cloth, number: usize) -> f64 {
        let tick = self.ticks[number % self.ticks.len()];
        if self.ticks.len() > 1 {
            cloth.set_settings(Settings { tick, ..cloth.settings().clone() }).unwrap();
        }
        cloth.step(1);
        f64::from(tick)
    }
}

/// The particles of each piece.
fn pieces(cloth: &Cloth) -> Vec<Vec<u32>> {
    let mut piece: Vec<u32> = (0..cloth.particle_count()).collect();
    for _ in 0..piece.len() {
        for triangle in cloth.indices().chunks_exact(3) {
            let least = triangle.iter().map(|v| piece[*v as usize]).min().unwrap();
            triangle.iter().for_each(|v| piece[*v as usize] = least);
        }
    }
    let lists = (0..cloth.particle_count())
        .map(|first| (0..cloth.particle_count()).filter(|i| piece[*i as usize] == first).collect());
    lists.filter(|list: &Vec<u32>| !list.is_empty()).collect()
}

/// Mass [kg], velocity of the centre of mass [m/s], angular momentum about it [N m s], kinetic energy
/// relative to it [J], and largest distance from the origin [m] and speed [m/s].
#[derive(Clone, Copy, Debug)]
struct Motion {
    mass: f64,
    v: DVec3,
    spin: DVec3,
    kinetic: f64,
    reach: f64,
    speed: f64,
}

impl Motion {
    /// Raises energy, reach and speed to those of another motion.
    fn raise(&mut self, other: &Self) {
        self.kinetic = self.kinetic.max(other.kinetic);
        self.reach = self.reach.max(other.reach);
        self.speed = self.speed.max(other.speed);
    }
}

fn motion(cloth: &Cloth, particles: &[u32]) -> Motion {
    let all = || {
        particles.iter().map(|i| {
            let (x, v) = (cloth.position(*i).unwrap(), cloth.velocity(*i).unwrap());
            (f64::from(cloth.mass(*i).unwrap()), x.as_dvec3(), v.as_dvec3())
        })
    };
    let mass: f64 = all().map(|(mass, _, _)| mass).sum();
    let center = all().map(|(mass, x, _)| x * mass).sum::<DVec3>() / mass;
    let v = all().map(|(mass, _, v)| v * mass).sum::<DVec3>() / mass;
    let spin = all().map(|(mass, x, u)| (x - center).cross(u - v) * mass).sum();
    let kinetic = all().map(|(mass, _, u)| 0.5 * mass * (u - v).length_squared()).sum();
    let largest = |numbers: &mut dyn Iterator<Item = f64>| numbers.fold(0.0, f64::max);
    let reach = largest(&mut all().map(|(_, x, _)| x.length()));
    let speed = largest(&mut all().map(|(_, _, v)| v.length()));
    Motion { mass, v, spin, kinetic, reach, speed }
}

/// Kinetic energy and energy in gravity [J].
fn energy(cloth: &Cloth) -> f64 {
    let gravity = cloth.settings().gravity.as_dvec3();
    let all = (0..cloth.particle_count()).map(|i| {
        let (x, v) = (cloth.position(i).unwrap().as_dvec3(), cloth.velocity(i).unwrap().as_dvec3());
        f64::from(cloth.mass(i).unwrap()) * (0.5 * v.length_squared() - gravity.dot(x))
    });
    all.sum()
}

/// Runs the ticks of a scene and tests each.
fn test_ticks(
    scene: &Scene,
    cloth: &mut Cloth,
    ticks: usize,
    mut test: impl FnMut(&Cloth, f64) -> Result<(), TestCaseError>,
) -> Result<(), TestCaseError> {
    let mut time = 0.0;
    for tick in 0..ticks {
        time += scene.step(cloth, tick);
        test(cloth, time)?;
    }
    Ok(())
}

/// Error of velocities after some substeps [m/s]: in each substep a velocity v, a displacement h v and
/// its correction are rounded once, each to the share [`ROUNDING`] of v. A correction that turns a
/// piece counts from a centre that is rounded to a share of `reach`, so that it moves the piece by
/// reach / spacing roundings at most. The rounding of a position itself does not count, since
/// velocities count exact displacements.
fn velocity_rounding(substeps: f64, motion: &Motion, spacing: f32) -> f64 {
    let roundings = 3.0 + motion.reach / f64::from(spacing);
    substeps * roundings * ROUNDING * motion.speed
}

/// Tests that the velocity of the centre of mass of each list of free particles only changes by
/// gravity, within rounding.
fn test_linear_momentum(
    scene: &Scene,
    cloth: &mut Cloth,
    lists: &[Vec<u32>],
) -> Result<(), TestCaseError> {
    let start: Vec<Motion> = lists.iter().map(|list| motion(cloth, list)).collect();
    let (mut most, mut substeps) = (start.clone(), 0.0);
    test_ticks(scene, cloth, 40, |cloth, time| {
        substeps += f64::from(scene.substeps);
        let fallen = DVec3::Y * (f64::from(scene.gravity) * time);
        for ((list, start), most) in lists.iter().zip(&start).zip(&mut most) {
            let now = motion(cloth, list);
            most.raise(&now);
            let error = now.v.distance(start.v + fallen);
            let allowed = velocity_rounding(substeps, most, scene.spacing);
            prop_assert!(error <= allowed, "after {} s: {} of {} m/s", time, error, allowed);
        }
        Ok(())
    })
}

#[test]
fn each_free_piece_keeps_its_linear_momentum() {
    for_scenes(24, (scene(Just(SelfCollision::None)), 0u32..4), |(scene, pins)| {
        let scene = Scene { pins: pins.min(scene.columns), ..scene };
        let mut cloth = scene.build();
        scene.push(&mut cloth);
        let mut pieces = pieces(&cloth);
        prop_assert_eq!(pieces.len(), scene.pieces as usize);
        pieces.retain(|piece| piece.iter().all(|i| *i >= scene.pins));
        test_linear_momentum(&scene, &mut cloth, &pieces)
    });
}

#[test]
fn free_pieces_that_touch_keep_the_sum_of_their_momenta() {
    let collision = prop_oneof![Just(SelfCollision::Particles), Just(SelfCollision::Surface)];
    for_scenes(24, scene(collision), |scene| {
        let scene = Scene { kind: Kind::Layers, ..scene };
        let mut cloth = scene.build();
        scene.push(&mut cloth);
        let all = (0..cloth.particle_count()).collect();
        test_linear_momentum(&scene, &mut cloth, &[all])
    });
}

/// A substep moves particles along straight lines. What `momentum` keeps constant in it differs from
/// the angular momentum by Σ m d × (v + v') / 2, where the displacement d is h v' with BDF1 and
/// (2 h v' + d₋) / 3 with BDF2. That is 4/3 of h times the kinetic energy at most.
#[test]
fn each_free_piece_keeps_its_angular_momentum() {
    for_scenes(24, (scene(Just(SelfCollision::None)), 1.0e-4_f32..1.0e-3), |(scene, share)| {
        // Each particle moves by this share of the spacing in a substep.
        let substep = share * scene.spacing / scene.speed;
        let ticks = vec![(substep * scene.substeps as f32).min(1.0 / 30.0)];
        let scene = Scene { ticks, ..scene };
        let mut cloth = scene.build();
        scene.push(&mut cloth);
        let pieces = pieces(&cloth);
        let start: Vec<Motion> = pieces.iter().map(|piece| motion(&cloth, piece)).collect();
        let (mut most, mut substeps) = (start.clone(), 0.0);
        test_ticks(&scene, &mut cloth, 40, |cloth, time| {
            substeps += f64::from(scene.substeps);
            for ((piece, start), most) in pieces.iter().zip(&start).zip(&mut most) {
                let now = motion(cloth, piece);
                most.raise(&now);
                let error = now.spin.distance(start.spin);
                let straight = 4.0 / 3.0 * time * most.kinetic;
                let rounding = velocity_rounding(substeps, most, scene.spacing);
                let allowed = straight + rounding * most.reach * most.mass;
                prop_assert!(error <= allowed, "after {} s: {} of {} N m s", time, error, allowed);
            }
            Ok(())
        })
    });
}

/// Rounding of the energy of a kilogram [J]: that of velocities changes v²/2, and that of positions
/// moves it in gravity. A particle also has eight links whose lengths are wrong by a rounding of its
/// position, and eight hinges, whose forces at rest cancel but for a rounding times the ratio of bending
/// stiffness to inertia. A substep may correct all of them.
fn energy_rounding(substeps: f64, motion: &Motion, scene: &Scene) -> f64 {
    let of_velocity = velocity_rounding(substeps, motion, scene.spacing) * motion.speed;
    let of_height = substeps * ROUNDING * motion.reach * f64::from(scene.gravity.abs());
    let h = f64::from(scene.ticks[0]) / f64::from(scene.substeps);
    let inertia = f64::from(DENSITY) * f64::from(scene.spacing).powi(4) / (h * h);
    let stiffness = 1.0 + f64::from(scene.bend_stiffness) / inertia;
    let of_elements = 8.0 * stiffness * ROUNDING * motion.reach / h;
    of_velocity + of_height + 0.5 * of_elements * of_elements
}

/// Tests that the energy per mass never exceeds its start, where links and bends have none, by more
/// than `excess` [J/kg] and rounding.
pub fn test_energy(
    scene: &Scene,
    cloth: &mut Cloth,
    ticks: usize,
    excess: f64,
) -> Result<(), TestCaseError> {
    let all: Vec<u32> = (0..cloth.particle_count()).collect();
    let (start, mut most, mut substeps) = (energy(cloth), motion(cloth, &all), 0.0);
    test_ticks(scene, cloth, ticks, |cloth, time| {
        substeps += f64::from(scene.substeps);
        most.raise(&motion(cloth, &all));
        let gain = (energy(cloth) - start) / most.mass;
        let allowed = excess + energy_rounding(substeps, &most, scene);
        prop_assert!(gain <= allowed, "after {} s: gained {} of {} J/kg", time, gain, allowed);
        Ok(())
    })
}

/// Scenes whose ticks are all alike and whose bending is as soft as that of cloth.
fn even_scene(collision: impl Strategy<Value = SelfCollision>) -> impl Strategy<Value = Scene> {
    (scene(collision), 0u32..5).prop_map(|(mut scene, pins)| {
        scene.ticks.truncate(1);
        scene.bend_stiffness = scene.bend_stiffness.min(0.25 * scene.spacing * scene.spacing);
        scene.layer_distance = scene.layer_distance.max(1.0);
        scene.pins = pins.min(scene.columns);
        scene
    })
}

/// Scenes of any bending stiffness. Ticks of uncut cloth may differ in length.
fn moving_scene(collision: impl Strategy<Value = SelfCollision>) -> impl Strategy<Value = Scene> {
    (scene(collision), 0u32..5).prop_map(|(mut scene, pins)| {
        if scene.kind == Kind::CutGrid && scene.pieces > 1 {
            scene.ticks.truncate(1);
        }
        scene.layer_distance = scene.layer_distance.max(1.0);
        scene.pins = pins.min(scene.columns);
        scene
    })
}

#[test]
fn moving_cloth_never_gains_energy_without_damping() {
    for_scenes(96, moving_scene(Just(SelfCollision::None)), |scene| {
        let mut cloth = scene.build();
        scene.push(&mut cloth);
        test_energy(&scene, &mut cloth, 60, 0.0)
    });
}

#[test]
fn layers_that_collide_never_gain_energy() {
    let collision = prop_oneof![Just(SelfCollision::Particles), Just(SelfCollision::Surface)];
    for_scenes(48, moving_scene(collision), |scene| {
        let scene = Scene { kind: Kind::Layers, ..scene };
        let mut cloth = scene.build();
        scene.push(&mut cloth);
        test_energy(&scene, &mut cloth, 60, 0.0)
    });
}

/// The history of new cloth is that of free fall, so BDF2 gives the particles of held cloth the speed
/// g h / 4 in the first substep, although they stay where they are.
#[test]
fn still_cloth_never_gains_energy() {
    let collision = prop_oneof![
        Just(SelfCollision::None),
        Just(SelfCollision::Particles),
        Just(SelfCollision::Surface),
    ];
    for_scenes(24, even_scene(collision), |scene| {
        let is_held = scene.pins > 0;
        let kind = if scene.collision == SelfCollision::None { scene.kind } else { Kind::Layers };
        let pins = if is_held { scene.columns } else { 0 };
        let iterations = if is_held { scene.iterations.max(2) } else { scene.iterations };
        let scene = Scene { kind, pins, iterations, ..scene };
        let mut cloth = scene.build();
        let h = f64::from(scene.ticks[0]) / f64::from(scene.substeps);
        let speed = if is_held { 0.25 * f64::from(scene.gravity) * h } else { 0.0 };
        test_energy(&scene, &mut cloth, 120, 0.5 * speed * speed)
    });
}

#[test]
fn saved_cloth_in_several_pieces_continues_with_the_same_bits() {
    let collision = prop_oneof![Just(SelfCollision::None), Just(SelfCollision::Particles)];
    for_scenes(12, (scene(collision), 0u32..4), |(scene, pins)| {
        let scene = Scene { pins: pins.min(scene.columns), ..scene };
        let mut cloth = scene.build();
        scene.push(&mut cloth);
        cloth.step(10);
        let mut copy = Cloth::restore(&cloth.save()).unwrap();
        for cloth in [&mut cloth, &mut copy] {
            cloth.step(10);
        }
        prop_assert_eq!(copy.state_hash(), cloth.state_hash());
        Ok(())
    });
}
