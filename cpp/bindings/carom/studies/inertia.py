# SPDX-License-Identifier: Apache-2.0
"""Mass properties by sampling, by a grid and by exact mesh sums, against closed forms.

The error is that of the inertia tensor, |I - I_exact| / |I_exact| (Frobenius), as root mean square
over seeds for methods that draw random points. `seconds` is the median time of one evaluation, the
inside test in numpy included. For meshes `samples` counts triangles: the sums are exact for the
mesh, so what is left is the error of the facets.
"""

from __future__ import annotations

import math
import statistics
import time
from collections.abc import Callable, Iterator
from typing import Any, NamedTuple

import numpy as np

from carom import MassProperties

Row = dict[str, Any]
Points = np.ndarray
"""(N, 3) float64, m."""

COUNTS = (1_000, 8_000, 64_000, 256_000)
SEEDS = 12
METHODS = ("monte_carlo", "stratified", "grid", "mesh")
RANDOM = ("monte_carlo", "stratified")


class Case(NamedTuple):
    name: str
    lower: tuple[float, float, float]
    upper: tuple[float, float, float]
    inside: Callable[[Points], np.ndarray]
    density: float | Callable[[Points], np.ndarray]
    exact: np.ndarray
    """(3, 3) kg m^2, closed form."""
    mesh: Callable[[int], tuple[np.ndarray, np.ndarray]] | None
    """(vertices, faces) inscribed in the body, of about so many faces."""


def ring_mesh(
    profile: Callable[[np.ndarray], tuple[np.ndarray, np.ndarray]], around: int, along: int
) -> tuple[np.ndarray, np.ndarray]:
    """Surface of a closed curve (r, z) turned about z: `around` x `along` quads cut in two."""
    r, z = profile(np.arange(along) * (2 * math.pi / along))
    turn = np.arange(around)[:, None] * (2 * math.pi / around)
    vertices = np.stack(
        [r * np.cos(turn), r * np.sin(turn), np.broadcast_to(z, (around, along))], axis=-1
    ).reshape(-1, 3)
    i, j = np.meshgrid(np.arange(around), np.arange(along), indexing="ij")
    a, b = i * along + j, (i + 1) % around * along + j
    c, d = (i + 1) % around * along + (j + 1) % along, i * along + (j + 1) % along
    faces = np.stack([np.stack([a, b, c], -1), np.stack([a, c, d], -1)]).reshape(-1, 3)
    return vertices, faces


def torus_mesh(faces: int) -> tuple[np.ndarray, np.ndarray]:
    along = max(4, round(math.sqrt(faces / 8)))  # edges about equal: the ring is 4 times as long
    return ring_mesh(
        lambda t: (1 + 0.25 * np.cos(t), 0.25 * np.sin(t)), faces // (2 * along), along
    )


def ball_mesh(faces: int) -> tuple[np.ndarray, np.ndarray]:
    """Cube of n x n squares on a side, blown up to the sphere."""
    n = max(1, round(math.sqrt(faces / 12)))
    side = np.tan(np.linspace(-math.pi / 4, math.pi / 4, n + 1))
    u, v = np.meshgrid(side, side, indexing="ij")
    i, j = np.meshgrid(np.arange(n), np.arange(n), indexing="ij")
    a, b = i * (n + 1) + j, (i + 1) * (n + 1) + j
    cells = np.stack([np.stack([a, b, b + 1], -1), np.stack([a, b + 1, a + 1], -1)]).reshape(-1, 3)
    vertices, triangles = [], []
    for axis in range(3):
        for sign in (-1.0, 1.0):
            points = np.stack([u, v, np.full_like(u, sign)], -1).reshape(-1, 3)
            points = np.roll(points / np.linalg.norm(points, axis=1)[:, None], axis + 1, axis=1)
            triangles.append((cells if sign > 0 else cells[:, ::-1]) + len(vertices) * (n + 1) ** 2)
            vertices.append(points)
    # The six sheets meet at equal corners up to rounding: joined by rounding them alike.
    return np.round(np.vstack(vertices), 14) + 0.0, np.vstack(triangles)


def _in_ball(p: Points) -> np.ndarray:
    return (p * p).sum(axis=1) <= 1


def _in_torus(p: Points) -> np.ndarray:
    return (np.hypot(p[:, 0], p[:, 1]) - 1) ** 2 + p[:, 2] ** 2 <= 0.25**2


def _in_bowl(p: Points) -> np.ndarray:
    return _in_ball(p) & (p[:, 2] <= 0)


def cases() -> list[Case]:
    ball_mass = 1000 * 4 / 3 * math.pi
    torus_mass = 1000 * 2 * math.pi**2 * 0.25**2
    across = torus_mass * (0.5 + 5 / 8 * 0.25**2)
    cube = ((-1.0, -1.0, -1.0), (1.0, 1.0, 1.0))
    # rho = 1000 r^2 in the unit ball: m r^2 integrates to 4 pi/7, two thirds of it about an axis
    graded = 1000 * 8 * math.pi / 21
    # half a ball below z = 0, about its own centre 3/8 below the flat side
    half = 0.5 * ball_mass
    tilted = half * (0.4 - 9 / 64)
    return [
        Case("ball", *cube, _in_ball, 1000.0, 0.4 * ball_mass * np.eye(3), ball_mesh),
        Case(
            "torus",
            (-1.25, -1.25, -0.25),
            (1.25, 1.25, 0.25),
            _in_torus,
            1000.0,
            np.diag([across, across, torus_mass * (1 + 0.75 * 0.25**2)]),
            torus_mesh,
        ),
        Case(
            "ball, density 1000 r^2",
            *cube,
            _in_ball,
            lambda p: 1000 * (p * p).sum(axis=1),
            graded * np.eye(3),
            None,
        ),
        Case("half a ball", *cube, _in_bowl, 1000.0, np.diag([tilted, tilted, 0.4 * half]), None),
    ]


def _evaluate(case: Case, method: str, count: int, seed: int) -> tuple[MassProperties, int, float]:
    if method == "mesh":
        assert case.mesh is not None
        vertices, faces = case.mesh(count)
        start = time.perf_counter()
        body = MassProperties.mesh(vertices, faces, density=1000.0)
        return body, len(faces), time.perf_counter() - start
    start = time.perf_counter()
    body = MassProperties.sampled(
        case.inside, case.lower, case.upper, case.density, count, seed=seed, method=method
    )
    seconds = time.perf_counter() - start
    assert body.error is not None
    return body, body.error.samples, seconds


def _plan() -> Iterator[tuple[Case, str, int]]:
    for case in cases():
        for method in METHODS:
            if method == "mesh" and case.mesh is None:
                continue
            for count in COUNTS:
                # a quarter of a million faces cost a second and tell no more than 64 000
                if method != "mesh" or count < COUNTS[-1]:
                    yield case, method, count


def run(progress: Callable[[int, int], None] | None = None) -> list[Row]:
    """Measures every case, method and count; ten to twenty seconds.

    progress: called with (rows done, rows in all) after each row.
    """
    plan = list(_plan())
    rows: list[Row] = []
    for case, method, count in plan:
        seeds = range(SEEDS if method in RANDOM else 1)
        runs = [_evaluate(case, method, count, seed) for seed in seeds]
        scale = np.linalg.norm(case.exact)
        errors = [np.linalg.norm(body.inertia - case.exact) / scale for body, _, _ in runs]
        rows.append(
            {
                "study": "inertia",
                "case": case.name,
                "method": method,
                "samples": runs[0][1],
                "error": float(np.sqrt(np.mean(np.square(errors)))),
                "error_unit": "relative",
                "seconds": statistics.median(seconds for _, _, seconds in runs),
            }
        )
        if progress is not None:
            progress(len(rows), len(plan))
    return rows


def slopes(rows: list[Row]) -> dict[tuple[str, str], float]:
    """Least-squares slope of log error against log samples for each (case, method)."""
    groups: dict[tuple[str, str], list[Row]] = {}
    for row in rows:
        groups.setdefault((row["case"], row["method"]), []).append(row)
    return {
        key: float(
            np.polyfit(
                np.log([row["samples"] for row in group]),
                np.log([row["error"] for row in group]),
                1,
            )[0]
        )
        for key, group in groups.items()
    }
