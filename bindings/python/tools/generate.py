"""Writes src/muslin/_generated from include/muslin.h, or fails where the two differ.

    MUSLIN_LIBRARY=libmuslin.so python3 generate.py [--write]

Defaults of fields are those that the library's init functions set.
"""

from __future__ import annotations

import ctypes
import os
import re
import sys
import textwrap
from pathlib import Path
from typing import Any

import header as h

ROOT = Path(__file__).resolve().parents[3]
TARGET = ROOT / "bindings/python/src/muslin/_generated"
COMMAND = "MUSLIN_BLESS=1 cargo xtask python"
WIDTH = 100

TYPES = {
    "float": "c_float",
    "double": "c_double",
    "uint8_t": "c_uint8",
    "uint32_t": "c_uint32",
    "uint64_t": "c_uint64",
    "size_t": "c_size_t",
}

# Names that choose one of several values: the prefix of their constants, the name of the type and
# of the table in Python.
CHOICES = {
    "LOG": ("LogLevel", "LOG_LEVELS"),
    "PRESET": ("PresetName", "PRESETS"),
    "MAP": ("MapName", "MAPS"),
    "SELF_COLLISION": ("SelfCollision", "SELF_COLLISIONS"),
    "PIN": ("PinMode", "PIN_MODES"),
    "WIND": ("WindModel", "WIND_MODELS"),
    "SHAPE": ("Shape", "SHAPES"),
    "EVENT": ("EventKind", "EVENT_KINDS"),
    "ATTRIBUTE": ("Attribute", "ATTRIBUTES"),
    "FORMAT": ("VertexFormat", "VERTEX_FORMATS"),
    "SEW": ("SewKind", "SEW_KINDS"),
}
NUMBERS = ["AS_MANY_AGAIN", "MAX_STREAMS", "ALL_VERTICES", "STAGE_SLOTS"]

# Structs that are dataclasses in Python, and the function that sets their defaults.
RECORDS = {
    "MuslinMaterial": "muslin_material_init_sized",
    "MuslinSettings": "muslin_settings_init_sized",
    "MuslinWind": "muslin_wind_init_sized",
    "MuslinHit": None,
    "MuslinChanges": None,
    "MuslinMeshReport": None,
    "MuslinStats": None,
}
# Names in Python that differ from the name in C without its prefix.
RENAMED = {"MuslinMaterial": "MaterialFields"}

# Fields that choose a value, by the prefix of its constants, and fields that are true or false.
CHOOSING = {"MuslinSettings.self_collision": "SELF_COLLISION", "MuslinWind.model": "WIND"}
FLAGS = {
    "MuslinSettings.tethers": "Whether tethers (long-range attachments) keep every particle within"
    " its rest distance of the pins. Default True.\n\nTethers carry the load that the iterations do"
    " not reach; they do not resist the stretch of links that have a stiffness. From 2 iterations"
    " on, whole chains of links are solved at once as well.",
    "MuslinSettings.tearing": "Whether links that are stretched past `tear_stretch` of `Material`"
    " tear. Default False.",
    "MuslinMeshReport.is_grid": "Whether the mesh is simulated as a regular grid.",
    "MuslinStats.asleep": "Whether the cloth sleeps, see `sleep_speed` of `Settings`.",
}
# Fields of which a part of the comment holds in C only.
REWORDED = {
    "MuslinStats.seconds": "Time of each stage in the last call that ran ticks [s], by its name."
    "\n\nTiming starts with the first `Cloth.stats` of a cloth; until then all entries are 0.",
    "MuslinStats.ticks": "Ticks since the cloth was made or reset.",
    "MuslinHit.triangle": "Triangle that was hit: a row of `Cloth.indices`.",
}
LEFT_OUT = {"struct_size", "stage_count"}


def main() -> None:
    given = h.read(ROOT / "include/muslin.h")
    check_names(given)
    files = {
        "__init__.py": '"""What is generated from include/muslin.h."""\n',
        "constants.py": constants(given),
        "structs.py": structs(given),
        "functions.py": functions(given),
    }
    files["records.py"] = records(given, load(files))
    is_writing = "--write" in sys.argv[1:]
    TARGET.mkdir(exist_ok=True)
    for name, text in files.items():
        path = TARGET / name
        if is_writing:
            path.write_text(text, encoding="utf-8")
        elif not path.exists() or path.read_text(encoding="utf-8") != text:
            shown = path.relative_to(ROOT)
            raise SystemExit(f"{shown} differs from muslin.h; to write it again: {COMMAND}")


def check_names(given: h.Header) -> None:
    """Fails if a table of this file names a field that the header does not have."""
    fields = {f"{struct.name}.{one.name}" for struct in given.structs for one in struct.fields}
    for name in [*CHOOSING, *FLAGS, *REWORDED]:
        if name not in fields:
            raise SystemExit(f"generate.py names {name}, which muslin.h does not have")


def opening(about: str) -> str:
    return f'"""{about}\n\nGenerated from include/muslin.h. To write it again: {COMMAND}\n"""\n\n'


def constants(given: h.Header) -> str:
    """Returns constants.py: statuses, numbers, and the names of choices with their numbers."""
    out = opening("Statuses, numbers and names.")
    out += "from enum import IntEnum\nfrom typing import Final, Literal\n\n\n"
    out += 'class Status(IntEnum):\n    """Why a call was refused."""\n\n'
    for one in given.statuses:
        out += f"    {one.name.removeprefix('MUSLIN_STATUS_')} = {one.value}\n"
        out += docstring(python_words(one.comment), 4)
    out += "\n"
    left = {one.name.removeprefix("MUSLIN_"): one for one in given.constants}
    for name in NUMBERS:
        value = left.pop(name).value
        out += f"\n{name}: Final = {value if value < 0x1_0000 else hex(value)}"
    out += "\n"
    for prefix, (kind, table) in CHOICES.items():
        own = [name for name in left if name.startswith(prefix + "_")]
        values = {choice(name): left.pop(name).value for name in own}
        words = ", ".join(f'"{name}"' for name in values)
        out += "\n" + wrapped(f"{kind} = Literal[", words, "]")
        pairs = ", ".join(f'"{name}": {value}' for name, value in values.items())
        out += wrapped(f"{table}: Final[dict[{kind}, int]] = {{", pairs, "}")
    if left:
        raise SystemExit(f"generate.py does not know these constants: {', '.join(left)}")
    return out


def choice(name: str) -> str:
    """Returns the name in Python of a constant that is one of several values, such as
    "top-edge"."""
    prefix = next(prefix for prefix in CHOICES if name.startswith(prefix + "_"))
    return name.removeprefix(prefix + "_").lower().replace("_", "-")


def structs(given: h.Header) -> str:
    """Returns structs.py: the ctypes structs."""
    used = {TYPES[one.type] for s in given.structs for one in s.fields if one.type in TYPES}
    out = opening("Structs of the C library, by their names in C.")
    used |= {"Array", "Structure", "c_void_p"}
    out += wrapped("from ctypes import (", ", ".join(sorted(used)), ")")
    out += "\nfrom .constants import STAGE_SLOTS\n"
    for struct in given.structs:
        out += f"\n\nclass {struct.name}(Structure):\n"
        for one in struct.fields:
            out += f"    {one.name}: {annotation(one)}\n"
        pairs = ", ".join(f'("{one.name}", {c_type(one)})' for one in struct.fields)
        out += wrapped("    _fields_ = [", pairs, "]")
    return out


def annotation(one: h.Field) -> str:
    if one.is_pointer:
        return "int | None"
    if one.length:
        return "Array[c_float]" if one.type == "float" else unknown(one.type)
    if one.type in TYPES:
        return "float" if one.type in ("float", "double") else "int"
    return one.type


def c_type(one: h.Field) -> str:
    if one.is_pointer:
        return "c_void_p"
    name = by_value(one.type)
    return f"{name} * {one.length.removeprefix('MUSLIN_')}" if one.length else name


def by_value(c_type: str) -> str:
    """Returns the type in ctypes of a number, struct or function."""
    return TYPES.get(c_type) or (c_type if c_type.startswith("Muslin") else unknown(c_type))


def unknown(c_type: str) -> str:
    raise SystemExit(f"generate.py does not know the type {c_type!r}")


def functions(given: h.Header) -> str:
    """Returns functions.py: the result and the parameters of every function."""
    used = sorted({t for f in given.functions for p in f.parameters for t in structs_of(p)})
    out = opening("Functions of the C library.")
    numbers = "c_char_p, c_float, c_size_t, c_uint32, c_void_p"
    out += wrapped("from ctypes import (", f"CDLL, CFUNCTYPE, POINTER, {numbers}", ")")
    out += "from typing import Any, Callable, Final\n\n"
    out += wrapped("from .structs import (", ", ".join(used), ")")
    out += "\nMuslinLogFn = CFUNCTYPE(None, c_uint32, c_char_p, c_void_p)\n\n"
    out += "# Name, type of the result (None: a status), types of the parameters. Pointers to\n"
    out += "# numbers are c_void_p, which takes addresses and byref().\n"
    out += "_SIGNATURES: Final[list[tuple[str, Any, list[Any]]]] = [\n"
    for one in given.functions:
        results = {"MuslinStatus": "None", "char *": "c_char_p", **TYPES}
        result = results.get(one.result) or unknown(one.result)
        parameters = ", ".join(parameter(p) for p in one.parameters)
        out += wrapped(f'    ("{one.name}", {result}, [', parameters, "]),")
    out += "]\n\nNAMES: Final = [name for name, _, _ in _SIGNATURES]\n\n\n"
    out += "def declare(library: CDLL, check: Callable[[int, Any, Any], int]) -> None:\n"
    about = "Sets the types of all functions. `check` receives each status that one returns."
    out += docstring(about, 4)
    out += "    for name, result, parameters in _SIGNATURES:\n"
    out += "        function = getattr(library, name)\n"
    out += "        function.argtypes = parameters\n"
    out += "        function.restype = c_uint32 if result is None else result\n"
    out += "        if result is None:\n"
    out += "            function.errcheck = check\n"
    return out


def structs_of(parameter_type: str) -> list[str]:
    name = parameter_type.rstrip(" *")
    return [name] if name.startswith("Muslin") and name != "MuslinLogFn" else []


def parameter(c_type: str) -> str:
    name = c_type.rstrip(" *")
    if not c_type.endswith("*"):
        return by_value(name)
    return f"POINTER({name})" if name.startswith("Muslin") else "c_void_p"


def records(given: h.Header, library: dict[str, Any]) -> str:
    """Returns records.py: the public dataclasses."""
    out = opening("Settings and reports as dataclasses.")
    names = sorted({CHOICES[prefix][0] for prefix in CHOOSING.values()})
    tables = sorted({CHOICES[prefix][1] for prefix in CHOOSING.values()})
    out += "from dataclasses import dataclass\nfrom typing import ClassVar\n\n"
    out += "from .._convert import Vec3\n"
    out += "from .._record import FLAG, NUMBER, STAGES, VECTOR, WHOLE, Kind, Record, choice\n"
    out += wrapped("from .constants import ", ", ".join(tables + names), "")
    out += wrapped("from .structs import (", ", ".join(sorted(RECORDS)), ")")
    for name, init in RECORDS.items():
        out += record(given, name, init, library)
    return out


def record(given: h.Header, name: str, init: str | None, library: dict[str, Any]) -> str:
    """Returns the dataclass of a struct."""
    struct = given.struct(name)
    fields = [one for one in struct.fields if one.name not in LEFT_OUT]
    out = "\n\n@dataclass(frozen=True, kw_only=True)\n"
    out += f"class {RENAMED.get(struct.name, struct.name.removeprefix('Muslin'))}(Record):\n"
    out += docstring(python_words(struct.comment), 4)
    out += f"\n    _struct: ClassVar = {struct.name}\n"
    if init:
        out += f'    _init: ClassVar = "{init}"\n'
    pairs = ", ".join(f'"{one.name}": {kind(struct, one)[0]}' for one in fields)
    out += wrapped("    _kinds: ClassVar[dict[str, Kind]] = {", pairs, "}") + "\n"
    default = library[init](struct.name) if init else None
    for one in fields:
        value = ""
        if default:
            value = f" = {literal(given, struct, one, getattr(default, one.name))}"
        out += f"    {one.name}: {kind(struct, one)[1]}{value}\n"
        name = f"{struct.name}.{one.name}"
        comment = FLAGS.get(name) or REWORDED.get(name) or one.comment
        if name in CHOOSING:
            comment += values_of(given, CHOOSING[name])
        out += docstring(python_words(comment), 4)
    return out


def kind(struct: h.Struct, one: h.Field) -> tuple[str, str]:
    """Returns how a field is converted, and its type in Python."""
    name = f"{struct.name}.{one.name}"
    if name in CHOOSING:
        kind, table = CHOICES[CHOOSING[name]]
        return f"choice({table})", kind
    if name in FLAGS:
        return "FLAG", "bool"
    if one.length == "MUSLIN_STAGE_SLOTS":
        return "STAGES", "dict[str, float]"
    by_type = {"float": ("NUMBER", "float"), "MuslinVec3": ("VECTOR", "Vec3")}
    whole = ("WHOLE", "int") if one.type in ("uint32_t", "uint64_t") else None
    return by_type.get(one.type) or whole or (unknown(one.type), "")


def values_of(given: h.Header, prefix: str) -> str:
    """Returns a list of the values of a choice, with the first sentences of their comments."""
    text = "\n"
    for constant in given.constants:
        if constant.name.startswith(f"MUSLIN_{prefix}_"):
            about = re.sub(r"^Value of `\w+`: ", "", constant.comment.split("\n")[0])
            about = about[:1].upper() + about[1:]
            text += f"\n- {quoted(constant.name)}: {about}"
    return text


def literal(given: h.Header, struct: h.Struct, one: h.Field, value: Any) -> str:
    """Returns a default as it is written in Python."""
    name = f"{struct.name}.{one.name}"
    if name in CHOOSING:
        prefix = CHOOSING[name]
        own = [c for c in given.constants if c.name.startswith(f"MUSLIN_{prefix}_")]
        return quoted(next(c.name for c in own if c.value == value))
    if name in FLAGS:
        return repr(bool(value))
    if one.type == "MuslinVec3":
        return repr((shortest(value.x), shortest(value.y), shortest(value.z)))
    return repr(shortest(value)) if one.type == "float" else repr(value)


def shortest(value: float) -> float:
    """Returns the number with the fewest digits that is `value` as a 32-bit float."""
    for digits in range(1, 10):
        short = float(f"{value:.{digits}g}")
        if ctypes.c_float(short).value == value:
            return short
    return value


def load(files: dict[str, str]) -> dict[str, Any]:
    """Returns functions that fill the structs of structs.py with the library's defaults."""
    library = ctypes.CDLL(os.environ["MUSLIN_LIBRARY"])
    names: dict[str, Any] = {}
    for file in ["constants.py", "structs.py"]:
        text = re.sub(r"from \.constants import .*\n", "", files[file])
        exec(compile(text, file, "exec"), names)

    def filled(init: str) -> Any:
        def fill(struct: str) -> Any:
            value = names[struct]()
            if getattr(library, init)(ctypes.byref(value), ctypes.sizeof(value)) != 0:
                raise SystemExit(f"{init} failed; is the library of another version?")
            return value

        return fill

    return {init: filled(init) for init in RECORDS.values() if init}


def python_words(comment: str) -> str:
    """Returns a comment with the names of Python in place of those of C."""
    kept = []
    for line in comment.split("\n"):
        # Initialisation and sizes of structs concern C only.
        sentences = [s for s in re.split(r"(?<=\.) (?=[A-Z])", line) if "_init" not in s]
        kept.append(" ".join(sentences))
    text = "\n".join(kept)
    text = re.sub(r"\bMUSLIN_(WIND|SELF_COLLISION)_(\w+)", lambda m: quoted(m[0]), text)
    text = text.replace("is NULL, out of range", "is missing, out of range")
    text = re.sub(r"\bmuslin_last_error\(\) returns a message", "the message", text)
    text = re.sub(r"\bmuslin_cloth_destroy\b", "`Cloth.close`", text)
    text = re.sub(r"\bmuslin_cloth_get_(\w+)", r"`Cloth.\1`", text)
    text = re.sub(r"\bmuslin_cloth_(\w+)", r"`Cloth.\1`", text)
    text = re.sub(r"(?<!`)\bMuslin([A-Z]\w+)", r"`\1`", text)
    return re.sub(r"\n{3,}", "\n\n", text).strip()


def quoted(name: str) -> str:
    return f'"{choice(name.removeprefix("MUSLIN_"))}"'


def docstring(text: str, indent: int) -> str:
    """Returns a docstring, with lines that are short enough."""
    if not text:
        return ""
    space = " " * indent
    if "\n" not in text and len(text) + indent + 6 <= WIDTH:
        return f'{space}"""{text}"""\n'
    lines: list[str] = []
    if "\n" not in text and len(text) + indent + 3 <= WIDTH:
        return f'{space}"""{text}\n{space}"""\n'
    for at, line in enumerate(text.split("\n")):
        first, more = ("- ", "  ") if line.startswith("- ") else ("", "")
        width = WIDTH - (3 if at == 0 else 0)
        line = line.removeprefix("- ")
        lines += textwrap.wrap(
            line, width, initial_indent=space + first, subsequent_indent=space + more
        ) or [""]
    return f'{space}"""{lines[0].strip()}\n' + "\n".join(lines[1:]) + f'\n{space}"""\n'


def wrapped(start: str, items: str, end: str) -> str:
    """Returns `start items end` on one line, or with the items on lines of their own."""
    one = f"{start}{items}{end}"
    if start.endswith("import (") and len(one) <= WIDTH + 2:
        return f"{start[:-1]}{items}\n"
    if len(one) <= WIDTH:
        return one + "\n"
    space = " " * (len(start) - len(start.lstrip()) + 4)
    # An entry stays on one line.
    items = re.sub(r": |(?<=\w\"), (?=c_|Muslin)| \* ", lambda m: m[0].replace(" ", "\0"), items)
    lines = textwrap.wrap(
        items + ",", WIDTH, initial_indent=space, subsequent_indent=space, break_long_words=False
    )
    return start + "\n" + "\n".join(lines).replace("\0", " ") + "\n" + space[4:] + end + "\n"


if __name__ == "__main__":
    main()
