# SPDX-License-Identifier: Apache-2.0
"""What a Marker cannot say, as YAML in its `text`."""

from carom_ros import checks, limits, strict_yaml
from carom_ros.refusal import Refusal
from carom_ros.requests import Vector

EXAMPLE = "{name: crate, mass: 2, friction: 0.5}"
_PLAIN = ("mass", "density", "friction", "restitution", "ccd")
KEYS = ("name", *_PLAIN, "velocity", "angular_velocity", "static", "frames")


def parse(text: str) -> dict[str, object]:
    """Checked values by key; only keys that were given. @throws Refusal"""
    if not text.strip():
        return {}
    given = strict_yaml.load(text, "text", limits.TEXT_CHARACTERS)
    if not isinstance(given, dict):
        raise Refusal("text", text, "must be a YAML mapping", f"for example {EXAMPLE}")
    for key in given:
        if key not in KEYS:
            raise Refusal(f"text.{key}", given[key], "is no property", checks.nearest(key, KEYS))
    return {key: _READERS[key](value, f"text.{key}") for key, value in given.items()}


def _mass(value: object, field: str) -> float:
    result = checks.number(value, field, limits.MASS_MAX_KG, "kg")
    if not result >= limits.MASS_MIN_KG:
        rule = f"must be at least {limits.MASS_MIN_KG:g} kg"
        raise Refusal(field, f"{result:.4g} kg", rule, "for a fixed body give static: true")
    return result


def _density(value: object, field: str) -> float:
    result = checks.number(value, field, 1e9, "kg/m^3")
    if not result > 0:
        raise Refusal(field, f"{result:.4g} kg/m^3", "must be > 0", "water has 1000")
    return result


def _friction(value: object, field: str) -> float:
    result = checks.number(value, field, 1e3, "")
    if not result >= 0:
        raise Refusal(field, result, "must be >= 0", "0 is frictionless, 0.5 is usual")
    return result


def _restitution(value: object, field: str) -> float:
    result = checks.number(value, field, 1.0, "")
    if not result >= 0:
        raise Refusal(field, result, "must be from 0 to 1", "0 does not bounce")
    return result


def _static(value: object, field: str) -> bool:
    if not isinstance(value, bool):
        raise Refusal(field, value, "must be true or false")
    return value


def _ccd(value: object, field: str) -> str:
    if value not in ("auto", "always", "never"):
        raise Refusal(field, value, "must be auto, always or never", "auto is right for most")
    return str(value)


def _frames(value: object, field: str) -> dict[str, Vector]:
    if not isinstance(value, dict) or len(value) > 64:
        raise Refusal(field, value, "must be at most 64 names with points", "{handle: [0, 0, 0.5]}")
    return {
        checks.body_name(name, field): checks.vector(
            point, f"{field}.{name}", limits.SIZE_MAX_M, "m"
        )
        for name, point in value.items()
    }


_READERS = {
    "name": checks.body_name,
    "mass": _mass,
    "density": _density,
    "friction": _friction,
    "restitution": _restitution,
    "ccd": _ccd,
    "velocity": lambda v, f: checks.vector(v, f, limits.SPEED_M_S, "m/s"),
    "angular_velocity": lambda v, f: checks.vector(v, f, limits.SPIN_RAD_S, "rad/s"),
    "static": _static,
    "frames": _frames,
}
