# SPDX-License-Identifier: Apache-2.0
"""Writes the meshes of the tree benches into the working folder: gen_meshes.py [FILE.obj]

FILE.obj: a further mesh, for example the Sponza hall in the media folder of the crate `bvh`.
"""

import sys
from pathlib import Path

import numpy as np


def save(name, vertices, faces):
    """Two int64 counts, float64 vertices, int32 faces: what common.h reads."""
    with Path(name).open("wb") as out:
        np.array([len(vertices), len(faces)], np.int64).tofile(out)
        np.ascontiguousarray(vertices, np.float64).tofile(out)
        np.ascontiguousarray(faces, np.int32).tofile(out)
    print(name, len(vertices), len(faces))


def grid(rows, columns):
    i, j = np.meshgrid(np.arange(rows), np.arange(columns), indexing="ij")
    a = (i * (columns + 1) + j).ravel()
    b = ((i + 1) * (columns + 1) + j).ravel()
    return np.concatenate([np.stack([a, b, b + 1], 1), np.stack([a, b + 1, a + 1], 1)])


def noise(points, rng, waves=24, amplitude=0.25):
    total = np.zeros(len(points))
    for k in range(waves):
        w = rng.normal(0, 2.0 + k * 0.9, 3)
        total += amplitude / (1 + k * 0.5) * np.sin(points @ w + rng.uniform(0, 7))
    return total


def sphere_and_terrain(name, triangles):
    n = round((triangles / 2) ** 0.5)
    rng = np.random.default_rng(5)
    faces = grid(n, n)
    u, v = (a.ravel() for a in np.meshgrid(*[np.linspace(0, 1, n + 1)] * 2, indexing="ij"))
    polar, azimuth = np.pi * (0.001 + 0.998 * u), 2 * np.pi * v
    d = np.stack(
        [np.sin(polar) * np.cos(azimuth), np.sin(polar) * np.sin(azimuth), np.cos(polar)], 1
    )
    save(f"sphere_{name}.bin", d * (1 + 0.15 * noise(d * 2, rng))[:, None], faces)
    p = np.stack([u * 10, v * 10, 0 * u], 1)
    p[:, 2] = noise(p * 0.5, rng) * 0.8
    save(f"terrain_{name}.bin", p, faces)


def read_obj(path):
    vertices, faces = [], []
    for line in Path(path).read_text().splitlines():
        kind, *rest = line.split() or [""]
        if kind == "v":
            vertices.append([float(x) for x in rest[:3]])
        elif kind == "f":
            given = [int(x.split("/")[0]) for x in rest]
            corner = [i - 1 if i > 0 else len(vertices) + i for i in given]
            faces += [[corner[0], corner[k], corner[k + 1]] for k in range(1, len(corner) - 1)]
    return np.array(vertices), np.array(faces)


for size, count in (("20k", 20_000), ("200k", 200_000), ("1m", 1_000_000)):
    sphere_and_terrain(size, count)
if len(sys.argv) > 1:
    save("sponza.bin", *read_obj(sys.argv[1]))
