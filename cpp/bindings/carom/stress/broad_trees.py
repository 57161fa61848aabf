# SPDX-License-Identifier: Apache-2.0
"""Trees and grids on meshes that give them nothing to divide, and rays that graze."""

from __future__ import annotations

import itertools

import numpy as np

from carom import Bvh, HashGrid, broad
from carom.stress.case import Group, largest
from carom.stress.solids import ball_mesh, box_mesh, grid_mesh

cases = Group("ccd")
TREES = tuple(itertools.product(("box", "sphere", "oriented_box"), ("low", "medium", "high")))


@cases.case(
    "1e5 triangles in one place: all centres equal, no plane divides them, recursion runs away",
    "depth of the deepest of five trees (every volume, every quality)",
    64,
    "levels",
)
def tree_of_identical_triangles() -> float:
    vertices = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]])
    faces = np.tile([[0, 1, 2]], (100_000, 1))
    deepest = 0
    for volume, quality in (*TREES[:3], TREES[4], TREES[7]):
        tree = Bvh(vertices, faces, volume=volume, quality=quality)
        distance, face = tree.raycast([[0.2, 0.2, 1.0]], [[0, 0, -1.0]])
        assert distance[0] == 1.0
        assert face[0] == 0
        deepest = largest(deepest, tree.depth)
    return deepest


@cases.case(
    "rays aimed exactly at the corners and edges of a closed mesh slip between its faces",
    "of 1926 rays from inside a ball, those that come out, worst of nine trees and a grid",
    0,
    "rays",
)
def rays_do_not_leak() -> float:
    vertices, faces = ball_mesh(1.0, 3)
    edges = {tuple(sorted((f[i], f[(i + 1) % 3]))) for f in faces for i in range(3)}
    middles = np.array([(vertices[a] + vertices[b]) / 2 for a, b in sorted(edges)])
    aims = np.concatenate([vertices, middles[: 1926 - len(vertices)]])
    origins = np.tile([0.1, -0.2, 0.05], (len(aims), 1))
    indices = [Bvh(vertices, faces, volume=v, quality=q) for v, q in TREES]
    indices.append(HashGrid(vertices, faces))
    return largest(int((~index.any_hit(origins, aims - origins)).sum()) for index in indices)


@cases.case(
    "boxes of no size and no thickness: flat meshes, points, a closed box that just touches",
    "overlap and ray answers that differ from a loop over all faces, nine trees and a grid",
    0,
    "answers",
)
def boxes_of_no_size() -> float:
    vertices, faces = grid_mesh(1.0, 8)
    points = len(vertices)
    vertices = np.concatenate([vertices, [[0.1, 0.1, 0.5]] * 3])
    faces = np.concatenate([faces, [[points, points + 1, points + 2]]])
    lower = np.concatenate([vertices, vertices - [0, 0, 0.25]])
    upper = np.concatenate([vertices, vertices])
    up = np.array([0, 0, 1.0])
    starts, ends = vertices + up, vertices - up
    judge, wrong = broad.AllFaces(vertices, faces), 0
    for index in [*(Bvh(vertices, faces, v, q) for v, q in TREES), HashGrid(vertices, faces)]:
        mine = (*index.overlaps(lower, upper), *index.segments(starts, ends))
        true = (*judge.overlaps(lower, upper), *judge.segments(starts, ends))
        wrong += sum(not np.array_equal(m, t) for m, t in zip(mine, true, strict=True))
    return wrong


@cases.case(
    "faces of a micrometre and of a thousand kilometres in one mesh, rays along axes (0 and -0)",
    "ray answers that differ from a loop over all faces, nine trees and a grid",
    0,
    "answers",
)
def sizes_twelve_decades_apart() -> float:
    rng = np.random.default_rng(46)
    parts = [
        box_mesh([size] * 3, rng.uniform(-2, 2, 3) * size) for size in 10.0 ** np.arange(-6, 7)
    ]
    vertices = np.concatenate([p for p, _ in parts])
    faces = np.concatenate([f + 8 * i for i, (_, f) in enumerate(parts)])
    origins = rng.normal(size=(600, 3)) * 10.0 ** rng.uniform(-6, 6, (600, 1))
    directions = rng.normal(size=(600, 3))
    directions[::3, 0], directions[1::3, 2] = 0.0, -0.0
    judge, wrong = broad.AllFaces(vertices, faces), 0
    for index in [*(Bvh(vertices, faces, v, q) for v, q in TREES), HashGrid(vertices, faces)]:
        for mine, true in zip(
            index.raycast(origins, directions), judge.raycast(origins, directions), strict=True
        ):
            wrong += int((mine != true).sum())
    return wrong


@cases.case(
    "boxes at 2^40 m that touch in one bit, and boxes without bounds",
    "pairs of 500 boxes that differ from all pairs, over 20 steps",
    0,
    "pairs",
)
def touching_boxes_far_away() -> float:
    rng, tree, wrong = np.random.default_rng(47), broad.BoxTree(), 0
    lower = 2.0**40 + rng.integers(0, 40, (500, 3)).astype(float)
    for _ in range(20):
        lower = lower + rng.integers(-1, 2, lower.shape)
        upper = lower + rng.integers(0, 4, lower.shape)
        lower[0], upper[0] = -np.inf, np.inf
        lower[1, 2], upper[1, 2] = -np.inf, 2.0**40
        pairs = {tuple(p) for p in tree.update(lower, upper).tolist()}
        meet = ((lower[:, None] <= upper[None]) & (lower[None] <= upper[:, None])).all(2)
        true = {(i, j) for i, j in zip(*np.nonzero(meet), strict=True) if i < j}
        wrong += len(pairs ^ true)
        lower[0], lower[1, 2] = 2.0**40, 2.0**40
    return wrong
