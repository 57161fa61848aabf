# SPDX-License-Identifier: Apache-2.0
"""Shapes as triangles in the body frame, told by name so that a new shape cannot stop a picture."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

Triangles = tuple[np.ndarray, np.ndarray]
"""vertices (V, 3) m, faces (F, 3), counter-clockwise seen from outside"""

AROUND, ALONG = 48, 12
_CORNERS = np.array([[x, y, z] for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)])
_SIDES = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
_BOX_FACES = np.array([[a, *bc] for a, b, c, d in _SIDES for bc in ((b, c), (c, d))])


def outline(shape: Any) -> Triangles | None:
    """None for a shape that has no outline here."""
    kind = type(shape).__name__
    if kind in _OUTLINES:
        return _OUTLINES[kind](shape)
    if hasattr(shape, "vertices") and hasattr(shape, "faces"):
        return shape.vertices, shape.faces
    return None


def revolved(rims: np.ndarray, heights: np.ndarray) -> Triangles:
    """Surface about z through rings of radius rims[i] at heights[i], bottom to top, closed at both
    ends by a point on the axis."""
    turn = np.arange(AROUND) * (2 * np.pi / AROUND)
    circle = np.stack([np.cos(turn), np.sin(turn), np.zeros(AROUND)], axis=1)
    rings = rims[:, None, None] * circle + heights[:, None, None] * np.array([0, 0, 1.0])
    ends = [[0, 0, heights[0]], [0, 0, heights[-1]]]
    low = np.arange(len(rims) - 1)[:, None] * AROUND + np.arange(AROUND)
    step = (np.arange(AROUND) + 1) % AROUND - np.arange(AROUND)
    bands = np.stack(
        [low, low + step, low + step + AROUND, low, low + step + AROUND, low + AROUND], -1
    )
    rim, top = np.arange(AROUND), (len(rims) - 1) * AROUND
    bottom_end, top_end = (
        np.full(AROUND, len(rims) * AROUND),
        np.full(AROUND, len(rims) * AROUND + 1),
    )
    bottom = np.stack([rim + step, rim, bottom_end], axis=1)
    lid = np.stack([top + rim, top + rim + step, top_end], axis=1)
    return np.vstack([rings.reshape(-1, 3), ends]), np.vstack([bands.reshape(-1, 3), bottom, lid])


def _capsule(shape: Any) -> Triangles:
    angle = np.linspace(0, np.pi / 2, ALONG + 1)[:-1]
    rims = shape.radius * np.cos(angle)
    heights = shape.length / 2 + shape.radius * np.sin(angle)
    vertices, faces = revolved(np.append(rims[::-1], rims), np.append(-heights[::-1], heights))
    vertices[-2:, 2] = [-shape.length / 2 - shape.radius, shape.length / 2 + shape.radius]
    return vertices, faces


def _ellipsoid(shape: Any) -> Triangles:
    angle = np.linspace(-np.pi / 2, np.pi / 2, 2 * ALONG + 1)[1:-1]
    vertices, faces = revolved(np.cos(angle), np.sin(angle))
    vertices[-2:, 2] = [-1, 1]
    return vertices * shape.radii, faces


def _cylinder(shape: Any) -> Triangles:
    return revolved(np.full(2, shape.radius), np.array([-0.5, 0.5]) * shape.length)


def _cone(shape: Any) -> Triangles:
    """The origin is the centre of mass, a quarter of the length above the base."""
    vertices, faces = revolved(np.array([shape.radius]), np.array([-0.25 * shape.length]))
    vertices[-1, 2] = 0.75 * shape.length
    return vertices, faces


def _terrain(shape: Any) -> Triangles:
    """The surface alone: what is below it is never seen."""
    rows, columns = shape.heights.shape
    y, x = np.meshgrid(np.arange(rows), np.arange(columns), indexing="ij")
    vertices = np.stack([x * shape.spacing, y * shape.spacing, shape.heights], -1).reshape(-1, 3)
    a = (y * columns + x)[:-1, :-1].reshape(-1)
    quads = [a, a + 1, a + columns + 1, a, a + columns + 1, a + columns]
    return vertices, np.stack(quads, axis=1).reshape(-1, 3)


def _ball(radius: float, centre: np.ndarray) -> Triangles:
    angle = np.linspace(-np.pi / 2, np.pi / 2, 2 * ALONG + 1)[1:-1]
    vertices, faces = revolved(np.cos(angle), np.sin(angle))
    vertices[-2:, 2] = [-1, 1]
    return radius * vertices + centre, faces


def _compound(shape: Any) -> Triangles | None:
    """Of the parts that have one, at their places."""
    vertices, faces, count = [], [], 0
    for part in shape.parts:
        for found in _pieces(part.shape):
            u, w = part.orientation[:3], part.orientation[3]
            across = 2 * np.cross(u, found[0])
            vertices.append(found[0] + w * across + np.cross(u, across) + part.position)
            faces.append(found[1] + count)
            count += len(found[0])
    return (np.vstack(vertices), np.vstack(faces)) if vertices else None


def _pieces(shape: Any) -> list[Triangles]:
    kind = type(shape).__name__
    if kind == "Sphere":
        return [_ball(shape.radius, np.zeros(3))]
    if kind == "Particles":
        return [_ball(shape.radius, centre) for centre in shape.positions]
    found = outline(shape)
    return [] if found is None else [found]


_OUTLINES: dict[str, Callable[[Any], Triangles]] = {
    "Box": lambda shape: (_CORNERS * shape.extents, _BOX_FACES),
    "Capsule": _capsule,
    "Compound": _compound,
    "Cone": _cone,
    "Cylinder": _cylinder,
    "Ellipsoid": _ellipsoid,
    "HeightField": _terrain,
}
