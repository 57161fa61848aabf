# SPDX-License-Identifier: Apache-2.0
"""What can go wrong with input, said so that it can be put right."""

from __future__ import annotations

import difflib
import os
from collections.abc import Iterable
from typing import IO, Any


class InvalidInput(ValueError):
    """Input that cannot be used, refused before anything changes.

    The message names the field, the value with its unit, the rule it breaks and what to do instead,
    as in "crate.mass: -2 kg, must be > 0; give density or set static".
    """

    def __init__(self, field: str, value: str, rule: str, remedy: str = "") -> None:
        super().__init__(f"{field}: {value}, {rule}" + (f"; {remedy}" if remedy else ""))
        self.field = field
        self.value = value
        self.rule = rule
        self.remedy = remedy

    def __reduce__(self) -> tuple[type, tuple[str, str, str, str]]:
        return type(self), (self.field, self.value, self.rule, self.remedy)


class MissingDependency(ImportError):
    """An optional package is not installed; the message holds the line that installs it."""

    def __init__(self, purpose: str, package: str, extra: str) -> None:
        super().__init__(f"{purpose} needs {package}: pip install 'carom[{extra}]'", name=package)


def writable(path: str | os.PathLike[str], field: str, mode: str, **options: Any) -> IO[Any]:
    """The file, open for writing. Raises InvalidInput naming `field` where that cannot be."""
    try:
        return open(path, mode, **options)  # noqa: PTH123  # any path-like
    except OSError as error:
        raise InvalidInput(field, str(path), f"must be writable ({error.strerror})") from error


def nearest(name: str, names: Iterable[str]) -> str:
    """A remedy: the valid name closest to `name`, or all of them where they are few."""
    valid = list(names)
    close = difflib.get_close_matches(name, valid, n=1)
    if close:
        return f"did you mean {close[0]}?"
    return "valid: " + ", ".join(valid) if 0 < len(valid) <= 20 else ""
