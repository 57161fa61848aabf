# SPDX-License-Identifier: Apache-2.0
"""Every pair of shapes: the largest error of the depth against an independent reference, and time.

`error` is that of the deepest point, m. Beside it: `normal`, of its normal where the reference has
one; `swapped`, between (a, b) and (b, a); `moved`, when one rigid motion carries both; `jump`, by
how much the depth changes beyond a motion of a micrometre. `coal_m` is the largest difference to
coal (PyPI), where it is installed and knows both shapes; its own tolerance is 1e-6.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path

import numpy as np

import carom
from carom.studies import pairs_coal
from carom.studies.common import Progress, Row, least_seconds, pyplot
from carom.studies.pairs_references import (
    Array,
    Placed,
    coarse_gaps,
    inverse,
    largest_gaps,
    reach_down,
    rotated,
    signed_distance,
)
from carom.studies.pairs_shapes import Twin, twins

MARGIN = 0.02
NEAR = 0.9 * MARGIN
NUDGE = 1e-6
DEEP = 0.1
"""m: overlaps of a distance grid are tried up to ten of its cells."""

Pose = tuple[Array, Array]


def _turn(random: np.random.Generator) -> Array:
    return _turns(random, 1)[0]


def _turns(random: np.random.Generator, count: int) -> Array:
    q = random.normal(size=(count, 4))
    return q / np.linalg.norm(q, axis=1, keepdims=True)


def _times(q: Array, r: Array) -> Array:
    v = q[3] * r[:3] + r[3] * q[:3] + np.cross(q[:3], r[:3])
    return np.append(v, q[3] * r[3] - q[:3] @ r[:3])


def _inside(outer: Pose, inner: Pose) -> Pose:
    return rotated(outer[1], inner[0]) + outer[0], _times(outer[1], inner[1])


def _depths(a: Twin, b: Twin, pa: list[Pose], pb: list[Pose]) -> tuple[Array, Array]:
    """Deepest separation of each pose, inf where nothing is within the margin, and its normal."""
    found = carom.collide(
        a.shape,
        b.shape,
        np.array([p for p, _ in pa]),
        np.array([p for p, _ in pb]),
        np.array([q for _, q in pa]),
        np.array([q for _, q in pb]),
        margin=MARGIN,
    )
    depth, normal = np.full(len(pa), np.inf), np.zeros((len(pa), 3))
    for c in found:
        if c["separation"] < depth[c["query"]]:
            depth[c["query"]] = c["separation"]
            normal[c["query"]] = c["normal"]
    return depth, normal


class Pair:
    """a and b with poses to try and, where there is a reference, its answers."""

    def __init__(self, a: Twin, b: Twin, trials: int, random: np.random.Generator) -> None:
        self.a, self.b, self.random = a, b, random
        self.pa: list[Pose] = []
        self.pb: list[Pose] = []
        self.true: list[float] = []
        self.normals: list[Array | None] = []
        self._grid = "sdf" in (a.name, b.name)
        self.reference, place = self._choose()
        if place is None:
            self._by_search(trials)
        while place and len(self.pa) < trials:
            pose_a, pose_b, depth, normal = place()
            # A grid gives how deep a point lies, which is the way out where the overlap is shallow.
            if depth <= NEAR and (depth >= -DEEP or not self._grid):
                self._take(pose_a, pose_b, depth, normal)

    def _take(self, pose_a: Pose, pose_b: Pose, depth: float, normal: Array | None = None) -> None:
        self.pa.append(pose_a)
        self.pb.append(pose_b)
        self.true.append(depth)
        self.normals.append(normal)

    def _choose(self) -> tuple[str, Callable[[], tuple[Pose, Pose, float, Array | None]] | None]:
        a, b = self.a, self.b
        if a.name == "plane":
            return "closed form", self._on_plane
        if self._grid and a.distance and b.distance:
            return "closed form", self._near_grid
        if a.convex and b.convex:
            return "search", None
        if a.triangles is not None and b.balls:
            return "all triangles", self._over_triangles
        return "level face", self._on_face

    def _some_pose(self) -> Pose:
        return self.random.uniform(-0.2, 0.2, 3), _turn(self.random)

    def _on_plane(self) -> tuple[Pose, Pose, float, Array | None]:
        depth = self.random.uniform(-0.05, MARGIN)
        inner = self._set_down(np.array([*self.random.uniform(-1, 1, 2), 0.1]), depth)
        outer = self._some_pose()
        return outer, _inside(outer, inner), depth, rotated(outer[1], np.array([0, 0, 1.0]))

    def _on_face(self) -> tuple[Pose, Pose, float, Array | None]:
        centre, width = self.a.flat
        depth = self.random.uniform(-0.02, MARGIN)
        where = centre + np.append(self.random.uniform(-0.1, 0.1, 2) * width, 0)
        inner = self._set_down(where, depth)
        outer = self._some_pose()
        return outer, _inside(outer, inner), depth, rotated(outer[1], np.array([0, 0, 1.0]))

    def _near_grid(self) -> tuple[Pose, Pose, float, Array | None]:
        """The grid is that of a ball: what matters of it is where its middle is."""
        other, grid = (self.b, self.a) if self.a.name == "sdf" else (self.a, self.b)
        ((middle, radius),) = grid.balls
        poses = [(self.random.uniform(-0.4, 0.4, 3), _turn(self.random)) for _ in range(2)]
        place, turn = poses[0 if other is self.a else 1]
        at = poses[1 if other is self.a else 0][0] + middle
        centre = rotated(inverse(turn), at - place)
        slope = [other.distance(centre + h) - other.distance(centre - h) for h in 1e-6 * np.eye(3)]
        normal = rotated(turn, np.array(slope) / np.linalg.norm(slope))
        depth = other.distance(centre) - radius
        return *poses, depth, normal if other is self.a else -normal

    def _set_down(self, where: Array, depth: float) -> Pose:
        """A pose of b whose lowest point is `depth` over `where`."""
        q = _turn(self.random)
        low = reach_down(self.b, q)
        return np.array([*(where[:2] - low[:2]), where[2] + depth - low[2]]), q

    def _by_search(self, count: int) -> None:
        """Poses by the score: those that a look round shows too far apart are drawn again."""
        random = self.random
        while len(self.pa) < count:
            many = 4 * count
            pose_a = random.uniform(-0.2, 0.2, (many, 3)), _turns(random, many)
            pose_b = pose_a[0] + random.uniform(-0.8, 0.8, (many, 3)), _turns(random, many)
            parts = [
                (Placed(s, *pose_a), Placed(t, *pose_b))
                for s in self.a.convex
                for t in self.b.convex
            ]
            looks = [coarse_gaps(a, b, random) for a, b in parts]
            bound = np.min([values.max(1) for values, _ in looks], axis=0)
            near = np.flatnonzero(bound <= NEAR)
            near = near[:count]
            depth = np.min(
                [
                    largest_gaps(a.some(near), b.some(near), random, (values[near], n[near]))
                    for (a, b), (values, n) in zip(parts, looks, strict=True)
                ],
                axis=0,
            )
            for i in np.flatnonzero(depth <= NEAR)[: count - len(self.pa)]:
                row = near[i]
                self._take(
                    (pose_a[0][row], pose_a[1][row]), (pose_b[0][row], pose_b[1][row]), depth[i]
                )

    def _over_triangles(self) -> tuple[Pose, Pose, float, Array | None]:
        outer = self._some_pose()
        if self.a.static:
            middle = self.random.uniform([1, 1, -0.2], [3, 3, 0.5])
        else:
            middle = self.random.uniform([-1.2, -1.2, -0.3], [1.2, 1.2, 1.3])
        inner = middle, _turn(self.random)
        depth = min(
            signed_distance(self.a, rotated(inner[1], centre) + inner[0]) - radius
            for centre, radius in self.b.balls
        )
        return outer, _inside(outer, inner), depth, None

    def measure(self, with_coal: bool) -> Row:
        a, b = self.a, self.b
        true = np.array(self.true)
        depth, normal = _depths(a, b, self.pa, self.pb)
        if self.reference == "search":
            # A depth that its own normal proves may lie above what the search found, never below.
            error = max(float((true - depth).max()), 0.0)
            error = max(error, *(self._along(i, depth[i], normal[i]) for i in range(len(true))))
        else:
            error = float(np.abs(depth - true).max())
        known = [i for i, n in enumerate(self.normals) if n is not None and math.isfinite(depth[i])]
        tilt = max((float(np.linalg.norm(normal[i] - self.normals[i])) for i in known), default=0.0)
        swapped, other = _depths(b, a, self.pb, self.pa)
        by = self.random.uniform(-3, 3, 3), _turn(self.random)
        there, _ = _depths(
            a, b, [_inside(by, p) for p in self.pa], [_inside(by, p) for p in self.pb]
        )
        nudge = self.random.normal(size=(len(true), 3))
        nudge *= NUDGE / np.linalg.norm(nudge, axis=1, keepdims=True)
        near, _ = _depths(
            a, b, self.pa, [(p + d, q) for (p, q), d in zip(self.pb, nudge, strict=True)]
        )
        arguments = [np.array(x) for x in zip(*self.pa, strict=True)]
        arguments += [np.array(x) for x in zip(*self.pb, strict=True)]
        pa, qa, pb, qb = arguments
        call = lambda: carom.collide(a.shape, b.shape, pa, pb, qa, qb, margin=MARGIN)  # noqa: E731
        seconds = least_seconds(call, batch=0.002, repeats=3) / len(true)
        return {
            "study": "pairs",
            "case": f"{a.name} {b.name}",
            "method": self.reference,
            "queries": len(true),
            "error": error,
            "error_unit": "m",
            "seconds": seconds,
            "allowed": max(a.tolerance, b.tolerance),
            "normal": tilt if known else None,
            "swapped": max(_difference(depth, swapped), float(np.abs(normal + other).max()))
            if self.reference in ("closed form", "level face")
            else _difference(depth, swapped),
            "moved": _difference(depth, there),
            "jump": max(0.0, _difference(depth, near) - NUDGE),
            "coal_m": pairs_coal.largest_difference(a, b, self.pa, self.pb, depth)
            if with_coal
            else None,
        }

    def _along(self, i: int, depth: float, n: Array) -> float:
        """How far the depth is from the gap of two parts along the normal, the nearest of them."""
        if not math.isfinite(depth):
            return math.inf
        return min(
            abs(float(-Placed(s, *self.pa[i])(n) - Placed(t, *self.pb[i])(-n)) - depth)
            for s in self.a.convex
            for t in self.b.convex
        )


def _difference(one: Array, two: Array) -> float:
    both = np.isfinite(one) & np.isfinite(two)
    if (np.isfinite(one) != np.isfinite(two)).any():
        return math.inf
    return float(np.abs(one - two)[both].max(initial=0.0))


BASES = {"plane": 3, "height_field": 2, "mesh": 1}
"""Who is a: what the reference knows best how to set things down on."""


def every_pair() -> list[tuple[Twin, Twin]]:
    """All 13 * 14 / 2 pairs but those of two static shapes, which never meet."""
    shapes = twins()
    pairs = []
    for i, first in enumerate(shapes):
        for second in shapes[i:]:
            if first.static and second.static:
                continue
            pair = sorted((first, second), key=lambda twin: -BASES.get(twin.name, 0))
            pairs.append((pair[0], pair[1]))
    return pairs


def run(progress: Progress | None = None, trials: int = 24, seed: int = 29) -> list[Row]:
    """Measures every pair at `trials` seeded poses that meet; less than a minute of work."""
    pairs = every_pair()
    rows = []
    for done, (a, b) in enumerate(pairs, 1):
        random = np.random.default_rng([seed, done])
        rows.append(Pair(a, b, trials, random).measure(pairs_coal.available()))
        if progress:
            progress(done, len(pairs))
    return rows


def _short(x: float) -> str:
    return f"{x / 1000:.0f}k" if x >= 1000 else f"{x:.0f}" if x >= 10 else f"{x:.2g}"


def as_text(rows: list[Row]) -> str:
    """A line per pair, its largest figures; `!` where the depth is off by more than allowed."""
    from carom.commands.output import table

    shown = lambda x: "" if x is None else f"{x:.0e}" if x else "0"  # noqa: E731
    head = ["pair", "reference", "depth m", "normal", "(b a)", "moved", "jump m", "coal m", "µs"]
    lines = [
        [
            row["case"],
            row["method"],
            shown(row["error"]) + ("" if row["error"] <= row["allowed"] else " !"),
            *(shown(row[key]) for key in ("normal", "swapped", "moved", "jump", "coal_m")),
            f"{1e6 * row['seconds']:.3g}",
        ]
        for row in rows
    ]
    text = [table(head, lines), "", f"{len(rows)} pairs at {rows[0]['queries']} poses each."]
    text.append(
        "Allowed: 1e-9 m; 1e-6 m of the distance grid, a ball in cells of 0.01 m, at overlaps"
    )
    return "\n".join([*text, "of up to 0.1 m. Distance grids with edges are not in this table."])


def plot(rows: list[Row], path: Path | str) -> None:
    """Two tables of squares: error and time of each pair."""
    plt = pyplot()
    names = [twin.name for twin in twins()]
    error, microseconds = (np.full((len(names), len(names)), np.nan) for _ in range(2))
    for row in rows:
        i, j = sorted(names.index(name) for name in row["case"].split())
        error[j, i] = max(row["error"], 1e-17)
        microseconds[j, i] = 1e6 * row["seconds"]
    figure, panels = plt.subplots(1, 2, figsize=(15, 7), layout="constrained")
    shown = (
        (panels[0], np.log10(error), "log10 of the largest error of the depth, m", "viridis_r"),
        (panels[1], np.log10(microseconds), "time of a pair, µs (k: thousand)", "cividis_r"),
    )
    for panel, values, title, colours in shown:
        panel.imshow(values, cmap=colours)
        middle = np.nanmean([np.nanmin(values), np.nanmax(values)])
        for j, i in np.argwhere(np.isfinite(values)):
            text = f"{values[j, i]:.0f}" if panel is panels[0] else _short(10 ** values[j, i])
            colour = "white" if values[j, i] > middle else "black"
            panel.text(i, j, text, ha="center", va="center", fontsize=8, color=colour)
        panel.set_xticks(range(len(names)), names, rotation=60, ha="right")
        panel.set_yticks(range(len(names)), names)
        panel.set_title(title)
        for side in ("top", "right"):
            panel.spines[side].set_visible(False)
    figure.savefig(path, dpi=120)
    plt.close(figure)
