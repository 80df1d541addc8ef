"""Build hook of hatchling: adds the C library to the wheel, and makes the tag of the wheel.

The library is the file that MUSLIN_LIBRARY names, or else one that cargo builds. It is called
through ctypes, so one wheel of a platform serves all versions of Python: py3-none-PLATFORM.
"""

from __future__ import annotations

import os
import re
import subprocess
import sys
import sysconfig
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

NAMES = {"win32": "muslin.dll", "darwin": "libmuslin.dylib"}


class LibraryHook(BuildHookInterface[Any]):
    """Adds the library of this platform."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        if version == "editable":
            raise RuntimeError("set MUSLIN_LIBRARY and PYTHONPATH=src to work on the package")
        name = NAMES.get(sys.platform, "libmuslin.so")
        given = os.environ.get("MUSLIN_LIBRARY")
        library = Path(given) if given else self.build(name)
        build_data["force_include"][str(library)] = f"muslin/{name}"
        build_data["pure_python"] = False
        build_data["tag"] = f"py3-none-{platform(library)}"

    def build(self, name: str) -> Path:
        """Builds the library in the repository that contains the package, for `pip install .`."""
        root = Path(self.root).parents[1]
        target = root / "target/python/cargo"
        command = ["cargo", "build", "--release", "--package", "muslin-c"]
        subprocess.run([*command, "--target-dir", str(target)], cwd=root, check=True)
        return target / "release" / name


def platform(library: Path) -> str:
    """Returns the platform of the wheel's tag. On Linux with glibc it names the oldest glibc that
    has all functions that the library needs (PEP 600)."""
    own = sysconfig.get_platform().replace("-", "_").replace(".", "_")
    versions = re.findall(rb"\0GLIBC_(\d+)\.(\d+)", library.read_bytes())
    if not own.startswith("linux_") or not versions:
        return own
    major, minor = max((int(major), int(minor)) for major, minor in versions)
    return f"manylinux_{major}_{minor}_{own.removeprefix('linux_')}"
