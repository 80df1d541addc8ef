//! Rigid motion: the translation and rotation about the centre of mass that fits given
//! displacements.
//!
//! ```text
//! c = Σ m x / Σ m      t = Σ m d / Σ m      ω = I⁻¹ Σ m (x − c) × (d − t)
//! displacement of a rigid body at x:   t + ω × (x − c)
//! ```
//! Method: the rigid displacement with the same linear and angular momentum, as in the global
//! damping of Müller et al., "Position based dynamics", 2007, sec. 3.5.
//!
//! Reads positions, displacements and masses; writes nothing.
//! Invariant: the bits do not depend on the SIMD level.

use crate::math::columns::Columns;
use crate::math::simd::{Level, Simd};
use crate::math::trig::{cos, sin};
use crate::solver::integrate::momentum_sums::{
    FreeParticles, LinearSums, PointSums, Points, spin_and_inertia,
};
use glam::{DVec3, Mat3, Vec3};

/// A rigid displacement: translation [m] and small rotation vector [rad] about `center` [m].
#[derive(Clone, Copy, Debug)]
pub(crate) struct RigidMotion {
    center: Vec3,
    translation: Vec3,
    rotation: Vec3,
}

impl RigidMotion {
    /// Fits the rigid motion with the linear and angular momentum of the displacements of some
    /// particles at `x`.
    pub fn fit<I: Iterator<Item = usize>>(
        particles: impl Fn() -> I,
        x: &Columns,
        displacement: impl Fn(usize) -> Vec3,
        mass: &[f32],
    ) -> Self {
        Self::of_points(&|add| {
            particles().for_each(|i| add(x.get(i), displacement(i), mass[i]));
        })
    }

    /// As `fit`, for points.
    pub fn of_points(points: Points<'_>) -> Self {
        let fitted = PointSums::of(points).translation();
        let (spin, inertia) = fitted.spin_and_inertia_of_points(points);
        Self { rotation: solve(&inertia, spin), ..fitted }
    }

    /// As `about`, for points.
    pub fn of_points_about(points: Points<'_>, pivot: Pivot) -> Self {
        let fitted = match pivot {
            Pivot::Nothing => PointSums::of(points).translation(),
            Pivot::Point(center) | Pivot::Axis(center, _) => {
                Self { center, translation: Vec3::ZERO, rotation: Vec3::ZERO }
            }
        };
        let (spin, inertia) = fitted.spin_and_inertia_of_points(points);
        Self { rotation: pivot.rotation(inertia, spin), ..fitted }
    }

    /// The rigid motion that gives the particles of a list at `x`, whose sums are `now`, the linear
    /// and angular momentum of the sums `before`.
    pub fn between(
        before: &PointSums,
        now: &PointSums,
        (list, x, mass): (&[u32], &Columns, &[f32]),
    ) -> Self {
        let momentum = before.momentum - now.momentum;
        let fitted = PointSums { momentum, ..*now }.translation();
        let mut inertia = Mat3::ZERO;
        for i in list.iter().map(|i| *i as usize) {
            add_inertia(&mut inertia, x.get(i) - fitted.center, mass[i]);
        }
        let spin = before.spin - now.spin - now.mean_position().cross(momentum);
        Self { rotation: Pivot::Nothing.rotation(inertia, spin.as_vec3()), ..fitted }
    }

    /// The angular momentum of displacements less the translation, and the moment of inertia, both
    /// about the centre.
    fn spin_and_inertia_of_points(&self, points: Points<'_>) -> (Vec3, Mat3) {
        let (mut spin, mut inertia) = (DVec3::ZERO, Mat3::ZERO);
        points(&mut |x, displacement, mass| {
            let r = x - self.center;
            spin += (r.cross(displacement - self.translation) * mass).as_dvec3();
            add_inertia(&mut inertia, r, mass);
        });
        (spin.as_vec3(), inertia)
    }

    /// The centre of mass and the translation, from sums over particles: of masses, of positions
    /// and of displacements times mass.
    fn translation_from_sums(total: f32, center: Vec3, momentum: Vec3) -> Self {
        if total <= 0.0 {
            return Self { center, translation: Vec3::ZERO, rotation: Vec3::ZERO };
        }
        let (center, translation) = (center * (1.0 / total), momentum * (1.0 / total));
        Self { center, translation, rotation: Vec3::ZERO }
    }

    /// The centre of mass of all free particles, and the translation with their momentum, in SIMD
    /// lanes.
    pub fn translation_of_free(level: Level, free: FreeParticles<'_>) -> Self {
        let LinearSums { mass, center, momentum } = LinearSums::of(level, free);
        Self::translation_from_sums(mass, center, momentum)
    }

    /// As `fit`, for all free particles, in SIMD lanes.
    pub fn of_free(level: Level, free: FreeParticles<'_>) -> Self {
        let Self { center, translation, .. } = Self::translation_of_free(level, free);
        let (spin, inertia) = spin_and_inertia(level, free, [center, translation]);
        Self { center, translation, rotation: solve(&inertia, spin) }
    }

    /// The rigid motion that `pivot` lets a body make, with the momenta of the displacements of all
    /// free particles, in SIMD lanes. Rotation about axes with little inertia is damped.
    pub fn about(level: Level, free: FreeParticles<'_>, pivot: Pivot) -> Self {
        let (center, translation) = match pivot {
            Pivot::Nothing => {
                let Self { center, translation, .. } = Self::translation_of_free(level, free);
                (center, translation)
            }
            Pivot::Point(point) | Pivot::Axis(point, _) => (point, Vec3::ZERO),
        };
        let (spin, inertia) = spin_and_inertia(level, free, [center, translation]);
        Self { center, translation, rotation: pivot.rotation(inertia, spin) }
    }

    /// The motion of a body about its `center` with this translation, angular momentum and moment of
    /// inertia.
    pub fn with_momentum(center: Vec3, translation: Vec3, spin: Vec3, inertia: Mat3) -> Self {
        Self { center, translation, rotation: Pivot::Nothing.rotation(inertia, spin) }
    }

    /// The translation [m].
    pub fn translation(&self) -> Vec3 {
        self.translation
    }

    /// The same rotation with another translation [m].
    pub fn with_translation(self, translation: Vec3) -> Self {
        Self { translation, ..self }
    }

    /// As `displacement_at`, for points in SIMD lanes.
    #[inline(always)]
    pub fn displacement_lanes<S: Simd>(&self, s: S, [x, y, z]: [S::F; 3]) -> [S::F; 3] {
        let Self { center, translation, rotation } = self;
        let (x, y, z) = (x - s.splat(center.x), y - s.splat(center.y), z - s.splat(center.z));
        let (tx, ty, tz) = (s.splat(rotation.x), s.splat(rotation.y), s.splat(rotation.z));
        [
            s.splat(translation.x) + (ty * z - tz * y),
            s.splat(translation.y) + (tz * x - tx * z),
            s.splat(translation.z) + (tx * y - ty * x),
        ]
    }

    /// What [`Self::displacement_at`] computes one component from, for points in columns.
    pub fn component<'a>(&self, axis: usize, at: [&'a [f32]; 3]) -> Component<'a> {
        let (a, b) = ((axis + 1) % 3, (axis + 2) % 3);
        Component {
            translation: self.translation[axis],
            rotation: [self.rotation[a], self.rotation[b]],
            center: [self.center[a], self.center[b]],
            at: [at[a], at[b]],
        }
    }

    /// Displacement of a point with the body [m], linear in the rotation.
    pub fn displacement_at(&self, point: Vec3) -> Vec3 {
        self.translation + self.rotation.cross(point - self.center)
    }

    /// Position of a point after the motion [m], with the exact rotation, so distances stay.
    pub fn transform(&self, point: Vec3) -> Vec3 {
        let (r, angle) = (point - self.center, self.rotation.length());
        let mut turned = r;
        if angle > 0.0 {
            let axis = self.rotation * (1.0 / angle);
            let (sin, cos) = (sin(f64::from(angle)), cos(f64::from(angle)));
            turned = r * cos + axis.cross(r) * sin + axis * (axis.dot(r) * (1.0 - cos));
        }
        self.center + self.translation + turned
    }
}

impl PointSums {
    /// The centre of mass of the points, and the translation with their momentum.
    fn translation(&self) -> RigidMotion {
        RigidMotion::translation_from_sums(
            self.mass as f32,
            self.center.as_vec3(),
            self.momentum.as_vec3(),
        )
    }
}

/// One component of a rigid motion: `translation + rotation[0] · (at[1] − center[1]) −
/// rotation[1] · (at[0] − center[0])`, where 0 and 1 are the next axes in cyclic order.
#[derive(Clone, Copy)]
pub(crate) struct Component<'a> {
    translation: f32,
    rotation: [f32; 2],
    center: [f32; 2],
    pub at: [&'a [f32]; 2],
}

impl Component<'_> {
    /// The displacement of a point with these coordinates [m].
    #[inline(always)]
    pub fn displacement(&self, a: f32, b: f32) -> f32 {
        let turned =
            self.rotation[0] * (b - self.center[1]) - (a - self.center[0]) * self.rotation[1];
        self.translation + turned
    }
}

/// What holds a body: it leaves free the rotation about itself.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Pivot {
    /// The body translates and rotates freely.
    Nothing,
    /// A fixed point [m].
    Point(Vec3),
    /// A line through a fixed point [m] with this direction.
    Axis(Vec3, Vec3),
}

/// Share of the mean moment of inertia that is added about every axis. A strip that is folded to a
/// line has nearly no inertia about it; a small error would turn it by a large angle.
const INERTIA_SHARE: f32 = 1.0e-4;

impl Pivot {
    /// The rotation [rad] of a body with this moment of inertia and angular momentum, both about
    /// the pivot.
    fn rotation(self, mut inertia: Mat3, spin: Vec3) -> Vec3 {
        let added = INERTIA_SHARE * (inertia.x_axis.x + inertia.y_axis.y + inertia.z_axis.z);
        inertia.x_axis.x += added;
        inertia.y_axis.y += added;
        inertia.z_axis.z += added;
        let Self::Axis(_, direction) = self else {
            return solve(&inertia, spin);
        };
        let length = direction.length();
        let axis = if length > 0.0 { direction * (1.0 / length) } else { Vec3::ZERO };
        let moment = axis.dot(inertia * axis);
        if moment > 0.0 { axis * (axis.dot(spin) / moment) } else { Vec3::ZERO }
    }
}

/// Adds the moment of inertia of a point of `mass` [kg] at `r` [m] from the centre.
#[inline(never)]
fn add_inertia(inertia: &mut Mat3, r: Vec3, mass: f32) {
    let r2 = r.length_squared();
    let products = [r * r.x, r * r.y, r * r.z];
    let axes = [Vec3::X, Vec3::Y, Vec3::Z];
    let column = |axis: usize| (axes[axis] * r2 - products[axis]) * mass;
    inertia.x_axis += column(0);
    inertia.y_axis += column(1);
    inertia.z_axis += column(2);
}

/// Solves m y = v by Cramer's rule; zero if the matrix is close to singular.
fn solve(m: &Mat3, v: Vec3) -> Vec3 {
    let det = m.x_axis.dot(m.y_axis.cross(m.z_axis));
    let size = m.x_axis.x + m.y_axis.y + m.z_axis.z;
    if det <= 1.0e-6 * size * size * size {
        return Vec3::ZERO;
    }
    Vec3::new(
        v.dot(m.y_axis.cross(m.z_axis)),
        m.x_axis.dot(v.cross(m.z_axis)),
        m.x_axis.dot(m.y_axis.cross(v)),
    ) * (1.0 / det)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fit_of_free_particles_equals_fit_of_points_at_every_simd_level() {
        let mut number = 0.7_f32;
        let mut next = || {
            number = (number * 1.37 + 0.61) % 3.0;
            number - 1.5
        };
        let count = 67;
        let (mut x, mut displacement) = (Columns::default(), Columns::default());
        for _ in 0..count {
            x.push(Vec3::new(next(), next(), next()));
            displacement.push(Vec3::new(next(), next(), next()));
        }
        let mass: Vec<f32> = (0..count).map(|_| 2.0 + next()).collect();
        let w: Vec<f32> =
            (0..count).map(|i| if i % 9 == 4 { 0.0 } else { 1.0 / mass[i] }).collect();
        let free = || (0..count).filter(|i| w[*i] > 0.0);
        let one = RigidMotion::fit(free, &x, |i| displacement.get(i), &mass);
        let free = FreeParticles {
            x: x.slices(),
            displacement: displacement.slices(),
            mass: &mass,
            w: &w,
        };
        let bits = |v: Vec3| v.to_array().map(f32::to_bits);
        let all: Vec<_> =
            Level::available().into_iter().map(|level| RigidMotion::of_free(level, free)).collect();
        for other in &all {
            for point in [Vec3::ZERO, Vec3::new(1.0, -2.0, 0.5)] {
                assert!(
                    (one.displacement_at(point) - other.displacement_at(point)).length() < 1.0e-4
                );
                assert_eq!(bits(other.displacement_at(point)), bits(all[0].displacement_at(point)));
            }
        }
    }

    #[test]
    fn a_large_rotation_keeps_distances() {
        let mut x = Columns::default();
        let corners = [Vec3::ZERO, Vec3::X, Vec3::new(0.3, 2.0, 0.0), Vec3::new(0.1, 0.4, 1.0)];
        corners.iter().for_each(|corner| x.push(*corner));
        let rotation = |r: Vec3, share: f32| Vec3::new(0.4, -0.3, 0.8).cross(r) * share + Vec3::X;
        let fit = |share: f32| {
            RigidMotion::fit(|| 0..4, &x, |i| rotation(corners[i], share), &[1.0, 2.0, 0.5, 1.0])
        };
        let (far, near) = (fit(1.0), fit(0.01));
        let moved = corners.map(|corner| far.transform(corner));
        for i in 0..4 {
            assert!(
                (far.displacement_at(corners[i]) - rotation(corners[i], 1.0)).length() < 1.0e-5
            );
            let edge = |at: &[Vec3; 4]| at[i].distance(at[(i + 1) % 4]);
            assert!((edge(&moved) - edge(&corners)).abs() < 1.0e-6);
            let little = corners[i] + rotation(corners[i], 0.01);
            assert!(
                near.transform(corners[i]).distance(little) < 1.0e-4,
                "a small rotation is linear"
            );
        }
    }
}
