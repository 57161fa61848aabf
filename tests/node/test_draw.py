# SPDX-License-Identifier: Apache-2.0
"""Shapes RViz has no marker for are drawn as closed surfaces of the right size."""

import math
from dataclasses import dataclass, field

import numpy as np
import pytest
from visualization_msgs.msg import Marker

from carom_ros.draw import AROUND, draw
from carom_ros.shapes import require_closed


# The core may be older than these shapes: what is drawn is told by name and fields alone.
@dataclass
class Capsule:
    radius: float
    length: float


@dataclass
class Cone:
    radius: float
    length: float


@dataclass
class Ellipsoid:
    radii: tuple


@dataclass
class Particles:
    radius: float
    positions: np.ndarray


@dataclass
class HeightField:
    spacing: float
    heights: np.ndarray = field(default_factory=lambda: np.array([[0.0, 1.0], [2.0, 3.0]]))


@dataclass
class Unheard:
    pass


def drawn(shape: object) -> Marker:
    marker = Marker(ns="body")
    draw(marker, shape)
    return marker


def corners(marker: Marker) -> np.ndarray:
    return np.array([[p.x, p.y, p.z] for p in marker.points])


def volume(points: np.ndarray) -> float:
    a, b, c = points.reshape(-1, 3, 3).transpose(1, 0, 2)
    return float(np.einsum("ij,ij->", a, np.cross(b, c))) / 6


@pytest.mark.parametrize(
    ("shape", "low", "high", "exact"),
    [
        (Capsule(0.5, 2.0), -1.5, 1.5, math.pi * 0.25 * 2 + 4 / 3 * math.pi * 0.125),
        (Cone(0.5, 2.0), -0.5, 1.5, math.pi * 0.25 * 2 / 3),
    ],
)
def test_a_round_shape_is_closed_outward_and_of_its_size(
    shape: object, low: float, high: float, exact: float
) -> None:
    points = corners(drawn(shape))
    vertices, index = np.unique(np.round(points, 12), axis=0, return_inverse=True)
    require_closed(vertices, index.reshape(-1, 3))  # closed, and volume > 0: it faces outward
    assert (points[:, 2].min(), points[:, 2].max()) == pytest.approx((low, high), abs=1e-12)
    assert points[:, 0].max() == pytest.approx(0.5, abs=1e-12)
    # An inscribed polygon of n corners has sin(x) / x, x = 2 pi / n, of the circle's area; the
    # caps' facets take off as much again at most.
    x = 2 * math.pi / AROUND
    assert exact * (math.sin(x) / x) ** 2 <= volume(points) < exact


def test_the_others() -> None:
    assert drawn(Ellipsoid((1, 2, 3))).scale.z == 6
    balls = drawn(Particles(0.1, np.eye(3)))
    assert (balls.type, len(balls.points), balls.scale.x) == (Marker.SPHERE_LIST, 3, 0.2)
    ground = corners(drawn(HeightField(0.5)))
    assert len(ground) == 6
    assert ground[:, 2].max() == 3
    assert ground[np.argmax(ground[:, 2])].tolist() == [0.5, 0.5, 3.0]
    assert "Unheard" in drawn(Unheard()).text
