# SPDX-License-Identifier: Apache-2.0
"""One of each shape, and the same bodies written down a second time: by support functions, centres
and triangles in numpy, sharing no code with the library."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import numpy as np

import carom
from carom.studies import pairs_distances as closed
from carom.studies.pairs_distances import Distance

Array = np.ndarray
Support = Callable[[Array], Array]
"""(..., 3) unit directions, body frame -> (...,) m: how far the body reaches along each."""


@dataclass
class Twin:
    """A shape and what the references know of it."""

    name: str
    shape: object
    convex: list[Support] = field(default_factory=list)
    """Support functions of convex pieces; the body is their union."""
    distance: Distance | None = None
    """Of a point to the body, signed, where it has a closed form."""
    balls: list[tuple[Array, float]] | None = None
    """Centres and radii where the body is nothing but balls."""
    triangles: Array | None = None
    """(F, 3, 3) m, of bodies that are surfaces."""
    solid_below: bool = False
    """Inside is below, as of a height field; else inside is where the surface winds round."""
    flat: tuple[Array, float] | None = None
    """Centre of a level face and its half width, m, to set things down on."""
    static: bool = False
    tolerance: float = 1e-9
    """m, of depth: 1e-6 of the distance grid, whose cells are 0.01 m, 1e-9 elsewhere."""


def _ball(radius: float, centre: Sequence[float] = (0, 0, 0)) -> Support:
    c = np.asarray(centre, float)
    return lambda n: n @ c + radius


def _box(extents: Sequence[float], centre: Sequence[float] = (0, 0, 0)) -> Support:
    half, c = 0.5 * np.asarray(extents), np.asarray(centre, float)
    return lambda n: n @ c + np.abs(n) @ half


def _across(n: Array) -> Array:
    return np.hypot(n[..., 0], n[..., 1])


def _cone(radius: float, length: float) -> Support:
    return lambda n: np.maximum(
        0.75 * length * n[..., 2], radius * _across(n) - 0.25 * length * n[..., 2]
    )


def _points(points: Array) -> Support:
    return lambda n: (n @ points.T).max(-1)


def _l_block() -> tuple[Array, Array]:
    """2 x 2 x 1 m without its quarter x > 0, y > 0; outward."""
    outline = np.array([[0, 0], [0, 1], [-1, 1], [-1, -1], [1, -1], [1, 0]], float)
    n = len(outline)
    vertices = np.vstack([np.c_[outline, np.zeros(n)], np.c_[outline, np.ones(n)]])
    faces = []
    for i in range(1, n - 1):  # fans about the notch, which sees every corner
        faces += [[0, i + 1, i], [n, n + i, n + i + 1]]
    for i in range(n):
        j = (i + 1) % n
        faces += [[i, j, n + j], [i, n + j, n + i]]
    return vertices, np.array(faces)


def _hills() -> Array:
    """Heights over 0.25 m cells, 8 m wide, with a level square from 3.5 to 7.5 m."""
    rows = np.arange(33)
    hills = 0.1 * np.sin(rows)[:, None] * np.cos(1.3 * rows)[None, :]
    hills[14:31, 14:31] = 0.0
    return hills


def _height_field_triangles(heights: Array, spacing: float) -> Array:
    out = []
    for i in range(heights.shape[0] - 1):
        for j in range(heights.shape[1] - 1):
            a, b, c, d = (
                np.array([(j + v) * spacing, (i + u) * spacing, heights[i + u, j + v]])
                for u, v in ((0, 0), (0, 1), (1, 1), (1, 0))
            )
            out += [[a, b, c], [a, c, d]]
    return np.array(out)


def twins() -> list[Twin]:
    """Thirteen shapes, sizes about 1 m."""
    cloud = np.random.default_rng(3).normal(size=(40, 3))
    cloud *= 0.5 / np.linalg.norm(cloud, axis=1, keepdims=True)
    vertices, faces = _l_block()
    hills = _hills()
    beads = np.array([[-0.3, 0, 0], [0, 0.1, 0], [0.3, 0, 0]])
    box_part = carom.Part(carom.Box([0.4, 0.4, 0.4]))
    ball_part = carom.Part(carom.Sphere(0.2), [0.3, 0, 0])
    cylinder = lambda n: 0.4 * np.abs(n[..., 2]) + 0.35 * _across(n)  # noqa: E731
    return [
        Twin(
            "sphere",
            carom.Sphere(0.4),
            [_ball(0.4)],
            closed.to_ball(0.4),
            [(np.zeros(3), 0.4)],
        ),
        Twin(
            "box",
            carom.Box([0.5, 0.7, 0.9]),
            [_box([0.5, 0.7, 0.9])],
            closed.to_box([0.5, 0.7, 0.9]),
        ),
        Twin("plane", carom.Plane([0, 0, 1], 0.1), static=True),
        Twin(
            "mesh",
            carom.Mesh(vertices, faces),
            triangles=vertices[faces],
            flat=(np.array([-0.45, -0.45, 1.0]), 0.45),
        ),
        Twin(
            "capsule",
            carom.Capsule(0.25, 0.6),
            [lambda n: 0.3 * np.abs(n[..., 2]) + 0.25],
            closed.to_capsule(0.25, 0.6),
        ),
        Twin(
            "cylinder",
            carom.Cylinder(0.35, 0.8),
            [cylinder],
            closed.to_revolved(np.array([[0, 0.4], [0.35, 0.4], [0.35, -0.4], [0, -0.4]])),
        ),
        Twin(
            "cone",
            carom.Cone(0.4, 0.9),
            [_cone(0.4, 0.9)],
            closed.to_revolved(np.array([[0, 0.675], [0.4, -0.225], [0, -0.225]])),
        ),
        Twin(
            "ellipsoid",
            carom.Ellipsoid([0.3, 0.4, 0.6]),
            [lambda n: np.linalg.norm(n * [0.3, 0.4, 0.6], axis=-1)],
            closed.to_ellipsoid([0.3, 0.4, 0.6]),
        ),
        Twin("convex_hull", carom.ConvexHull(cloud), [_points(cloud)], closed.to_hull(cloud)),
        Twin(
            "sdf",
            carom.Sdf.from_function(
                lambda p: float(np.sqrt(p @ p)) - 0.4, [-0.4] * 3, [0.4] * 3, 0.01
            ),
            [_ball(0.4)],
            closed.to_ball(0.4),
            [(np.zeros(3), 0.4)],
            tolerance=1e-6,
        ),
        Twin(
            "height_field",
            carom.HeightField(hills, 0.25),
            triangles=_height_field_triangles(hills, 0.25),
            solid_below=True,
            flat=(np.array([5.5, 5.5, 0.0]), 1.0),
            static=True,
        ),
        Twin(
            "particles",
            carom.Particles(beads, 0.15),
            [_ball(0.15, b) for b in beads],
            closed.nearest_of([closed.to_ball(0.15, b) for b in beads]),
            [(b, 0.15) for b in beads],
        ),
        Twin(
            "compound",
            carom.Compound([box_part, ball_part]),
            [_box([0.4, 0.4, 0.4]), _ball(0.2, [0.3, 0, 0])],
            closed.nearest_of([closed.to_box([0.4] * 3), closed.to_ball(0.2, [0.3, 0, 0])]),
        ),
    ]
