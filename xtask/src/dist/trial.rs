//! Tries unpacked packages as users would: with CMake, with pkg-config, and with a compiler alone.

use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::Command;

use super::build;
use super::paths::{unpacked_dir, work_dir, zig};
use super::platforms::{Compiler, Format, Platform, Trial};
use crate::failure::{Failure, Result};
use crate::{files, pack, shell};

/// Checks the files of an unpacked package, and builds and runs programs that use it.
pub fn try_out(platform: &Platform) -> Result {
    let trial = Attempt::new(platform)?;
    pack::check_checksums(&trial.package)?;
    match platform.trial {
        Trial::Symbols => Ok(()),
        Trial::LinkOnly(_) => trial.link_beside_other(),
        _ => {
            trial.build_with_cmake()?;
            trial.build_with_pkg_config()?;
            trial.build_first_program()?;
            trial.link_import_library()?;
            // Two libraries that both define symbols of Rust cannot be linked.
            if platform.format == Format::Wasm { Ok(()) } else { trial.link_beside_other() }
        }
    }
}

/// A package while it is tried.
struct Attempt<'a> {
    platform: &'a Platform,
    /// The unpacked folder.
    package: PathBuf,
    work: PathBuf,
    /// The C compiler; none where programs cannot be linked.
    compiler: Option<Compiler>,
    /// The program that runs programs, with its first arguments; none if they run by themselves.
    runner: Vec<&'static str>,
}

impl<'a> Attempt<'a> {
    fn new(platform: &'a Platform) -> Result<Self> {
        let work = work_dir().join(platform.target);
        files::create_empty_dir(&work)?;
        let mingw = Compiler::Program("x86_64-w64-mingw32-gcc", Some("x86_64-w64-mingw32"));
        let (compiler, runner) = match platform.trial {
            Trial::Here(compiler) => (Some(compiler), Vec::new()),
            Trial::Qemu(compiler, options) => {
                (Some(compiler), [&["qemu-aarch64"], options].concat())
            }
            Trial::Wine => (Some(mingw), vec!["wine"]),
            // Emscripten 3.1 loads its module by `fetch` if there is one, but node's takes no paths.
            Trial::Node => (Some(Compiler::Emcc), vec!["node", "--no-experimental-fetch"]),
            Trial::LinkOnly(target) => (Some(Compiler::Zig(target)), Vec::new()),
            Trial::Symbols => (None, Vec::new()),
        };
        let package = unpacked_dir().join(build::name(platform));
        let trial = Self { platform, package, work, compiler, runner };
        if platform.trial == Trial::Wine {
            trial.build_missing_dll()?;
        }
        Ok(trial)
    }

    /// Builds a system library that Wine 8 lacks. Newer versions of Wine load their own.
    fn build_missing_dll(&self) -> Result {
        let mut cc = self.cc()?;
        cc.arg("-shared").arg(project().join("bcryptprimitives.c")).arg("-ladvapi32");
        shell::run(cc.arg("-o").arg(self.work.join("bcryptprimitives.dll")))
    }

    /// The C compiler.
    fn cc(&self) -> Result<Command> {
        match self.compiler {
            Some(Compiler::Program(program, _)) => Ok(shell::command(program)),
            Some(Compiler::Zig(target)) => {
                let mut zig = shell::command(zig()?);
                zig.args(["cc", "-target", target]);
                Ok(zig)
            }
            Some(Compiler::Emcc) => Ok(shell::command("emcc")),
            None => Err(Failure::new("there is no C compiler for this platform")),
        }
    }

    /// Runs a program with the shared library of the package.
    fn run(&self, program: &Path) -> Result {
        let words: Vec<OsString> =
            self.runner.iter().map(OsString::from).chain([program.into()]).collect();
        let mut command = shell::command(&words[0]);
        command.args(&words[1..]).env("LD_LIBRARY_PATH", self.package.join("lib"));
        if self.platform.trial == Trial::Wine {
            let windows = |path: &Path| format!("Z:{}", path.display()).replace('/', "\\");
            let path = [windows(&self.package.join("bin")), windows(&self.work)].join(";");
            command.env("WINEPATH", path).env("WINEDEBUG", "-all");
            // Wine keeps its files here, and asks for no browser and no menus.
            command.env("WINEPREFIX", work_dir().join("wine"));
            command.env("WINEDLLOVERRIDES", "winemenubuilder.exe,mscoree,mshtml=");
        }
        shell::run(&mut command)
    }

    fn suffix(&self) -> &'static str {
        match self.platform.trial {
            Trial::Wine => ".exe",
            Trial::Node => ".js",
            _ => "",
        }
    }

    /// Builds the CMake project with all packages in its search path, and runs its programs.
    fn build_with_cmake(&self) -> Result {
        let built = self.work.join("cmake");
        shell::run(&mut self.configure(&built, &unpacked_dir())?)?;
        let cache = files::read(&built.join("CMakeCache.txt"))?;
        let selected =
            format!("Muslin_DIR:PATH={}", self.package.join("lib/cmake/Muslin").display());
        if !cache.lines().any(|line| line == selected) {
            return Err(Failure::new("CMake did not select the package of this platform"));
        }
        shell::run(shell::command("cmake").arg("--build").arg(&built))?;
        for name in ["with_shared", "with_static"] {
            self.run(&built.join(format!("{name}{}", self.suffix())))?;
        }
        Ok(())
    }

    /// The command that configures the CMake project with the packages in a folder.
    fn configure(&self, built: &Path, packages: &Path) -> Result<Command> {
        let mut cmake = shell::command("cmake");
        cmake.arg("-S").arg(project()).arg("-B").arg(built);
        cmake.arg(definition("CMAKE_PREFIX_PATH", packages));
        let toolchain = match self.compiler {
            Some(Compiler::Program(_, name)) => name.map(toolchain),
            Some(Compiler::Zig(target)) => {
                cmake.env("ZIG", zig()?).env("ZIG_TARGET", target);
                Some(toolchain("zig"))
            }
            Some(Compiler::Emcc) => {
                // Its toolchain file restricts searches to its own folders.
                cmake.arg("-DCMAKE_FIND_ROOT_PATH_MODE_PACKAGE=BOTH");
                Some(emscripten_toolchain()?)
            }
            None => None,
        };
        cmake.args(toolchain.map(|file| definition("CMAKE_TOOLCHAIN_FILE", &file)));
        Ok(cmake)
    }

    /// Compiles with the options that pkg-config prints.
    fn build_with_pkg_config(&self) -> Result {
        let mut ask = shell::command("pkg-config");
        ask.env("PKG_CONFIG_LIBDIR", self.package.join("lib/pkgconfig"));
        let version = format!("muslin = {}", pack::VERSION);
        let flags = shell::output(ask.args(["--cflags", "--libs", &version]))?;
        let program = self.work.join(format!("pkg-config{}", self.suffix()));
        let mut cc = self.cc()?;
        cc.arg(consumer()).args(flags.split_whitespace()).arg("-o").arg(&program);
        shell::run(&mut cc)?;
        self.run(&program)
    }

    /// Compiles the program in the package's README, with the static library.
    fn build_first_program(&self) -> Result {
        let readme = files::read(&self.package.join("README.md"))?;
        let code = readme.split_once("```c\n").and_then(|(_, rest)| rest.split_once("```"));
        let (code, _) = code.ok_or_else(|| Failure::new("README.md shows no program in C"))?;
        let source = self.work.join("first.c");
        files::write(&source, code)?;
        let program = self.work.join(format!("first{}", self.suffix()));
        let mut cc = self.cc()?;
        cc.arg(source).arg("-I").arg(self.package.join("include"));
        cc.arg(self.package.join("lib/libmuslin.a"));
        cc.args(pack::linker_options(self.platform.system_libraries)).arg("-o").arg(&program);
        shell::run(&mut cc)?;
        self.run(&program)
    }

    /// Links the import library that is meant for Visual Studio, where the package has one.
    fn link_import_library(&self) -> Result {
        let library = self.package.join("lib/muslin.lib");
        if !library.exists() {
            return Ok(());
        }
        let program = self.work.join("import.exe");
        let mut cc = self.cc()?;
        cc.arg("-I").arg(self.package.join("include")).arg(consumer()).arg(library);
        shell::run(cc.arg("-o").arg(&program))?;
        self.run(&program)
    }

    /// Links the static library into one program with another Rust library, and runs it where that
    /// is possible.
    fn link_beside_other(&self) -> Result {
        let other = self.work.join("libother.a");
        let mut rustc = shell::command("rustc");
        rustc.args(["--edition=2024", "--crate-type=staticlib", "-Copt-level=1"]);
        rustc.args(["--target", self.platform.target, "-o"]).arg(&other);
        shell::run(rustc.arg(project().join("other.rs")))?;
        let program = self.work.join(format!("two{}", self.suffix()));
        let mut cc = self.cc()?;
        cc.arg("-DWITH_OTHER").arg("-I").arg(self.package.join("include")).arg(consumer());
        cc.arg(self.package.join("lib/libmuslin.a")).arg(&other);
        cc.args(pack::linker_options(self.platform.system_libraries));
        if self.platform.target.ends_with("musl") {
            // The other library brings no unwinder.
            cc.arg("-lunwind");
        }
        shell::run(cc.arg("-o").arg(&program))?;
        if matches!(self.platform.trial, Trial::LinkOnly(_)) {
            return Ok(());
        }
        self.run(&program)
    }
}

/// Fails unless CMake, in a build for each platform, finds only the package of that platform
/// suitable.
pub fn check_selection(platforms: &[Platform]) -> Result {
    for platform in platforms {
        let mut cmake = shell::command("cmake");
        for (name, value) in platform.cmake {
            cmake.arg(format!("-D{name}={value}"));
        }
        cmake.arg(definition("PACKAGES", &unpacked_dir()));
        let suitable = shell::output(cmake.arg("-P").arg(project().join("suitable.cmake")))?;
        let (suitable, expected) = (suitable.trim(), format!("-- {}", build::name(platform)));
        if suitable != expected {
            let target = platform.target;
            return Err(Failure::new(format!("CMake selects {suitable:?} for {target}")));
        }
    }
    println!("CMake selects the right package for {} platforms", platforms.len());
    Ok(())
}

/// Fails unless CMake, where there is only a package for another platform, says so.
pub fn check_refusal(platforms: &[Platform]) -> Result {
    let is_here = |one: &&Platform| one.trial == Trial::Here(Compiler::Program("cc", None));
    let is_elsewhere = |one: &&Platform| one.trial == Trial::Symbols;
    let (Some(here), Some(other)) =
        (platforms.iter().find(is_here), platforms.iter().find(is_elsewhere))
    else {
        return Err(Failure::new("there are no two platforms to compare"));
    };
    let trial = Attempt::new(here)?;
    let packages = unpacked_dir().join(build::name(other));
    let mut cmake = trial.configure(&trial.work.join("refused"), &packages)?;
    let done = cmake.output().map_err(|error| Failure::new(format!("cmake: {error}")))?;
    let errors = String::from_utf8_lossy(&done.stderr);
    let expected = format!("for {}, and this build is for {}", other.target, here.target);
    // CMake breaks long lines.
    let text = errors.split_whitespace().collect::<Vec<_>>().join(" ");
    if done.status.success() || !text.contains(&expected) {
        return Err(Failure::new(format!("CMake does not say {expected:?}, but: {errors}")));
    }
    println!("CMake refuses the package of another platform and names both");
    Ok(())
}

fn definition(name: &str, path: &Path) -> OsString {
    let mut definition = OsString::from(format!("-D{name}="));
    definition.push(path);
    definition
}

/// The CMake project that uses the package.
fn project() -> PathBuf {
    files::root().join("tests/c/package")
}

/// A toolchain file of the project.
fn toolchain(name: &str) -> PathBuf {
    project().join(format!("toolchains/{name}.cmake"))
}

/// The toolchain file that comes with Emscripten.
fn emscripten_toolchain() -> Result<PathBuf> {
    let root = shell::output(shell::command("em-config").arg("EMSCRIPTEN_ROOT"))?;
    Ok(Path::new(root.trim()).join("cmake/Modules/Platform/Emscripten.cmake"))
}

fn consumer() -> PathBuf {
    project().join("consumer.c")
}
