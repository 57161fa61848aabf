# SPDX-License-Identifier: Apache-2.0
"""Fills a message from plain values, as `ros2 topic pub` does from its YAML.

Every value is checked against the field's type: rclpy itself sends an int in a double field, or a
text, as a garbage number. `auto` in a Header and `now` in a Time stand for the present.
"""

import math
from collections.abc import Mapping

from rosidl_parser.definition import (
    AbstractGenericString,
    AbstractNestedType,
    Array,
    BasicType,
    BoundedSequence,
    NamespacedType,
)

from carom_ros.checks import nearest
from carom_ros.refusal import Refusal
from carom_ros.topic.types import message_class

_INTEGERS = {
    **{f"int{bits}": (-(2 ** (bits - 1)), 2 ** (bits - 1) - 1) for bits in (8, 16, 32, 64)},
    **{f"uint{bits}": (0, 2**bits - 1) for bits in (8, 16, 32, 64)},
    "char": (0, 255),
}


def fill(msg: object, values: object, now: object = None, path: str = "") -> None:
    """Sets the fields named in `values`, a mapping or None. @throws Refusal naming the field.

    @param now  builtin_interfaces Time that `auto` and `now` stand for
    """
    if values is None:
        return
    if not isinstance(values, Mapping):
        raise Refusal(path or "values", values, "must be a mapping of fields", "{field: value}")
    kinds = dict(zip(msg.get_fields_and_field_types(), msg.SLOT_TYPES, strict=True))
    for name, value in values.items():
        if name not in kinds:
            where = f"{path}.{name}".lstrip(".")
            raise Refusal(where, value, f"is no field of {_name(msg)}", nearest(name, kinds))
        setattr(msg, name, _value(kinds[name], value, now, f"{path}.{name}".lstrip(".")))


def _value(kind: object, value: object, now: object, path: str) -> object:
    if isinstance(kind, AbstractNestedType):
        return _array(kind, value, now, path)
    if isinstance(kind, NamespacedType):
        return _message(kind, value, now, path)
    if isinstance(kind, AbstractGenericString):
        if not isinstance(value, str):
            raise Refusal(path, value, "must be text", f"quote it: '{value}'")
        limit = getattr(kind, "maximum_size", None)
        if limit is not None and len(value) > limit:
            raise Refusal(path, value, f"must have at most {limit} characters")
        return value
    return _basic(kind, value, path)


def _message(kind: NamespacedType, value: object, now: object, path: str) -> object:
    name = f"{kind.namespaces[0]}/{kind.name}"
    child = message_class(name)()
    if value == "auto" and name == "std_msgs/Header" and now is not None:
        child.stamp = now
    elif value == "now" and name == "builtin_interfaces/Time" and now is not None:
        return now
    else:
        fill(child, value, now, path)
    return child


def _array(kind: AbstractNestedType, value: object, now: object, path: str) -> object:
    if not isinstance(value, (list, tuple)):
        raise Refusal(path, value, "must be a list", "write [a, b, c]")
    if isinstance(kind, Array) and len(value) != kind.size:
        raise Refusal(path, f"{len(value)} values", f"must have {kind.size}")
    if isinstance(kind, BoundedSequence) and len(value) > kind.maximum_size:
        raise Refusal(path, f"{len(value)} values", f"must have at most {kind.maximum_size}")
    return [_value(kind.value_type, item, now, f"{path}[{row}]") for row, item in enumerate(value)]


def _basic(kind: BasicType, value: object, path: str) -> object:
    name = kind.typename
    if name == "boolean":
        if not isinstance(value, bool):
            raise Refusal(path, value, "must be true or false")
        return value
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        raise Refusal(path, value, f"must be a number ({name})")
    if name in ("float", "double", "long double"):
        try:
            result = float(value)
        except OverflowError:
            raise Refusal(path, value, f"is too large for a {name}") from None
        if name == "float" and math.isfinite(result) and abs(result) > 3.402823466e38:
            raise Refusal(path, value, "is too large for a float")
        return result
    if not isinstance(value, int):
        raise Refusal(path, value, f"must be a whole number ({name})")
    if name == "octet":
        if not 0 <= value <= 255:
            raise Refusal(path, value, "must be from 0 to 255 (octet)")
        return bytes([value])
    low, high = _INTEGERS[name]
    if not low <= value <= high:
        raise Refusal(path, value, f"must be from {low} to {high} ({name})")
    return value


def _name(msg: object) -> str:
    return f"{type(msg).__module__.split('.')[0]}/msg/{type(msg).__name__}"
