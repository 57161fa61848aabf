# SPDX-License-Identifier: Apache-2.0
"""Messages as plain values, YAML, CSV or JSON lines."""

import json
import math
import re
from collections.abc import Iterator

from carom_ros.checks import nearest
from carom_ros.refusal import Refusal

_PLAIN_TEXT = re.compile(r"[A-Za-z_/][\w/.-]*\Z")
_WORDS = {"true", "false", "null", "yes", "no", "on", "off", "y", "n", "nan", "inf"}
_STEP = re.compile(r"\.?([A-Za-z_]\w*)|\[(\d+)\]")


def plain(value: object) -> object:
    """A message, array or number as dicts, lists and Python's own numbers."""
    if hasattr(value, "get_fields_and_field_types"):
        return {name: plain(getattr(value, name)) for name in value.get_fields_and_field_types()}
    if isinstance(value, bytes):
        return list(value) if len(value) != 1 else value[0]
    if isinstance(value, (str, bool, int, float)):
        return value
    if hasattr(value, "tolist"):  # array.array and numpy arrays
        return value.tolist()
    return [plain(item) for item in value]


def pick(value: object, path: str) -> object:
    """The part of a message that a path such as poses[0].position.z names. @throws Refusal"""
    at = 0
    while at < len(path):
        step = _STEP.match(path, at)
        if not step:
            raise Refusal("field", path, "must be like poses[0].position.z")
        name, index = step.groups()
        at = step.end()
        if name is not None:
            known = getattr(value, "get_fields_and_field_types", dict)()
            if name not in known:
                raise Refusal("field", path, f"{name} is no field there", nearest(name, known))
            value = getattr(value, name)
        elif not hasattr(value, "__len__") or isinstance(value, str) or int(index) >= len(value):
            raise Refusal("field", path, f"there is no element [{index}]")
        else:
            value = value[int(index)]
    return value


def shorten(value: object, length: int | None, *, arrays: bool, texts: bool) -> object:
    """Cuts long arrays and texts after `length` items (None: never), or leaves them out."""
    if isinstance(value, dict):
        return {k: shorten(v, length, arrays=arrays, texts=texts) for k, v in value.items()}
    if isinstance(value, list):
        if not arrays:
            return f"<sequence, length {len(value)}>"
        cut = value if length is None else value[:length]
        items = [shorten(item, length, arrays=arrays, texts=texts) for item in cut]
        return [*items, "..."] if len(cut) < len(value) else items
    if isinstance(value, str):
        if not texts:
            return f"<string length {len(value)}>"
        return value if length is None or len(value) <= length else value[:length] + "..."
    return value


def to_yaml(value: object, indent: str = "") -> Iterator[str]:
    """Lines of block YAML, fields in the message's order."""
    if isinstance(value, dict) and value:
        for key, item in value.items():
            if isinstance(item, (dict, list)) and item:
                yield f"{indent}{key}:"
                yield from to_yaml(item, indent + ("  " if isinstance(item, dict) else ""))
            else:
                yield f"{indent}{key}: {_scalar(item)}"
    elif isinstance(value, list) and value:
        for item in value:
            lines = list(to_yaml(item, indent + "  "))
            yield f"{indent}- {lines[0].lstrip()}"
            yield from lines[1:]
    else:
        yield f"{indent}{_scalar(value)}"


def to_flow(value: object) -> str:
    """The same as YAML in one line."""
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key}: {to_flow(item)}" for key, item in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(map(to_flow, value)) + "]"
    return _scalar(value)


def to_csv(value: object) -> str:
    """All leaves in order, separated by commas, texts quoted where they need it."""
    return ",".join(_csv_cell(leaf) for leaf in _leaves(value))


def to_json(value: object) -> str:
    """One line of JSON; NaN and infinities become null, as JSON has no such numbers."""
    return json.dumps(_finite(value), ensure_ascii=False)


def _finite(value: object) -> object:
    if isinstance(value, dict):
        return {key: _finite(item) for key, item in value.items()}
    if isinstance(value, list):
        return [_finite(item) for item in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


def _leaves(value: object) -> Iterator[object]:
    if isinstance(value, dict):
        value = list(value.values())
    if isinstance(value, list):
        for item in value:
            yield from _leaves(item)
    else:
        yield value


def _csv_cell(value: object) -> str:
    text = value if isinstance(value, str) else _scalar(value)
    return '"' + text.replace('"', '""') + '"' if any(c in text for c in ',"\n\r') else text


def _scalar(value: object) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float):
        if math.isnan(value):
            return ".nan"
        if math.isinf(value):
            return ".inf" if value > 0 else "-.inf"
        return repr(value)
    if isinstance(value, str):
        if _PLAIN_TEXT.match(value) and value.lower() not in _WORDS:
            return value
        if value.isprintable():
            return "'" + value.replace("'", "''") + "'"
        return json.dumps(value)
    if isinstance(value, dict):
        return "{}"
    return "[]" if isinstance(value, list) else str(value)
