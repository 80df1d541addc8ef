//! Tips: where a slit in the cloth ends, and threads carry most of what the slit does not.
//!
//! The strain ahead of a slit of length a rises to about √(a / h) times that around it, where h is how
//! finely the mesh can follow it. Threads that tear at a strain of their own would so let the cloth tear
//! the earlier the finer its mesh is. What does not depend on the mesh is the energy that a slit frees as
//! it grows (Griffith 1921): with it threads at a tip tear at √(z / h) times the strain that others
//! do, where z is the length over which strain spreads at the tip of a real one.
//!
//! What the solver has not got to of a load looks like strain too, and at a tip it is greatest. Threads
//! there tear at no less than that, so that a slit cloth does not come apart under its own weight.

use crate::mesh::{Fan, Mesh, NONE, next_corner, prev_corner};
use crate::model::material::Material;
use glam::Vec3;

/// Over how many thicknesses of the cloth strain spreads at a tip.
const PROCESS_ZONE: f32 = 16.0;

/// Threads at a tip tear at this share of the strain at least, however coarse the mesh is.
const MIN_STRAIN_RATIO: f32 = 0.2;

/// From so much cloth around it on [rad], a vertex at a border is a tip: five sixths of a circle, well past
/// any corner.
const MIN_TIP_ANGLE: f32 = 5.235_988;

/// The strain at which threads at a tip tear, where the solver may leave them with so much.
pub(crate) fn tear_strain(material: &Material, spacing: f32, solver_residual: f32) -> f32 {
    let others = material.tear_stretch - 1.0;
    let at_tip = others * tip_strain_ratio(material, spacing);
    let at_least = if solver_residual < others { solver_residual } else { others };
    if at_tip < at_least { at_least } else { at_tip }
}

/// At what share of the strain that others do threads at a tip tear.
fn tip_strain_ratio(material: &Material, spacing: f32) -> f32 {
    let share = (PROCESS_ZONE * material.thickness / spacing).sqrt();
    let share = if share > MIN_STRAIN_RATIO { share } else { MIN_STRAIN_RATIO };
    if share < 1.0 { share } else { 1.0 }
}

/// Whether a vertex is a tip. `rest` is the rest position of each site, `fan` room to work in.
pub(crate) fn is_crack_tip(mesh: &Mesh, rest: &[Vec3], vertex: u32, fan: &mut Fan) -> bool {
    let corner = mesh.corner_of[vertex as usize];
    if corner == NONE {
        return false;
    }
    mesh.gather_fan(corner, fan);
    let at = |corner: u32| rest[mesh.source[mesh.vertex(corner) as usize] as usize];
    let angle = |corner: &u32| {
        let (p, q) =
            (at(next_corner(*corner)) - at(*corner), at(prev_corner(*corner)) - at(*corner));
        angle_between(p, q)
    };
    !fan.is_closed && fan.corners.iter().map(angle).sum::<f32>() > MIN_TIP_ANGLE
}

/// The angle between two ways [rad], to a hundredth.
fn angle_between(p: Vec3, q: Vec3) -> f32 {
    // The tangent of half of it.
    let (sine, cosine) = (p.cross(q).length(), p.dot(q));
    let half = sine / (cosine + (sine * sine + cosine * cosine).sqrt());
    let arctangent = |t: f32| t / (1.0 + 0.281_25 * t * t);
    let angle = if half <= 1.0 {
        arctangent(half)
    } else {
        core::f32::consts::FRAC_PI_2 - arctangent(1.0 / half)
    };
    2.0 * angle
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_are_right_to_a_hundredth() {
        for degrees in [1.0_f32, 30.0, 45.0, 60.0, 90.0, 120.0, 150.0, 179.0] {
            let (sine, cosine) = degrees.to_radians().sin_cos();
            let found = angle_between(Vec3::X * 2.0, Vec3::new(cosine, 0.0, sine) * 0.3);
            assert!((found - degrees.to_radians()).abs() < 0.011, "{degrees}°: {found}");
        }
    }

    #[test]
    fn the_end_of_a_slit_is_a_tip_and_corners_are_not() {
        let frame = crate::mesh::grid::GridFrame {
            origin: Vec3::ZERO,
            right: Vec3::X,
            down: Vec3::NEG_Y,
            spacing: 1.0,
        };
        let rest = crate::mesh::grid::positions(4, 4, &frame);
        let mut mesh = Mesh::new(crate::mesh::grid::triangles(4, 4), 16, 20);
        // A slit from the left border to vertex 6.
        let edge = |mesh: &Mesh, a: u32, b: u32| {
            mesh.edges().find(|edge| mesh.ends(*edge) == (a, b)).unwrap()
        };
        let slit = [edge(&mesh, 4, 5), edge(&mesh, 5, 6)];
        mesh.open_edges(&slit, &mut Vec::new(), &mut Vec::new());
        let mut fan = Fan::default();
        let tips =
            (0..mesh.vertex_count() as u32).filter(|v| is_crack_tip(&mesh, &rest, *v, &mut fan));
        assert_eq!(tips.collect::<Vec<_>>(), [6]);
    }
}
