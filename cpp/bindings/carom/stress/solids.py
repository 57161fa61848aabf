# SPDX-License-Identifier: Apache-2.0
"""Meshes the cases are built from."""

from __future__ import annotations

import numpy as np

BOX_FACES = np.array(
    [
        [0, 2, 1], [1, 2, 3], [4, 5, 6], [5, 7, 6], [0, 1, 4], [1, 5, 4],
        [2, 6, 3], [3, 6, 7], [0, 4, 2], [2, 4, 6], [1, 3, 5], [3, 7, 5],
    ]
)  # fmt: skip


def box_mesh(extents, centre=(0.0, 0.0, 0.0)) -> tuple[np.ndarray, np.ndarray]:
    """(vertices, faces) of a box, faces counter-clockwise from outside."""
    corners = np.array([[x, y, z] for z in (-1, 1) for y in (-1, 1) for x in (-1, 1)])
    return corners * np.asarray(extents, float) / 2 + np.asarray(centre, float), BOX_FACES.copy()


def ball_mesh(radius: float, splits: int) -> tuple[np.ndarray, np.ndarray]:
    """Icosphere: 20 * 4^splits faces, every corner on the sphere."""
    g = (1 + 5**0.5) / 2
    points = [(-1, g, 0), (1, g, 0), (-1, -g, 0), (1, -g, 0), (0, -1, g), (0, 1, g), (0, -1, -g),
              (0, 1, -g), (g, 0, -1), (g, 0, 1), (-g, 0, -1), (-g, 0, 1)]  # fmt: skip
    faces = [(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4),
             (11, 10, 2), (10, 7, 6), (7, 1, 8), (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8),
             (3, 8, 9), (4, 9, 5), (2, 4, 11), (6, 2, 10), (8, 6, 7), (9, 8, 1)]  # fmt: skip
    points = [np.array(p) / np.linalg.norm(p) for p in points]
    for _ in range(splits):
        middle: dict[tuple[int, int], int] = {}
        finer = []
        for a, b, c in faces:
            m = []
            for i, j in ((a, b), (b, c), (c, a)):
                key = (min(i, j), max(i, j))
                if key not in middle:
                    p = points[i] + points[j]
                    middle[key] = len(points)
                    points.append(p / np.linalg.norm(p))
                m.append(middle[key])
            finer += [(a, m[0], m[2]), (b, m[1], m[0]), (c, m[2], m[1]), tuple(m)]
        faces = finer
    return radius * np.array(points), np.array(faces)


def grid_mesh(size: float, cells: int) -> tuple[np.ndarray, np.ndarray]:
    """Flat square at z = 0 in 2 cells^2 triangles, facing up: an open sheet of no thickness."""
    line = np.linspace(-size / 2, size / 2, cells + 1)
    points = np.array([[x, y, 0.0] for y in line for x in line])
    faces = []
    for j in range(cells):
        for i in range(cells):
            a = j * (cells + 1) + i
            b = a + cells + 1
            faces += [(a, a + 1, b + 1), (a, b + 1, b)]
    return points, np.array(faces)
