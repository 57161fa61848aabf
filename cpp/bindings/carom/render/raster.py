# SPDX-License-Identifier: Apache-2.0
"""Which surface each pixel sees: a depth buffer over triangles and spheres, in bulk."""

from __future__ import annotations

import numpy as np

from carom.render.surfaces import Surfaces
from carom.render.views import View

CHUNK = 400_000
"""Samples worked on at once: their arrays stay in the processor's cache."""


def raster(view: View, surfaces: Surfaces) -> tuple[np.ndarray, np.ndarray]:
    """Keys (H, W), -inf where nothing is seen, and indices (H, W): the triangle, T + the sphere, or
    -1."""
    keys = np.full(view.height * view.width, -np.inf)
    index = np.full(keys.shape, -1, dtype=np.int64)
    _draw_triangles(view, surfaces.corners, keys, index)
    for i, (centre, radius) in enumerate(zip(surfaces.centres, surfaces.radii, strict=True)):
        _draw_sphere(view, centre, radius, len(surfaces.corners) + i, keys, index)
    shape = view.height, view.width
    return keys.reshape(shape), index.reshape(shape)


def _draw_triangles(view: View, corners: np.ndarray, keys: np.ndarray, index: np.ndarray) -> None:
    """Triangles of like size on the raster are worked on together, a grid of samples for each."""
    if not len(corners):
        return
    xy, key = view.project(corners)
    in_front = np.isfinite(key).all(1) & ((key > 0).all(1) if view.perspective else True)
    limit = np.array([view.width - 1, view.height - 1])
    lower = np.clip(np.ceil(xy.min(1)), 0, limit + 1)
    upper = np.clip(np.floor(xy.max(1)), -1, limit)
    span = upper - lower + 1
    shown = np.flatnonzero(in_front & (span > 0).all(1))
    size_class = np.ceil(np.log2(np.maximum(span[shown], 1))).astype(int)
    for group in np.unique(size_class, axis=0):
        members = shown[(size_class == group).all(1)]
        width, height = 2 ** int(group[0]), 2 ** int(group[1])
        step = max(1, CHUNK // (width * height))
        for i in range(0, len(members), step):
            part = members[i : i + step]
            _fill(view.width, xy[part], key[part], lower[part], upper[part], part,
                  (width, height), keys, index)  # fmt: skip


def _fill(
    row_width: int,
    xy: np.ndarray,
    key: np.ndarray,
    lower: np.ndarray,
    upper: np.ndarray,
    names: np.ndarray,
    grid: tuple[int, int],
    keys: np.ndarray,
    index: np.ndarray,
) -> None:
    x = lower[:, :1] + np.arange(grid[0])
    y = lower[:, 1:] + np.arange(grid[1])
    per_x, per_y, at_corner = gradients(xy)
    # A corner's weight, and the key, is a part of x plus a part of y: one addition a sample.
    dx, dy = x - xy[:, 0, :1], y - xy[:, 0, 1:]
    along_x = per_x[:, :, None] * dx[:, None, :] + at_corner[:, :, None]
    along_y = per_y[:, :, None] * dy[:, None, :]
    inside = (x <= upper[:, :1])[:, None, :] & (y <= upper[:, 1:])[:, :, None]
    for k in range(3):
        inside &= along_x[:, k, None, :] >= -along_y[:, k, :, None]
    t, iy, ix = np.nonzero(inside)
    sample_key = ((along_x[t, :, ix] + along_y[t, :, iy]) * key[t]).sum(1)
    pixel = (y[t, iy] * row_width + x[t, ix]).astype(np.int64)
    np.maximum.at(keys, pixel, sample_key)
    nearest = sample_key == keys[pixel]
    index[pixel[nearest]] = names[t[nearest]]


def gradients(xy: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """How the weights of a triangle's corners change per pixel in x and in y, and what they are at
    its first corner; each (T, 3). NaN for a triangle seen edge on, so that no sample is in it."""
    (ax, ay), (bx, by), (cx, cy) = np.moveaxis(xy, 0, -1)
    with np.errstate(divide="ignore", invalid="ignore"):
        over = 1 / ((bx - ax) * (cy - ay) - (by - ay) * (cx - ax))
        b_x, b_y = (cy - ay) * over, (ax - cx) * over
        c_x, c_y = (ay - by) * over, (bx - ax) * over
    first = np.zeros((len(xy), 3))
    first[:, 0] = 1
    return np.stack([-b_x - c_x, b_x, c_x], 1), np.stack([-b_y - c_y, b_y, c_y], 1), first


def _draw_sphere(
    view: View, centre: np.ndarray, radius: float, name: int, keys: np.ndarray, index: np.ndarray
) -> None:
    depth = (centre - view.origin) @ view.axes[2]
    if view.perspective and depth <= 2 * radius:
        return  # the eye is in it or all but touches it
    xy, _ = view.project(centre)
    # In perspective the outline is an ellipse of at most this half-width about the centre's pixel.
    near = np.hypot(1, (xy - 0.5 * np.array([view.width, view.height])).max() / view.scale)
    reach = view.scale * radius * (near**2 / (depth - radius) if view.perspective else 1) + 1
    x0, y0 = np.maximum(np.floor(xy - reach), 0).astype(int)
    x1 = min(int(xy[0] + reach) + 1, view.width - 1)
    y1 = min(int(xy[1] + reach) + 1, view.height - 1)
    if x0 > x1 or y0 > y1:
        return
    x, y = np.meshgrid(np.arange(x0, x1 + 1), np.arange(y0, y1 + 1))
    origins, directions = view.rays(x, y)
    depth, hit = _ray_sphere(origins, directions, centre, radius)
    pixel = (y * view.width + x)[hit]
    key = view.key(depth[hit])
    nearer = key > keys[pixel]
    keys[pixel[nearer]] = key[nearer]
    index[pixel[nearer]] = name


def _ray_sphere(
    origins: np.ndarray, directions: np.ndarray, centre: np.ndarray, radius: float
) -> tuple[np.ndarray, np.ndarray]:
    to = centre - origins
    a = (directions**2).sum(-1)
    b = (to * directions).sum(-1)
    under_root = b * b - a * ((to**2).sum(-1) - radius**2)
    hit = under_root > 0
    return (b - np.sqrt(np.where(hit, under_root, 0))) / a, hit
