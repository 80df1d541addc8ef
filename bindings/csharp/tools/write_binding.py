"""Writes Muslin.cs from include/muslin.h, or fails where the two differ.

    python3 write_binding.py [--write]

Names, order and comments are those of the header. The inline functions of the header are
translated statement by statement.
"""

from __future__ import annotations

import re
import sys
import textwrap
from pathlib import Path
from xml.sax.saxutils import escape

ROOT = Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "bindings/python/tools"))

import header as h  # noqa: E402

TARGET = ROOT / "bindings/csharp/Muslin.cs"
COMMAND = "MUSLIN_BLESS=1 cargo xtask test csharp"
WIDTH = 100

TYPES = {
    "char": "byte",
    "double": "double",
    "float": "float",
    "int8_t": "sbyte",
    "size_t": "UIntPtr",
    "uint8_t": "byte",
    "uint32_t": "uint",
    "uint64_t": "ulong",
    "void": "void",
}

# Words of C# that the header uses as names.
KEYWORDS = {"base", "event", "fixed", "in", "lock", "object", "out", "params", "ref", "string"}

INLINE = re.compile(r"static inline (\w+) (muslin_\w+)\(([^)]*)\) \{\n(.*?)\n\}", re.S)

OPENING = f"""\
// The C library of Muslin for C#: every constant, struct and function of muslin.h by its own name.
//
// Generated from include/muslin.h. To write it again:
//   {COMMAND}
//
// The code is unsafe, as the library takes pointers. Structs are passed as they are, so a call
// allocates and copies nothing. Initialise each struct with its muslin_..._init function.

using System;
using System.Runtime.InteropServices;

namespace Muslin
{{
"""

CLASS = """\
    /// <summary>The functions and constants of the C library.</summary>
    public static unsafe class Native
    {
#if (UNITY_IOS || UNITY_TVOS || UNITY_VISIONOS) && !UNITY_EDITOR
        /// <summary>The program itself, which the static library is linked into.</summary>
        public const string LIBRARY = "__Internal";
#else
        /// <summary>The name of the shared library, without prefix and suffix.</summary>
        public const string LIBRARY = "muslin";
#endif

        /// <summary>Returns a text of the library, such as that of muslin_last_error.</summary>
        public static string Text(byte* text)
        {
            int length = 0;
            while (text[length] != 0) length++;
            return System.Text.Encoding.UTF8.GetString(text, length);
        }
"""


def main() -> None:
    text = binding(ROOT / "include/muslin.h")
    shown = TARGET.relative_to(ROOT)
    if "--write" in sys.argv[1:]:
        TARGET.write_text(text, encoding="utf-8")
    elif not TARGET.exists() or TARGET.read_text(encoding="utf-8") != text:
        raise SystemExit(f"{shown} differs from muslin.h; to write it again: {COMMAND}")


def binding(path: Path) -> str:
    """Returns the file of C#."""
    given = h.read(path)
    numbers = {one.name: one.value for one in given.constants}
    out = OPENING + enum(given) + log_function(given)
    out += "".join(struct(one, numbers) for one in given.structs)
    out += CLASS
    out += "".join(constant(one) for one in given.constants)
    out += "".join(function(one) for one in given.functions)
    out += inline_functions(path.read_text(encoding="utf-8"))
    return out + "    }\n}\n"


def enum(given: h.Header) -> str:
    out = summary("Result of a call.", 4) + "    public enum MuslinStatus\n    {\n"
    for one in given.statuses:
        out += summary(one.comment, 8)
        out += f"        {one.name.removeprefix('MUSLIN_STATUS_')} = {one.value},\n"
    return out + "    }\n\n"


def log_function(given: h.Header) -> str:
    """Returns the type of the function that receives log messages."""
    about = given.log_comment
    about += "\n\nKeep a reference to the delegate for as long as the library may call it."
    out = summary(about, 4) + "    [UnmanagedFunctionPointer(CallingConvention.Cdecl)]\n"
    parameters = "uint level, byte* message, void* user"
    return out + f"    public unsafe delegate void MuslinLogFn({parameters});\n\n"


def struct(one: h.Struct, numbers: dict[str, int]) -> str:
    is_unsafe = any(field.is_pointer or field.length for field in one.fields)
    out = summary(one.comment, 4) + "    [StructLayout(LayoutKind.Sequential)]\n"
    out += f"    public {'unsafe ' if is_unsafe else ''}struct {one.name}\n    {{\n"
    for field in one.fields:
        out += summary(field.comment, 8)
        kind, name = c_sharp(field.type), identifier(field.name)
        if field.length:
            out += (
                f"        public fixed {kind} {name}[{numbers.get(field.length, field.length)}];\n"
            )
        else:
            out += f"        public {kind} {name};\n"
    return out + "    }\n\n"


def constant(one: h.Constant) -> str:
    out = "\n" + summary(one.comment, 8)
    value = one.value if one.value < 0x1_0000 else f"0x{one.value:X}"
    return out + f"        public const uint {one.name} = {value};\n"


def function(one: h.Function) -> str:
    out = "\n" + summary(one.comment, 8)
    out += "        [DllImport(LIBRARY, CallingConvention = CallingConvention.Cdecl)]\n"
    pairs = zip(one.parameters, one.names, strict=True)
    parameters = [f"{c_sharp(kind)} {identifier(name)}" for kind, name in pairs]
    return out + declaration(
        f"public static extern {c_sharp(one.result)} {one.name}", parameters, ";"
    )


def declaration(start: str, parameters: list[str], end: str) -> str:
    """Returns a declaration on one line, or with one parameter on each line."""
    line = f"        {start}({', '.join(parameters)}){end}\n"
    if len(line) <= WIDTH:
        return line
    inner = ",\n".join(f"            {one}" for one in parameters)
    return f"        {start}(\n{inner}){end}\n"


def inline_functions(text: str) -> str:
    """Returns the inline functions of the header, translated statement by statement."""
    found = list(INLINE.finditer(text))
    if len(found) != text.count("static inline "):
        raise SystemExit("muslin.h has an inline function of an unknown form")
    out = ""
    for match in found:
        result, name, given, body = match.groups()
        parameters = []
        for one in given.split(","):
            word = one.split()[-1].lstrip("*")
            kind = h.plain(re.sub(r"\w+$", "", " ".join(one.split())))
            parameters.append(f"{c_sharp(kind)} {identifier(word)}")
        about = "Initialises a struct: its size and, if it has any, its defaults."
        if result != "void":
            about = "Returns a stream with all of its fields set."
        out += "\n" + summary(about, 8)
        out += declaration(f"public static {c_sharp(result)} {name}", parameters, "")
        out += "        {\n"
        for statement in " ".join(body.split()).split(";")[:-1]:
            line = statement.strip().replace("(void)", "").replace("(uint32_t)", "(uint)")
            line = line.replace("size_t", "UIntPtr")
            line = re.sub(r"\b(\w+)(?=->|\.|,|\)|$)", lambda m: identifier(m[1]), line)
            out += wrapped(f"            {line};") + "\n"
        out += "        }\n"
    return out


def wrapped(line: str) -> str:
    """Returns a call with its arguments on lines of their own where it is too long."""
    if len(line) <= WIDTH:
        return line
    call, arguments = line.split("(", 1)
    return "\n                ".join([f"{call}(", *arguments.replace(", ", ",\n").split("\n")])


def identifier(name: str) -> str:
    return f"@{name}" if name in KEYWORDS else name


def c_sharp(c_type: str) -> str:
    """Returns a type of C# for a type of C without `const`."""
    name = c_type.rstrip(" *")
    stars = c_type.count("*")
    if name not in TYPES and not name.startswith("Muslin"):
        raise SystemExit(f"write_binding.py does not know the type {c_type!r}")
    return TYPES.get(name, name) + "*" * stars


def summary(comment: str, indent: int) -> str:
    """Returns a comment as documentation of C#."""
    about, _, returned = comment.partition("@return")
    out = element("summary", about.strip(), indent)
    if returned:
        out += element("returns", returned.strip(), indent)
    return out


def element(tag: str, text: str, indent: int) -> str:
    prefix = " " * indent + "/// "
    one = f"{prefix}<{tag}>{escape(text)}</{tag}>\n"
    if "\n" not in text and len(one) <= WIDTH:
        return one
    lines = []
    for paragraph in escape(text).split("\n"):
        hanging = "  " if paragraph.startswith("- ") else ""
        width = WIDTH - len(prefix)
        lines += textwrap.wrap(
            paragraph, width, subsequent_indent=hanging, break_long_words=False
        ) or [""]
    body = "".join(f"{prefix}{line}".rstrip() + "\n" for line in lines)
    return f"{prefix}<{tag}>\n{body}{prefix}</{tag}>\n"


if __name__ == "__main__":
    main()
