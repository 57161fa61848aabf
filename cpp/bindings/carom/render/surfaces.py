# SPDX-License-Identifier: Apache-2.0
"""The scene as things to draw: triangles, spheres and planes, in the world."""

from __future__ import annotations

import warnings
from dataclasses import dataclass

import numpy as np

from carom._core import Plane, Scene, Sphere
from carom.render.outlines import outline

SMOOTH_COS = np.cos(0.6)
"""Choice: faces that meet below 0.6 rad are drawn as one smooth surface, others with an edge."""


@dataclass
class Surfaces:
    corners: np.ndarray
    """(T, 3, 3) m, world"""
    normals: np.ndarray
    """(T, 3, 3) unit, at the corners"""
    triangle_body: np.ndarray
    """(T,) row"""
    centres: np.ndarray
    """(S, 3) m"""
    radii: np.ndarray
    """(S,) m"""
    sphere_body: np.ndarray
    """(S,) row"""
    plane_normals: np.ndarray
    """(P, 3) unit"""
    plane_offsets: np.ndarray
    """(P,) m"""
    plane_body: np.ndarray
    """(P,) row"""


def surfaces_of(scene: Scene, poses: np.ndarray) -> Surfaces:
    """poses: (N, 7) as `Simulation.poses()` gives them, a row for each body of the scene."""
    triangles, spheres, planes = [], [], []
    for row, (body, pose) in enumerate(zip(scene.bodies, poses, strict=True)):
        position, turn = pose[:3], rotation_matrix(pose[3:])
        if isinstance(body.shape, Sphere):
            spheres.append((position, body.shape.radius, row))
        elif isinstance(body.shape, Plane):
            normal = turn @ (body.shape.normal / np.linalg.norm(body.shape.normal))
            planes.append((normal, body.shape.offset + normal @ position, row))
        elif hasattr(body.shape, "positions"):  # a set of equal balls
            centres = body.shape.positions @ turn.T + position
            spheres += [(centre, body.shape.radius, row) for centre in centres]
        elif (found := outline(body.shape)) is None:
            warnings.warn(f"{body.name} is not drawn: {type(body.shape).__name__}", stacklevel=2)
        else:
            corners, normals = _triangles(*found)
            rows = np.full(len(corners), row)
            triangles.append((corners @ turn.T + position, normals @ turn.T, rows))
    none = np.empty((0, 3, 3)), np.empty((0, 3, 3)), np.empty(0)
    corners, normals, rows = map(np.concatenate, zip(*triangles, none, strict=True))
    return Surfaces(
        corners,
        normals,
        rows.astype(np.int64),
        np.array([s[0] for s in spheres]).reshape(-1, 3),
        np.array([s[1] for s in spheres]),
        np.array([s[2] for s in spheres], dtype=np.int64),
        np.array([p[0] for p in planes]).reshape(-1, 3),
        np.array([p[1] for p in planes]),
        np.array([p[2] for p in planes], dtype=np.int64),
    )


def rotation_matrix(xyzw: np.ndarray) -> np.ndarray:
    """(3, 3) from a unit quaternion x y z w."""
    x, y, z, w = xyzw
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )


def _triangles(vertices: np.ndarray, faces: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Corners and corner normals, body frame."""
    corners = vertices[faces]
    area = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    return corners, _unit(_smooth(area, faces))


def _smooth(area: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """(T, 3, 3): at each corner, the sum over the faces that meet there without an edge between."""
    vertex = faces.reshape(-1)
    by_vertex = np.argsort(vertex, kind="stable")
    valence = np.bincount(vertex)
    first = np.cumsum(valence) - valence
    count = valence[vertex]  # each corner is paired with every corner at its vertex, itself too
    corner = np.repeat(np.arange(len(vertex)), count)
    place = np.arange(len(corner)) - np.repeat(np.cumsum(count) - count, count)
    other = by_vertex[first[vertex[corner]] + place] // 3
    normal = _unit(area)
    joined = (normal[corner // 3] * normal[other]).sum(1) > SMOOTH_COS
    smooth = np.zeros((len(vertex), 3))
    np.add.at(smooth, corner[joined], area[other[joined]])
    return smooth.reshape(-1, 3, 3)


def _unit(vectors: np.ndarray) -> np.ndarray:
    length = np.linalg.norm(vectors, axis=-1, keepdims=True)
    return vectors / np.where(length > 0, length, 1)
