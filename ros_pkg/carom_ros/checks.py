# SPDX-License-Identifier: Apache-2.0
"""Checks of single values, each raising Refusal with field, value, rule and remedy."""

import difflib
import math
import re
from collections.abc import Iterable, Sequence

import carom
from carom_ros import limits
from carom_ros.refusal import Refusal

_NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]*\Z")


def number(value: object, field: str, limit: float, unit: str) -> float:
    """A finite number of magnitude at most `limit`."""
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        raise Refusal(field, value, f"must be a number in {unit or 'plain units'}")
    try:
        result = float(value)
    except OverflowError:
        result = math.inf
    if not math.isfinite(result):
        raise Refusal(field, result, "must be finite")
    if abs(result) > limit:
        raise Refusal(field, f"{result:.4g} {unit}", f"must be at most {limit:g} {unit} in size")
    return result


def vector(value: object, field: str, limit: float, unit: str) -> tuple[float, float, float]:
    """Three finite numbers, from a list of three or from a message with x, y and z."""
    parts: Sequence[object]
    if all(hasattr(value, axis) for axis in "xyz"):
        parts = (value.x, value.y, value.z)
    elif isinstance(value, (list, tuple)) and len(value) == 3:
        parts = value
    else:
        raise Refusal(field, value, f"must be three numbers in {unit}", "write [x, y, z]")
    return tuple(
        number(part, f"{field}.{axis}", limit, unit)
        for axis, part in zip("xyz", parts, strict=True)
    )


def orientation(value: object, field: str) -> tuple[float, float, float, float]:
    """A unit quaternion (x, y, z, w), normalised; refuses zero and what is far from unit."""
    parts = [number(getattr(value, axis), f"{field}.{axis}", 1e9, "") for axis in "xyzw"]
    norm = math.sqrt(math.fsum(part * part for part in parts))
    if norm == 0:
        raise Refusal(field, "0 0 0 0", "must not be zero", "no rotation is x 0 y 0 z 0 w 1")
    unit = tuple(part / norm for part in parts)
    if abs(norm - 1) > limits.QUATERNION_NORM:
        remedy = "send " + " ".join(
            f"{axis} {part:.4g}" for axis, part in zip("xyzw", unit, strict=True)
        )
        raise Refusal(field, f"norm {norm:.4g}", "must be a unit quaternion", remedy)
    return unit


def size(value: object, field: str) -> float:
    """A length of a shape: > 0 and within what the physics can do."""
    result = number(value, field, limits.SIZE_MAX_M, "m")
    if not result > 0:
        raise Refusal(field, f"{result:.4g} m", "must be > 0", "scale is the full size in metres")
    if result < limits.SIZE_MIN_M:
        raise Refusal(field, f"{result:.4g} m", f"must be at least {limits.SIZE_MIN_M:g} m")
    return result


def body_name(value: object, field: str) -> str:
    """A name that can stand in topic names."""
    if not isinstance(value, str) or not _NAME.match(value):
        raise Refusal(
            field,
            value,
            "must be letters, digits and underscores, a letter first",
            "for example crate_1",
        )
    if len(value) > limits.NAME_CHARACTERS:
        raise Refusal(field, value, f"must have at most {limits.NAME_CHARACTERS} characters")
    return value


def require_scene_in_limits(scene: carom.Scene) -> None:
    """Of a scene sent over ~/scene what Markers are held to as well. @throws Refusal"""
    for row, body in enumerate(scene.bodies):
        at = f"bodies[{row}]"
        if len(body.name) > limits.NAME_CHARACTERS:
            rule = f"must have at most {limits.NAME_CHARACTERS} characters"
            raise Refusal(f"{at}.name", body.name, rule, "topic names are built from it")
        for field, limit, unit in (
            ("position", limits.COORDINATE_M, "m"),
            ("velocity", limits.SPEED_M_S, "m/s"),
            ("angular_velocity", limits.SPIN_RAD_S, "rad/s"),
        ):
            vector(getattr(body, field).tolist(), f"{at}.{field}", limit, unit)
        if not body.static:
            number(body.mass_properties.mass, f"{at}.mass", limits.MASS_MAX_KG, "kg")
    for row, effect in enumerate(scene.effects):
        if isinstance(effect, carom.UniformGravity):
            at = f"effects[{row}].acceleration"
            vector(effect.acceleration.tolist(), at, limits.ACCELERATION, "m/s^2")


def nearest(word: str, known: Iterable[str]) -> str:
    """The remedy for a word that is not known: the nearest that is, or all of them."""
    options = sorted(known)
    close = difflib.get_close_matches(str(word), options, n=1)
    if close:
        return f"did you mean {close[0]}?"
    if not options:
        return "there are none"
    more = f" and {len(options) - 12} more" if len(options) > 12 else ""
    return f"known: {', '.join(options[:12])}{more}"
