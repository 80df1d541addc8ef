//! Crack tips: where a slit in the cloth ends and its load concentrates.
//!
//! The strain ahead of a slit of length a is about √(a / h) times the strain around it, where h is
//! the mesh size. With a fixed strain limit, a cloth with a finer mesh would tear earlier. The
//! energy that a growing slit releases (Griffith 1921) does not depend on the mesh; it follows if
//! edges at a tip tear at √(z / h) times the usual strain, where z is the length of the process
//! zone of a real tear.
//!
//! Unconverged load also appears as strain, most of all at a tip. Edges at tips therefore tear at
//! no less than the residual strain of the solver, so that a slit cloth does not tear under its own
//! weight.
//!
//! Reads mesh and rest positions; returns strains and marks.

use crate::mesh::{Fan, Mesh, NONE, next_corner, prev_corner};
use crate::model::material::Material;
use glam::Vec3;

/// Length of the process zone at a tip, in thicknesses of the cloth.
const PROCESS_ZONE: f32 = 16.0;

/// Minimum ratio of the tear strain at a tip to the usual one, however coarse the mesh is.
const MIN_STRAIN_RATIO: f32 = 0.2;

/// Minimum angle of cloth around a border vertex that is a tip [rad]: 300°, well above that of any
/// corner.
const MIN_TIP_ANGLE: f32 = 5.235_988;

/// The strain at which edges at a tip tear that tear at `usual_strain` elsewhere. `spacing` is the
/// mesh size [m], `solver_residual` the strain that the solver may leave there.
#[inline(never)]
pub(crate) fn tear_strain(
    usual_strain: f32,
    material: &Material,
    spacing: f32,
    solver_residual: f32,
) -> f32 {
    let at_tip = usual_strain * tip_strain_ratio(material, spacing);
    let min_strain = if solver_residual < usual_strain { solver_residual } else { usual_strain };
    if at_tip < min_strain { min_strain } else { at_tip }
}

/// Ratio of the tear strain at a tip to the usual one: √(z / h), clamped to `MIN_STRAIN_RATIO` and
/// 1.
fn tip_strain_ratio(material: &Material, spacing: f32) -> f32 {
    let share = (PROCESS_ZONE * material.thickness / spacing).sqrt();
    let share = if share > MIN_STRAIN_RATIO { share } else { MIN_STRAIN_RATIO };
    if share < 1.0 { share } else { 1.0 }
}

/// Returns whether a vertex is a crack tip. `rest` is the rest position of each site [m], `fan` is
/// scratch.
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

/// The angle between two vectors [rad], accurate to 0.01.
fn angle_between(p: Vec3, q: Vec3) -> f32 {
    // The tangent of half of the angle.
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
    fn angles_are_accurate_to_a_hundredth() {
        for degrees in [1.0_f32, 30.0, 45.0, 60.0, 90.0, 120.0, 150.0, 179.0] {
            let (sine, cosine) = degrees.to_radians().sin_cos();
            let found = angle_between(Vec3::X * 2.0, Vec3::new(cosine, 0.0, sine) * 0.3);
            assert!((found - degrees.to_radians()).abs() < 0.011, "{degrees}°: {found}");
        }
    }

    #[test]
    fn the_end_of_a_slit_is_a_crack_tip_and_corners_are_not() {
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
