# SPDX-License-Identifier: Apache-2.0
"""Views: how world points land on a raster, and the rays of its pixels.

A view's `key` is affine over a triangle on the raster and grows towards the viewer: 1/depth in
perspective, -depth without.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np


@dataclass
class View:
    origin: np.ndarray
    """(3,) m, world: the eye, or the middle of the raster"""
    axes: np.ndarray
    """(3, 3) rows: right, down, forward"""
    scale: float
    """pixels per m at depth 1 (perspective), or pixels per m"""
    width: int
    height: int
    perspective: bool

    def project(self, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Pixel coordinates (..., 2), pixel centres at whole numbers, and keys (...)."""
        local = (points - self.origin) @ self.axes.T
        depth = local[..., 2]
        over = 1 / depth if self.perspective else np.ones_like(depth)
        middle = 0.5 * np.array([self.width - 1, self.height - 1])
        return local[..., :2] * (self.scale * over)[..., None] + middle, (
            over if self.perspective else -depth
        )

    def rays(self, x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Origins and directions, world; the parameter along a ray is depth."""
        right = ((x - 0.5 * (self.width - 1)) / self.scale)[..., None] * self.axes[0]
        down = ((y - 0.5 * (self.height - 1)) / self.scale)[..., None] * self.axes[1]
        aside = right + down
        if self.perspective:
            return np.broadcast_to(self.origin, aside.shape), aside + self.axes[2]
        return self.origin + aside, np.broadcast_to(self.axes[2], aside.shape)

    def key(self, depth: np.ndarray) -> np.ndarray:
        return 1 / depth if self.perspective else -depth


def axes_along(forward: np.ndarray) -> np.ndarray:
    """Rows right, down, forward, with z up on the raster."""
    forward = forward / np.linalg.norm(forward)
    up = np.array([0.0, 0.0, 1.0]) if abs(forward[2]) < 0.999 else np.array([0.0, 1.0, 0.0])
    right = np.cross(forward, up)
    right /= np.linalg.norm(right)
    return np.array([right, np.cross(forward, right), forward])


def camera(
    points: np.ndarray, size: tuple[int, int], azimuth: float, elevation: float, fov: float = 0.5
) -> View:
    """The nearest eye that has all points in the picture. Angles in rad; fov: of the height."""
    width, height = size
    ce, se = np.cos(elevation), np.sin(elevation)
    axes = axes_along(-np.array([ce * np.cos(azimuth), ce * np.sin(azimuth), se]))
    target = 0.5 * (points.min(0) + points.max(0))
    local = (points - target) @ axes.T
    slope = 0.88 * np.tan(fov / 2) * np.array([width / height, 1.0])  # a margin of 12 %
    distance = (np.abs(local[:, :2]) / slope - local[:, 2:]).max()
    scale = 0.5 * height / np.tan(fov / 2)
    return View(target - distance * axes[2], axes, scale, width, height, True)


def parallel(points: np.ndarray, direction: np.ndarray, pixels: int) -> View:
    """All points on a square raster, seen along `direction`: what a far light sees."""
    axes = axes_along(direction)
    local = points @ axes.T
    lower, upper = local.min(0), local.max(0)
    extent = max((upper - lower)[:2].max(), 1e-9)
    return View(
        0.5 * (lower + upper) @ axes, axes, (pixels - 4) / extent, pixels, pixels, perspective=False
    )
