#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes terrain.ply: hills near Jacksboro, Tennessee, 1 : 1000, as a closed block.

The elevations are real ones: jacksboro_fault_dem.npz, 3 arc-seconds apart, which matplotlib ships
as sample data (matplotlib's licence, PSF-like). Every second sample of a square of 65 x 65 is kept;
a skirt and a floor make the surface a solid. Needs matplotlib: pip install 'carom[plot]'.
"""

from pathlib import Path

import numpy as np
from matplotlib.cbook import get_sample_data

ROW, COLUMN, SAMPLES, STRIDE = 150, 120, 33, 2
METRES_PER_DEGREE = 111_320.0
SCALE = 1e-3
FLOOR = -0.5  # m, below the lowest sample


def main() -> None:
    with get_sample_data("jacksboro_fault_dem.npz") as data:
        step = float(data["dx"]) * METRES_PER_DEGREE * STRIDE * SCALE
        latitude = float(data["ymin"])
        window = data["elevation"][ROW:, COLUMN:][
            : SAMPLES * STRIDE : STRIDE, : SAMPLES * STRIDE : STRIDE
        ]
    z = SCALE * (window[::-1].astype(float) - window.min())
    x = step * np.cos(np.radians(latitude)) * (np.arange(SAMPLES) - SAMPLES // 2)
    y = step * (np.arange(SAMPLES) - SAMPLES // 2)
    vertices, faces = [], []
    for i in range(SAMPLES):
        vertices += [(x[j], y[i], z[i, j]) for j in range(SAMPLES)]
    at = lambda i, j: i * SAMPLES + j  # noqa: E731
    for i in range(SAMPLES - 1):
        for j in range(SAMPLES - 1):
            a, b, c, d = at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)
            # The diagonal that bends less, so that ridges stay ridges.
            if abs(vertices[a][2] - vertices[c][2]) <= abs(vertices[b][2] - vertices[d][2]):
                faces += [(a, b, c), (a, c, d)]
            else:
                faces += [(a, b, d), (b, c, d)]
    n = SAMPLES - 1
    rim = [at(0, j) for j in range(n)] + [at(i, n) for i in range(n)]
    rim += [at(n, n - j) for j in range(n)] + [at(n - i, 0) for i in range(n)]
    low = len(vertices)
    vertices += [(*vertices[v][:2], FLOOR) for v in rim]
    middle = len(vertices)
    vertices.append((0.0, 0.0, FLOOR))
    for k, v in enumerate(rim):
        m = (k + 1) % len(rim)
        faces += [(v, low + k, rim[m]), (rim[m], low + k, low + m), (middle, low + m, low + k)]
    write(Path(__file__).with_name("terrain.ply"), np.array(vertices), np.array(faces))


def write(path: Path, vertices: np.ndarray, faces: np.ndarray) -> None:
    header = "\n".join(
        [
            "ply",
            "format binary_little_endian 1.0",
            "comment hills near Jacksboro, Tennessee, 1:1000, by make_terrain.py; elevations:",
            "comment jacksboro_fault_dem.npz in matplotlib's sample data (matplotlib licence)",
            f"element vertex {len(vertices)}",
            *(f"property float {axis}" for axis in "xyz"),
            f"element face {len(faces)}",
            "property list uchar int vertex_indices",
            "end_header\n",
        ]
    )
    rows = np.zeros(len(faces), dtype=[("n", "u1"), ("v", "<i4", 3)])
    rows["n"], rows["v"] = 3, faces
    path.write_bytes(header.encode() + vertices.astype("<f4").tobytes() + rows.tobytes())


if __name__ == "__main__":
    main()
