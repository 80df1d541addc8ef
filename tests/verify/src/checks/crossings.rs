//! Pairs of triangles that cross, by exact predicates.
//!
//! Two triangles cross if an edge of one passes through the inside of the other. Touching is no
//! crossing. Triangles that share one particle are tested too; those that share an edge cannot
//! cross.

use super::bvh::Bvh;
use super::exact::orientation;
use muslin::glam::DVec3;

/// Number of pairs of triangles of the cloth that cross. `corners` are the particles of each
/// triangle of the tree.
pub fn count_self_crossings(tree: &Bvh, corners: &[[u32; 3]]) -> usize {
    let mut count = 0;
    tree.visit_self_pairs(&mut |a, b| {
        let shared = corners[a].iter().filter(|v| corners[b].contains(v)).count();
        if shared < 2 && do_cross(tree.triangle(a), tree.triangle(b)) {
            count += 1;
        }
    });
    count
}

/// Number of pairs of a triangle of the cloth and a triangle of a body that cross.
pub fn count_crossings(tree: &Bvh, body: &Bvh) -> usize {
    let mut count = 0;
    tree.visit_pairs(body, &mut |a, b| {
        count += usize::from(do_cross(tree.triangle(a), body.triangle(b)));
    });
    count
}

/// Whether two triangles cross.
fn do_cross(one: [DVec3; 3], other: [DVec3; 3]) -> bool {
    let sides = |of: [DVec3; 3], plane: [DVec3; 3]| {
        of.map(|p| orientation([plane[0], plane[1], plane[2], p]))
    };
    let are_both = |sides: [i8; 3]| sides.contains(&1) && sides.contains(&-1);
    let of_one = sides(one, other);
    if !are_both(of_one) {
        return false;
    }
    let of_other = sides(other, one);
    are_both(of_other) && (edge_pierces(one, of_one, other) || edge_pierces(other, of_other, one))
}

/// Whether an edge of `one`, whose corners are on these sides of the plane of `other`, passes
/// through the inside of `other`.
fn edge_pierces(one: [DVec3; 3], sides: [i8; 3], other: [DVec3; 3]) -> bool {
    [(0, 1), (1, 2), (2, 0)].into_iter().any(|(i, j)| {
        if sides[i] * sides[j] != -1 {
            return false;
        }
        let around = [(0, 1), (1, 2), (2, 0)]
            .map(|(k, l)| orientation([one[i], one[j], other[k], other[l]]));
        around == [1; 3] || around == [-1; 3]
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const FLAT: [DVec3; 3] = [DVec3::ZERO, DVec3::X, DVec3::Y];

    #[test]
    fn a_triangle_through_another_crosses_it_and_one_that_touches_does_not() {
        let upright = |z: f64| {
            [
                DVec3::new(0.25, 0.25, z),
                DVec3::new(0.25, 0.25, z + 1.0),
                DVec3::new(0.25, 2.0, z + 1.0),
            ]
        };
        assert!(do_cross(upright(-0.5), FLAT) && do_cross(FLAT, upright(-0.5)));
        assert!(!do_cross(upright(0.0), FLAT));
        assert!(do_cross(upright(-1.0e-12), FLAT));
        assert!(!do_cross(upright(0.5), FLAT));
    }

    #[test]
    fn triangles_that_share_a_particle_cross_where_the_opposite_edge_passes_through() {
        let through = |x: f64| [DVec3::ZERO, DVec3::new(x, x, -1.0), DVec3::new(x, x, 1.0)];
        assert!(do_cross(through(0.25), FLAT));
        assert!(!do_cross(through(-0.25), FLAT));
    }

    #[test]
    fn each_crossing_of_two_rows_of_triangles_is_counted_once() {
        let mut triangles = Vec::new();
        for i in 0..20 {
            let at = DVec3::X * 2.0 * f64::from(i);
            triangles.push(FLAT.map(|p| p + at));
            triangles.push([
                at + DVec3::new(0.25, 0.25, -0.5),
                at + DVec3::new(0.25, 0.25, 0.5),
                at + DVec3::new(0.25, 2.0, 0.5),
            ]);
        }
        let corners: Vec<_> = (0..40).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
        assert_eq!(count_self_crossings(&Bvh::new(triangles), &corners), 20);
    }
}
