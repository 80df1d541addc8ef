"""The package agrees with include/muslin.h: names, numbers, layout of structs, functions."""

from __future__ import annotations

import ctypes
import inspect
import re
import subprocess
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest

import muslin
from muslin._generated import constants, functions, structs
from muslin._library import lib

ROOT = Path(__file__).parents[2]
SOURCES = Path(muslin.__file__).parent
STRUCTS = {
    name: kind
    for name, kind in vars(structs).items()
    if inspect.isclass(kind) and kind is not ctypes.Structure and issubclass(kind, ctypes.Structure)
}
# Functions that the package does not call, and why.
NOT_CALLED = {
    "muslin_version": "`version` is the text of muslin_version_string",
    "muslin_status_string": "`Status` has names, and each `Error` the message of its call",
}


def test_every_function_of_the_library_is_called_or_has_a_reason() -> None:
    header = (ROOT / "include/muslin.h").read_text()
    declared = set(re.findall(r"^[\w ]+?[ *]+(muslin_\w+)\((?!.*\{)", header, re.M))
    declared -= set(re.findall(r"static inline \w+ (muslin_\w+)\(", header))
    assert len(declared) > 80 and set(functions.NAMES) == declared
    files = [path for path in SOURCES.glob("*.py")] + [SOURCES / "_generated/records.py"]
    text = "\n".join(path.read_text() for path in files)
    called = set(re.findall(r"\blib\.(muslin_\w+)\b", text))
    called |= set(re.findall(r'"(muslin_\w+_init_sized)"', text))
    assert declared - called == set(NOT_CALLED)


def test_structs_have_the_layout_of_the_c_compiler(tmp_path: Path) -> None:
    rows, expected = [], []
    for name, kind in STRUCTS.items():
        rows.append(f'printf("{name} %zu\\n", sizeof({name}));')
        expected.append(f"{name} {ctypes.sizeof(kind)}")
        for field, *_ in kind._fields_:
            rows.append(
                f'printf("{name}.{field} %zu %zu\\n", offsetof({name}, {field}), '
                f"sizeof((({name} *)0)->{field}));"
            )
            place = getattr(kind, field)
            expected.append(f"{name}.{field} {place.offset} {place.size}")
    program = (
        "#include <muslin.h>\n#include <stdio.h>\nint main(void) {\n" + "\n".join(rows) + "}\n"
    )
    (tmp_path / "layout.c").write_text(program)
    compile = ["cc", "-std=c99", "-I", str(ROOT / "include"), "layout.c", "-o", "layout"]
    subprocess.run(compile, cwd=tmp_path, check=True)
    out = subprocess.run([tmp_path / "layout"], capture_output=True, text=True, check=True).stdout
    assert out.splitlines() == expected
    assert len(STRUCTS) == len(re.findall(r"^typedef struct", program_of_header(), re.M))


def program_of_header() -> str:
    return (ROOT / "include/muslin.h").read_text()


def test_constants_have_the_numbers_of_the_binary_interface() -> None:
    abi = (ROOT / "include/muslin.abi").read_text()
    numbers = {name: int(value) for name, value in re.findall(r"^MUSLIN_(\w+) = (\d+)$", abi, re.M)}
    known = {f"STATUS_{status.name}": int(status) for status in constants.Status}
    known |= {
        name: vars(constants)[name]
        for name in ("AS_MANY_AGAIN", "MAX_STREAMS", "ALL_VERTICES", "STAGE_SLOTS")
    }
    tables: dict[str, Mapping[Any, int]] = {
        "LOG": constants.LOG_LEVELS,
        "PRESET": constants.PRESETS,
        "MAP": constants.MAPS,
        "SELF_COLLISION": constants.SELF_COLLISIONS,
        "PIN": constants.PIN_MODES,
        "WIND": constants.WIND_MODELS,
        "SHAPE": constants.SHAPES,
        "EVENT": constants.EVENT_KINDS,
        "ATTRIBUTE": constants.ATTRIBUTES,
        "FORMAT": constants.VERTEX_FORMATS,
        "SEW": constants.SEW_KINDS,
    }
    for prefix, table in tables.items():
        for name, value in table.items():
            known[f"{prefix}_{name.upper().replace('-', '_')}"] = value
    assert known == numbers


def test_the_version_is_that_of_the_library() -> None:
    major, minor, patch = (int(part) for part in muslin.version.split("."))
    assert lib.muslin_version() == major << 16 | minor << 8 | patch
    assert muslin.__version__ == muslin.version


def test_every_status_has_a_name_and_a_meaning() -> None:
    unknown = lib.muslin_status_string(len(constants.Status))
    meanings = {lib.muslin_status_string(status) for status in constants.Status}
    assert len(meanings) == len(constants.Status) and unknown not in meanings


@pytest.mark.parametrize("name", muslin.__all__)
def test_every_public_name_is_documented(name: str) -> None:
    thing = getattr(muslin, name)
    if inspect.isclass(thing) and thing.__module__.startswith("muslin"):
        assert inspect.getdoc(thing), name
        for member, value in inspect.getmembers(thing):
            is_call = inspect.isfunction(value) or inspect.ismethod(value)
            if not member.startswith("_") and (is_call or isinstance(value, property)):
                assert inspect.getdoc(value), f"{name}.{member}"
    elif inspect.isfunction(thing):
        assert inspect.getdoc(thing), name
