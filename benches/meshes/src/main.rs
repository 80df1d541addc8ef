//! `cargo xtask bench meshes PATH…`: what cloths cost that are made from meshes in files, and how
//! far they stretch, beside grids of as many particles. Without a path it takes generated meshes.
//!
//! ```text
//! read (OBJ, glTF) ─┐
//!                   ├─▶ hang by the top 3 % for 1 s ─▶ table, warnings
//! generate ─────────┘
//! ```

mod generate;
mod hang;
mod noise;
mod read;
#[allow(dead_code)]
#[path = "../../tables/table.rs"]
mod table;

use hang::{Hung, hang, hang_grid};
use muslin::MeshDesc;
use std::path::Path;
use std::process::ExitCode;
use table::{Table, format_number, format_ratio};

const USAGE: &str = "\
cargo xtask bench meshes [PATH…] [OPTION…]: OBJ and glTF files; without a path, generated meshes
  --scale=NUMBER           factor on all positions, such as 0.01 for centimetres
  --weld=METRES            distance of vertices that become one particle; the default is 0
  --simplify-below=METRES  also measures each mesh with its shorter edges collapsed
  --test                   runs two ticks, to check that it runs";

/// What the arguments ask for.
struct Options {
    paths: Vec<String>,
    scale: f32,
    weld_distance: f32,
    simplify_below: f32,
    is_test: bool,
}

fn main() -> ExitCode {
    match run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("{message}");
            ExitCode::FAILURE
        }
    }
}

fn run() -> Result<(), String> {
    let options = options()?;
    let meshes = if options.paths.is_empty() {
        generate::all(options.is_test)
    } else {
        let read = |path: &String| {
            let mesh = read::read(Path::new(path)).map_err(|why| format!("{path}: {why}"))?;
            let name = Path::new(path).file_name().unwrap_or_default();
            Ok((name.to_string_lossy().into_owned(), mesh))
        };
        options.paths.iter().map(read).collect::<Result<Vec<_>, String>>()?
    };
    let mut table = Table::new(
        &["mesh"],
        &[
            "particles",
            "triangles",
            "shortest mm",
            "mean mm",
            "thin",
            "collapsed",
            "ms a tick",
            "bending",
            "ns a particle",
            "grid",
            "ratio",
            "stretch %",
            "99th %",
        ],
    );
    let ticks = if options.is_test { 2 } else { 60 };
    let mut warnings = Vec::new();
    for (name, mut desc) in meshes {
        desc.positions.iter_mut().for_each(|x| *x *= options.scale);
        desc.weld_distance = options.weld_distance;
        let limits = [0.0, options.simplify_below];
        let count = if options.simplify_below == 0.0 { 1 } else { 2 };
        for simplify_below in limits.into_iter().take(count) {
            let desc = MeshDesc { simplify_below, ..desc.clone() };
            let hung = hang(desc, ticks).map_err(|error| format!("{name}: {error}"))?;
            table.push(row(&name, &hung, hang_grid(&hung, ticks)));
            let name =
                if simplify_below > 0.0 { format!("{name}, simplified") } else { name.clone() };
            let texts = hung.report.warnings().into_iter().chain(hung.warning);
            warnings.extend(texts.map(|text| format!("{name}: {text}")));
        }
    }
    println!(
        "\nMeshes: cotton, default settings, hung by the top 3 % of the height for {ticks} ticks; \
         minimum of {} runs on one thread.\n\
         grid: ns a particle of a grid with as many particles that hangs likewise. Stretch of the \
         edges at the end: the greatest, and the 99th percentile.\n",
        hang::RUNS
    );
    println!("{table}");
    warnings.iter().for_each(|warning| println!("{warning}"));
    Ok(())
}

fn options() -> Result<Options, String> {
    let mut options = Options {
        paths: Vec::new(),
        scale: 1.0,
        weld_distance: 0.0,
        simplify_below: 0.0,
        is_test: false,
    };
    for argument in std::env::args().skip(1) {
        let (name, value) = argument.split_once('=').unwrap_or((&argument, ""));
        let number = || value.parse::<f32>().map_err(|_| format!("{name} needs a number\n{USAGE}"));
        match name {
            "--scale" => options.scale = number()?,
            "--weld" => options.weld_distance = number()?,
            "--simplify-below" => options.simplify_below = number()?,
            "--test" => options.is_test = true,
            _ if name.starts_with("--") => return Err(format!("unknown option {name}\n{USAGE}")),
            _ => options.paths.push(argument),
        }
    }
    Ok(options)
}

/// A row of the table, beside the ns per particle of a grid.
fn row(name: &str, hung: &Hung, grid_ns: f64) -> Vec<String> {
    let report = &hung.report;
    let ns = 1.0e6 * hung.ms / f64::from(report.particles);
    let is_simplified = report.collapsed_edges + report.flipped_edges > 0;
    vec![
        if is_simplified { format!("{name}, simplified") } else { name.into() },
        report.particles.to_string(),
        report.kept_triangles.to_string(),
        format_number(1.0e3 * f64::from(report.shortest_edge), 2),
        format_number(1.0e3 * f64::from(report.mean_edge), 1),
        report.thin_triangles.to_string(),
        report.collapsed_edges.to_string(),
        format_number(hung.ms, 2),
        hung.bend_ms.map_or_else(table::no_value, |ms| format_number(ms, 2)),
        format_number(ns, 0),
        format_number(grid_ns, 0),
        format_ratio(ns / grid_ns),
        format_number(100.0 * hung.max_stretch, 2),
        format_number(100.0 * hung.stretch_99, 2),
    ]
}
