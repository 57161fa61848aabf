# SPDX-License-Identifier: Apache-2.0
"""Cubics with multiple, clustered, outside and vanishing roots, against exact isolation."""

from __future__ import annotations

import math
from fractions import Fraction

import numpy as np

from carom import ccd
from carom.stress.case import Group, largest
from carom.studies.ccd_exact import roots_in_unit_interval

cases = Group("ccd")


def _integers(coefficients: np.ndarray) -> list[int]:
    """The same polynomial, scaled to integers; no rounding."""
    exact = [Fraction(float(c)) for c in coefficients]
    common = math.lcm(*(c.denominator for c in exact))
    whole = [int(c * common) for c in exact]
    while whole and whole[-1] == 0:
        whole.pop()
    return whole


def root_errors(polynomials: np.ndarray) -> float:
    """Largest distance of a root to its exact place, fraction of [0, 1]; inf for a wrong number."""
    found = ccd.cubic_roots(polynomials)
    worst = 0.0
    for coefficients, roots in zip(polynomials, found.roots, strict=True):
        exact = roots_in_unit_interval(_integers(coefficients))
        roots = roots[~np.isnan(roots)]
        if len(roots) != len(exact):
            return math.inf
        for root, true in zip(roots, exact, strict=True):
            low, high = true.narrower_than(80)
            worst = largest(worst, abs(float(Fraction(float(root)) - (low + high) / 2)))
    return worst


def _from_roots(*roots: float) -> list[float]:
    """Ascending coefficients; exact where the roots are short dyadic numbers."""
    p = [1.0]
    for r in roots:
        p = [a - r * b for a, b in zip([0.0, *p], [*p, 0.0], strict=True)]
    return p


@cases.case(
    "three roots of which the first two lie outside [0, 1]: a search from 0 stops at the wrong one",
    "largest error of a root over 300 cubics; inf for a wrong number of roots",
    1e-14,
    "of the step",
    note="roots at least 2^-6 apart: 16 u of the coefficients times a slope no flatter than that",
)
def roots_outside_the_step() -> float:
    rng = np.random.default_rng(43)
    grid = rng.integers(1, 63, 300) / 64.0
    outside = rng.integers(1, 200, (300, 2)) / 64.0
    outside[:, 1] += outside[:, 0]
    below = np.where(rng.random((300, 1)) < 0.5, -outside, 1 + outside)
    return root_errors(np.array([_from_roots(*b, g) for b, g in zip(below, grid, strict=True)]))


@cases.case(
    "double and triple roots, exact in binary: no sign change tells of them",
    "largest error of a root over 200 cubics; inf for a wrong number of roots",
    1e-14,
    "of the step",
)
def multiple_roots() -> float:
    polynomials = []
    for i in range(1, 64, 2):
        r = i / 64.0
        polynomials += [
            _from_roots(r, r),
            _from_roots(r, r, r),
            _from_roots(r, r, 2.0),
            _from_roots(r, r, -0.5),
            _from_roots(r, r, (i + 16) / 128.0),
            [-c for c in _from_roots(r, r, 0.0)],
        ]
    padded = [p + [0.0] * (4 - len(p)) for p in polynomials]
    return root_errors(np.array(padded))


@cases.case(
    "roots exactly at 0 and at 1, where a half-open interval loses one",
    "largest error of a root; inf for a wrong number of roots",
    1e-15,
    "of the step",
)
def roots_at_both_ends() -> float:
    third = [-1.0, 0.25, 0.5, 2.0]
    return root_errors(np.array([_from_roots(0.0, 1.0, r) for r in third]))


@cases.case(
    "leading coefficients of 1e-300 and denormal: dividing by them overflows",
    "largest error of a root against the quadratic or line that is left",
    1e-14,
    "of the step",
)
def vanishing_leading_coefficient() -> float:
    quadratic, line = _from_roots(0.25, 0.75), [-0.375, 1.0, 0.0]
    polynomials = [
        [*p, tiny] for p in (quadratic, line) for tiny in (1e-300, -1e-300, 5e-324, -0.0)
    ] + [[-0.375, 1.0, 1e-300, 1e-300], [-0.375, 1.0, -5e-324, 5e-324]]
    return root_errors(np.array(polynomials))


@cases.case(
    "coefficients scaled by 2^+-600: products of two of them leave the range of a double",
    "largest error of a root; inf for a wrong number of roots",
    1e-14,
    "of the step",
)
def coefficients_at_the_ends_of_the_range() -> float:
    base = np.array([_from_roots(0.25, 0.5, 0.75), _from_roots(0.5, 0.5, 0.25)])
    return largest(root_errors(np.ldexp(base, k)) for k in (600, -600, 1015, -1000))


@cases.case(
    "round-off that keeps an interval from shrinking: the lecture asks for a cap on the loop",
    "most function values spent on one of 3000 cubics, the lecture's method",
    192,
    "evaluations",
    note="three brackets of 64 halvings",
)
def root_search_ends(seed: int = 44) -> float:
    rng = np.random.default_rng(seed)
    clusters = [
        _from_roots(*(0.5 + rng.integers(-3, 4, 3) * 2.0 ** -rng.integers(20, 50)))
        for _ in range(1000)
    ]
    wild = rng.normal(size=(2000, 4)) * 10.0 ** rng.uniform(-150, 150, (2000, 4))
    result = ccd.cubic_roots(np.concatenate([np.array(clusters), wild]), method="lecture")
    return float(result.iterations.max())
