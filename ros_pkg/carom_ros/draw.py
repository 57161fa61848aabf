# SPDX-License-Identifier: Apache-2.0
"""Shapes of the core as markers, in the body frame, told by name so that newer ones draw too."""

from collections.abc import Callable

import numpy as np
from geometry_msgs.msg import Point
from visualization_msgs.msg import Marker

PLANE_M = 20.0
"""Edge of the square a plane is drawn as; it has no end."""
SHEET_M = 0.002
AROUND, ALONG = 24, 8  # facets of what RViz has no marker for


def draw(marker: Marker, shape: object) -> None:
    """Sets type, scale, points and, for what cannot be drawn, text."""
    kind = type(shape).__name__
    if kind in _DRAWN:
        _DRAWN[kind](marker, shape)
    elif hasattr(shape, "vertices") and hasattr(shape, "faces"):
        _triangles(marker, shape.vertices[np.asarray(shape.faces).reshape(-1)])
    else:
        _as(marker, Marker.TEXT_VIEW_FACING, (0.0, 0.0, 0.1))
        marker.text = f"{marker.ns}: {kind}"


def _as(marker: Marker, kind: int, size: object) -> None:
    marker.type = kind
    marker.scale.x, marker.scale.y, marker.scale.z = (float(each) for each in size)


def _triangles(marker: Marker, corners: np.ndarray) -> None:
    _as(marker, Marker.TRIANGLE_LIST, (1.0, 1.0, 1.0))
    marker.points = [Point(x=x, y=y, z=z) for x, y, z in corners.tolist()]


def _balls(marker: Marker, shape: object) -> None:
    _as(marker, Marker.SPHERE_LIST, (2 * shape.radius,) * 3)
    marker.points = [Point(x=x, y=y, z=z) for x, y, z in np.asarray(shape.positions).tolist()]


def _capsule(marker: Marker, shape: object) -> None:
    angles = np.linspace(-np.pi / 2, np.pi / 2, 2 * ALONG + 1)
    rims, heights = shape.radius * np.cos(angles), shape.radius * np.sin(angles)
    lift = np.where(np.arange(len(angles)) <= ALONG, -shape.length / 2, shape.length / 2)
    # The equator twice, once on each end of the straight part.
    rims, heights, lift = (np.insert(a, ALONG, a[ALONG]) for a in (rims, heights, lift))
    lift[ALONG + 1] = shape.length / 2
    _triangles(marker, revolved(rims, heights + lift))


def _cone(marker: Marker, shape: object) -> None:
    # The origin is the centre of mass, a quarter of the length above the base.
    low, high = -shape.length / 4, 3 * shape.length / 4
    _triangles(marker, revolved(np.array([0.0, shape.radius, 0.0]), np.array([low, low, high])))


def _terrain(marker: Marker, shape: object) -> None:
    heights = np.asarray(shape.heights)
    row, column = np.meshgrid(*(np.arange(n) for n in heights.shape), indexing="ij")
    grid = np.stack([column * shape.spacing, row * shape.spacing, heights], axis=-1)
    a, b, c, d = grid[:-1, :-1], grid[:-1, 1:], grid[1:, 1:], grid[1:, :-1]
    _triangles(marker, np.stack([a, b, c, a, c, d], axis=2).reshape(-1, 3))


def revolved(rims: np.ndarray, heights: np.ndarray) -> np.ndarray:
    """Corners (3 T, 3) of a closed surface about z through rings of radius rims[i] at heights[i],
    bottom to top, first and last of radius 0; outward."""
    turn = np.arange(AROUND) * (2 * np.pi / AROUND)
    x, y = np.cos(turn), np.sin(turn)
    faces = []
    for low, high in zip(range(len(rims) - 1), range(1, len(rims)), strict=True):
        for k in range(AROUND):
            n = (k + 1) % AROUND
            corner = [
                (rims[ring] * x[at], rims[ring] * y[at], heights[ring])
                for ring, at in ((low, k), (low, n), (high, n), (high, k))
            ]
            if low > 0:  # a pole is a point, though cos(pi / 2) is not quite 0
                faces += [corner[0], corner[1], corner[2]]
            if high < len(rims) - 1:
                faces += [corner[0], corner[2], corner[3]]
    return np.array(faces)


_DRAWN: dict[str, Callable[[Marker, object], None]] = {
    "Box": lambda m, s: _as(m, Marker.CUBE, s.extents),
    "Sphere": lambda m, s: _as(m, Marker.SPHERE, (2 * s.radius,) * 3),
    "Ellipsoid": lambda m, s: _as(m, Marker.SPHERE, 2 * np.asarray(s.radii)),
    "Cylinder": lambda m, s: _as(m, Marker.CYLINDER, (2 * s.radius, 2 * s.radius, s.length)),
    "Plane": lambda m, s: _as(m, Marker.CUBE, (PLANE_M, PLANE_M, SHEET_M)),
    "Particles": _balls,
    "Capsule": _capsule,
    "Cone": _cone,
    "HeightField": _terrain,
}
