//! A disc of triangles that are nearly equal-sided and know no direction: rings that are as far apart as the
//! particles in them, each turned against the one inside.

use glam::{Vec2, Vec3};
use std::f32::consts::{SQRT_2, TAU};

/// A disc as a mesh: flat in x and z around the origin, its front up.
#[derive(Clone, Debug, PartialEq)]
pub struct Disc {
    /// Where its vertices are [m], from the middle outwards.
    pub positions: Vec<Vec3>,
    /// Three vertices a triangle.
    pub indices: Vec<u32>,
    /// Where in the weave, 0 to 1 along x and along z.
    pub uvs: Vec<Vec2>,
    /// Vertices of the rim, which are the last ones.
    pub rim: u32,
}

impl Disc {
    /// Rings around the middle for about so many particles across.
    pub fn rings(particles_across: u32) -> u32 {
        // An equal-sided triangle is lower than its side is long.
        ((particles_across.max(3) - 1) as f32 / 3.0_f32.sqrt()).round() as u32
    }

    /// A disc of this radius [m] with so many rings around its middle, 1 at least, turned by an angle [rad].
    pub fn new(radius: f32, rings: u32, turn: f32) -> Self {
        let rings = rings.max(1);
        let mut disc =
            Self { positions: vec![Vec3::ZERO], indices: Vec::new(), uvs: Vec::new(), rim: 0 };
        let mut inner = Ring { first: 0, count: 1, turn };
        for ring in 1..=rings {
            let count = (TAU * ring as f32 * (0.75_f32).sqrt()).round() as u32;
            // √2 of a cell further on: no line leads straight from the middle to the rim.
            let turn = inner.turn + SQRT_2 * TAU / count as f32;
            let outer = Ring { first: disc.positions.len() as u32, count, turn };
            let away = radius * ring as f32 / rings as f32;
            disc.positions.extend((0..count).map(|i| {
                let (z, x) = outer.angle(i).sin_cos();
                Vec3::new(x, 0.0, z) * away
            }));
            inner.join(&outer, &mut disc.indices);
            inner = outer;
        }
        disc.rim = inner.count;
        let uv = |x: &Vec3| Vec2::new(0.5 + 0.5 * x.x / radius, 0.5 - 0.5 * x.z / radius);
        disc.uvs = disc.positions.iter().map(uv).collect();
        disc
    }
}

/// Vertices around the middle.
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

    /// Triangles between this ring and the next: each time the ring goes on whose next vertex comes first.
    fn join(&self, outer: &Self, indices: &mut Vec<u32>) {
        let inside = if self.count == 1 { 0 } else { self.count };
        // The outer vertex that comes next after the first one inside.
        let cell = TAU / outer.count as f32;
        let start = ((self.turn - outer.turn) / cell).ceil() as i32;
        let start = start.rem_euclid(outer.count as i32) as u32;
        let begin = outer.angle(start);
        let lag = (begin - self.turn).rem_euclid(TAU);
        let (mut i, mut o) = (0, 0);
        while i < inside || o < outer.count {
            let ahead = |share: f32, count: u32| TAU * share / count as f32;
            let next_inside = ahead(i as f32 + 0.5, self.count);
            let next_outside = lag + ahead(o as f32 + 0.5, outer.count);
            let at = [self.vertex(i), outer.vertex(start + o)];
            if o == outer.count || i < inside && next_inside < next_outside {
                indices.extend([at[0], self.vertex(i + 1), at[1]]);
                i += 1;
            } else {
                indices.extend([at[0], outer.vertex(start + o + 1), at[1]]);
                o += 1;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_disc_is_whole_faces_up_and_its_triangles_are_nearly_equal_sided() {
        for across in [3, 5, 12, 24, 40, 56, 128] {
            let disc = Disc::new(0.15, Disc::rings(across), 0.3);
            let (mut area, mut least, mut longest) = (0.0, f32::MAX, 0.0_f32);
            let mut open = std::collections::HashSet::new();
            for t in disc.indices.chunks_exact(3) {
                let [a, b, c] = [t[0], t[1], t[2]].map(|i| disc.positions[i as usize]);
                let normal = (b - a).cross(c - a);
                assert!(normal.y > 0.0, "{across} across: a triangle faces down");
                area += 0.5 * normal.y;
                for [a, b, c] in [[a, b, c], [b, c, a], [c, a, b]] {
                    least = least.min((b - a).angle_between(c - a).to_degrees());
                    longest = longest.max((b - a).length());
                }
                for [a, b] in [[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]] {
                    assert!(open.insert([a, b]), "{across} across: an edge is doubled");
                }
            }
            let border = open.iter().filter(|[a, b]| !open.contains(&[*b, *a])).count();
            assert_eq!(border as u32, disc.rim, "{across} across: there is a hole");
            let corners = disc.rim as f32;
            let whole = 0.5 * corners * 0.15 * 0.15 * (TAU / corners).sin();
            assert!((area / whole - 1.0).abs() < 1.0e-4, "{across} across: {area} m² of {whole}");
            assert!(least > 32.0, "{across} across: an angle of {least}°");
            let even = 0.3 / (across - 1) as f32;
            assert!(longest < 1.6 * even, "{across} across: an edge of {longest} m");
        }
    }
}
