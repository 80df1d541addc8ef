//! Stage `Outputs`: what a renderer reads, from what the solver keeps.

use super::World;
use crate::fabric::weave::LinkKind;
use glam::Vec3;

/// Positions, three numbers a vertex.
pub(crate) fn positions(world: &World, out: &mut Vec<Vec3>) {
    out.clear();
    out.extend(world.particles.x.iter());
}

/// Vertex normals: the mean of the triangles around, weighted by area. Zero where there is none.
pub(crate) fn normals(world: &World, out: &mut Vec<Vec3>) {
    out.clear();
    out.resize(world.particles.len(), Vec3::ZERO);
    let x = &world.particles.x;
    for triangle in &world.mesh.triangles {
        let [a, b, c] = triangle.map(|v| v as usize);
        let (xa, xb, xc) = (x.at(a), x.at(b), x.at(c));
        let doubled = (xb - xa).cross(xc - xa);
        out[a] += doubled;
        out[b] += doubled;
        out[c] += doubled;
    }
    for normal in out {
        let length = normal.length();
        *normal = if length > 0.0 { *normal * (1.0 / length) } else { Vec3::ZERO };
    }
}

/// The greatest and the mean stretch of the stretch links: 0.01 is 1 % longer than at rest.
pub(crate) fn stretch(world: &World) -> (f32, f32) {
    let x = &world.particles.x;
    let (mut most, mut sum, mut count) = (0.0_f32, 0.0_f64, 0_u32);
    for links in [&world.weave.links, &world.weave.extra] {
        for link in 0..links.len() {
            if links.active[link] && links.kind(link) == LinkKind::Stretch {
                let span = x.at(links.b[link] as usize) - x.at(links.a[link] as usize);
                let stretch = span.length() / links.rest[link] - 1.0;
                most = if stretch > most { stretch } else { most };
                sum += f64::from(stretch);
                count += 1;
            }
        }
    }
    (most, if count == 0 { 0.0 } else { (sum / f64::from(count)) as f32 })
}

/// Energy of motion [J].
pub(crate) fn kinetic_energy(world: &World) -> f32 {
    let p = &world.particles;
    let of = |i: usize| 0.5 * f64::from(p.mass[i]) * f64::from(p.v.at(i).length_squared());
    (0..p.len()).map(of).sum::<f64>() as f32
}
