//! The steps of the tests: what each is about, what it needs, what it writes and what runs it.

use crate::failure::Result;
use crate::setup::{self, Need};
use crate::{
    bits, c_tests, clean_root, clients, csharp, demo, dist, engines, examples, fuzz, godot,
    js_tests, package, python, readme, rust, site, verify, web,
};

/// One part of the tests.
pub struct Step {
    /// What a person types to run it alone.
    pub name: &'static str,
    /// One line for the output.
    pub about: &'static str,
    /// What must be installed.
    pub needs: &'static [&'static Need],
    /// What it writes: beside it, no step runs that writes or reads the same.
    pub writes: &'static [Output],
    /// What it reads and another step writes. Alone, the step builds it itself.
    pub reads: &'static [Output],
    /// Whether `cargo xtask test` runs it, or only `cargo xtask test --all`.
    pub is_default: bool,
    /// Runs it to its end.
    pub run: fn() -> Result,
}

/// A folder that steps write.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Output {
    /// `target/debug`, which cargo locks while it builds.
    DebugBuild,
    /// `libmuslin` in `target/release`.
    CLibrary,
    /// `target/release-test`, which cargo locks while it builds.
    TestBuild,
    /// `dist/js` and the copy of it that tests import.
    NpmPackage,
    /// `dist/web`.
    DemoPage,
    /// `dist/c`.
    CPackage,
    /// `dist/release`.
    ReleasePackages,
    /// `dist/python` and the environments with the wheel.
    PythonPackage,
    /// `target/fuzz`.
    Fuzzer,
    /// `target/godot`.
    GodotExtension,
}

use Output::{
    CLibrary, CPackage, DebugBuild, DemoPage, Fuzzer, GodotExtension, NpmPackage, PythonPackage,
    ReleasePackages, TestBuild,
};

/// All steps. Those that take longest come early, so that the last ones end together.
pub const STEPS: &[Step] = &[
    Step {
        name: "fmt",
        about: "the Rust code is formatted",
        needs: &[],
        writes: &[],
        reads: &[],
        is_default: true,
        run: rust::check_format,
    },
    Step {
        name: "bits",
        about: "the same bits in release, in wasm and on other processors",
        needs: bits::NEEDS,
        writes: &[TestBuild],
        reads: &[],
        is_default: true,
        run: bits::test,
    },
    Step {
        name: "rust",
        about: "tests and examples in Rust, with overflow checks and debug assertions",
        needs: &[&setup::EGL],
        writes: &[DebugBuild],
        reads: &[],
        is_default: true,
        run: rust::test,
    },
    Step {
        name: "verify",
        about: "the guarantees of cloth after every tick, in a few scenes; reference cases of physics",
        needs: &[],
        writes: &[TestBuild],
        reads: &[],
        is_default: true,
        run: verify::test_briefly,
    },
    Step {
        name: "js",
        about: "the npm package in node",
        needs: &[&setup::NODE],
        writes: &[NpmPackage],
        reads: &[],
        is_default: true,
        run: js_tests::test_in_node,
    },
    Step {
        name: "clippy",
        about: "no lint reports anything, and no link of the documentation is broken",
        needs: &[],
        writes: &[],
        reads: &[],
        is_default: true,
        run: rust::lint,
    },
    Step {
        name: "c",
        about: "header, tests and examples in C and C++",
        needs: &[&setup::CXX, &setup::VALGRIND],
        writes: &[CLibrary],
        reads: &[],
        is_default: true,
        run: c_tests::check,
    },
    Step {
        name: "web",
        about: "the demo's page in a browser",
        needs: &[&setup::NODE, &setup::CHROMIUM],
        writes: &[DemoPage],
        reads: &[],
        is_default: true,
        run: web::test,
    },
    Step {
        name: "shot",
        about: "the demo's pictures, drawn without a screen",
        needs: &[&setup::EGL],
        writes: &[DebugBuild],
        reads: &[],
        is_default: true,
        run: demo::test_shot,
    },
    Step {
        name: "package",
        about: "the C library as users install it",
        needs: package::NEEDS,
        writes: &[CLibrary, CPackage],
        reads: &[],
        is_default: true,
        run: package::test,
    },
    Step {
        name: "python",
        about: "the Python package as users install it, its types and examples",
        needs: python::NEEDS,
        writes: &[CLibrary, PythonPackage],
        reads: &[],
        is_default: true,
        run: python::test,
    },
    Step {
        name: "csharp",
        about: "the binding of C# under Mono, and the recipes for Unity and Unreal",
        needs: csharp::NEEDS,
        writes: &[CLibrary],
        reads: &[],
        is_default: true,
        run: csharp::test,
    },
    Step {
        name: "clients",
        about: "the npm package as users install it: a page, Vite, webpack, node",
        needs: &[&setup::NODE, &setup::CHROMIUM],
        writes: &[],
        reads: &[NpmPackage],
        is_default: true,
        run: clients::test,
    },
    Step {
        name: "frameworks",
        about: "the npm package in Next, Nuxt, SvelteKit, Vue, React, Vitest, bundlers, Bun, Deno",
        needs: &[&setup::NEW_NODE, &setup::CHROMIUM],
        writes: &[],
        reads: &[NpmPackage],
        is_default: true,
        run: clients::test_frameworks,
    },
    Step {
        name: "readme",
        about: "every block of code and every command in README.md, CONTRIBUTING.md and docs",
        needs: readme::NEEDS,
        writes: &[CLibrary, DebugBuild, PythonPackage],
        reads: &[NpmPackage],
        is_default: true,
        run: || readme::test(is_step),
    },
    Step {
        name: "fuzz",
        about: "a few calls of the C library in random order with random arguments",
        needs: fuzz::NEEDS,
        writes: &[Fuzzer],
        reads: &[],
        is_default: true,
        run: fuzz::test_briefly,
    },
    Step {
        name: "examples",
        about: "the npm package's example pages in a browser",
        needs: &[&setup::NODE, &setup::CHROMIUM],
        writes: &[],
        reads: &[NpmPackage],
        is_default: true,
        run: examples::test,
    },
    Step {
        name: "page",
        about: "the npm package in a browser",
        needs: &[&setup::NODE, &setup::CHROMIUM],
        writes: &[],
        reads: &[NpmPackage],
        is_default: true,
        run: js_tests::test_in_browser,
    },
    Step {
        name: "demo",
        about: "the demo as it is shipped: its build with link-time optimisation, and a picture",
        needs: &[&setup::EGL],
        writes: &[],
        reads: &[],
        is_default: false,
        run: demo::test_release,
    },
    Step {
        name: "site",
        about: "the site in a browser: links, policy, search, playground, contrast",
        needs: site::NEEDS,
        writes: &[DemoPage],
        reads: &[NpmPackage],
        is_default: false,
        run: site::test,
    },
    Step {
        name: "dist",
        about: "the C library's release packages for all platforms, run where that is possible",
        needs: dist::NEEDS,
        writes: &[ReleasePackages],
        reads: &[],
        is_default: false,
        run: dist::test,
    },
    Step {
        name: "clean-root",
        about: "the packed artefacts in a new Debian: C by CMake, Python by pip, npm in Vite and React",
        needs: clean_root::NEEDS,
        writes: &[CLibrary, ReleasePackages, PythonPackage],
        reads: &[NpmPackage],
        is_default: false,
        run: clean_root::test,
    },
    Step {
        name: "engines",
        about: "the C library's examples in engines, and their pictures",
        needs: engines::NEEDS,
        writes: &[CLibrary],
        reads: &[],
        is_default: false,
        run: engines::test,
    },
    Step {
        name: "godot",
        about: "the extension for Godot, its project and the scripts of its page, in Godot",
        needs: godot::NEEDS,
        writes: &[GodotExtension],
        reads: &[],
        is_default: false,
        run: godot::test,
    },
    Step {
        name: "fuzz-long",
        about: "hundreds of sequences of calls, and a planted mistake that the fuzzer must find",
        needs: fuzz::NEEDS,
        writes: &[Fuzzer],
        reads: &[],
        is_default: false,
        run: fuzz::test,
    },
];

/// Whether there is a step of this name.
pub fn is_step(name: &str) -> bool {
    STEPS.iter().any(|step| step.name == name)
}

impl Step {
    /// Whether it opens pages in a browser.
    pub fn needs_browser(&self) -> bool {
        self.needs.iter().any(|need| need.name == setup::CHROMIUM.name)
    }

    /// Whether one writes what the other writes or reads, so that they must not run side by side.
    pub fn conflicts_with(&self, other: &Self) -> bool {
        let clash = |writer: &Self, user: &Self| {
            writer.writes.iter().any(|out| user.writes.contains(out) || user.reads.contains(out))
        };
        clash(self, other) || clash(other, self)
    }
}
