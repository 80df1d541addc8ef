//! Packs the C library as users install it: a folder with headers, libraries, files for pkg-config
//! and CMake, licences and checksums.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::failure::{During, Failure, Result};
use crate::setup::{self, Need};
use crate::{c, files, shell};

/// What packing and testing the package needs.
pub const NEEDS: &[&Need] = &[&setup::CXX, &setup::CMAKE, &setup::PKG_CONFIG];

/// The largest size of the shared library, stripped [bytes].
const MAX_SHARED: u64 = 2_135_000;
/// The largest size of the example `hang.c` with the static library, stripped [bytes].
const MAX_STATIC: u64 = 1_685_000;

/// The least number of 8-lane multiplications in the shared library. The compiler makes many of
/// them from plain loops; options that reduce size can stop that without notice.
const MIN_WIDE_PRODUCTS: usize = 1_900;

const VERSION: &str = env!("CARGO_PKG_VERSION");
const MAJOR: &str = env!("CARGO_PKG_VERSION_MAJOR");

/// The folder that the package is built in.
pub fn dir() -> PathBuf {
    files::root().join("dist/c")
}

fn lib() -> PathBuf {
    dir().join("lib")
}

/// Builds the library and packs it.
pub fn build() -> Result {
    if !cfg!(target_os = "linux") {
        return Err(Failure::new("the C package is made on Linux only"));
    }
    setup::ensure(NEEDS)?;
    c::build()?;
    files::create_empty_dir(&dir())?;
    let copy = |from: &Path, to: &str| -> Result {
        let to = dir().join(to);
        files::create_dir(to.parent().unwrap_or(&to))?;
        std::fs::copy(from, &to).map(|_| ()).during(|| format!("copying {}", from.display()))
    };
    let root = files::root();
    for header in ["muslin.h", "muslin.hpp"] {
        copy(&root.join("include").join(header), &format!("include/{header}"))?;
    }
    for license in ["LICENSE-MIT", "LICENSE-APACHE"] {
        copy(&root.join(license), &format!("share/doc/muslin/{license}"))?;
    }
    copy(&root.join("bindings/c/README.md"), "share/doc/muslin/README.md")?;
    fill(&root.join("bindings/c/muslin.pc.in"), "lib/pkgconfig/muslin.pc")?;
    for config in ["MuslinConfig.cmake", "MuslinConfigVersion.cmake"] {
        let from = root.join("bindings/c/cmake").join(config);
        fill(&from, &format!("lib/cmake/Muslin/{config}"))?;
    }
    let whole = format!("libmuslin.so.{VERSION}");
    copy(&c::release_dir().join("libmuslin.so"), &format!("lib/{whole}"))?;
    shell::run(shell::command("strip").arg(lib().join(&whole)))?;
    files::symlink(&whole, &lib().join(format!("libmuslin.so.{MAJOR}")))?;
    files::symlink(&format!("libmuslin.so.{MAJOR}"), &lib().join("libmuslin.so"))?;
    prelink()?;
    write_checksums()?;
    println!("the C package is in dist/c");
    Ok(())
}

/// Copies a text with the version in place of `@version@` and `@major@`.
fn fill(from: &Path, to: &str) -> Result {
    let to = dir().join(to);
    files::create_dir(to.parent().unwrap_or(&to))?;
    let text = files::read(from)?.replace("@version@", VERSION).replace("@major@", MAJOR);
    files::write(&to, &text)
}

/// Links the static library into one object that exports the functions of the header only, so that
/// the copy of Rust's standard library in it cannot clash with another one.
fn prelink() -> Result {
    let work = files::target().join("package");
    files::create_empty_dir(&work)?;
    let (whole, object, list) = (work.join("whole.o"), work.join("muslin.o"), work.join("exports"));
    let names = exported(&c::release_dir().join("libmuslin.a"), &["--defined-only"])?;
    files::write(&list, &(names.join("\n") + "\n"))?;
    let mut ld = shell::command("ld");
    ld.args(["-r", "--gc-sections", "--gc-keep-exported", "--force-group-allocation"]);
    names.iter().for_each(|name| {
        ld.args(["-u", name]);
    });
    // The whole command would fill the screen.
    println!("$ ld -r … -o {} libmuslin.a", whole.display());
    shell::output(ld.arg("-o").arg(&whole).arg(c::release_dir().join("libmuslin.a")))?;
    let mut keep = std::ffi::OsString::from("--keep-global-symbols=");
    keep.push(&list);
    // A linked object needs no bytecode for link-time optimisation.
    let drop = ["--strip-debug", "--remove-section=.llvmbc", "--remove-section=.llvmcmd"];
    shell::run(shell::command("objcopy").arg(keep).args(drop).arg(&whole).arg(&object))?;
    shell::run(shell::command("ar").arg("rcsD").arg(lib().join("libmuslin.a")).arg(&object))
}

/// The names of the functions `muslin_*` in a library, sorted.
fn exported(library: &Path, options: &[&str]) -> Result<Vec<String>> {
    let mut nm = shell::command("nm");
    nm.args(["--extern-only", "--format=posix"]).args(options).arg(library);
    let symbols = shell::output(&mut nm)?;
    let name = |line: &str| {
        let mut words = line.split(' ');
        let (name, kind) = (words.next()?, words.next()?);
        (kind == "T" && name.starts_with("muslin_")).then(|| name.to_owned())
    };
    let mut names: Vec<String> = symbols.lines().filter_map(name).collect();
    names.sort();
    names.dedup();
    Ok(names)
}

/// Writes the checksum of every file, so that `sha256sum --check SHA256SUMS` finds damaged ones.
fn write_checksums() -> Result {
    let mut names = Vec::new();
    list(&dir(), "", &mut names)?;
    let mut sum = Command::new("sha256sum");
    let sums = shell::output(sum.current_dir(dir()).args(&names))?;
    files::write(&dir().join("SHA256SUMS"), &sums)
}

/// Collects the plain files of a folder by their paths from the top, which begin with `prefix`.
fn list(folder: &Path, prefix: &str, names: &mut Vec<String>) -> Result {
    for path in files::list(folder)? {
        let name = format!("{prefix}{}", path.file_name().unwrap_or_default().to_string_lossy());
        if path.is_dir() {
            list(&path, &format!("{name}/"), names)?;
        } else if !path.is_symlink() {
            names.push(name);
        }
    }
    Ok(())
}

/// Packs the library, and builds and runs programs with it as users would.
pub fn test() -> Result {
    build()?;
    check_exports()?;
    check_sizes()?;
    check_vectors()?;
    let work = files::target().join("package/consumers");
    files::create_empty_dir(&work)?;
    let mut sums = Command::new("sha256sum");
    shell::run(sums.current_dir(dir()).args(["--check", "--quiet", "SHA256SUMS"]))?;
    test_plain_compiler(&work)?;
    test_pkg_config(&work)?;
    test_cmake(&work)?;
    test_two_libraries(&work)
}

/// Fails unless both libraries export exactly the functions that the header declares.
fn check_exports() -> Result {
    let header = files::read(&files::root().join("include/muslin.h"))?;
    let static_inline = |name: &str| header.contains(&format!("static inline void {name}("));
    let is_declared = |name: &&str| {
        !static_inline(name) && !header.contains(&format!("static inline MuslinStream {name}("))
    };
    let words = header.split(|c: char| !c.is_alphanumeric() && c != '_' && c != '(');
    let calls = words.filter_map(|word| word.split_once('(').map(|(name, _)| name));
    let mut declared: Vec<&str> =
        calls.filter(|name| name.starts_with("muslin_")).filter(is_declared).collect();
    declared.sort_unstable();
    declared.dedup();
    let shared = lib().join(format!("libmuslin.so.{VERSION}"));
    for (library, options) in [
        (shared, &["--dynamic", "--defined-only"][..]),
        (lib().join("libmuslin.a"), &["--defined-only"]),
    ] {
        let mut nm = shell::command("nm");
        nm.args(["--extern-only", "--format=posix"]).args(options).arg(&library);
        let symbols = shell::output(&mut nm)?;
        let foreign = symbols
            .lines()
            .filter_map(|line| line.split_once(' '))
            .find(|(name, _)| !name.starts_with("muslin_"));
        if let Some((name, _)) = foreign {
            return Err(Failure::new(format!("{} exports {name} too", library.display())));
        }
        let exported = exported(&library, options)?;
        if exported != declared {
            let differs = |name: &&String| !declared.contains(&name.as_str());
            let more: Vec<_> = exported.iter().filter(differs).collect();
            let less: Vec<_> = declared
                .iter()
                .filter(|name| !exported.iter().any(|other| other == *name))
                .collect();
            return Err(Failure::new(format!(
                "{} does not export what muslin.h declares: it adds {more:?} and lacks {less:?}",
                library.display()
            )));
        }
    }
    Ok(())
}

/// Fails if a library is larger than its limit.
fn check_sizes() -> Result {
    let shared = size(&lib().join(format!("libmuslin.so.{VERSION}")))?;
    let program = files::target().join("package/hang");
    let mut cc = shell::command("cc");
    cc.args(["-O1", "-Wl,--gc-sections", "-s", "-I"]).arg(dir().join("include"));
    cc.arg(files::root().join("bindings/c/examples/hang.c")).arg(lib().join("libmuslin.a"));
    shell::run(cc.args(["-lm", "-o"]).arg(&program))?;
    let program = size(&program)?;
    println!("the shared library has {shared} bytes, an example with the static one {program}");
    if shared > MAX_SHARED || program > MAX_STATIC {
        return Err(Failure::new(format!(
            "the libraries are too large: the limits are {MAX_SHARED} and {MAX_STATIC} bytes"
        )));
    }
    Ok(())
}

/// Fails if the compiler has not vectorised the loops of the library.
fn check_vectors() -> Result {
    if !cfg!(target_arch = "x86_64") {
        println!("vector instructions are counted on x86-64 only");
        return Ok(());
    }
    let library = lib().join(format!("libmuslin.so.{VERSION}"));
    let mut objdump = shell::command("objdump");
    let code = shell::output(objdump.args(["-d", "--no-show-raw-insn"]).arg(&library))?;
    let wide = code.lines().filter(|line| line.contains("vmulps") && line.contains("%ymm")).count();
    println!("the shared library has {wide} multiplications of 8 lanes");
    if wide < MIN_WIDE_PRODUCTS {
        return Err(Failure::new(format!(
            "the compiler did not vectorise the library: it has {wide} multiplications of 8 lanes, \
             and at least {MIN_WIDE_PRODUCTS} are expected"
        )));
    }
    Ok(())
}

fn size(path: &Path) -> Result<u64> {
    let metadata = std::fs::metadata(path).during(|| format!("reading {}", path.display()))?;
    Ok(metadata.len())
}

fn consumer() -> PathBuf {
    files::root().join("tests/c/package/consumer.c")
}

/// Runs a program with the shared library of the package.
fn run(program: &Path) -> Result {
    shell::run(shell::command(program).env("LD_LIBRARY_PATH", lib()))
}

fn test_plain_compiler(work: &Path) -> Result {
    for (name, library) in [("plain-static", "libmuslin.a"), ("plain-shared", "libmuslin.so")] {
        let mut cc = shell::command("cc");
        cc.arg("-I").arg(dir().join("include")).arg(consumer()).arg(lib().join(library));
        shell::run(cc.args(["-lm", "-lpthread", "-ldl", "-o"]).arg(work.join(name)))?;
        run(&work.join(name))?;
    }
    Ok(())
}

fn test_pkg_config(work: &Path) -> Result {
    let mut ask = shell::command("pkg-config");
    ask.env("PKG_CONFIG_PATH", lib().join("pkgconfig"));
    let flags = shell::output(ask.args(["--cflags", "--libs", &format!("muslin = {VERSION}")]))?;
    let program = work.join("pkg-config");
    let mut cc = shell::command("cc");
    cc.arg(consumer()).args(flags.split_whitespace()).arg("-o").arg(&program);
    shell::run(&mut cc)?;
    run(&program)
}

fn test_cmake(work: &Path) -> Result {
    let built = work.join("cmake");
    let mut cmake = shell::command("cmake");
    cmake.arg("-S").arg(files::root().join("tests/c/package")).arg("-B").arg(&built);
    let mut prefix = std::ffi::OsString::from("-DCMAKE_PREFIX_PATH=");
    prefix.push(dir());
    shell::run(cmake.arg(prefix).arg("-DCMAKE_BUILD_TYPE=Release"))?;
    shell::run(shell::command("cmake").arg("--build").arg(&built))?;
    run(&built.join("with_shared"))?;
    run(&built.join("with_static"))
}

/// Links two static Rust libraries, each with a standard library of its own, into one program.
fn test_two_libraries(work: &Path) -> Result {
    let (other, program) = (work.join("libother.a"), work.join("two"));
    let mut rustc = shell::command("rustc");
    rustc.args(["--edition=2024", "--crate-type=staticlib", "-o"]).arg(&other);
    shell::run(rustc.arg(files::root().join("tests/c/package/other.rs")))?;
    let mut cc = shell::command("cc");
    cc.arg("-DWITH_OTHER").arg("-I").arg(dir().join("include")).arg(consumer());
    cc.arg(lib().join("libmuslin.a")).arg(&other);
    shell::run(cc.args(["-lm", "-lpthread", "-ldl", "-o"]).arg(&program))?;
    run(&program)
}
