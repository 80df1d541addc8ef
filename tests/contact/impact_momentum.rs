//! A free sheet that a fast ball hits: its momentum changes by what gravity and the reported impulses
//! explain, in every tick.

use crate::shapes::{sphere, upright_sheet, with_bound, with_surface, without_losses};
use muslin::Cloth;
use muslin::glam::{DVec3, Quat, Vec3};

/// Largest unexplained change of the mean velocity in a tick [m/s].
const MOST_LINEAR: f64 = 1.0e-3;

/// Largest unexplained change of the angular velocity in a tick [rad/s], at rest and per m/s of the
/// ball.
const MOST_ANGULAR: [f64; 2] = [1.0e-2, 2.0e-3];

/// Mass, centre of mass, momentum, and angular momentum about the origin.
fn momentum(cloth: &Cloth) -> (f64, DVec3, DVec3, DVec3) {
    let mut sums = (0.0, DVec3::ZERO, DVec3::ZERO, DVec3::ZERO);
    for i in 0..cloth.particle_count() {
        let m = f64::from(cloth.mass(i).unwrap());
        let (x, v) = (cloth.position(i).unwrap().as_dvec3(), cloth.velocity(i).unwrap().as_dvec3());
        sums = (sums.0 + m, sums.1 + x * m, sums.2 + v * m, sums.3 + x.cross(v) * m);
    }
    (sums.0, sums.1 / sums.0, sums.2, sums.3)
}

/// Polar moment of inertia about the centre of mass.
fn polar_inertia(cloth: &Cloth, center: DVec3) -> f64 {
    (0..cloth.particle_count())
        .map(|i| {
            let r = cloth.position(i).unwrap().as_dvec3() - center;
            f64::from(cloth.mass(i).unwrap()) * r.length_squared()
        })
        .sum()
}

#[test]
fn a_free_sheet_takes_up_just_the_impulses_of_a_fast_ball() {
    for (speed, is_bounded, is_surface) in
        [(3.0, false, false), (5.0, true, false), (15.0, false, false), (50.0, false, false)]
    {
        let mut desc = without_losses(upright_sheet(20, 1.0));
        if is_bounded {
            desc = with_bound(desc, 0.05);
        }
        if is_surface {
            desc = with_surface(desc);
        }
        let mut cloth = Cloth::grid(&desc).unwrap();
        let center = momentum(&cloth).1;
        // Off the centre, so that the sheet turns too.
        let mut at = center.as_vec3() + Vec3::new(0.2, 0.1, -0.35);
        let ball = cloth.add_collider(&sphere(0.2, at)).unwrap();
        let (mut pushes, mut turn) = (0.0, 0.0_f64);
        for tick in 0..12 {
            at.z += speed / 60.0;
            cloth.move_collider(ball, at, Quat::IDENTITY).unwrap();
            let (mass, c0, p0, l0) = momentum(&cloth);
            cloth.step(1);
            let (_, c1, p1, l1) = momentum(&cloth);
            let weight = cloth.settings().gravity.as_dvec3() * (mass / 60.0);
            let impulse = cloth.collider_impulse(ball).unwrap();
            let (j, n) = (impulse.linear.as_dvec3(), impulse.angular.as_dvec3());
            let linear = p1 - p0 - weight + j;
            let angular = l1 - l0 - ((c0 + c1) * 0.5).cross(weight) + n + at.as_dvec3().cross(j);
            let spin = (angular - c1.cross(linear)) / polar_inertia(&cloth, c1);
            let errors = [linear.length() / mass, spin.length()];
            assert!(
                errors[0] < MOST_LINEAR
                    && errors[1] < MOST_ANGULAR[0] + MOST_ANGULAR[1] * f64::from(speed),
                "tick {tick} at {speed} m/s, bound {is_bounded}, surface {is_surface}: {errors:?}"
            );
            pushes += j.length() / mass;
            turn = turn.max((l1 - c1.cross(p1)).length() / polar_inertia(&cloth, c1));
        }
        assert!(pushes > 0.5 * f64::from(speed), "the ball gives {pushes} m/s");
        assert!(turn > 0.5, "the sheet turns by {turn} rad/s");
    }
}
