"""Writes the reference of the Python package as Markdown: `python python.py SOURCES OUT`.

Griffe reads the sources without running them, so neither the C library nor NumPy is needed.
"""

import inspect
import re
import sys
from pathlib import Path

import griffe

PUBLIC = re.compile(r"(?!_)")


def main(sources: str, out: str) -> None:
    package = griffe.load("muslin", search_paths=[sources], resolve_aliases=True)
    names = [name for name in package.exports or [] if not str(name).startswith("__")]
    members = {str(name): target(package[str(name)]) for name in names}
    missing = [name for name, member in members.items() if not member]
    if missing or "Cloth" not in members:
        sys.exit(f"griffe does not find {missing or 'Cloth'} in {sources}")
    folder = Path(out)
    folder.mkdir(parents=True, exist_ok=True)
    classes = {name: one for name, one in members.items() if one.is_class and name != "Cloth"}
    others = {name: one for name, one in members.items() if not one.is_class}
    lines = ["# The Python package", "", text(package), ""]
    lines += ["| page | content |", "| --- | --- |", "| [Cloth](cloth.md) | the cloth |"]
    lines += [f"| [Classes](classes.md) | {', '.join(f'`{name}`' for name in classes)} |"]
    lines += [f"| [Functions and names](names.md) | {', '.join(f'`{name}`' for name in others)} |"]
    write(folder / "index.md", lines)
    write(folder / "cloth.md", ["# Python: Cloth", "", *class_lines(members["Cloth"], 2)])
    lines = ["# Python: classes", ""]
    for name, one in classes.items():
        lines += [f"## {name}", "", *class_lines(one, 3)]
    write(folder / "classes.md", lines)
    lines = ["# Python: functions and names", ""]
    for name, one in others.items():
        lines += [f"## {name}", "", *code(declaration(name, one)), text(one), ""]
    write(folder / "names.md", lines)


def target(member: griffe.Object | griffe.Alias) -> griffe.Object:
    return member.final_target if member.is_alias else member


def class_lines(one: griffe.Object, level: int) -> list[str]:
    """The text of a class and its public members; inherited ones in the order of its bases."""
    bases = [base for base in one.mro() if base.path.startswith("muslin.")]
    lines = [text(one), ""]
    seen = set()
    for owner in [one, *bases]:
        for name, member in owner.members.items():
            member = target(member) if not member.is_alias else member
            if not PUBLIC.match(name) or member.is_alias:
                continue
            is_shown = member.docstring or member.is_attribute and member.annotation
            if not is_shown or name in seen:
                continue
            seen.add(name)
            heading = f"{'#' * level} {name} {{#{one.name}.{name}}}"
            lines += [heading, "", *code(declaration(name, member)), text(member), ""]
    return lines


def declaration(name: str, member: griffe.Object) -> str:
    """The code that declares a member, without its body."""
    if member.is_function:
        parameters = [str(parameter) for parameter in signature(member)]
        start, end = f"def {name}(", f") -> {member.returns or 'None'}"
        line = f"{start}{', '.join(parameters)}{end}"
        kinds = [kind for kind in ("classmethod", "staticmethod") if kind in member.labels]
        start = "".join(f"@{kind}\n" for kind in kinds) + start
        if len(line) <= 88:
            return line if not kinds else f"@{kinds[0]}\n{line}"
        return "\n".join([start, *(f"    {parameter}," for parameter in parameters), end])
    if "property" in member.labels:
        is_writable = "writable" in member.labels
        return f"{name}: {member.annotation}  # {'property' if is_writable else 'read-only'}"
    kind = f": {member.annotation}" if member.annotation else ""
    value = f" = {member.value}" if member.value is not None else ""
    return f"{name}{kind}{value}"


def signature(member: griffe.Function) -> list[str]:
    shown = []
    has_star = False
    for one in member.parameters:
        if one.name in ("self", "cls"):
            continue
        star = {griffe.ParameterKind.var_positional: "*", griffe.ParameterKind.var_keyword: "**"}
        if one.kind is griffe.ParameterKind.keyword_only and not has_star:
            shown.append("*")
        has_star |= one.kind in (griffe.ParameterKind.keyword_only, griffe.ParameterKind.var_positional)
        kind = f": {one.annotation}" if one.annotation else ""
        has_default = one.default is not None and one.kind not in star
        default = f" = {one.default}" if has_default else ""
        shown.append(f"{star.get(one.kind, '')}{one.name}{kind}{default}")
    return shown


def code(declared: str) -> list[str]:
    return ["```python", declared, "```", ""]


def text(member: griffe.Object) -> str:
    """The docstring as Markdown: what Markdown would read as markup stays, but for code."""
    if not member.docstring:
        return ""
    blocks = re.split(r"((?:^(?: {4}.*)?\n)* {4}.*$)", inspect.cleandoc(member.docstring.value), flags=re.M)
    return "\n".join(
        "\n".join(["", *code(inspect.cleandoc(block))]) if at % 2 else prose(block)
        for at, block in enumerate(blocks)
    )


def prose(block: str) -> str:
    return "\n".join(escaped(line) for line in block.strip("\n").split("\n"))


def escaped(line: str) -> str:
    bullet = re.match(r"\s*- ", line)
    start = bullet.group() if bullet else ""
    parts = re.split(r"(`[^`]*`)", line[len(start) :])
    return start + "".join(
        part if part.startswith("`") else re.sub(r"[\[\]<*]", lambda sign: "\\" + sign.group(), part)
        for part in parts
    )


def write(path: Path, lines: list[str]) -> None:
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


main(*sys.argv[1:])
