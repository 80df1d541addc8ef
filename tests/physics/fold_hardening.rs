//! Fold hardening and weakening: the more a fold has yielded, the larger is its yield angle and the
//! smaller its bend stiffness.

use crate::common::folding::{
    ARC_HALF_LENGTH, STRIP_LENGTH, fold_strip, node_spacing, paper_sheet_desc, residual_angle,
};
use crate::common::rms_speed;
use muslin::glam::Vec3;
use muslin::{Cloth, GridDesc, Material, MeshDesc};

const YIELD_ANGLE: f32 = 0.5;
const STIFFNESS: f32 = 4.0e-5;

/// The descriptor of a strip for folding, of a material that hardens and weakens as it yields.
fn hardening_strip(nodes: u32, hardening: f32, weakening: f32) -> GridDesc {
    let mut desc = paper_sheet_desc(nodes, 5, YIELD_ANGLE);
    desc.material.yield_hardening = hardening;
    desc.material.yield_weakening = weakening;
    // Softer than paper, so that the substeps that suffice for any mesh suffice for the finest one.
    desc.material.bend_stiffness = STIFFNESS;
    desc.settings.damping = 4.0;
    desc
}

/// The same particles as a mesh with the opposite diagonals, so that it is not recognised as a
/// grid.
fn mesh_desc(grid: &GridDesc) -> MeshDesc {
    let (columns, rows) = (grid.columns, grid.rows);
    let mut desc = MeshDesc {
        material: grid.material.clone(),
        settings: grid.settings.clone(),
        ..MeshDesc::default()
    };
    for i in 0..columns * rows {
        let (column, row) = ((i % columns) as f32, (i / columns) as f32);
        desc.positions.push((Vec3::X * column + Vec3::Z * row) * grid.spacing);
    }
    for row in 0..rows - 1 {
        for column in 0..columns - 1 {
            let a = row * columns + column;
            let (b, c, d) = (a + 1, a + columns, a + columns + 1);
            desc.indices.extend([a, c, d, a, d, b]);
        }
    }
    desc
}

/// The strip as a mesh cloth.
fn mesh_cloth(grid: &GridDesc) -> Cloth {
    let cloth = Cloth::mesh(&mesh_desc(grid)).unwrap();
    assert!(!cloth.mesh_report().is_grid);
    cloth
}

/// The strip as a grid and as a mesh.
fn grid_and_mesh(grid: &GridDesc) -> [(&'static str, Cloth); 2] {
    [("grid", Cloth::grid(grid).unwrap()), ("mesh", mesh_cloth(grid))]
}

/// Messages of the values that are out of tolerance.
struct Misses(Vec<String>);

impl Misses {
    fn check(&mut self, name: &str, found: f32, exact: f32, tolerance: f32) {
        println!("{name}: {found:.4}, reference {exact:.4}");
        if (found - exact).abs() > tolerance {
            self.0.push(format!("{name}: {found}, not {exact}"));
        }
    }

    fn finish(self) {
        assert!(self.0.is_empty(), "missed:\n{}", self.0.join("\n"));
    }
}

/// Tolerance of the remaining fold angle [°]; wider on a mesh, where each hinge has only its own
/// part of the fold.
fn tolerance_degrees(kind: &str) -> f32 {
    if kind == "grid" { 2.0 } else { 5.0 }
}

/// Folds a strip from the angle `from` to `to`, back to the angle `keeps` that should remain, and
/// releases it. Returns the remaining angle [rad].
fn remaining_angle(cloth: &mut Cloth, nodes: u32, [from, to]: [f32; 2], keeps: f32) -> f32 {
    fold_strip(cloth, nodes, ARC_HALF_LENGTH, [from, to]);
    fold_strip(cloth, nodes, ARC_HALF_LENGTH, [to, keeps]);
    residual_angle(cloth, nodes)
}

#[test]
fn hardening_and_weakening_reduce_the_remaining_fold_angle() {
    let mut misses = Misses(Vec::new());
    for nodes in [24, 40, 56] {
        for (hardening, weakening) in [(0.0_f32, 0.0_f32), (0.5, 0.0), (1.0, 0.0), (0.0, 2.0)] {
            for angle in [0.4_f32, 1.2, 1.8] {
                for (kind, mut cloth) in
                    grid_and_mesh(&hardening_strip(nodes, hardening, weakening))
                {
                    // On a mesh, a fold without hardening concentrates in a few hinges.
                    if kind == "mesh" && hardening + weakening == 0.0 {
                        continue;
                    }
                    let divisor = 1.0 + hardening + weakening * YIELD_ANGLE;
                    let exact = ((angle - YIELD_ANGLE) / divisor).max(0.0);
                    let remains = remaining_angle(&mut cloth, nodes, [0.0, angle], exact);
                    let name = format!(
                        "{kind} of {nodes}, hardening {hardening}, weakening {weakening}, by {angle}"
                    );
                    misses.check(
                        &name,
                        remains.to_degrees(),
                        exact.to_degrees(),
                        tolerance_degrees(kind),
                    );
                }
            }
        }
    }
    misses.finish();
}

#[test]
fn a_hardened_fold_has_a_larger_yield_angle_in_both_directions() {
    let mut misses = Misses(Vec::new());
    let (hardening, first, second) = (0.5_f32, 1.4_f32, 2.0_f32);
    let keeps = |angle: f32| (angle - YIELD_ANGLE) / (1.0 + hardening);
    for nodes in [24, 40, 56] {
        for (kind, mut cloth) in grid_and_mesh(&hardening_strip(nodes, hardening, 0.0)) {
            let mut row = |name: &str, remains: f32, exact: f32| {
                let name = format!("{kind} of {nodes}, {name}");
                misses.check(
                    &name,
                    remains.to_degrees(),
                    exact.to_degrees(),
                    tolerance_degrees(kind),
                );
            };
            let kept = keeps(first);
            let remains = remaining_angle(&mut cloth, nodes, [0.0, first], kept);
            row("first fold", remains, kept);
            // By more than the initial yield angle from its rest, but within the hardened one.
            let again = kept + YIELD_ANGLE + 0.9 * hardening * kept;
            let remains = remaining_angle(&mut cloth, nodes, [kept, again], kept);
            row("second fold, within the hardened yield angle", remains, kept);
            let remains = remaining_angle(&mut cloth, nodes, [kept, second], keeps(second));
            row("third fold, beyond it", remains, keeps(second));
            // Pressed flat, it yields by the part beyond its yield angle, which has grown here too.
            let kept = keeps(second);
            let limit = YIELD_ANGLE + hardening * kept;
            let exact = kept - (kept - limit).max(0.0) / (1.0 + hardening);
            let remains = remaining_angle(&mut cloth, nodes, [kept, 0.0], exact);
            row("pressed flat", remains, exact);
        }
    }
    misses.finish();
}

/// The droop of the free end of a horizontal strip that is clamped at its start [m].
fn droop(mut cloth: Cloth, nodes: u32) -> f32 {
    let count = cloth.positions().len() as u32;
    for i in (0..count).filter(|i| i % nodes < 2) {
        cloth.pin(i, None).unwrap();
    }
    let mut ticks = 0;
    while ticks < 120 || (rms_speed(&cloth) > 1.0e-5 && ticks < 3600) {
        cloth.step(1);
        ticks += 1;
    }
    let ends = (0..count).filter(|i| i % nodes == nodes - 1);
    let sum: f32 = ends.clone().map(|i| -cloth.positions()[i as usize].y).sum();
    sum / ends.count() as f32
}

#[test]
fn a_weakened_crease_pressed_flat_turns_in_proportion_to_its_weakening() {
    let mut misses = Misses(Vec::new());
    let (weakening, angle, gravity) = (4.0_f32, 1.2_f32, 0.025);
    for nodes in [24, 40, 56] {
        let mut grid = hardening_strip(nodes, 0.0, weakening);
        grid.material.yield_angle = 0.0;
        grid.material.fold_length = 0.01;
        grid.settings.gravity = Vec3::NEG_Y * gravity;
        let load = grid.material.density * gravity;
        let exact = load * (STRIP_LENGTH - node_spacing(nodes)).powi(4) / (8.0 * STIFFNESS);
        let plain = grid_and_mesh(&grid).map(|(kind, cloth)| {
            let name = format!("{kind} of {nodes}, droop of a strip [mm]");
            let droop = droop(cloth, nodes);
            misses.check(&name, 1e3 * droop, 1e3 * exact, 0.03e3 * exact);
            droop
        });
        // Creases between grid lines, on a grid line, and oblique. The part of the strip beyond a
        // crease turns about the crease's middle.
        for (share, skew) in [(0.43, 0.0), (0.5, 0.0), (0.5, 0.5 * STRIP_LENGTH / 8.0)] {
            let place = share * STRIP_LENGTH;
            for ((kind, mut cloth), plain) in grid_and_mesh(&grid).into_iter().zip(plain) {
                let middle = Vec3::new(place, 0.0, 2.0 * node_spacing(nodes));
                let off = Vec3::new(2.0 * skew, 0.0, STRIP_LENGTH / 4.0);
                cloth.crease(middle - off, middle + off, 0.5 * angle).unwrap();
                cloth.crease(middle - off, middle + off, -0.5 * angle).unwrap();
                let beyond = STRIP_LENGTH - place;
                let turn = 0.5 * load * beyond * beyond / STIFFNESS
                    * (grid.material.fold_length * weakening * angle);
                let exact = turn * beyond;
                // An oblique crease is longer, but a strip that does not stretch bends less of it.
                let tolerance = match (skew == 0.0, kind) {
                    (true, _) => 0.05,
                    (false, "grid") => 0.12,
                    (false, _) => 0.2,
                };
                let more = droop(cloth, nodes) - plain;
                let name = format!(
                    "{kind} of {nodes}, extra droop by a crease at {share}, skewed by {skew} [mm]"
                );
                misses.check(&name, 1e3 * more, 1e3 * exact, 1e3 * tolerance * exact);
            }
        }
    }
    misses.finish();
}

#[test]
fn a_weakened_fold_opens_more_under_a_load() {
    let mut misses = Misses(Vec::new());
    let (weakening, angle) = (2.0_f32, 1.3_f32);
    let kept = (angle - YIELD_ANGLE) / (1.0 + weakening * YIELD_ANGLE);
    for nodes in [24, 40, 56] {
        for (kind, mut cloth) in grid_and_mesh(&hardening_strip(nodes, 0.0, weakening)) {
            let kept = remaining_angle(&mut cloth, nodes, [0.0, angle], kept);
            // A small load on the free part, perpendicular to it.
            let middle = STRIP_LENGTH / 2.0;
            let count = cloth.positions().len() as u32;
            for i in (0..count).filter(|i| ((i % nodes) as f32) < 0.3 * nodes as f32) {
                cloth.pin(i, None).unwrap();
            }
            let mut loaded_arm = |weakening: f32, pull: f32| {
                let material = Material { yield_weakening: weakening, ..cloth.material().clone() };
                cloth.set_material(material).unwrap();
                let along = arm(&cloth, nodes);
                let mut settings = cloth.settings().clone();
                settings.gravity = perpendicular_to(along) * pull;
                cloth.set_settings(settings).unwrap();
                cloth.step(900);
                arm(&cloth, nodes)
            };
            let pull = 0.08;
            let [weak, weak_loaded, firm, firm_loaded] =
                [(weakening, 0.0), (weakening, pull), (0.0, 0.0), (0.0, pull)]
                    .map(|(weakening, pull)| loaded_arm(weakening, pull));
            let more = weak.angle_between(weak_loaded) - firm.angle_between(firm_loaded);
            let material = cloth.material();
            let moment = 0.5 * material.density * pull * middle * middle;
            let exact =
                moment / material.bend_stiffness * (material.fold_length * weakening * kept);
            let name = format!("{kind} of {nodes}, opens further by");
            misses.check(&name, more.to_degrees(), exact.to_degrees(), 0.08 * exact.to_degrees());
        }
    }
    misses.finish();
}

/// A vector along the free part of a folded strip, near its end.
fn arm(cloth: &Cloth, nodes: u32) -> Vec3 {
    let at = |column: u32| cloth.positions()[(2 * nodes + column) as usize];
    at(nodes - 1) - at(nodes - 1 - nodes / 8)
}

/// The unit vector in the x–y plane perpendicular to `along`.
fn perpendicular_to(along: Vec3) -> Vec3 {
    Vec3::new(along.y, -along.x, 0.0).normalize()
}

/// The strip after a crease and a fold, so that its hinges have hardened and weakened.
fn creased_and_folded(mut cloth: Cloth, nodes: u32) -> Cloth {
    cloth.crease(Vec3::new(0.05, 0.0, -0.1), Vec3::new(0.08, 0.0, 0.3), 0.7).unwrap();
    fold_strip(&mut cloth, nodes, ARC_HALF_LENGTH, [0.0, 1.5]);
    cloth
}

#[test]
fn a_cloth_saved_while_its_folds_harden_continues_with_the_same_bits() {
    let nodes = 24;
    for (kind, cloth) in grid_and_mesh(&hardening_strip(nodes, 0.3, 1.5)) {
        let mut cloth = creased_and_folded(cloth, nodes);
        let mut restored = Cloth::restore(&cloth.save()).unwrap();
        assert_eq!(restored.state_hash(), cloth.state_hash(), "{kind}");
        for cloth in [&mut cloth, &mut restored] {
            fold_strip(cloth, nodes, ARC_HALF_LENGTH, [1.5, 2.2]);
            cloth.unpin_all();
            cloth.step(60);
        }
        assert_eq!(restored.state_hash(), cloth.state_hash(), "{kind}");
        // Hash and save contain accumulated plastic angles only while the material hardens or
        // weakens. Without both it is dropped.
        let firm =
            Material { yield_weakening: 0.0, yield_hardening: 0.0, ..cloth.material().clone() };
        cloth.set_material(firm).unwrap();
        let mut restored = Cloth::restore(&cloth.save()).unwrap();
        for cloth in [&mut cloth, &mut restored] {
            let soft = Material { yield_weakening: 3.0, ..cloth.material().clone() };
            cloth.set_material(soft).unwrap();
            cloth.step(30);
        }
        assert_eq!(restored.state_hash(), cloth.state_hash(), "{kind}");
    }
}

#[test]
fn reset_clears_the_accumulated_plastic_angles_of_folds() {
    let nodes = 24;
    for (kind, cloth) in grid_and_mesh(&hardening_strip(nodes, 0.3, 1.5)) {
        let mut fresh = cloth.clone();
        let mut cloth = creased_and_folded(cloth, nodes);
        cloth.reset();
        assert_eq!(cloth.state_hash(), fresh.state_hash(), "{kind}");
        for cloth in [&mut cloth, &mut fresh] {
            fold_strip(cloth, nodes, ARC_HALF_LENGTH, [0.0, 1.5]);
        }
        assert_eq!(cloth.state_hash(), fresh.state_hash(), "{kind}");
    }
}

#[test]
fn hardened_folds_can_be_torn_and_cut_and_survive_extreme_coefficients() {
    let nodes = 24;
    for (kind, cloth) in grid_and_mesh(&hardening_strip(nodes, 0.3, 1.5)) {
        let mut cloth = creased_and_folded(cloth, nodes);
        cloth.unpin_all();
        let middle = cloth.positions()[(2 * nodes + nodes / 2) as usize];
        cloth.tear_edge(2 * nodes + nodes / 2, 3 * nodes + nodes / 2).unwrap();
        cloth
            .cut(
                middle - Vec3::Y * 0.1 - Vec3::Z * 0.012,
                middle + Vec3::Y * 0.1 - Vec3::Z * 0.012,
                Vec3::X,
            )
            .unwrap();
        let mut restored = Cloth::restore(&cloth.save()).unwrap();
        for cloth in [&mut cloth, &mut restored] {
            cloth.step(60);
            for most in [f32::MAX, 1.0e20] {
                let (yield_hardening, yield_weakening) = (most, most);
                let material = cloth.material().clone();
                cloth
                    .set_material(Material { yield_hardening, yield_weakening, ..material })
                    .unwrap();
                cloth.step(30);
            }
            assert!(cloth.positions().iter().all(|x| x.length() < 1.0), "{kind}");
        }
        assert_eq!(restored.state_hash(), cloth.state_hash(), "{kind}");
    }
}

#[test]
fn a_material_without_hardening_or_weakening_accumulates_no_plastic_angles() {
    let nodes = 24;
    for (kind, cloth) in grid_and_mesh(&hardening_strip(nodes, 0.0, 0.0)) {
        let mut unchanged = creased_and_folded(cloth, nodes);
        // Yielding before the change does not count, so switching weakening on causes no jump.
        let mut changed = unchanged.clone();
        let material = Material { yield_weakening: 2.0, ..unchanged.material().clone() };
        changed.set_material(material).unwrap();
        unchanged.step(1);
        changed.step(1);
        assert_eq!(changed.positions(), unchanged.positions(), "{kind}");
    }
}
