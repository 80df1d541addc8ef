//! Builds the libraries of a platform, packs them, and checks what they export.

use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::Command;

use super::archive;
use super::paths::{packages_dir, tools_dir, work_dir, zig_path};
use super::platforms::{Builder, Format, OLDEST_GLIBC, Platform};
use crate::binutils::Binutils;
use crate::failure::{During, Failure, Result};
use crate::pack::{Package, VERSION, shared_name};
use crate::{c, files, python, setup, shell, symbols};

/// Makes symbols of objects for Windows local, which LLVM's program does not.
const MINGW_OBJCOPY: &str = "x86_64-w64-mingw32-objcopy";

/// The name of a platform's package.
pub fn name(platform: &Platform) -> String {
    format!("muslin-{VERSION}-{}", platform.target)
}

/// Builds, packs and checks the package of a platform.
pub fn package(platform: &Platform, tools: &Binutils) -> Result<Package> {
    let built = compile(platform)?;
    let package = Package {
        dir: packages_dir().join(name(platform)),
        target: platform.target.into(),
        system_libraries: platform.system_libraries,
        has_shared: platform.has_shared,
    };
    package.create()?;
    add_static(platform, tools, &package, &built.join("libmuslin.a"))?;
    match platform.format {
        Format::Elf if platform.has_shared => add_shared(tools, &package, &built)?,
        Format::Coff => add_dll(tools, &package, &built)?,
        _ => {}
    }
    add_bill_of_materials(platform, &package)?;
    check_paths(&package)?;
    package.write_checksums()?;
    Ok(package)
}

/// Builds the libraries, and returns their folder.
fn compile(platform: &Platform) -> Result<PathBuf> {
    let target = platform.target;
    let mut cargo = match platform.builder {
        Builder::Zig => {
            setup::ensure_target(target)?;
            let (major, minor) = OLDEST_GLIBC;
            let mut cargo = shell::cargo(&["zigbuild", "--target"]);
            cargo.arg(format!("{target}.{major}.{minor}")).env("PATH", zig_path()?);
            cargo
        }
        Builder::Cargo => {
            setup::ensure_target(target)?;
            rustc(platform)
        }
        Builder::StdFromSource => {
            setup::ensure_std_source()?;
            let mut cargo = rustc(platform);
            cargo.arg("-Zbuild-std=std,panic_unwind").env("RUSTC_BOOTSTRAP", "1");
            cargo
        }
    };
    cargo.args(["--release", "--locked", "--package", "muslin-c"]);
    let flags = c::compiler_flags()?.join("\x1f");
    shell::run(cargo.env("CARGO_ENCODED_RUSTFLAGS", flags).env_remove("RUSTFLAGS"))?;
    Ok(files::target().join(target).join("release"))
}

/// `cargo rustc` with the kinds of libraries that the package has: a static one needs no linker.
fn rustc(platform: &Platform) -> Command {
    let mut cargo = shell::cargo(&["rustc", "--crate-type=staticlib", "--target", platform.target]);
    cargo.args(platform.has_shared.then_some("--crate-type=cdylib"));
    cargo
}

/// Adds the static library, with as few symbols of Rust's own as the format allows.
fn add_static(platform: &Platform, tools: &Binutils, package: &Package, built: &Path) -> Result {
    let packed = package.lib().join("libmuslin.a");
    match platform.format {
        Format::Elf => {
            let unwinder = static_unwinder(platform)?;
            let archives: Vec<&Path> = std::iter::once(built).chain(unwinder.as_deref()).collect();
            let work = work_dir().join("prelink");
            files::create_empty_dir(&work)?;
            tools.prelink(&archives, &symbols::declared()?, &work, &packed)?;
        }
        Format::MachO => localize(platform, tools, &tools.objcopy, package, built)?,
        Format::Coff => localize(platform, tools, Path::new(MINGW_OBJCOPY), package, built)?,
        // No program makes symbols of WebAssembly objects local.
        Format::Wasm => package.copy(built, "lib/libmuslin.a")?,
    }
    let exported: Vec<_> = own_symbols(platform, tools, &packed)?;
    symbols::check(&packed, exported)
}

/// The unwinder that Rust ships for targets whose C library has none.
fn static_unwinder(platform: &Platform) -> Result<Option<PathBuf>> {
    if !platform.target.ends_with("musl") {
        return Ok(None);
    }
    let mut rustc = shell::command("rustc");
    rustc.args(["--print", "target-libdir", "--target", platform.target]);
    let libraries = shell::output(&mut rustc)?;
    Ok(Some(Path::new(libraries.trim()).join("self-contained/libunwind.a")))
}

/// Copies an archive, without debug information, and makes local what the library's own object
/// defines beside the functions of the header.
fn localize(
    platform: &Platform,
    tools: &Binutils,
    objcopy: &Path,
    package: &Package,
    built: &Path,
) -> Result {
    let packed = package.lib().join("libmuslin.a");
    package.copy(built, "lib/libmuslin.a")?;
    let members = shell::output(shell::command(&tools.ar).arg("t").arg(&packed))?;
    let empty: Vec<_> = members.lines().filter(|name| name.ends_with(".dwo")).collect();
    if !empty.is_empty() {
        shell::output(shell::command(&tools.ar).arg("dD").arg(&packed).args(empty))?;
    }
    let declared = symbols::declared()?;
    let underscore = if platform.format == Format::MachO { "_" } else { "" };
    let mut command = shell::command(objcopy);
    command.arg("--strip-debug");
    for name in own_symbols(platform, tools, &packed)? {
        if !declared.contains(&name) {
            command.arg(format!("--localize-symbol={underscore}{name}"));
        }
    }
    shell::run(command.arg(&packed))
}

/// The names that the static library defines for others: of a prelinked one all; else those of
/// its own object, since linkers take others, of Rust's compiler library, only if they lack them.
fn own_symbols(platform: &Platform, tools: &Binutils, library: &Path) -> Result<Vec<String>> {
    let is_prefixed = platform.format == Format::MachO;
    let defined = symbols::defined(tools, library, &[], is_prefixed)?;
    let is_own = |symbol: &symbols::Symbol| match platform.format {
        Format::Elf => true,
        Format::MachO => symbol.member.starts_with("muslin"),
        // `.refptr` is a pointer that linkers merge.
        Format::Coff => symbol.member.starts_with("muslin") && !symbol.name.starts_with(".refptr."),
        Format::Wasm => symbol.name.starts_with("muslin_"),
    };
    Ok(defined.into_iter().filter(is_own).map(|symbol| symbol.name).collect())
}

/// Adds the shared library of Linux, and checks its functions and which glibc it needs.
fn add_shared(tools: &Binutils, package: &Package, built: &Path) -> Result {
    package.add_shared(&built.join("libmuslin.so"), &tools.strip)?;
    let library = package.lib().join(shared_name());
    let exported = symbols::defined(tools, &library, &["--dynamic"], false)?;
    symbols::check(&library, exported.into_iter().map(|symbol| symbol.name).collect())?;
    let mut nm = shell::command(&tools.nm);
    let needed = newest_glibc(&shell::output(nm.arg("--dynamic").arg(&library))?);
    let (major, minor) = needed
        .ok_or_else(|| Failure::new(format!("{} names no version of glibc", library.display())))?;
    println!("{} needs glibc {major}.{minor}", package.target);
    if (major, minor) > OLDEST_GLIBC {
        return Err(Failure::new(format!("{} needs glibc {major}.{minor}", library.display())));
    }
    Ok(())
}

/// The newest version of glibc that symbols such as `fcntl64@GLIBC_2.28` ask for.
fn newest_glibc(symbols: &str) -> Option<(u32, u32)> {
    let version = |text: &str| {
        let mut numbers = text.split('.').map(str::parse);
        Some((numbers.next()?.ok()?, numbers.next()?.ok()?))
    };
    symbols
        .split("@GLIBC_")
        .skip(1)
        .filter_map(|rest| version(rest.split_whitespace().next()?))
        .max()
}

/// Adds the DLL with an import library for MinGW and one for Visual Studio, and checks what the DLL
/// exports and loads.
fn add_dll(tools: &Binutils, package: &Package, built: &Path) -> Result {
    package.copy(&built.join("muslin.dll"), "bin/muslin.dll")?;
    let dll = package.dir.join("bin/muslin.dll");
    shell::run(shell::command(&tools.strip).arg(&dll))?;
    package.copy(&built.join("libmuslin.dll.a"), "lib/libmuslin.dll.a")?;
    let list = work_dir().join("muslin.def");
    let exports = symbols::declared()?.join("\n");
    files::write(&list, &format!("LIBRARY muslin.dll\nEXPORTS\n{exports}\n"))?;
    let option = |start: &str, path: &Path| {
        let mut option = OsString::from(start);
        option.push(path);
        option
    };
    let mut lib = shell::command(tools.ld.with_file_name("lld-link"));
    lib.args(["/lib", "/machine:x64"]).arg(option("/def:", &list));
    shell::run(lib.arg(option("/out:", &package.lib().join("muslin.lib"))))?;

    let listed = |what: &str| -> Result<Vec<String>> {
        let readobj = tools.nm.with_file_name("llvm-readobj");
        let output = shell::output(shell::command(readobj).arg(what).arg(&dll))?;
        let names = output.lines().filter_map(|line| line.trim().strip_prefix("Name: "));
        Ok(names.map(String::from).collect())
    };
    symbols::check(&dll, listed("--coff-exports")?)?;
    // Libraries of the compiler, such as libgcc_s_seh-1.dll, are on no user's machine.
    match listed("--coff-imports")?.iter().find(|name| name.starts_with("lib")) {
        None => Ok(()),
        Some(name) => Err(Failure::new(format!("muslin.dll needs {name}"))),
    }
}

/// Adds the bill of materials and the licences of what the library contains.
fn add_bill_of_materials(platform: &Platform, package: &Package) -> Result {
    let mut cargo = shell::cargo(&["metadata", "--format-version=1", "--locked"]);
    let metadata = shell::output(cargo.args(["--filter-platform", platform.target]))?;
    let input = work_dir().join("metadata.json");
    files::write(&input, &metadata)?;
    let mut python = python::python_of(&tools_dir());
    python.arg(files::root().join("bindings/c/tools/bill_of_materials.py"));
    python.args(["--target", platform.target, "--metadata"]).arg(input);
    python.args(["--time", &archive::time()?.to_string(), "--output"]);
    shell::run(python.arg(package.dir.join("share/doc/muslin")))
}

/// Fails if a file of the package names a folder of this machine.
fn check_paths(package: &Package) -> Result {
    for name in package.entries()? {
        let content =
            std::fs::read(package.dir.join(&name)).during(|| format!("reading {name}"))?;
        for (path, _) in c::machine_paths()? {
            if content.windows(path.len()).any(|window| window == path.as_bytes()) {
                return Err(Failure::new(format!("{name} of {} names {path}", package.target)));
            }
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_newest_glibc_is_compared_by_number() {
        let symbols = "U free@GLIBC_2.2.5\nU fcntl64@GLIBC_2.28\nU x@GLIBC_2.9\n";
        assert_eq!(newest_glibc(symbols), Some((2, 28)));
        assert_eq!(newest_glibc("T muslin_version_string\n"), None);
    }
}
