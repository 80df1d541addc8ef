"""Writes what the C library contains: a bill of materials (CycloneDX) and all licences.

The parts are the crates that `cargo metadata` lists as normal dependencies for the target, and
Rust's standard library. Crates that only run while it is built, such as macros, are no parts.
"""

from __future__ import annotations

import argparse
import json
import shutil
import subprocess
import uuid
from datetime import datetime, timezone
from pathlib import Path
from typing import Any

import tomllib
from cyclonedx.contrib.license.factories import LicenseFactory
from cyclonedx.model import HashAlgorithm, HashType, Property
from cyclonedx.model.bom import Bom, BomMetaData
from cyclonedx.model.component import Component, ComponentType
from cyclonedx.output.json import JsonV1Dot5
from cyclonedx.schema import SchemaVersion
from cyclonedx.validation.json import JsonStrictValidator
from packageurl import PackageURL

ROOT = Path(__file__).resolve().parents[3]
LIBRARY = "muslin-c"
LICENSE_NAMES = ["LICENSE*", "LICENCE*", "COPYING*", "COPYRIGHT*", "NOTICE*"]


def parts(metadata: dict[str, Any]) -> tuple[dict[str, Any], dict[str, list[str]]]:
    """Returns the packages that the library contains by their ids, and what each depends on."""
    packages = {package["id"]: package for package in metadata["packages"]}
    nodes = {node["id"]: node for node in metadata["resolve"]["nodes"]}
    [root] = [key for key, package in packages.items() if package["name"] == LIBRARY]
    found: dict[str, list[str]] = {}
    waiting = [root]
    while waiting:
        key = waiting.pop()
        if key in found:
            continue
        normal = [
            one["pkg"]
            for one in nodes[key]["deps"]
            if any(kind["kind"] is None for kind in one["dep_kinds"])
            and not is_macro(packages[one["pkg"]])
        ]
        found[key] = normal
        waiting.extend(normal)
    return {key: packages[key] for key in found}, found


def is_macro(package: dict[str, Any]) -> bool:
    """Whether a package holds procedural macros, which run in the compiler."""
    return any("proc-macro" in target["kind"] for target in package["targets"])


def checksums() -> dict[tuple[str, str], str]:
    """Returns the SHA-256 of each crate that was downloaded, by name and version."""
    lock = tomllib.loads((ROOT / "Cargo.lock").read_text())
    return {
        (one["name"], one["version"]): one["checksum"]
        for one in lock["package"]
        if "checksum" in one
    }


def rustc(*options: str) -> str:
    """Returns what the Rust compiler prints."""
    done = subprocess.run(["rustc", *options], check=True, capture_output=True, text=True, cwd=ROOT)
    return done.stdout.strip()


def component(
    package: dict[str, Any], sums: dict[tuple[str, str], str], kind: ComponentType
) -> Component:
    """Describes a crate. One of this repository has no address in a registry."""
    name, version = package["name"], package["version"]
    checksum = sums.get((name, version))
    return Component(
        name=name,
        version=version,
        type=kind,
        bom_ref=f"{name}@{version}",
        description=package["description"],
        licenses=[LicenseFactory().make_from_string(package["license"])],
        purl=PackageURL("cargo", name=name, version=version) if checksum else None,
        hashes=[HashType(alg=HashAlgorithm.SHA_256, content=checksum)] if checksum else [],
    )


def copy_licenses(folder: Path, to: Path, names: list[str]) -> None:
    """Copies the licences that lie in a folder, which are files of these names.

    Raises FileNotFoundError if there is none.
    """
    files = sorted({file for pattern in names for file in folder.glob(pattern) if file.is_file()})
    if not files:
        raise FileNotFoundError(f"{folder.name} holds no licence")
    to.mkdir(parents=True)
    for file in files:
        shutil.copyfile(file, to / file.name)


def main() -> None:
    """Writes `muslin.cdx.json` and the folder `third-party` into the output folder."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--metadata", type=Path, required=True)
    parser.add_argument("--target", required=True)
    parser.add_argument("--time", type=int, required=True)
    parser.add_argument("--output", type=Path, required=True)
    options = parser.parse_args()
    packages, dependencies = parts(json.loads(options.metadata.read_text()))
    sums = checksums()

    components: dict[str, Component] = {}
    for key, package in packages.items():
        is_library = package["name"] == LIBRARY
        components[key] = component(package, sums, ComponentType.LIBRARY)
        if not is_library and package["source"]:
            folder = options.output / "third-party" / f"{package['name']}-{package['version']}"
            copy_licenses(Path(package["manifest_path"]).parent, folder, LICENSE_NAMES)
    [root] = [one for one in components.values() if one.name == LIBRARY]

    release = rustc("--version").split()[1]
    std = Component(
        name="std",
        version=release,
        type=ComponentType.LIBRARY,
        bom_ref=f"std@{release}",
        description="Rust's standard library",
        licenses=[LicenseFactory().make_from_string("MIT OR Apache-2.0")],
    )
    notices = Path(rustc("--print", "sysroot")) / "share/doc/rust"
    folder = options.output / "third-party" / f"std-{release}"
    copy_licenses(notices, folder, ["COPYRIGHT-library.html"])

    metadata = BomMetaData(
        component=root,
        timestamp=datetime.fromtimestamp(options.time, timezone.utc),
        properties=[Property(name="muslin:target", value=options.target)],
    )
    parts_of_root = [one for one in components.values() if one is not root]
    bom = Bom(
        components=[*parts_of_root, std],
        metadata=metadata,
        serial_number=uuid.uuid5(uuid.NAMESPACE_URL, f"muslin/{root.version}/{options.target}"),
    )
    for key, names in dependencies.items():
        bom.register_dependency(components[key], [components[name] for name in names] + [std])
    text = JsonV1Dot5(bom).output_as_string(indent=2)
    error = JsonStrictValidator(SchemaVersion.V1_5).validate_str(text)
    if error:
        raise SystemExit(f"the bill of materials is not valid: {error}")
    (options.output / "muslin.cdx.json").write_text(text + "\n")


if __name__ == "__main__":
    main()
