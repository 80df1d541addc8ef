//! Hangs a mesh or a grid, and measures the time of a tick and the stretch at the end.

use cpu_time::ThreadTime;
use muslin::glam::Vec3;
use muslin::{Cloth, GridDesc, Material, MeshDesc, MeshReport, PinMode, Preset, Stage};

/// How many times each cloth is hung.
pub const RUNS: usize = 3;

/// Part of the height, from the top, that is pinned.
const PINNED: f32 = 0.03;

/// What was measured of a cloth that hung.
pub struct Hung {
    pub report: MeshReport,
    /// Time of a tick [ms].
    pub ms: f64,
    /// Time of bending in a tick [ms]; `None` if the profile has none.
    pub bend_ms: Option<f64>,
    /// Greatest stretch of an edge, and the 99th percentile; 0 is its rest length.
    pub max_stretch: f64,
    pub stretch_99: f64,
    /// What is wrong with the result.
    pub warning: Option<String>,
}

/// Makes a cloth of cotton from a mesh, and lets it hang by its top.
pub fn hang(mut desc: MeshDesc, ticks: u32) -> muslin::Result<Hung> {
    desc.material = Material::preset(Preset::Cotton);
    stand_up(&mut desc.positions);
    desc.pinned = top(&desc.positions);
    let cloth = Cloth::mesh(&desc)?;
    let (ms, bend_ms, end) = time(&cloth, ticks);
    let mut stretch = stretches(&cloth, &end);
    stretch.sort_by(f64::total_cmp);
    let at_share = |share: f64| stretch[((stretch.len() - 1) as f64 * share) as usize];
    let stats = end.stats();
    let slow = format!("{} links exceed `max_stretch`", stats.over_stretched);
    Ok(Hung {
        report: *cloth.mesh_report(),
        ms,
        bend_ms: Some(bend_ms).filter(|ms| *ms > 0.0),
        max_stretch: at_share(1.0),
        stretch_99: at_share(0.99),
        warning: (stats.over_stretched > 0).then_some(slow),
    })
}

/// Lets a square grid with about as many particles hang likewise, and returns the time of a tick per
/// particle [ns].
pub fn hang_grid(like: &Hung, ticks: u32) -> f64 {
    let side = f64::from(like.report.particles).sqrt().round().max(2.0) as u32;
    let mut cloth = Cloth::grid(&GridDesc {
        columns: side,
        rows: side,
        spacing: like.report.mean_edge,
        pin_mode: PinMode::None,
        material: Material::preset(Preset::Cotton),
        ..GridDesc::default()
    })
    .expect("the grid is valid");
    for particle in top(cloth.positions()) {
        cloth.pin(particle, None).expect("the particle exists");
    }
    1.0e6 * time(&cloth, ticks).0 / f64::from(side * side)
}

/// Turns a mesh that lies flat, so that its z becomes its height or, if it has none, its y.
fn stand_up(positions: &mut [Vec3]) {
    let size = size(positions);
    if size.y < 0.1 * size.max_element() {
        positions.iter_mut().for_each(|x| *x = Vec3::new(x.x, x.z, -x.y));
    }
}

fn bounds(positions: &[Vec3]) -> [Vec3; 2] {
    let start = [Vec3::INFINITY, Vec3::NEG_INFINITY];
    positions.iter().fold(start, |[low, high], x| [low.min(*x), high.max(*x)])
}

fn size(positions: &[Vec3]) -> Vec3 {
    let [low, high] = bounds(positions);
    high - low
}

/// The vertices in the top of the height.
fn top(positions: &[Vec3]) -> Vec<u32> {
    let [low, high] = bounds(positions);
    let least = high.y - PINNED * (high.y - low.y);
    (0..).zip(positions).filter(|(_, x)| x.y >= least).map(|(vertex, _)| vertex).collect()
}

/// Returns the least time of a tick [ms], the time of bending in it [ms], and the cloth at the end.
fn time(cloth: &Cloth, ticks: u32) -> (f64, f64, Cloth) {
    let (mut least, mut least_bending, mut end) = (f64::INFINITY, f64::INFINITY, cloth.clone());
    for _ in 0..RUNS {
        end = cloth.clone();
        let start = ThreadTime::now();
        end.step(ticks);
        least = least.min(start.elapsed().as_secs_f64());
        let mut profiled = cloth.clone();
        profiled.set_clock(Some(clock));
        profiled.step(ticks);
        let bending = profiled.stats().seconds[Stage::Bend as usize];
        least_bending = least_bending.min(f64::from(bending));
    }
    let ms = 1.0e3 / f64::from(ticks);
    (ms * least, ms * least_bending, end)
}

/// Returns the processor time of this thread [s]; time of other programs is not counted.
fn clock() -> f64 {
    ThreadTime::now().as_duration().as_secs_f64()
}

/// The stretch of every edge between two states of a cloth.
fn stretches(rest: &Cloth, end: &Cloth) -> Vec<f64> {
    let length = |cloth: &Cloth, a: u32, b: u32| {
        let [a, b] = [a, b].map(|vertex| cloth.positions()[vertex as usize].as_dvec3());
        a.distance(b)
    };
    let triangles = rest.indices().as_chunks::<3>().0.iter();
    let edges = triangles.flat_map(|[a, b, c]| [[*a, *b], [*b, *c], [*c, *a]]);
    edges.map(|[a, b]| length(end, a, b) / length(rest, a, b) - 1.0).collect()
}
