//! Folds that get harder to fold and easier to bend the more they have given way.

use crate::common::folding::{ARC, SIZE, fold, release, sheet, spacing};
use crate::common::strip::speed;
use muslin::glam::Vec3;
use muslin::{Cloth, GridDesc, Material, MeshDesc};

const YIELD_ANGLE: f32 = 0.5;
const STIFFNESS: f32 = 4.0e-5;

/// A strip as hands fold it, of a material that changes as it gives way.
fn worn(nodes: u32, hardening: f32, weakening: f32) -> GridDesc {
    let mut desc = sheet(nodes, 5, YIELD_ANGLE);
    desc.material.yield_hardening = hardening;
    desc.material.yield_weakening = weakening;
    // Softer than paper, so that the steps of any mesh are enough for the finest one.
    desc.material.bend_stiffness = STIFFNESS;
    desc.settings.damping = 4.0;
    desc
}

/// The same particles as a mesh with diagonals to the other side, which is no grid.
fn as_mesh(grid: &GridDesc) -> MeshDesc {
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

fn mesh(grid: &GridDesc) -> Cloth {
    let cloth = Cloth::mesh(&as_mesh(grid)).unwrap();
    assert!(!cloth.mesh_report().is_grid);
    cloth
}

/// Both kinds of a strip.
fn kinds(grid: &GridDesc) -> [(&'static str, Cloth); 2] {
    [("grid", Cloth::grid(grid).unwrap()), ("mesh", mesh(grid))]
}

struct Misses(Vec<String>);

impl Misses {
    fn row(&mut self, name: &str, found: f32, exact: f32, most_off: f32) {
        println!("{name}: {found:.4}, reference {exact:.4}");
        if (found - exact).abs() > most_off {
            self.0.push(format!("{name}: {found}, not {exact}"));
        }
    }

    fn finish(self) {
        assert!(self.0.is_empty(), "missed:\n{}", self.0.join("\n"));
    }
}

/// How far off what stays of a fold may be [°]: a mesh sees a fold only as far as each of its hinges does.
fn most_off(kind: &str) -> f32 {
    if kind == "grid" { 2.0 } else { 5.0 }
}

/// Folds a strip on from what it keeps, back to what it is to keep, and lets go; what it keeps [rad].
fn fold_on(cloth: &mut Cloth, nodes: u32, [from, to]: [f32; 2], keeps: f32) -> f32 {
    fold(cloth, nodes, ARC, [from, to]);
    fold(cloth, nodes, ARC, [to, keeps]);
    release(cloth, nodes)
}

#[test]
fn of_a_fold_that_hardens_or_weakens_less_stays() {
    let mut misses = Misses(Vec::new());
    for nodes in [24, 40, 56] {
        for (hardening, weakening) in [(0.0_f32, 0.0_f32), (0.5, 0.0), (1.0, 0.0), (0.0, 2.0)] {
            for angle in [0.4_f32, 1.2, 1.8] {
                for (kind, mut cloth) in kinds(&worn(nodes, hardening, weakening)) {
                    // On a mesh a fold that does not harden is drawn to few hinges.
                    if kind == "mesh" && hardening + weakening == 0.0 {
                        continue;
                    }
                    let grows = 1.0 + hardening + weakening * YIELD_ANGLE;
                    let exact = ((angle - YIELD_ANGLE) / grows).max(0.0);
                    let stays = fold_on(&mut cloth, nodes, [0.0, angle], exact);
                    let name = format!("{kind} of {nodes}, {hardening} {weakening}, by {angle}");
                    misses.row(&name, stays.to_degrees(), exact.to_degrees(), most_off(kind));
                }
            }
        }
    }
    misses.finish();
}

#[test]
fn a_fold_that_hardened_takes_more_to_be_bent_on_or_back() {
    let mut misses = Misses(Vec::new());
    let (hardening, first, second) = (0.5_f32, 1.4_f32, 2.0_f32);
    let keeps = |angle: f32| (angle - YIELD_ANGLE) / (1.0 + hardening);
    for nodes in [24, 40, 56] {
        for (kind, mut cloth) in kinds(&worn(nodes, hardening, 0.0)) {
            let mut row = |name: &str, stays: f32, exact: f32| {
                let name = format!("{kind} of {nodes}, {name}");
                misses.row(&name, stays.to_degrees(), exact.to_degrees(), most_off(kind));
            };
            let kept = keeps(first);
            let stays = fold_on(&mut cloth, nodes, [0.0, first], kept);
            row("for the first time", stays, kept);
            // By more than the yield angle from where it rests, yet not beyond what it was folded by.
            let again = kept + YIELD_ANGLE + 0.9 * hardening * kept;
            let stays = fold_on(&mut cloth, nodes, [kept, again], kept);
            row("again, not as far", stays, kept);
            let stays = fold_on(&mut cloth, nodes, [kept, second], keeps(second));
            row("on", stays, keeps(second));
            // Pressed flat it gives way by what is beyond its limit to that side, which has grown as well.
            let kept = keeps(second);
            let limit = YIELD_ANGLE + hardening * kept;
            let exact = kept - (kept - limit).max(0.0) / (1.0 + hardening);
            let stays = fold_on(&mut cloth, nodes, [kept, 0.0], exact);
            row("back", stays, exact);
        }
    }
    misses.finish();
}

/// How far the end of a level strip sinks that is held where it begins [m].
fn droop(mut cloth: Cloth, nodes: u32) -> f32 {
    let count = cloth.positions().len() as u32;
    for i in (0..count).filter(|i| i % nodes < 2) {
        cloth.pin(i, None).unwrap();
    }
    let mut ticks = 0;
    while ticks < 120 || (speed(&cloth) > 1.0e-5 && ticks < 3600) {
        cloth.step(1);
        ticks += 1;
    }
    let ends = (0..count).filter(|i| i % nodes == nodes - 1);
    let sum: f32 = ends.clone().map(|i| -cloth.positions()[i as usize].y).sum();
    sum / ends.count() as f32
}

#[test]
fn a_crease_pressed_flat_turns_as_much_more_as_it_is_weaker() {
    let mut misses = Misses(Vec::new());
    let (weakening, angle, gravity) = (4.0_f32, 1.2_f32, 0.025);
    for nodes in [24, 40, 56] {
        let mut grid = worn(nodes, 0.0, weakening);
        grid.material.yield_angle = 0.0;
        grid.material.fold_length = 0.01;
        grid.settings.gravity = Vec3::NEG_Y * gravity;
        let load = grid.material.density * gravity;
        let exact = load * (SIZE - spacing(nodes)).powi(4) / (8.0 * STIFFNESS);
        let plain = kinds(&grid).map(|(kind, cloth)| {
            let name = format!("{kind} of {nodes}, droop of a strip [mm]");
            let droop = droop(cloth, nodes);
            misses.row(&name, 1e3 * droop, 1e3 * exact, 0.03e3 * exact);
            droop
        });
        // Between threads, on one, and askew: what is beyond it of the strip turns about its middle.
        for (share, lean) in [(0.43, 0.0), (0.5, 0.0), (0.5, 0.5 * SIZE / 8.0)] {
            let place = share * SIZE;
            for ((kind, mut cloth), plain) in kinds(&grid).into_iter().zip(plain) {
                let middle = Vec3::new(place, 0.0, 2.0 * spacing(nodes));
                let off = Vec3::new(2.0 * lean, 0.0, SIZE / 4.0);
                cloth.crease(middle - off, middle + off, 0.5 * angle).unwrap();
                cloth.crease(middle - off, middle + off, -0.5 * angle).unwrap();
                let beyond = SIZE - place;
                let turn = 0.5 * load * beyond * beyond / STIFFNESS
                    * (grid.material.fold_length * weakening * angle);
                let exact = turn * beyond;
                // Of what leans a strip has more, of which less can bend, as it does not stretch.
                let most_off = match (lean == 0.0, kind) {
                    (true, _) => 0.05,
                    (false, "grid") => 0.12,
                    (false, _) => 0.2,
                };
                let more = droop(cloth, nodes) - plain;
                let name =
                    format!("{kind} of {nodes}, more by a crease at {share} leaning {lean} [mm]");
                misses.row(&name, 1e3 * more, 1e3 * exact, 1e3 * most_off * exact);
            }
        }
    }
    misses.finish();
}

#[test]
fn a_fold_that_gave_way_opens_the_more_under_a_load() {
    let mut misses = Misses(Vec::new());
    let (weakening, angle) = (2.0_f32, 1.3_f32);
    let kept = (angle - YIELD_ANGLE) / (1.0 + weakening * YIELD_ANGLE);
    for nodes in [24, 40, 56] {
        for (kind, mut cloth) in kinds(&worn(nodes, 0.0, weakening)) {
            let kept = fold_on(&mut cloth, nodes, [0.0, angle], kept);
            // A small load at the other end, square to the way to it.
            let middle = SIZE / 2.0;
            let count = cloth.positions().len() as u32;
            for i in (0..count).filter(|i| ((i % nodes) as f32) < 0.3 * nodes as f32) {
                cloth.pin(i, None).unwrap();
            }
            let mut way = |weakening: f32, pull: f32| {
                let material = Material { yield_weakening: weakening, ..cloth.material().clone() };
                cloth.set_material(material).unwrap();
                let along = arm(&cloth, nodes);
                let mut settings = cloth.settings().clone();
                settings.gravity = square_to(along) * pull;
                cloth.set_settings(settings).unwrap();
                cloth.step(900);
                arm(&cloth, nodes)
            };
            let pull = 0.08;
            let [weak, loaded, firm, pressed] =
                [(weakening, 0.0), (weakening, pull), (0.0, 0.0), (0.0, pull)]
                    .map(|(weakening, pull)| way(weakening, pull));
            let more = weak.angle_between(loaded) - firm.angle_between(pressed);
            let material = cloth.material();
            let moment = 0.5 * material.density * pull * middle * middle;
            let exact =
                moment / material.bend_stiffness * (material.fold_length * weakening * kept);
            let name = format!("{kind} of {nodes}, opens by more");
            misses.row(&name, more.to_degrees(), exact.to_degrees(), 0.08 * exact.to_degrees());
        }
    }
    misses.finish();
}

/// The way along the part of a folded strip that is beyond the fold.
fn arm(cloth: &Cloth, nodes: u32) -> Vec3 {
    let at = |column: u32| cloth.positions()[(2 * nodes + column) as usize];
    at(nodes - 1) - at(nodes - 1 - nodes / 8)
}

fn square_to(along: Vec3) -> Vec3 {
    Vec3::new(along.y, -along.x, 0.0).normalize()
}

/// Both hardened and weakened, folded and creased.
fn used(mut cloth: Cloth, nodes: u32) -> Cloth {
    cloth.crease(Vec3::new(0.05, 0.0, -0.1), Vec3::new(0.08, 0.0, 0.3), 0.7).unwrap();
    fold(&mut cloth, nodes, ARC, [0.0, 1.5]);
    cloth
}

#[test]
fn a_cloth_with_worn_folds_is_saved_amid_folding_and_goes_on_in_the_same_bits() {
    let nodes = 24;
    for (kind, cloth) in kinds(&worn(nodes, 0.3, 1.5)) {
        let mut cloth = used(cloth, nodes);
        let mut restored = Cloth::restore(&cloth.save()).unwrap();
        assert_eq!(restored.state_hash(), cloth.state_hash(), "{kind}");
        for cloth in [&mut cloth, &mut restored] {
            fold(cloth, nodes, ARC, [1.5, 2.2]);
            cloth.unpin_all();
            cloth.step(60);
        }
        assert_eq!(restored.state_hash(), cloth.state_hash(), "{kind}");
        // What matters is counted in the hash, and stays behind where it no longer does.
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
fn a_reset_takes_what_folds_gave_way_by_away() {
    let nodes = 24;
    for (kind, cloth) in kinds(&worn(nodes, 0.3, 1.5)) {
        let mut fresh = cloth.clone();
        let mut cloth = used(cloth, nodes);
        cloth.reset();
        assert_eq!(cloth.state_hash(), fresh.state_hash(), "{kind}");
        for cloth in [&mut cloth, &mut fresh] {
            fold(cloth, nodes, ARC, [0.0, 1.5]);
        }
        assert_eq!(cloth.state_hash(), fresh.state_hash(), "{kind}");
    }
}

#[test]
fn worn_folds_may_be_torn_and_cut_and_weaken_as_much_as_numbers_say() {
    let nodes = 24;
    for (kind, cloth) in kinds(&worn(nodes, 0.3, 1.5)) {
        let mut cloth = used(cloth, nodes);
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
fn what_hardens_and_weakens_by_nothing_counts_nothing() {
    let nodes = 24;
    for (kind, cloth) in kinds(&worn(nodes, 0.0, 0.0)) {
        let mut worn = used(cloth, nodes);
        // What folds gave way by before does not count, so that nothing jumps.
        let mut later = worn.clone();
        let material = Material { yield_weakening: 2.0, ..worn.material().clone() };
        later.set_material(material).unwrap();
        worn.step(1);
        later.step(1);
        assert_eq!(later.positions(), worn.positions(), "{kind}");
    }
}
