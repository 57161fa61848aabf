# SPDX-License-Identifier: Apache-2.0
"""How much of the sun and of the sky each point sees, by depth buffers from many directions.

A far light in a direction sees what it lights: a point is lit when nothing in the light's view lies
in front of it. Sixteen directions over the sun's disc give its soft shadow, sixty-four over the sky
the darkening of corners and of the ground under things.
"""

from __future__ import annotations

import numpy as np

from carom.render.raster import raster
from carom.render.surfaces import Surfaces
from carom.render.views import View, parallel

SUN = np.array([-0.45, -0.62, 0.80]) / np.linalg.norm([-0.45, -0.62, 0.80])
SUN_RADIUS = 0.045
"""rad; ten times the true sun's, as a studio light has it."""


def sun_directions(count: int = 16) -> np.ndarray:
    """(count, 3) unit vectors towards points of the sun's disc."""
    aside = np.cross(SUN, [0, 0, 1])
    aside /= np.linalg.norm(aside)
    up = np.cross(aside, SUN)
    radius = SUN_RADIUS * np.sqrt((np.arange(count) + 0.5) / count)
    turn = np.arange(count) * _GOLDEN_ANGLE
    spread = (radius * np.cos(turn))[:, None] * aside + (radius * np.sin(turn))[:, None] * up
    directions = SUN + spread
    return directions / np.linalg.norm(directions, axis=1, keepdims=True)


def sky_directions(count: int = 64) -> np.ndarray:
    """(count, 3) unit vectors spread evenly over the upper half of the sphere."""
    z = (np.arange(count) + 0.5) / count
    turn = np.arange(count) * _GOLDEN_ANGLE
    r = np.sqrt(1 - z * z)
    return np.stack([r * np.cos(turn), r * np.sin(turn), z], axis=1)


_GOLDEN_ANGLE = np.pi * (3 - np.sqrt(5))


def lit_by(
    surfaces: Surfaces,
    hull: np.ndarray,
    directions: np.ndarray,
    points: np.ndarray,
    normals: np.ndarray,
    pixels: int,
) -> np.ndarray:
    """(M,) mean over the directions of max(n . d, 0) where the point sees that direction.

    hull: points that bound everything that throws a shadow; points, normals: (M, 3).
    """
    middle = hull.mean(0)  # single precision below: 1e-7 of the scene's size is far below a texel
    p, n = ((a - b).T.astype(np.float32, order="C") for a, b in ((points, middle), (normals, 0)))
    total = np.zeros(len(points), np.float32)
    for direction in directions:
        cosine = _dot(direction, n)
        facing = np.flatnonzero(cosine > 0)
        view = parallel(hull, -direction, pixels)
        keys, _ = raster(view, surfaces)
        seen = _sees(view, keys, middle, p[:, facing], n[:, facing])
        total[facing] += cosine[facing] * seen
    return total / len(directions)


def _sees(
    view: View, keys: np.ndarray, middle: np.ndarray, points: np.ndarray, normals: np.ndarray
) -> np.ndarray:
    """True for points in front of, or within half a texel of, what the light sees there."""
    texel = 1 / view.scale
    moved = points + np.float32(1.5 * texel) * normals
    centre = 0.5 * np.array([view.width - 1, view.height - 1])
    start = view.axes @ (middle - view.origin)
    x = np.rint(
        _dot(view.axes[0] * view.scale, moved) + np.float32(start[0] * view.scale + centre[0])
    )
    y = np.rint(
        _dot(view.axes[1] * view.scale, moved) + np.float32(start[1] * view.scale + centre[1])
    )
    depth = _dot(view.axes[2], moved) + np.float32(start[2])
    on_map = (x >= 0) & (x < view.width) & (y >= 0) & (y < view.height)
    pixel = np.where(on_map, y * view.width + x, 0).astype(np.int32)
    return ~on_map | (-depth >= keys.reshape(-1)[pixel] - 0.5 * texel)


def _dot(vector: np.ndarray, points: np.ndarray) -> np.ndarray:
    """vector . points, (3, M) single precision. By hand: far faster than a product of 3 columns."""
    a, b, c = vector.astype(np.float32)
    return a * points[0] + b * points[1] + c * points[2]
