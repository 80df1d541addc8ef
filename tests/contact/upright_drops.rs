//! A sheet that falls onto its lower edge and crumples with surface collision stays above the floor.

use crate::checks::bodies::Body;
use crate::checks::stretch::RestShape;
use crate::checks::surface::Surface;
use crate::shapes::{cuboid, floor, upright_sheet, with_bound, with_surface};
use muslin::glam::Vec3;
use muslin::{Cloth, ColliderDesc, GridDesc, Material, Preset};

/// Depth of a particle or a triangle that counts as penetration [m].
const TOLERANCE: f64 = 1.0e-4;

/// Drops a sheet of 40 x 40 particles, whose lower edge is 5 cm above y = 0, with waves.
fn drop(body: ColliderDesc, fabric: Preset, bound: f32, substeps: u32) {
    let case = format!("{:?}, {fabric:?}, bound {bound}, {substeps} substeps", body.shape);
    let sheet = upright_sheet(40, 0.585);
    let mut desc = GridDesc {
        origin: sheet.origin.with_y(0.635),
        material: Material::preset(fabric),
        ..with_bound(with_surface(sheet), bound)
    };
    desc.settings.substeps = substeps;
    let mut cloth = Cloth::grid(&desc).unwrap();
    let body = Body::new(cloth.add_collider(&body).unwrap(), body);
    let (rest, held) = (RestShape::of(&cloth), vec![false; cloth.particle_count() as usize]);
    for i in 0..cloth.particle_count() {
        let x = cloth.position(i).unwrap();
        let speed = 0.05 * (7.0 * x.x + 5.0 * x.y).sin();
        cloth.set_velocity(i, Vec3::Z * speed).unwrap();
    }
    for tick in 0..20 {
        cloth.step(1);
        let found = body.penetration(&cloth, &Surface::of(&cloth), &held);
        let depth = found.particles.max(found.triangles);
        assert!(depth < TOLERANCE, "{case}, tick {tick}: {depth} m deep");
        let strain = rest.strain(&cloth);
        assert!(!strain.is_broken || strain.is_told, "{case}, tick {tick}: {}", strain.greatest);
    }
}

#[test]
fn a_sheet_that_falls_on_its_edge_stays_above_a_floor() {
    drop(floor(0.0), Preset::Cotton, 0.0, 4);
    drop(floor(0.0), Preset::Silk, 0.0, 20);
    drop(floor(0.0), Preset::Paper, 0.0, 4);
}

#[test]
fn a_sheet_with_a_bound_that_falls_on_its_edge_stays_above_a_box() {
    let table = cuboid(Vec3::splat(0.5), -Vec3::Y * 0.5);
    drop(table.clone(), Preset::Silk, 0.02, 4);
    drop(table.clone(), Preset::Cotton, 0.02, 20);
    drop(table, Preset::Paper, 0.02, 20);
}
