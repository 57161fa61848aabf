# SPDX-License-Identifier: Apache-2.0
"""Moving bodies of every kind for the tunnelling runs, with points of their surface."""

from __future__ import annotations

import itertools
import math
from typing import Any, NamedTuple

import numpy as np

from carom import (
    Box,
    Capsule,
    Compound,
    Cone,
    ConvexHull,
    Cylinder,
    Ellipsoid,
    Mesh,
    Part,
    Particles,
    Sphere,
)

UNIT = np.array([p for p in itertools.product((-1, 0, 1), repeat=3) if any(p)], float)
UNIT /= np.linalg.norm(UNIT, axis=1)[:, None]
RING = np.array([[math.cos(a), math.sin(a), 0.0] for a in np.arange(16) * math.pi / 8])


class Mover(NamedTuple):
    kind: str
    shape: Any
    surface: np.ndarray
    """(N, 3) m, points of the surface, body frame."""
    inner: float
    """m, radius of a ball about the body frame's origin that lies inside the body."""
    outer: float
    """m, of one that holds it."""


def _made(kind: str, shape: Any, surface: np.ndarray, inner: float) -> Mover:
    return Mover(kind, shape, surface, inner, float(np.linalg.norm(surface, axis=1).max()))


def _sphere(rng, size):
    return _made("sphere", Sphere(size), size * UNIT, size)


def _box(rng, size):
    extents = 2 * size * np.exp(rng.uniform(-2.3, 0, 3))  # edges 1 : 10 at most
    corners = np.array(list(itertools.product((-0.5, 0, 0.5), repeat=3))) * extents
    return _made("box", Box(extents), corners, extents.min() / 2)


def _capsule(rng, size):
    radius, length = size * rng.uniform(0.1, 0.7), size * rng.uniform(0.1, 2)
    points = np.concatenate([radius * UNIT + [0, 0, s * length / 2] for s in (-1, 1)])
    return _made("capsule", Capsule(radius, length), points, radius)


def _cylinder(rng, size):
    radius, length = size * rng.uniform(0.05, 0.8), size * rng.uniform(0.05, 2)
    points = np.concatenate([radius * RING + [0, 0, s * length / 2] for s in (-1, 1)])
    return _made("cylinder", Cylinder(radius, length), points, min(radius, length / 2))


def _cone(rng, size):
    radius, length = size * rng.uniform(0.2, 0.8), size * rng.uniform(0.2, 1.3)
    points = np.concatenate([radius * RING - [0, 0, length / 4], [[0, 0, 0.75 * length]]])
    # the base is length / 4 away; the side's distance is that of the apex times the sine there
    side = 0.75 * length * radius / math.hypot(radius, length)
    return _made("cone", Cone(radius, length), points, min(length / 4, side))


def _ellipsoid(rng, size):
    radii = size * np.exp(rng.uniform(-2, 0, 3))
    return _made("ellipsoid", Ellipsoid(radii), UNIT * radii, radii.min())


def _hull_points(rng, size):
    """Random, symmetric about the origin (so the centre of mass is there), never thin."""
    half = rng.normal(size=(rng.integers(3, 12), 3))
    half = np.concatenate([half / np.linalg.norm(half, axis=1)[:, None], 0.4 * np.eye(3)])
    return size * np.concatenate([half, -half])


def _hull(rng, size):
    points = _hull_points(rng, size)
    # the octahedron of the six points on the axes, 0.4 size out, lies inside
    shape = ConvexHull(points)
    return _made("hull", shape, np.array(shape.vertices), 0.4 * size / math.sqrt(3))


def _mesh(rng, size):
    """A hull's surface as a closed triangle mesh."""
    hull = ConvexHull(_hull_points(rng, size))
    vertices = np.array(hull.vertices)
    shape = Mesh(vertices, np.array(hull.faces))
    return _made("mesh", shape, vertices, 0.4 * size / math.sqrt(3))


def _particles(rng, size):
    radius = size * rng.uniform(0.1, 0.4)
    half = rng.uniform(-1, 1, (rng.integers(1, 7), 3)) * (size - radius) / math.sqrt(3)
    centres = np.concatenate([half, -half, np.zeros((1, 3))])
    points = (centres[:, None] + radius * UNIT[None]).reshape(-1, 3)
    return _made("particles", Particles(centres, radius), points, radius)


def _compound(rng, size):
    """A dumb-bell: two balls on a bar."""
    ball, bar = size * rng.uniform(0.1, 0.4), size * rng.uniform(0.02, 0.09)
    arm = size - ball
    parts = [
        Part(Box([bar, bar, 2 * arm])),
        Part(Sphere(ball), [0, 0, arm]),
        Part(Sphere(ball), [0, 0, -arm]),
    ]
    points = np.concatenate([ball * UNIT + [0, 0, s * arm] for s in (-1, 1)])
    return _made("compound", Compound(parts), points, bar / 2)


KINDS = {
    "sphere": _sphere,
    "box": _box,
    "capsule": _capsule,
    "cylinder": _cylinder,
    "cone": _cone,
    "ellipsoid": _ellipsoid,
    "hull": _hull,
    "mesh": _mesh,
    "particles": _particles,
    "compound": _compound,
}


def make(kind: str, rng: np.random.Generator, size: float) -> Mover:
    """A body of that kind, at most about `size` m from its origin to its surface."""
    return KINDS[kind](rng, size)
