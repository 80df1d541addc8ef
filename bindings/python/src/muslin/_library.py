"""Loads the C library, declares its functions, and turns statuses into errors."""

from __future__ import annotations

import atexit
import ctypes
import os
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any, Final

from ._convert import to_choice
from ._errors import Error, bad_value
from ._generated.constants import LOG_LEVELS, LogLevel, Status
from ._generated.functions import MuslinLogFn, declare

_NAMES: Final = {"win32": "muslin.dll", "darwin": "libmuslin.dylib"}

# Statuses that are answers, not errors.
_ANSWERS: Final = (Status.OK, Status.NOTHING_HIT, Status.NOT_TORN)

# Numbers that C programs pass, and what they are in Python.
_LENGTHS: Final = {
    "`pair_count`": "`len(pairs)`",
    "`pinned_count`": "`len(pinned)`",
    "`vertex_count`": "`len(positions)`",
    "`index_count`": "`indices.size`",
}
# The array whose rows `count` counts, where it is not `particles`.
_COUNTED: Final = {
    "muslin_cloth_set_positions": "positions",
    "muslin_cloth_set_velocities": "velocities",
    "muslin_cloth_update_collider": "positions",
}
# These have a `vertex_count` in Python too.
_WRITERS: Final = ("muslin_cloth_write_vertices", "muslin_skin_write_vertices")


def _check(status: int, function: Any, _arguments: object) -> int:
    """Returns a status that is an answer; raises `Error` with the library's message otherwise."""
    if status in _ANSWERS:
        return status
    name, message = function.__name__, lib.muslin_last_error().decode()
    if name not in _WRITERS:
        counted = _COUNTED.get(name, "particles")
        for number, length in {**_LENGTHS, "`count`": f"`len({counted})`"}.items():
            message = message.replace(number, length)
    raise Error(Status(status), message)


def _load() -> ctypes.CDLL:
    """Loads the library that the package contains, or the one that MUSLIN_LIBRARY names."""
    own = Path(__file__).with_name(_NAMES.get(sys.platform, "libmuslin.so"))
    library = ctypes.CDLL(os.environ.get("MUSLIN_LIBRARY") or str(own))
    declare(library, _check)
    return library


lib: Final = _load()
"""The functions of the C library. Those that return a status raise `Error` if it is an error.
A call releases the interpreter's lock, so that cloths on other threads go on."""

version: Final[str] = lib.muslin_version_string().decode()
"""Version of the C library, such as "0.1.0"."""


def init(struct: ctypes.Structure, function: str) -> None:
    """Sets size and defaults of a struct with an init function of the library."""
    getattr(lib, function)(ctypes.byref(struct), ctypes.sizeof(struct))


_log_handler: Callable[[LogLevel, str], None] | None = None
_LEVEL_NAMES: Final = {number: name for name, number in LOG_LEVELS.items()}


def _pass_on(level: int, message: bytes, _user: object) -> None:
    handler = _log_handler
    if handler is not None:
        handler(_LEVEL_NAMES[level], message.decode())


# One function for all handlers: the library may still call it when a handler was replaced.
_log: Final = MuslinLogFn(_pass_on)


def set_log(handler: Callable[[LogLevel, str], None] | None, max_level: LogLevel = "info") -> None:
    """Sends log messages up to `max_level` to `handler`; None, the initial value, switches the log
    off.

    - "error": a bug in Muslin interrupted a call.
    - "warn": a call was refused. The message is that of the `Error`.
    - "info": a cloth was created or destroyed.

    `handler` is called with a level and a message, on the thread of the call that it reports,
    perhaps on several threads at once. What it raises is printed and ignored.
    """
    global _log_handler
    if handler is not None and not callable(handler):
        raise bad_value("handler", "be a function or None")
    level = to_choice(max_level, "max_level", LOG_LEVELS)
    _log_handler = handler
    lib.muslin_set_log(_log if handler is not None else MuslinLogFn(), level, None)


def _stop_log() -> None:
    set_log(None)


# The interpreter cannot be called any more once it ends.
atexit.register(_stop_log)
