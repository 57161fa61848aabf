# SPDX-License-Identifier: Apache-2.0
"""Names and types of a bound function's arguments, read from the signature pybind11 writes.

Scene files take the arguments of the constructors as their keys. Reading them here keeps the
binding the one place that lists them: a new shape or effect can be written in a file at once.
"""

from __future__ import annotations

import functools
import re
from typing import Any, NamedTuple


class Parameter(NamedTuple):
    kind: str
    """The annotation, as written."""
    required: bool


def parameters(cls_or_function: Any) -> dict[str, Parameter]:
    """Arguments by name, in order; empty where the signature tells none."""
    function = cls_or_function.__init__ if isinstance(cls_or_function, type) else cls_or_function
    return _parse(function.__doc__ or "")


@functools.cache
def _parse(doc: str) -> dict[str, Parameter]:
    _, _, arguments = doc.partition(") ->")[0].partition("(")
    found = (re.match(r"\s*(\w+): ([^=]+)(=?)", part) for part in _split(arguments))
    return {m[1]: Parameter(m[2].strip(), not m[3]) for m in found if m and m[1] != "self"}


def _split(text: str) -> list[str]:
    """At commas that are not inside brackets."""
    parts, depth, start = [], 0, 0
    for i, char in enumerate(text):
        depth += (char in "[(") - (char in "])")
        if char == "," and depth == 0:
            parts.append(text[start:i])
            start = i + 1
    return [*parts, text[start:]]
