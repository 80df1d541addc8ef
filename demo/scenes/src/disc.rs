//! Triangle mesh of a disc: concentric rings of vertices, as far apart as the vertices within a
//! ring, each rotated against the one inside. The triangles are nearly equilateral and have no
//! preferred direction, so that a drape test shows the fabric and not the mesh.

use glam::{Vec2, Vec3};
use std::f32::consts::{SQRT_2, TAU};

/// A disc in the plane of x and z around the origin; its front faces up (+y).
#[derive(Clone, Debug, PartialEq)]
pub struct Disc {
    /// Positions of the vertices [m], from the centre outwards. The first one is the centre.
    pub positions: Vec<Vec3>,
    /// Three vertices per triangle.
    pub indices: Vec<u32>,
    /// Texture coordinates, 0 to 1 along x and along z.
    pub uvs: Vec<Vec2>,
    /// Number of vertices on the rim; they are the last ones.
    pub rim: u32,
}

impl Disc {
    /// Returns the number of rings for about this many particles across the disc.
    pub fn rings(particles_across: u32) -> u32 {
        // The height of an equilateral triangle is √3/2 of its side.
        ((particles_across.max(3) - 1) as f32 / 3.0_f32.sqrt()).round() as u32
    }

    /// Creates a disc of this radius [m] with this many rings around its centre (at least 1),
    /// rotated by `turn` [rad].
    pub fn new(radius: f32, rings: u32, turn: f32) -> Self {
        let rings = rings.max(1);
        let mut disc =
            Self { positions: vec![Vec3::ZERO], indices: Vec::new(), uvs: Vec::new(), rim: 0 };
        let mut inner = Ring { first: 0, count: 1, turn };
        for ring in 1..=rings {
            let count = (TAU * ring as f32 * (0.75_f32).sqrt()).round() as u32;
            // Rotated by √2 cells, an irrational number: no straight line of edges leads to the
            // rim.
            let turn = inner.turn + SQRT_2 * TAU / count as f32;
            let outer = Ring { first: disc.positions.len() as u32, count, turn };
            let distance = radius * ring as f32 / rings as f32;
            disc.positions.extend((0..count).map(|i| {
                let (z, x) = outer.angle(i).sin_cos();
                Vec3::new(x, 0.0, z) * distance
            }));
            inner.triangulate(&outer, &mut disc.indices);
            inner = outer;
        }
        disc.rim = inner.count;
        let uv = |x: &Vec3| Vec2::new(0.5 + 0.5 * x.x / radius, 0.5 - 0.5 * x.z / radius);
        disc.uvs = disc.positions.iter().map(uv).collect();
        disc
    }
}

/// Vertices on a circle around the centre.
#[derive(Clone, Copy, Debug)]
struct Ring {
    first: u32,
    count: u32,
    turn: f32,
}

impl Ring {
    fn angle(&self, i: u32) -> f32 {
        self.turn + TAU * i as f32 / self.count as f32
    }

    fn vertex(&self, i: u32) -> u32 {
        self.first + i % self.count
    }

    /// Appends the triangles between this ring and the next one. Both rings are walked around once;
    /// each triangle advances the ring whose next vertex has the smaller angle.
    fn triangulate(&self, outer: &Self, indices: &mut Vec<u32>) {
        let inner_steps = if self.count == 1 { 0 } else { self.count };
        // The first outer vertex at or after the angle of the first inner one.
        let cell = TAU / outer.count as f32;
        let start = ((self.turn - outer.turn) / cell).ceil() as i32;
        let start = start.rem_euclid(outer.count as i32) as u32;
        let begin = outer.angle(start);
        let offset = (begin - self.turn).rem_euclid(TAU);
        let (mut i, mut o) = (0, 0);
        while i < inner_steps || o < outer.count {
            let angle = |share: f32, count: u32| TAU * share / count as f32;
            let next_inner = angle(i as f32 + 0.5, self.count);
            let next_outer = offset + angle(o as f32 + 0.5, outer.count);
            let [a, b] = [self.vertex(i), outer.vertex(start + o)];
            if o == outer.count || i < inner_steps && next_inner < next_outer {
                indices.extend([a, self.vertex(i + 1), b]);
                i += 1;
            } else {
                indices.extend([a, outer.vertex(start + o + 1), b]);
                o += 1;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_disc_has_no_holes_faces_up_and_has_nearly_equilateral_triangles() {
        for across in [3, 5, 12, 24, 40, 56, 128] {
            let disc = Disc::new(0.15, Disc::rings(across), 0.3);
            let (mut area, mut smallest_angle, mut longest_edge) = (0.0, f32::MAX, 0.0_f32);
            let mut edges = std::collections::HashSet::new();
            for t in disc.indices.chunks_exact(3) {
                let [a, b, c] = [t[0], t[1], t[2]].map(|i| disc.positions[i as usize]);
                let normal = (b - a).cross(c - a);
                assert!(normal.y > 0.0, "{across} across: a triangle faces down");
                area += 0.5 * normal.y;
                for [a, b, c] in [[a, b, c], [b, c, a], [c, a, b]] {
                    smallest_angle = smallest_angle.min((b - a).angle_between(c - a).to_degrees());
                    longest_edge = longest_edge.max((b - a).length());
                }
                for [a, b] in [[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]] {
                    assert!(edges.insert([a, b]), "{across} across: an edge is used twice");
                }
            }
            let border = edges.iter().filter(|[a, b]| !edges.contains(&[*b, *a])).count();
            assert_eq!(border as u32, disc.rim, "{across} across: there is a hole");
            let corners = disc.rim as f32;
            let expected = 0.5 * corners * 0.15 * 0.15 * (TAU / corners).sin();
            assert!(
                (area / expected - 1.0).abs() < 1.0e-4,
                "{across} across: the area is {area} m² and not {expected} m²"
            );
            assert!(smallest_angle > 32.0, "{across} across: an angle of {smallest_angle}°");
            let spacing = 0.3 / (across - 1) as f32;
            assert!(longest_edge < 1.6 * spacing, "{across} across: an edge of {longest_edge} m");
        }
    }
}
