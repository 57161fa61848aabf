# SPDX-License-Identifier: Apache-2.0
"""Depth of two shapes by ways that share no code with the library: closed forms, sums over all
triangles, and a plain search over directions."""

from __future__ import annotations

import numpy as np

from carom.studies.pairs_shapes import Array, Support, Twin


def rotated(q: Array, v: Array) -> Array:
    """v turned by unit quaternions x y z w."""
    u, w = q[..., :3], q[..., 3:]
    t = 2 * np.cross(u, v)
    return v + w * t + np.cross(u, t)


def inverse(q: Array) -> Array:
    return q * [-1, -1, -1, 1]


class Placed:
    """A piece's support function at a pose, or at N: positions (N, 3), orientations (N, 4)."""

    def __init__(self, support: Support, position: Array, orientation: Array) -> None:
        self.support, self.position, self.back = support, position, inverse(orientation)

    def __call__(self, n: Array) -> Array:
        """n: (..., 3) unit, world; of N poses (N, ..., 3)."""
        extra = n.ndim - self.position.ndim
        shape = (*self.position.shape[:-1], *([1] * extra))
        back = np.broadcast_to(self.back.reshape(*shape, 4), (*n.shape[:-1], 4))
        place = self.position.reshape(*shape, 3)
        return self.support(rotated(back, n)) + (n * place).sum(-1)

    def some(self, rows: Array) -> Placed:
        return Placed(self.support, self.position[rows], inverse(self.back)[rows])


def gap(a: Placed, b: Placed, n: Array) -> Array:
    """Between the planes that support a and b along n, from a to b."""
    return -a(n) - b(-n)


def coarse_gaps(a: Placed, b: Placed, random: np.random.Generator) -> tuple[Array, Array]:
    """Of N poses: (N, 4) the best gaps of a look round, and (N, 4, 3) their directions.

    Every direction tried is a lower bound, so these are never too large.
    """
    around = random.normal(size=(600, 3))
    around /= np.linalg.norm(around, axis=1, keepdims=True)
    across = b.position - a.position
    length = np.linalg.norm(across, axis=1, keepdims=True)
    n = np.repeat(around[None], len(across), axis=0)
    n[:, 0] = np.where(length > 0, across / np.where(length > 0, length, 1), n[:, 0])
    values = gap(a, b, n)
    best = np.argsort(values, axis=1)[:, -4:]
    return np.take_along_axis(values, best, 1), np.take_along_axis(n, best[..., None], 1)


def largest_gaps(
    a: Placed, b: Placed, random: np.random.Generator, start: tuple[Array, Array] | None = None
) -> Array:
    """(N,): the distances, or minus the depths; never too large.

    A coarse look round, then the best few improved by random steps that grow when they help and
    shrink when they do not: it needs no smoothness, as there is none at edges and corners.
    """
    values, n = start or coarse_gaps(a, b, random)
    step = np.full(values.shape, 0.1)
    for _ in range(120):
        tries = n[:, :, None] + step[..., None, None] * random.normal(size=(*n.shape[:2], 16, 3))
        tries /= np.linalg.norm(tries, axis=-1, keepdims=True)
        found = gap(a, b, tries)
        top = found.argmax(-1)[..., None]
        reached = np.take_along_axis(found, top, -1)[..., 0]
        better = reached > values
        new = np.take_along_axis(tries, top[..., None], -2)[..., 0, :]
        n = np.where(better[..., None], new, n)
        values = np.where(better, reached, values)
        step = np.clip(step * np.where(better, 1.4, 0.6), 1e-13, 0.5)
    return values.max(1)


def largest_gap(a: Placed, b: Placed, random: np.random.Generator) -> float:
    """largest_gaps of one pose."""
    one = [Placed(p.support, p.position[None], inverse(p.back)[None]) for p in (a, b)]
    return float(largest_gaps(one[0], one[1], random)[0])


def winding_number(triangles: Array, p: Array) -> float:
    """1 inside, 0 outside, by solid angles (A. Van Oosterom, J. Strackee, 1983)."""
    a, b, c = (triangles[:, i] - p for i in range(3))
    la, lb, lc = (np.linalg.norm(x, axis=1) for x in (a, b, c))
    top = np.einsum("ij,ij->i", a, np.cross(b, c))
    dot = lambda x, y: np.einsum("ij,ij->i", x, y)  # noqa: E731
    low = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb
    return float(np.arctan2(top, low).sum() / (2 * np.pi))


def distance_to_triangles(triangles: Array, p: Array) -> float:
    """Least over all: inside its prism the height over the plane, else the nearest edge."""
    a, b, c = (triangles[:, i] for i in range(3))
    normal = np.cross(b - a, c - a)
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    inside = np.ones(len(a), bool)
    best = np.full(len(a), np.inf)
    for p0, p1 in ((a, b), (b, c), (c, a)):
        along = p1 - p0
        inside &= np.einsum("ij,ij->i", np.cross(along, p - p0), normal) >= 0
        t = np.einsum("ij,ij->i", p - p0, along) / np.einsum("ij,ij->i", along, along)
        best = np.minimum(best, np.linalg.norm(p - p0 - np.clip(t, 0, 1)[:, None] * along, axis=1))
    height = np.abs(np.einsum("ij,ij->i", p - a, normal))
    return float(np.where(inside, np.minimum(height, best), best).min())


def signed_distance(surface: Twin, p: Array) -> float:
    """p in the frame of the surface."""
    distance = distance_to_triangles(surface.triangles, p)
    if not surface.solid_below:
        return -distance if winding_number(surface.triangles, p) > 0.5 else distance
    a, b, c = (surface.triangles[:, i] for i in range(3))
    area = lambda u, v: u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]  # noqa: E731
    whole = area(b - a, c - a)
    v, w = area(p - a, c - a) / whole, area(b - a, p - a) / whole
    over = np.flatnonzero((v >= 0) & (w >= 0) & (v + w <= 1))[0]
    height = (a + v[:, None] * (b - a) + w[:, None] * (c - a))[over, 2]
    return -distance if p[2] < height else distance


def reach_down(body: Twin, orientation: Array) -> Array:
    """Lowest point of a body at its origin, turned: only its height is used where it is not a
    single one."""
    down = rotated(inverse(orientation), np.array([0, 0, -1.0]))
    if body.triangles is not None:
        corners = rotated(orientation, body.triangles.reshape(-1, 3))
        return corners[corners[:, 2].argmin()]
    deepest = max(body.convex, key=lambda support: float(support(down)))
    # The support point is the gradient of the support function: differences over 1e-6 rad are good
    # to 1e-6 m, and only place the body sideways.
    point = np.array(
        [(float(deepest(down + h)) - float(deepest(down - h))) / 2e-6 for h in 1e-6 * np.eye(3)]
    )
    point = rotated(orientation, point)
    point[2] = -float(deepest(down))
    return point
