# SPDX-License-Identifier: Apache-2.0
"""Queries of every kind that breaks continuous collision detection, from a seed.

`generate(kind, category, count, rng)` gives (count, 8, 3): point, a, b, c or a0, a1, b0, b1, at the
start and then at the end.
"""

from __future__ import annotations

import numpy as np


def _random(rng, n, kind):
    """Overlapping boxes: points in a cube, each moving by up to its size."""
    start = rng.uniform(-1, 1, (n, 4, 3))
    return np.concatenate([start, start + rng.uniform(-1, 1, (n, 4, 3))], axis=1)


def _simulation(rng, n, kind):
    """Small features, shared motion plus a little of their own, as between two frames."""
    start = rng.uniform(-0.02, 0.02, (n, 4, 3)) + rng.uniform(-2, 2, (n, 1, 3))
    shared = rng.uniform(-0.05, 0.05, (n, 1, 3))
    own = rng.uniform(-0.02, 0.02, (n, 4, 3))
    return np.concatenate([start, start + shared + own], axis=1)


def _integer_grid(rng, n, kind):
    return rng.integers(-2, 3, (n, 8, 3)).astype(float)


def _coplanar(rng, n, kind):
    """All motion in one plane: an axis plane, or z = x + y, exact in doubles on a coarse grid."""
    q = rng.integers(-8, 9, (n, 8, 3)) / 8.0
    q[: n // 2, :, 2] = 0.25
    q[n // 2 :, :, 2] = q[n // 2 :, :, 0] + q[n // 2 :, :, 1]
    return q


def _parallel(rng, n, kind):
    """Parallel or in-plane sliding: both primitives translate in a common plane or line."""
    q = _coplanar(rng, n, kind)
    move = rng.integers(-8, 9, (n, 2, 3)) / 8.0
    move[: n // 2, :, 2] = 0
    move[n // 2 :, :, 2] = move[n // 2 :, :, 0] + move[n // 2 :, :, 1]
    split = 1 if kind == "point_triangle" else 2
    if kind == "edge_edge":
        along = q[:, 1] - q[:, 0]
        third = np.arange(n) % 3 == 0
        q[third, 3] = q[third, 2] + along[third] * rng.choice([-1, 0.5, 1, 2], (third.sum(), 1))
    q[:, 4 : 4 + split] = q[:, :split] + move[:, :1]
    q[:, 4 + split :] = q[:, split:4] + move[:, 1:]
    return q


def _degenerate(rng, n, kind):
    """Zero-length edges, zero-area triangles, coincident points; at one end or at both."""
    q = rng.integers(-2, 3, (n, 8, 3)) / 2.0
    how = np.arange(n) % 5
    for i in range(n):
        a, b = (2, 3) if kind == "edge_edge" or i % 2 else (1, 2)
        for end in ((0,), (4,), (0, 4))[i % 3]:
            if how[i] == 0:
                q[i, end + b] = q[i, end + a]
            elif how[i] == 1:
                q[i, end + 3] = 0.5 * (q[i, end + 1] + q[i, end + 2])
            elif how[i] == 2:
                q[i, end + 1] = q[i, end + 2] = q[i, end + 3]
            elif how[i] == 3:
                q[i, end + 1] = q[i, end]
            else:
                q[i, end : end + 4, 1:] = 0
    return q


def _border(rng, n, kind, time=None):
    """Contact exactly on a border or corner at an exact dyadic time: built at that time on a coarse
    grid, where the sums below have no rounding."""
    at = rng.integers(-8, 9, (n, 4, 3)) / 8.0
    weight = rng.integers(0, 9, n) / 8.0
    weight[::3] = rng.integers(0, 2, len(weight[::3]))
    if kind == "point_triangle":
        at[:, 0] = (1 - weight)[:, None] * at[:, 1] + weight[:, None] * at[:, 2]
    else:  # an end of the first edge on the second
        at[:, 0] = (1 - weight)[:, None] * at[:, 2] + weight[:, None] * at[:, 3]
    t = rng.choice([0.25, 0.5, 0.75], n) if time is None else rng.choice(time, n)
    speed = rng.integers(-8, 9, (n, 4, 3)) / 2.0
    t = t[:, None, None]
    return np.concatenate([at - t * speed, at + (1 - t) * speed], axis=1)


def _ulps(rng, q):
    """One to three coordinates moved by one to four spacings."""
    q = q.copy()
    for i in range(len(q)):
        for _ in range(rng.integers(1, 4)):
            j, k = rng.integers(8), rng.integers(3)
            for _ in range(rng.integers(1, 5)):
                q[i, j, k] = np.nextafter(q[i, j, k], rng.choice([-np.inf, np.inf]))
    return q


def _border_ulp(rng, n, kind):
    return _ulps(rng, _border(rng, n, kind))


def _ends(rng, n, kind):
    """Contact exactly at t = 0 or 1."""
    return _border(rng, n, kind, time=[0.0, 1.0])


def _ends_ulp(rng, n, kind):
    return _ulps(rng, _ends(rng, n, kind))


def _far(rng, n, kind):
    """A common offset of 1e6; the sums round, the answer is that of the rounded numbers."""
    offset = rng.choice([-1e6, 1e6, 0], (n, 1, 3))
    return _mixed(rng, n, kind) + offset


def _mixed(rng, n, kind):
    kinds = (_random, _integer_grid, _coplanar, _border, _border_ulp, _tangent, _ends)
    parts = [f(rng, n, kind) for f in kinds]
    pick = rng.integers(len(parts), size=n)
    return np.stack(parts)[pick, np.arange(n)]


def _tiny(rng, n, kind):
    return _mixed(rng, n, kind) * 10.0 ** rng.uniform(-9, -6, (n, 1, 1))


def _huge(rng, n, kind):
    return _mixed(rng, n, kind) * 10.0 ** rng.uniform(6, 9, (n, 1, 1))


def _extreme(rng, n, kind):
    """Powers of two down to denormals and up to the largest doubles."""
    exponent = rng.choice([-1070, -1040, -1000, -600, -300, 300, 600, 1000, 1018], (n, 1, 1))
    return np.ldexp(_mixed(rng, n, kind), exponent)


def _fast(rng, n, kind):
    """Moves 1e2 to 1e6 times the size of the primitives."""
    q = _mixed(rng, n, kind)
    middle = 0.5 * (q[:, :4] + q[:, 4:])
    direction = rng.normal(size=(n, 1, 3)) * 10.0 ** rng.uniform(2, 6, (n, 1, 1))
    who = np.array([1.0, 0, 0, 0] if kind == "point_triangle" else [1.0, 1, 0, 0])[None, :, None]
    return np.concatenate([middle - who * direction, middle + who * direction], axis=1)


def _tangent(rng, n, kind):
    """Double roots: the point (or edge) touches the turning plane and leaves again; then a gap of 0
    or +-2^-k is added."""
    q = np.zeros((n, 8, 3))
    for i in range(n):
        a, s = rng.integers(1, 8, 2) / 4.0
        gap = rng.choice([0.0, 0.0, 2.0**-20, -(2.0**-20), 2.0**-40, -(2.0**-40), 2.0**-52])
        # f(t) ~ (2t - 1)^2 s a + gap: the height of the point and of the plane are equal there
        if kind == "point_triangle":
            # plane z = m(t) x with m = s (2t - 1); the point at x = a (2t - 1), z = -gap
            q[i, [0, 4]] = [[-a, 0, -gap], [a, 0, -gap]]
            for end, m in ((0, -s), (4, s)):
                q[i, end + 1] = [-4, -3, -4 * m]
                q[i, end + 2] = [4, -3, 4 * m]
                q[i, end + 3] = [0, 5, 0]
        else:
            for end, m, x in ((0, -s, -a), (4, s, a)):
                q[i, end] = [x, -3, -gap]
                q[i, end + 1] = [x, 3, -gap]
                q[i, end + 2] = [-4, 0, -4 * m]
                q[i, end + 3] = [4, 0, 4 * m]
        q[i] = q[i][:, rng.permutation(3)]
    return q


def _static(rng, n, kind):
    """Nothing moves, or everything by the same vector, or all but a translation stands still."""
    q = _mixed(rng, n, kind)
    q[:, 4:] = q[:, :4]
    q[1::3, 4:] += rng.integers(-4, 5, (len(q[1::3]), 1, 3)) / 4.0
    q[2::3, 4] += rng.integers(-4, 5, (len(q[2::3]), 3)) / 4.0
    return q


def _screw(rng, n, kind):
    """Chords of a rigid rotation about a random axis."""
    q = _mixed(rng, n, kind)
    axis = rng.normal(size=(n, 3))
    axis /= np.linalg.norm(axis, axis=1)[:, None]
    angle = rng.uniform(-1, 1, n) * 10.0 ** rng.uniform(-3, 0.4, n)
    moving = (0,) if kind == "point_triangle" else (0, 1)
    q[:, 4:] = q[:, :4]
    for j in moving:
        x = q[:, j]
        along = np.einsum("ni,ni->n", axis, x)[:, None] * axis
        c, s = np.cos(angle)[:, None], np.sin(angle)[:, None]
        q[:, 4 + j] = along + c * (x - along) + s * np.cross(axis, x)
    return q


def _gap(rng, n, kind):
    """A near miss: a translation that stops 1e-16 .. 1e-3 short, or goes that much too far."""
    q = _border(rng, n, kind, time=[0.5])
    at = 0.5 * (q[:, :4] + q[:, 4:])
    who = np.array([1.0, 0, 0, 0] if kind == "point_triangle" else [1.0, 1, 0, 0])[None, :, None]
    if kind == "point_triangle":
        normal = np.cross(at[:, 2] - at[:, 1], at[:, 3] - at[:, 1])
    else:
        normal = np.cross(at[:, 1] - at[:, 0], at[:, 3] - at[:, 2])
    length = np.linalg.norm(normal, axis=1)[:, None]
    normal = np.where(length > 0, normal / np.where(length > 0, length, 1), [[0, 0, 1.0]])
    gap = rng.choice([-1, 1], (n, 1)) * 10.0 ** rng.uniform(-16, -3, (n, 1))
    end = at + who * (gap * normal)[:, None]
    return np.concatenate([at + who * normal[:, None], end], axis=1)


def _rotated_sliding(rng, n, kind):
    """In-plane sliding turned by a random rotation: coplanar to rounding, half moved by ulps."""
    q = _parallel(rng, n, kind)
    turn = np.linalg.qr(rng.normal(size=(n, 3, 3)))[0]
    q = np.einsum("nij,nkj->nki", turn, q)
    q[::2] = _ulps(rng, q[::2])
    return q


def _slivers(rng, n, kind):
    """Axes and corners of very different sizes."""
    q = _mixed(rng, n, kind)
    q *= 10.0 ** rng.integers(-8, 1, (n, 1, 3))
    q[::2, [2, 6]] *= 10.0 ** rng.integers(-6, 4, (len(q[::2]), 1, 1))
    return q


def _wide_range(rng, n, kind):
    """Some coordinates 2^-120 to 2^120 times the others, in one query."""
    q = _mixed(rng, n, kind)
    scaled = np.ldexp(q, rng.integers(-120, 121, q.shape))
    return np.where(rng.random(q.shape) < 0.3, scaled, q)


CATEGORIES = {
    "random": _random,
    "simulation": _simulation,
    "integer_grid": _integer_grid,
    "coplanar": _coplanar,
    "parallel": _parallel,
    "degenerate": _degenerate,
    "border": _border,
    "border_ulp": _border_ulp,
    "ends": _ends,
    "ends_ulp": _ends_ulp,
    "far": _far,
    "tiny": _tiny,
    "huge": _huge,
    "extreme": _extreme,
    "fast": _fast,
    "tangent": _tangent,
    "static": _static,
    "screw": _screw,
    "gap": _gap,
    "rotated_sliding": _rotated_sliding,
    "slivers": _slivers,
    "wide_range": _wide_range,
}


def generate(kind: str, category: str, count: int, rng: np.random.Generator) -> np.ndarray:
    """(count, 8, 3) queries of one category; every value is finite."""
    q = np.ascontiguousarray(CATEGORIES[category](rng, count, kind))
    assert q.shape == (count, 8, 3)
    assert np.isfinite(q).all()
    return q
