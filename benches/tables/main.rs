//! The tables of `cargo xtask bench`: Muslin beside the plain loop that most people write, in one run.
//!
//! `kernels` tells what one projection of one constraint costs, `ticks` what whole ticks cost and
//! how calm and how long the cloth is in the end, `shreds` what tears add to that, `layers` what
//! collision with itself adds, `scenes` what the demo's scenes cost, `receipt` what its receipt costs
//! in all that happens to it. Names choose among them. `--test` runs everything once and tiny, and
//! times nothing that is worth reading. `benches/node` prints the same in wasm.

mod cases;
mod kernels;
mod layers;
mod measure;
mod receipt;
mod scenes;
mod shreds;
mod table;
mod ticks;

use std::process::ExitCode;

/// How much is run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Effort {
    /// What it takes for figures.
    Timed,
    /// Everything once, to see that it runs.
    Once,
}

/// A table's name, and what prints it.
type Entry = (&'static str, fn(Effort));

const TABLES: [Entry; 6] = [
    ("kernels", kernels::print),
    ("ticks", ticks::print),
    ("shreds", shreds::print),
    ("layers", layers::print),
    ("scenes", scenes::print),
    ("receipt", receipt::print),
];

fn main() -> ExitCode {
    let (options, names): (Vec<_>, Vec<_>) =
        std::env::args().skip(1).partition(|arg| arg.starts_with("--"));
    // As other harnesses do: cargo says `--bench` when it benches, and nothing when it tests.
    let has = |option: &str| options.iter().any(|given| given == option);
    let effort = if has("--bench") && !has("--test") { Effort::Timed } else { Effort::Once };
    if let Some(unknown) = names.iter().find(|name| !TABLES.iter().any(|(known, _)| known == name))
    {
        eprintln!(
            "there is no table {unknown:?}; the tables are kernels, ticks, shreds, layers, scenes and receipt"
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

/// The processor's kind and its vector instructions, as far as kernels may use them.
fn machine() -> String {
    let mut vectors: Vec<&str> = Vec::new();
    #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
    {
        let offers = [
            ("SSE2", std::is_x86_feature_detected!("sse2")),
            ("AVX2", std::is_x86_feature_detected!("avx2")),
            (
                "AVX-512F",
                std::is_x86_feature_detected!("avx512f") && cfg!(not(muslin_at_most_avx2)),
            ),
        ];
        vectors.extend(offers.iter().filter(|(_, is_there)| *is_there).map(|(name, _)| name));
    }
    #[cfg(target_arch = "aarch64")]
    vectors.push("NEON");
    if vectors.is_empty() {
        vectors.push("no vectors that are known");
    }
    format!("{} with {}", std::env::consts::ARCH, vectors.join(", "))
}
