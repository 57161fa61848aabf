# SPDX-License-Identifier: Apache-2.0
"""Rotations and free bodies, as the cases measure them: nothing here is the library's own."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from carom import MassProperties, Scene, Simulation, Sphere, integrate_free
from carom.stress.case import largest

AT_REST = (0.0, 0.0, 0.0, 1.0)
U = 2.0**-53
"""Half an ulp of 1: the relative error of one rounded operation."""


def top(moments: Sequence[float], mass: float = 1.0) -> MassProperties:
    """A body by its principal moments, kg m^2, centred."""
    return MassProperties(mass, [0, 0, 0], np.diag(np.asarray(moments, float)))


def product(p: Sequence[float], q: Sequence[float]) -> np.ndarray:
    """Quaternion product, x y z w."""
    (a, b, c, d), (e, f, g, h) = p, q
    return np.array(
        [
            d * e + a * h + b * g - c * f,
            d * f - a * g + b * h + c * e,
            d * g + a * f - b * e + c * h,
            d * h - a * e - b * f - c * g,
        ]
    )


def about(axis: Sequence[float], angle: float) -> np.ndarray:
    """Quaternion of a turn by `angle` rad about a unit axis."""
    return np.array([*(math.sin(angle / 2) * np.asarray(axis, float)), math.cos(angle / 2)])


def matrix(q: Sequence[float]) -> np.ndarray:
    """Rotation matrix of a quaternion of any length > 0."""
    x, y, z, w = q
    n = 2 / (x * x + y * y + z * z + w * w)
    return np.array(
        [
            [1 - n * (y * y + z * z), n * (x * y - w * z), n * (x * z + w * y)],
            [n * (x * y + w * z), 1 - n * (x * x + z * z), n * (y * z - w * x)],
            [n * (x * z - w * y), n * (y * z + w * x), 1 - n * (x * x + y * y)],
        ]
    )


def angle(p: Sequence[float], q: Sequence[float]) -> float:
    """Between two orientations, rad; small angles to full precision."""
    p, q = np.asarray(p, float), np.asarray(q, float)
    p, q = p / np.linalg.norm(p), q / np.linalg.norm(q)
    q = q if p @ q >= 0 else -q
    return float(4 * math.atan2(np.linalg.norm(p - q), np.linalg.norm(p + q)))


def spin_energy(moments: Sequence[float], q: Sequence[float], w: Sequence[float]) -> float:
    """J, from world angular velocity w and orientation q of the principal axes."""
    body = matrix(q).T @ np.asarray(w, float)
    return float(0.5 * (np.asarray(moments, float) * body) @ body)


def spin_momentum(moments: Sequence[float], q: Sequence[float], w: Sequence[float]) -> np.ndarray:
    """kg m^2/s, world axes."""
    r = matrix(q)
    return r @ (np.asarray(moments, float) * (r.T @ np.asarray(w, float)))


def watch(
    moments: Sequence[float],
    w: Sequence[float],
    step: float,
    steps: int,
    looks: int,
    method: str,
    q: Sequence[float] = AT_REST,
) -> tuple[float, float]:
    """Flies in `looks` parts and returns the worst relative error of energy and of momentum."""
    body = top(moments)
    q, w = np.asarray(q, float), np.asarray(w, float)
    energy, momentum = spin_energy(moments, q, w), spin_momentum(moments, q, w)
    worst_energy = worst_momentum = 0.0
    part = steps // looks
    for _ in range(looks):
        q, w = integrate_free(body, q, w, part * step, part, method)
        now = spin_energy(moments, q, w)
        drift = np.linalg.norm(spin_momentum(moments, q, w) - momentum)
        worst_energy = largest(worst_energy, abs(now / energy - 1))
        worst_momentum = largest(worst_momentum, float(drift / np.linalg.norm(momentum)))
    return worst_energy, worst_momentum


def lone_body(
    moments: Sequence[float],
    w: Sequence[float],
    dt: float,
    integrator: str = "symmetric_top",
    q: Sequence[float] = AT_REST,
) -> Simulation:
    """A simulation of one body that nothing touches."""
    scene = Scene()
    scene.add(
        Sphere(0.1), name="body", mass_properties=top(moments), orientation=q, angular_velocity=w
    )
    return Simulation(scene, dt=dt, integrator=integrator)
