//! The platforms that release packages of the C library are made for.

/// The system libraries that the static library needs on Linux with glibc.
pub const GLIBC_LIBRARIES: &[&str] = &["gcc_s", "m", "pthread", "dl"];

/// The oldest glibc that the shared libraries load on.
pub const OLDEST_GLIBC: (u32, u32) = (2, 28);

/// A platform with its package.
pub struct Platform {
    /// The target as Rust names it.
    pub target: &'static str,
    /// What the table calls it.
    pub about: &'static str,
    pub format: Format,
    pub builder: Builder,
    pub has_shared: bool,
    /// The system libraries and options of linkers that the static library needs, beside those of
    /// every program.
    pub system_libraries: &'static [&'static str],
    pub trial: Trial,
    /// What CMake knows in a build for this platform.
    pub cmake: &'static [(&'static str, &'static str)],
}

/// The format of object files.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Format {
    Elf,
    MachO,
    Coff,
    Wasm,
}

/// What builds the libraries.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Builder {
    /// Cargo, with the standard library that rustup installs.
    Cargo,
    /// Cargo with Zig as the linker, which links for [`OLDEST_GLIBC`].
    Zig,
    /// Cargo, which also builds the standard library, since rustup may not have it.
    StdFromSource,
}

/// How a program that uses the package is tried.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Trial {
    /// Compiled by this compiler and run on this machine.
    Here(Compiler),
    /// Compiled by this compiler and run by an emulator with these first arguments.
    Qemu(Compiler, &'static [&'static str]),
    /// Compiled by MinGW and run by Wine.
    Wine,
    /// Compiled by Emscripten and run by node.
    Node,
    /// Compiled and linked by Zig for its name of the target, but not run.
    LinkOnly(&'static str),
    /// Not compiled: the symbols of the library are checked.
    Symbols,
}

/// A C compiler.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Compiler {
    /// A program, with the toolchain file of `tests/c/package` that selects it.
    Program(&'static str, Option<&'static str>),
    /// Zig, for its name of the target.
    Zig(&'static str),
    /// Emscripten.
    Emcc,
}

const MINGW_LIBRARIES: &[&str] = &["kernel32", "ntdll", "userenv", "ws2_32", "dbghelp"];

const fn linux(target: &'static str, cmake: &'static [(&'static str, &'static str)]) -> Platform {
    Platform {
        target,
        about: "Linux, glibc 2.28 or newer",
        format: Format::Elf,
        builder: Builder::Zig,
        has_shared: true,
        system_libraries: GLIBC_LIBRARIES,
        trial: Trial::Here(Compiler::Program("cc", None)),
        cmake,
    }
}

const fn musl(
    target: &'static str,
    trial: Trial,
    cmake: &'static [(&'static str, &'static str)],
) -> Platform {
    Platform {
        about: "Linux, musl",
        builder: Builder::Cargo,
        has_shared: false,
        system_libraries: &[],
        trial,
        ..linux(target, cmake)
    }
}

const fn apple(
    target: &'static str,
    about: &'static str,
    trial: Trial,
    cmake: &'static [(&'static str, &'static str)],
) -> Platform {
    Platform {
        target,
        about,
        format: Format::MachO,
        builder: Builder::Cargo,
        has_shared: false,
        system_libraries: &[],
        trial,
        cmake,
    }
}

const fn android(target: &'static str, cmake: &'static [(&'static str, &'static str)]) -> Platform {
    Platform {
        target,
        about: "Android",
        format: Format::Elf,
        builder: Builder::Cargo,
        has_shared: false,
        system_libraries: &["dl", "m"],
        trial: Trial::Symbols,
        cmake,
    }
}

/// All platforms.
pub const PLATFORMS: &[Platform] = &[
    linux(
        "x86_64-unknown-linux-gnu",
        &[
            ("CMAKE_SYSTEM_NAME", "Linux"),
            ("CMAKE_SYSTEM_PROCESSOR", "x86_64"),
            ("MUSLIN_FOR_GLIBC", "1"),
        ],
    ),
    Platform {
        trial: Trial::Qemu(
            Compiler::Program("aarch64-linux-gnu-gcc", Some("aarch64-linux-gnu")),
            &["-L", "/usr/aarch64-linux-gnu"],
        ),
        ..linux(
            "aarch64-unknown-linux-gnu",
            &[
                ("CMAKE_SYSTEM_NAME", "Linux"),
                ("CMAKE_SYSTEM_PROCESSOR", "aarch64"),
                ("MUSLIN_FOR_GLIBC", "1"),
            ],
        )
    },
    musl(
        "x86_64-unknown-linux-musl",
        Trial::Here(Compiler::Zig("x86_64-linux-musl")),
        &[("CMAKE_SYSTEM_NAME", "Linux"), ("CMAKE_SYSTEM_PROCESSOR", "x86_64")],
    ),
    musl(
        "aarch64-unknown-linux-musl",
        Trial::Qemu(Compiler::Zig("aarch64-linux-musl"), &[]),
        &[("CMAKE_SYSTEM_NAME", "Linux"), ("CMAKE_SYSTEM_PROCESSOR", "aarch64")],
    ),
    Platform {
        target: "x86_64-pc-windows-gnu",
        about: "Windows 10 or newer",
        format: Format::Coff,
        builder: Builder::Cargo,
        has_shared: true,
        system_libraries: MINGW_LIBRARIES,
        trial: Trial::Wine,
        cmake: &[("CMAKE_SYSTEM_NAME", "Windows"), ("CMAKE_SYSTEM_PROCESSOR", "AMD64")],
    },
    apple(
        "x86_64-apple-darwin",
        "macOS, Intel",
        Trial::LinkOnly("x86_64-macos"),
        &[("CMAKE_SYSTEM_NAME", "Darwin"), ("CMAKE_SYSTEM_PROCESSOR", "x86_64")],
    ),
    apple(
        "aarch64-apple-darwin",
        "macOS, Apple silicon",
        Trial::LinkOnly("aarch64-macos"),
        &[
            ("CMAKE_SYSTEM_NAME", "Darwin"),
            ("CMAKE_SYSTEM_PROCESSOR", "x86_64"),
            ("CMAKE_OSX_ARCHITECTURES", "arm64"),
        ],
    ),
    apple(
        "aarch64-apple-ios",
        "iOS",
        Trial::Symbols,
        &[
            ("CMAKE_SYSTEM_NAME", "iOS"),
            ("CMAKE_SYSTEM_PROCESSOR", "arm64"),
            ("CMAKE_OSX_SYSROOT", "iphoneos"),
        ],
    ),
    Platform {
        builder: Builder::StdFromSource,
        ..apple(
            "aarch64-apple-ios-sim",
            "iOS simulator",
            Trial::Symbols,
            &[
                ("CMAKE_SYSTEM_NAME", "iOS"),
                ("CMAKE_OSX_ARCHITECTURES", "arm64"),
                (
                    "CMAKE_OSX_SYSROOT",
                    "/Platforms/iPhoneSimulator.platform/SDKs/iPhoneSimulator.sdk",
                ),
            ],
        )
    },
    android(
        "aarch64-linux-android",
        &[("CMAKE_SYSTEM_NAME", "Android"), ("CMAKE_ANDROID_ARCH_ABI", "arm64-v8a")],
    ),
    android("x86_64-linux-android", &[("CMAKE_SYSTEM_NAME", "Android"), ("ANDROID_ABI", "x86_64")]),
    android(
        "armv7-linux-androideabi",
        &[("CMAKE_SYSTEM_NAME", "Android"), ("ANDROID_ABI", "armeabi-v7a")],
    ),
    Platform {
        target: "wasm32-unknown-emscripten",
        about: "Emscripten",
        format: Format::Wasm,
        builder: Builder::Cargo,
        has_shared: false,
        // Rust's standard library unwinds by exceptions of WebAssembly.
        system_libraries: &["-fwasm-exceptions"],
        trial: Trial::Node,
        cmake: &[("CMAKE_SYSTEM_NAME", "Emscripten"), ("CMAKE_SYSTEM_PROCESSOR", "x86")],
    },
];

impl Platform {
    /// How a program that uses the package was tried, in words.
    pub fn tried(&self) -> &'static str {
        match self.trial {
            Trial::Here(_) => "run on x86-64 Linux",
            Trial::Qemu(..) => "run by qemu-aarch64",
            Trial::Wine => "run by Wine",
            Trial::Node => "run by node",
            Trial::LinkOnly(_) => "linked by Zig, not run",
            Trial::Symbols => "symbols checked, not linked",
        }
    }

    /// What the package holds, in words.
    pub fn libraries(&self) -> &'static str {
        match (self.format, self.has_shared) {
            (Format::Coff, _) => "DLL, import libraries, static",
            (_, true) => "shared, static",
            (_, false) => "static",
        }
    }

    /// The ending of the archive.
    pub fn archive_suffix(&self) -> &'static str {
        if self.format == Format::Coff { ".zip" } else { ".tar.gz" }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::files;

    #[test]
    fn the_manual_says_how_each_platform_was_tried() {
        let manual = files::read(&files::root().join("docs/manual/integration.md")).unwrap();
        for platform in PLATFORMS {
            let Platform { target, about, .. } = platform;
            let (libraries, tried) = (platform.libraries(), platform.tried());
            let row = format!("| `{target}` | {about} | {libraries} | {tried} |");
            assert!(manual.contains(&row), "docs/manual/integration.md lacks the row {row}");
        }
    }
}
