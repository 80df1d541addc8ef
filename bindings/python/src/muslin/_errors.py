"""The error of every refused call."""

from __future__ import annotations

import re

from ._generated.constants import Status

_FIELD = re.compile(r"^`([^`]+)` must (.*)$", re.S)


class Error(Exception):
    """A call was refused. It changed nothing: neither the cloth nor arrays of the caller.

    The text names the field and the rule, such as "`settings.tick` must be above 0 and at most 1".
    """

    status: Status
    """Why the call was refused."""
    field: str | None
    """The field or argument that broke a rule, such as "settings.tick"; None if it is no field."""
    rule: str
    """What `field` must do, such as "be above 0 and at most 1"; without a field, the whole text."""

    def __init__(self, status: Status, message: str) -> None:
        # With these arguments, errors can be pickled and sent to other processes.
        super().__init__(status, message)
        match = _FIELD.match(message)
        self.status = Status(status)
        self.field, self.rule = (match[1], match[2]) if match else (None, message)

    def __str__(self) -> str:
        return str(self.args[1])


def bad_value(field: str, rule: str) -> Error:
    """Returns the error "`field` must rule"."""
    return Error(Status.BAD_VALUE, f"`{field}` must {rule}")
