# SPDX-License-Identifier: Apache-2.0
"""Signed distance of a point to a body, negative inside, body frame: closed forms in numpy."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import combinations

import numpy as np

Array = np.ndarray
Distance = Callable[[Array], float]
"""(3,) m -> m."""


def to_ball(radius: float, centre: Sequence[float] = (0, 0, 0)) -> Distance:
    c = np.asarray(centre, float)
    return lambda p: float(np.linalg.norm(p - c)) - radius


def to_box(extents: Sequence[float]) -> Distance:
    half = 0.5 * np.asarray(extents)

    def distance(p: Array) -> float:
        over = np.abs(p) - half
        return float(np.linalg.norm(np.maximum(over, 0)) + min(over.max(), 0.0))

    return distance


def to_capsule(radius: float, length: float) -> Distance:
    def distance(p: Array) -> float:
        on_axis = np.array([0, 0, np.clip(p[2], -length / 2, length / 2)])
        return float(np.linalg.norm(p - on_axis)) - radius

    return distance


def to_revolved(section: Array) -> Distance:
    """section: (N, 2) corners (radius, height) of the half plane, from the top of the axis down."""
    start, along = section[:-1], np.diff(section, axis=0)
    length = np.linalg.norm(along, axis=1)
    outward = np.stack([-along[:, 1], along[:, 0]], axis=1) / length[:, None]

    def distance(p: Array) -> float:
        q = np.array([np.hypot(p[0], p[1]), p[2]])
        over = ((q - start) * outward).sum(1)
        if over.max() <= 0:
            return float(over.max())
        t = np.clip(((q - start) * along).sum(1) / length**2, 0, 1)
        return float(np.linalg.norm(q - start - t[:, None] * along, axis=1).min())

    return distance


def to_ellipsoid(radii: Sequence[float]) -> Distance:
    """The multiplier of the nearest point by halving: no Newton's method to go astray."""
    r = np.asarray(radii, float)

    def distance(p: Array) -> float:
        low, high = -(r.min() ** 2), r.max() * (float(np.linalg.norm(p)) + r.max())
        for _ in range(200):
            middle = 0.5 * (low + high)
            outside = ((r * p / (middle + r**2)) ** 2).sum() > 1
            low, high = (middle, high) if outside else (low, middle)
        nearest = r**2 * p / (high + r**2)
        return float(np.copysign(np.linalg.norm(p - nearest), high))

    return distance


def to_hull(points: Array) -> Distance:
    """Of points in general position: the triangles that have all others on one side."""
    middle = points.mean(0)
    corners = np.array(list(combinations(range(len(points)), 3)))
    a, b, c = (points[corners[:, i]] for i in range(3))
    normal = np.cross(b - a, c - a)
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    normal *= np.sign(((a - middle) * normal).sum(1))[:, None]
    offset = (a * normal).sum(1)
    is_face = (normal @ points.T - offset[:, None]).max(1) < 1e-12
    triangles, normal, offset = points[corners[is_face]], normal[is_face], offset[is_face]
    from carom.studies.pairs_references import distance_to_triangles

    def distance(p: Array) -> float:
        over = float((normal @ p - offset).max())
        return over if over <= 0 else distance_to_triangles(triangles, p)

    return distance


def nearest_of(parts: Sequence[Distance]) -> Distance:
    return lambda p: min(part(p) for part in parts)
