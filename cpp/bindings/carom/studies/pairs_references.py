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
    """A piece's support function at a pose."""

    def __init__(self, support: Support, position: Array, orientation: Array) -> None:
        self.support, self.position, self.back = support, position, inverse(orientation)

    def __call__(self, n: Array) -> Array:
        """n: (..., 3) unit, world."""
        return self.support(rotated(np.broadcast_to(self.back, (*n.shape[:-1], 4)), n)) + (
            n @ self.position
        )


def gap(a: Placed, b: Placed, n: Array) -> Array:
    """Between the planes that support a and b along n, from a to b."""
    return -a(n) - b(-n)


def largest_gap(a: Placed, b: Placed, random: np.random.Generator) -> float:
    """The distance, or minus the depth. Every direction tried is a lower bound, so never too large.

    A coarse look round, then the best few improved by random steps that grow when they help and
    shrink when they do not: it needs no smoothness, as there is none at edges and corners.
    """
    n = random.normal(size=(1200, 3))
    n /= np.linalg.norm(n, axis=1, keepdims=True)
    across = b.position - a.position
    if np.linalg.norm(across) > 0:
        n[0] = across / np.linalg.norm(across)
    values = gap(a, b, n)
    best = np.argsort(values)[-4:]
    n, values = n[best], values[best]
    step = np.full(len(n), 0.1)
    for _ in range(120):
        tries = n[:, None] + step[:, None, None] * random.normal(size=(len(n), 16, 3))
        tries /= np.linalg.norm(tries, axis=2, keepdims=True)
        found = gap(a, b, tries)
        top = found.argmax(1)
        reached = found[np.arange(len(n)), top]
        better = reached > values
        n = np.where(better[:, None], tries[np.arange(len(n)), top], n)
        values = np.where(better, reached, values)
        step = np.clip(step * np.where(better, 1.4, 0.6), 1e-13, 0.5)
    return float(values.max())


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
