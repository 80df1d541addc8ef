"""Reads the C header: constants, enums, structs and functions, with their comments.

The header is written by cbindgen in one style, which this reader relies on; `read` fails on a
declaration that it does not understand.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from pathlib import Path


@dataclass
class Constant:
    """A `#define` or an enumerator."""

    name: str
    value: int
    comment: str


@dataclass
class Field:
    """A field of a struct. `type` is its C type without `const`; `length` is that of an array."""

    name: str
    type: str
    length: str | None
    comment: str

    @property
    def is_pointer(self) -> bool:
        return self.type.endswith("*")


@dataclass
class Struct:
    """A struct and its fields in order."""

    name: str
    comment: str
    fields: list[Field] = field(default_factory=list)


@dataclass
class Function:
    """A function: its result, and the types and names of its parameters."""

    name: str
    result: str
    parameters: list[str]
    names: list[str]
    comment: str


@dataclass
class Header:
    """All declarations of the header."""

    constants: list[Constant] = field(default_factory=list)
    statuses: list[Constant] = field(default_factory=list)
    structs: list[Struct] = field(default_factory=list)
    functions: list[Function] = field(default_factory=list)
    log_comment: str = ""
    """The comment of MuslinLogFn."""

    def struct(self, name: str) -> Struct:
        """Returns the struct of this name."""
        return next(struct for struct in self.structs if struct.name == name)


COMMENT = re.compile(r"/\*\*(.*?)\*/\s*", re.S)
DEFINE = re.compile(r"#define (MUSLIN_\w+) (\w+)\s*")
ENUM = re.compile(r"typedef enum MuslinStatus \{(.*?)\} MuslinStatus;\s*", re.S)
STRUCT = re.compile(r"typedef struct (\w+) \{(.*?)\} \1;\s*", re.S)
CALLBACK = re.compile(
    r"typedef void \(\*MuslinLogFn\)\(uint32_t level, const char \*message, void \*user\);\s*"
)
FUNCTION = re.compile(r"((?:const )?\w+ \*?)(muslin_\w+)\(([^)]*)\);\s*")
MEMBER = re.compile(r"((?:const )?\w+ \*?)(\w+)(?:\[(\w+)\])?;\s*")
ENUMERATOR = re.compile(r"(\w+) = (\d+),\s*")
PREPROCESSOR = re.compile(r"#.*\n\s*|extern \"C\" \{\s*|\}  // extern \"C\"\s*")


def read(path: Path) -> Header:
    """Reads a header up to its inline functions."""
    text = path.read_text(encoding="utf-8").split("/* Initialise a struct:")[0]
    text = text[text.index("#pragma once") :]
    header, numbers = Header(), {"UINT32_MAX": 0xFFFF_FFFF}
    for comment, match in declarations(text, [DEFINE, ENUM, STRUCT, CALLBACK, FUNCTION]):
        if match.re is DEFINE:
            value = numbers[match[2]] if match[2] in numbers else int(match[2])
            header.constants.append(Constant(match[1], value, comment))
        elif match.re is ENUM:
            for note, one in declarations(match[1], [ENUMERATOR]):
                header.statuses.append(Constant(one[1], int(one[2]), note))
        elif match.re is STRUCT:
            members = declarations(match[2], [MEMBER])
            fields = [Field(one[2], plain(one[1]), one[3], note) for note, one in members]
            header.structs.append(Struct(match[1], comment, fields))
        elif match.re is CALLBACK:
            header.log_comment = comment
        elif match.re is FUNCTION:
            given = [] if match[3] == "void" else match[3].split(",")
            parameters = [plain(re.sub(r"\w+$", "", one.strip())) for one in given]
            names = [one.split()[-1].lstrip("*") for one in given]
            function = Function(match[2], plain(match[1]), parameters, names, comment)
            header.functions.append(function)
    return header


def declarations(text: str, forms: list[re.Pattern[str]]) -> list[tuple[str, re.Match[str]]]:
    """Returns the declarations of these forms, each with the comment before it."""
    found, comment, at = [], "", len(text) - len(text.lstrip())
    while at < len(text):
        if match := COMMENT.match(text, at):
            comment = prose(match[1])
        elif match := next(filter(None, (form.match(text, at) for form in forms)), None):
            found.append((comment, match))
            comment = ""
        else:
            match = PREPROCESSOR.match(text, at)
            if match is None:
                raise SystemExit(
                    f"muslin.h has an unknown kind of declaration: {text[at : at + 60]!r}"
                )
        at = match.end()
    return found


def plain(c_type: str) -> str:
    """Returns a C type without `const`, as in "float *"."""
    return c_type.replace("const ", "").strip()


def prose(comment: str) -> str:
    """Returns a comment without its stars; paragraphs and items of lists are lines of their own."""
    lines = [re.sub(r"^\s*\*? ?", "", line).rstrip() for line in comment.strip().splitlines()]
    out: list[str] = []
    for line in lines:
        is_new = not out or not line or line.startswith("- ") or not out[-1]
        if is_new:
            out.append(line)
        else:
            out[-1] += " " + line.strip()
    return "\n".join(out)
