//! Runs a scene and applies every check after each tick.

use crate::checks::bodies::Penetration;
use crate::checks::crossings::count_self_crossings;
use crate::checks::momentum::{Momentum, Residual};
use crate::checks::surface::Surface;
use crate::play::{Play, Scene, Setup};
use cpu_time::ThreadTime;
use muslin::SelfCollision;
use muslin::glam::DVec3;
use std::time::Duration;

/// Depth of a particle in a collider that fails [m].
pub const MAX_DEPTH: f64 = 1.0e-4;
/// Depth of a triangle in a sphere, a capsule or a box that fails [m].
pub const MAX_TRIANGLE_DEPTH: f64 = 1.0e-4;
/// Unexplained change of the mean velocity in one tick, and over the whole scene, that fails [m/s].
pub const MAX_VELOCITY_ERROR: f64 = 1.0e-3;
/// Unexplained change of the angular velocity in one tick that fails [rad/s].
pub const MAX_SPIN_ERROR: f64 = 2.0e-2;
/// The worst value of a measure and the tick in which it occurred.
#[derive(Clone, Copy, Debug)]
pub struct Worst {
    pub value: f64,
    pub tick: u32,
}

impl Worst {
    fn new() -> Self {
        Self { value: f64::NEG_INFINITY, tick: 0 }
    }

    fn update(&mut self, value: f64, tick: u32) {
        if value > self.value {
            *self = Self { value, tick };
        }
    }
}

/// What the checks measured over a scene.
#[derive(Debug)]
pub struct Report {
    pub name: String,
    pub ticks: u32,
    pub particles: u32,
    /// Whether the surface collides with itself, so that crossings fail.
    pub is_surface: bool,
    /// Ticks that ended with a crossing, and the most pairs that crossed.
    pub crossing_ticks: u32,
    pub crossings: Worst,
    /// Ticks with a particle in a collider, and the greatest depth [m].
    pub penetration_ticks: u32,
    pub depth: Worst,
    /// Greatest depth of a triangle in a primitive [m], and the most pairs with a mesh that cross.
    pub triangle_depth: Worst,
    pub mesh_pairs: Worst,
    /// Ticks that ended past the bound of stretch, reported and not.
    pub told: u32,
    pub untold: u32,
    pub strain: Worst,
    /// The bound; 0 = none.
    pub bound: f32,
    /// Ticks that ended with a number that is not finite.
    pub not_finite: u32,
    /// The budget of momentum, if the piece is free.
    pub budget: Option<Budget>,
    /// Processor time of the ticks, mean and worst.
    pub mean: Duration,
    pub worst: Duration,
    /// What the scene's own check found first.
    pub own: Option<String>,
}

/// Residuals of the momentum budget.
#[derive(Clone, Copy, Debug)]
pub struct Budget {
    /// The worst tick, as changes of the mean velocity [m/s] and of the angular velocity [rad/s].
    pub velocity: Worst,
    pub spin: Worst,
    /// Sum over the scene [m/s].
    drift: DVec3,
    /// Sum of the impulses of colliders, per mass [m/s].
    pub pushes: f64,
}

impl Budget {
    fn new() -> Self {
        Self { velocity: Worst::new(), spin: Worst::new(), drift: DVec3::ZERO, pushes: 0.0 }
    }

    fn update(&mut self, residual: Residual, tick: u32) {
        let (velocity, spin) = (residual.velocity.length(), residual.spin.length());
        self.velocity.update(velocity, tick);
        self.spin.update(spin, tick);
        self.drift += residual.velocity;
        self.pushes += residual.push;
    }

    /// Unexplained change of the mean velocity over the scene [m/s].
    pub fn drift(&self) -> f64 {
        self.drift.length()
    }

    fn failures(&self) -> impl Iterator<Item = &'static str> {
        let failed = [
            (self.velocity.value > MAX_VELOCITY_ERROR, "momentum of a tick"),
            (self.drift() > MAX_VELOCITY_ERROR, "momentum of the scene"),
            (self.spin.value > MAX_SPIN_ERROR, "angular momentum"),
        ];
        failed.into_iter().filter(|(is_failed, _)| *is_failed).map(|(_, what)| what)
    }
}

impl Report {
    fn new(scene: &Scene, setup: &Setup, ticks: u32) -> Self {
        let (settings, is_free) = (setup.play.cloth.settings(), setup.is_free);
        Self {
            name: scene.name.clone(),
            ticks,
            particles: setup.play.cloth.particle_count(),
            is_surface: settings.self_collision == SelfCollision::Surface,
            crossing_ticks: 0,
            crossings: Worst { value: 0.0, tick: 0 },
            penetration_ticks: 0,
            depth: Worst::new(),
            triangle_depth: Worst::new(),
            mesh_pairs: Worst { value: 0.0, tick: 0 },
            told: 0,
            untold: 0,
            strain: Worst::new(),
            bound: settings.max_stretch,
            not_finite: 0,
            budget: is_free.then(Budget::new),
            mean: Duration::ZERO,
            worst: Duration::ZERO,
            own: None,
        }
    }

    /// What failed, in a few words.
    pub fn failures(&self) -> Vec<String> {
        let mut failures = Vec::new();
        let mut fail = |is_failed: bool, what: &str| {
            if is_failed {
                failures.push(what.to_string());
            }
        };
        fail(self.is_surface && self.crossings.value > 0.0, "crossings");
        fail(self.penetration_ticks > 0, "penetrations");
        fail(self.triangle_depth.value > MAX_TRIANGLE_DEPTH, "triangles");
        fail(self.mesh_pairs.value > 0.0, "mesh pairs");
        fail(self.untold > 0, "untold breaks");
        fail(self.not_finite > 0, "not finite");
        failures.extend(self.budget.iter().flat_map(Budget::failures).map(String::from));
        failures.extend(self.own.clone());
        failures
    }
}

/// Runs a scene for `ticks` ticks.
///
/// # Errors
/// A sentence if the scene makes a call that the library refuses.
pub fn run(scene: &Scene, ticks: u32) -> Result<Report, String> {
    let refused =
        |error: muslin::Error| format!("scene {} was refused a call: {error}", scene.name);
    let mut setup = (scene.build)().map_err(refused)?;
    let mut report = Report::new(scene, &setup, ticks);
    let start = Surface::of(&setup.play.cloth);
    let crossings = count_self_crossings(&start.tree, &start.corners);
    if crossings > 0 {
        return Err(format!("scene {} starts with {crossings} crossings", scene.name));
    }
    let held = setup.play.held();
    for body in &setup.play.bodies {
        let depth = body.penetration(&setup.play.cloth, &start, &held).particles;
        if depth > 0.0 {
            return Err(format!("scene {} starts {depth} m deep in a collider", scene.name));
        }
    }
    let mut total = Duration::ZERO;
    for tick in 0..ticks {
        (setup.drive)(&mut setup.play, tick).map_err(refused)?;
        let before = setup.is_free.then(|| Momentum::of(&setup.play.cloth));
        let clock = ThreadTime::now();
        setup.play.cloth.step(1);
        let time = clock.elapsed();
        total += time;
        report.worst = report.worst.max(time);
        if !is_finite(&setup.play) {
            report.not_finite += 1;
            continue;
        }
        if let Some(before) = before {
            let residual = before.residual(&setup.play);
            report.budget.iter_mut().for_each(|budget| budget.update(residual, tick));
        }
        check(&mut report, &mut setup.play, tick);
        if report.own.is_none() {
            let failure = (setup.watch)(&setup.play, tick).err();
            report.own = failure.map(|what| format!("tick {tick}: {what}"));
        }
    }
    report.mean = total / ticks.max(1);
    report.particles = report.particles.max(setup.play.cloth.particle_count());
    Ok(report)
}

/// Checks crossings, penetrations and stretch after a tick.
fn check(report: &mut Report, play: &mut Play, tick: u32) {
    play.rest.read_events(&mut play.cloth);
    let surface = Surface::of(&play.cloth);
    let crossings = count_self_crossings(&surface.tree, &surface.corners);
    report.crossing_ticks += u32::from(crossings > 0);
    report.crossings.update(crossings as f64, tick);
    let held = play.held();
    let all = play.bodies.iter().map(|body| body.penetration(&play.cloth, &surface, &held));
    let penetration = all.fold(Penetration::default(), Penetration::max);
    report.penetration_ticks += u32::from(penetration.particles > MAX_DEPTH);
    report.depth.update(penetration.particles, tick);
    report.triangle_depth.update(penetration.triangles, tick);
    report.mesh_pairs.update(penetration.pairs as f64, tick);
    let strain = play.rest.strain(&play.cloth);
    report.strain.update(strain.greatest, tick);
    report.told += u32::from(strain.is_broken && strain.is_told);
    report.untold += u32::from(strain.is_broken && !strain.is_told);
}

fn is_finite(play: &Play) -> bool {
    let cloth = &play.cloth;
    let finite = |i: u32| {
        cloth.position(i).is_some_and(|x| x.is_finite())
            && cloth.velocity(i).is_some_and(|v| v.is_finite())
    };
    (0..cloth.particle_count()).all(finite)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::play::{Drive, Setup};
    use crate::shapes::{floor, upright_sheet, with_bound, with_surface};
    use muslin::glam::{Quat, Vec3};

    /// What fails in a scene of a small sheet over a floor in which `plant` spoils something.
    fn failures(is_free: bool, plant: fn() -> Drive) -> Vec<String> {
        let scene = Scene::new("planted", 3, move || {
            let mut desc = with_bound(with_surface(upright_sheet(6, 0.25)), 0.05);
            desc.settings.damping = if is_free { 0.5 } else { 0.0 };
            let mut play = Play::grid(&desc)?;
            play.add(floor(-1.0))?;
            Ok(Setup { drive: plant(), is_free, ..Setup::from(play) })
        });
        run(&scene, 3).unwrap().failures()
    }

    #[test]
    fn a_scene_without_a_mistake_passes() {
        assert!(failures(false, || Box::new(|_, _| Ok(()))).is_empty());
    }

    #[test]
    fn rows_that_are_placed_through_the_sheet_are_found_as_crossings() {
        let plant: fn() -> Drive = || {
            Box::new(|play, tick| match tick {
                // The first two rows are placed on both sides of a cell between the next two. All are
                // held, so the solver cannot separate them.
                1 => (0..12).try_for_each(|i| {
                    let x = play.cloth.position(i).unwrap_or_default().x;
                    let target = Vec3::new(x + 0.017, 0.003, if i < 6 { 0.03 } else { -0.03 });
                    play.cloth.set_position(i, target)?;
                    play.cloth.pin(i, Some(target))?;
                    play.cloth.pin(12 + i, None)
                }),
                _ => Ok(()),
            })
        };
        assert!(failures(false, plant).contains(&"crossings".to_string()));
    }

    #[test]
    fn a_floor_that_jumps_above_the_sheet_is_found_as_penetrations() {
        let plant: fn() -> Drive = || {
            Box::new(|play, tick| match tick {
                1 => {
                    let body = &mut play.bodies[0];
                    body.desc.position = Vec3::ZERO;
                    play.cloth.teleport_collider(body.collider, Vec3::ZERO, Quat::IDENTITY)
                }
                _ => Ok(()),
            })
        };
        assert_eq!(failures(false, plant), ["penetrations", "triangles"]);
    }

    #[test]
    fn damping_is_found_as_a_change_of_momentum_without_a_cause() {
        let plant: fn() -> Drive =
            || Box::new(|play, _| play.set_velocities(|_| Vec3::new(1.0, 0.0, 0.0)));
        let found = failures(true, plant);
        assert!(found.contains(&"momentum of the scene".to_string()), "{found:?}");
    }
}
