//! The tables of `cargo xtask bench`: Muslin and, in the same run, a plain scalar loop as
//! reference.
//!
//! | table | measures |
//! | --- | --- |
//! | `kernels` | the cost of one projection of one constraint |
//! | `ticks` | the cost of whole ticks, and how still and how stretched the cloth is at the end |
//! | `shreds` | the cost of a tick of a sheet with thousands of tears |
//! | `layers` | what self-collision adds to a tick |
//! | `scenes` | the cost of a tick of the scenes of the demo |
//! | `receipt` | the cost of a tick of the receipt scene in all its situations |
//! | `crowd` | the cost of a frame of many small cloths, separately and in one call |
//!
//! Arguments select tables by name. `--test` runs everything once in a small size, to check that it
//! runs; its times mean nothing. `benches/node` prints the first two tables for wasm.

mod cases;
mod crowd;
mod kernels;
mod layers;
mod measure;
mod receipt;
mod scenes;
mod shreds;
mod table;
mod ticks;

use std::process::ExitCode;

/// How much is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Effort {
    /// All rounds, for meaningful times.
    Full,
    /// Everything once, to check that it runs.
    Smoke,
}

/// Name of a table, and the function that prints it.
type TableEntry = (&'static str, fn(Effort));

const TABLES: [TableEntry; 7] = [
    ("kernels", kernels::print),
    ("ticks", ticks::print),
    ("shreds", shreds::print),
    ("layers", layers::print),
    ("scenes", scenes::print),
    ("receipt", receipt::print),
    ("crowd", crowd::print),
];

fn main() -> ExitCode {
    let (options, names): (Vec<_>, Vec<_>) =
        std::env::args().skip(1).partition(|arg| arg.starts_with("--"));
    // As in other harnesses: `cargo bench` passes `--bench`, `cargo test` passes nothing.
    let has = |option: &str| options.iter().any(|given| given == option);
    let effort = if has("--bench") && !has("--test") { Effort::Full } else { Effort::Smoke };
    if let Some(unknown) = names.iter().find(|name| !TABLES.iter().any(|(known, _)| known == name))
    {
        eprintln!(
            "there is no table {unknown:?}; the tables are kernels, ticks, shreds, layers, scenes, \
             receipt and crowd"
        );
        return ExitCode::FAILURE;
    }
    println!("Muslin {}, native: {}", env!("CARGO_PKG_VERSION"), machine());
    for (name, print) in TABLES {
        if names.is_empty() || names.iter().any(|wanted| wanted == name) {
            print(effort);
        }
    }
    ExitCode::SUCCESS
}

/// Returns the architecture of the processor and the SIMD instructions that the kernels may use.
fn machine() -> String {
    let mut simd: Vec<&str> = Vec::new();
    #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
    {
        let features = [
            ("SSE2", std::is_x86_feature_detected!("sse2")),
            ("AVX2", std::is_x86_feature_detected!("avx2")),
        ];
        simd.extend(
            features.iter().filter(|(_, is_supported)| *is_supported).map(|(name, _)| name),
        );
    }
    #[cfg(target_arch = "aarch64")]
    simd.push("NEON");
    if simd.is_empty() {
        simd.push("no known SIMD");
    }
    format!("{} with {}", std::env::consts::ARCH, simd.join(", "))
}
