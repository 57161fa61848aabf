# SPDX-License-Identifier: Apache-2.0
"""coal (the maintained hpp-fcl) as a second opinion on the depth of convex pairs."""

from __future__ import annotations

import functools
import importlib.util
from typing import Any

import numpy as np

import carom
from carom.studies.pairs_shapes import Array, Twin


@functools.cache
def available() -> bool:
    return importlib.util.find_spec("coal") is not None


def _shape(twin: Twin) -> Any:
    """coal's own, None where it has no such shape. Its cone stands about the middle of its height,
    ours about its centre of mass."""
    import coal

    s = twin.shape
    if isinstance(s, carom.Sphere):
        return coal.Sphere(s.radius)
    if isinstance(s, carom.Box):
        return coal.Box(*s.extents)
    if isinstance(s, carom.Capsule):
        return coal.Capsule(s.radius, s.length)
    if isinstance(s, carom.Cylinder):
        return coal.Cylinder(s.radius, s.length)
    if isinstance(s, carom.Cone):
        return coal.Cone(s.radius, s.length)
    if isinstance(s, carom.Ellipsoid):
        return coal.Ellipsoid(*s.radii)
    return None


def _transform(twin: Twin, position: Array, orientation: Array) -> Any:
    import coal

    x, y, z, w = orientation
    rotation = np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )
    if isinstance(twin.shape, carom.Cone):
        position = position + rotation[:, 2] * twin.shape.length / 4
    return coal.Transform3s(rotation, position)


def largest_difference(a: Twin, b: Twin, pa: list, pb: list, depth: Array) -> float | None:
    """Between its signed distance and ours, m; None for shapes it has not. Of deep overlaps it is
    not asked: there it has been off by 0.1 m where our own normal proves the depth."""
    shapes = _shape(a), _shape(b)
    if None in shapes:
        return None
    import coal

    request, worst = coal.DistanceRequest(), 0.0
    for pose_a, pose_b, ours in zip(pa, pb, depth, strict=True):
        if ours < -0.1:
            continue
        result = coal.DistanceResult()
        theirs = coal.distance(
            shapes[0], _transform(a, *pose_a), shapes[1], _transform(b, *pose_b), request, result
        )
        worst = max(worst, abs(theirs - ours))
    return worst
