# SPDX-License-Identifier: Apache-2.0
"""Mass properties in rational arithmetic: every double is a fraction, and no rounding follows."""

from __future__ import annotations

from collections.abc import Iterable
from fractions import Fraction
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from carom.stress.case import largest


class ExactMass(NamedTuple):
    mass: Fraction
    com: list[Fraction]
    inertia: list[list[Fraction]]
    """About the centre of mass."""


def _from_sums(mass: Fraction, first: list[Fraction], second: list[list[Fraction]]) -> ExactMass:
    """From integrals of 1, x and x x^T."""
    com = [f / mass for f in first]
    about = [[second[i][j] - mass * com[i] * com[j] for j in range(3)] for i in range(3)]
    trace = sum(about[i][i] for i in range(3))
    inertia = [[(trace if i == j else 0) - about[i][j] for j in range(3)] for i in range(3)]
    return ExactMass(mass, com, inertia)


def of_mesh(vertices: ArrayLike, faces: Iterable[Iterable[int]]) -> ExactMass:
    """Density 1, by the tetrahedra from the origin to each face."""
    points = [[Fraction(float(x)) for x in p] for p in np.asarray(vertices, float)]
    mass, first = Fraction(0), [Fraction(0)] * 3
    second = [[Fraction(0)] * 3 for _ in range(3)]
    for face in faces:
        a, b, c = (points[int(k)] for k in face)
        cross = [
            b[(i + 1) % 3] * c[(i + 2) % 3] - b[(i + 2) % 3] * c[(i + 1) % 3] for i in range(3)
        ]
        six_volumes = sum(a[i] * cross[i] for i in range(3))
        mass += six_volumes / 6
        total = [a[i] + b[i] + c[i] for i in range(3)]
        for i in range(3):
            first[i] += six_volumes * total[i] / 24
            for j in range(3):
                corners = a[i] * a[j] + b[i] * b[j] + c[i] * c[j]
                second[i][j] += six_volumes * (corners + total[i] * total[j]) / 120
    return _from_sums(mass, first, second)


def of_particles(positions: ArrayLike, masses: ArrayLike) -> ExactMass:
    points = [[Fraction(float(x)) for x in p] for p in np.asarray(positions, float)]
    weights = [Fraction(float(m)) for m in np.asarray(masses, float)]
    mass = sum(weights, Fraction(0))
    pairs = list(zip(weights, points, strict=True))
    first = [sum((m * p[i] for m, p in pairs), Fraction(0)) for i in range(3)]
    second = [
        [sum((m * p[i] * p[j] for m, p in pairs), Fraction(0)) for j in range(3)] for i in range(3)
    ]
    return _from_sums(mass, first, second)


def inertia_error(found: ArrayLike, exact: ExactMass) -> float:
    """Largest error of an entry, over the largest exact entry."""
    found = np.asarray(found, float)
    scale = largest(abs(exact.inertia[i][i]) for i in range(3))
    errors = (
        abs(Fraction(float(found[i, j])) - exact.inertia[i][j]) for i in range(3) for j in range(3)
    )
    return float(largest(errors) / scale)


def moments_error(found: ArrayLike, exact: ExactMass) -> float:
    """Largest relative error of a diagonal entry: for bodies whose axes are the frame's."""
    found = np.asarray(found, float)
    return float(
        largest(abs(Fraction(float(found[i, i])) / exact.inertia[i][i] - 1) for i in range(3))
    )
