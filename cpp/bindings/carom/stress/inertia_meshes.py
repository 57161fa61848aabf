# SPDX-License-Identifier: Apache-2.0
"""Meshes that are thin, far away, hollow or wrong, against rational arithmetic."""

from __future__ import annotations

import math
from fractions import Fraction

import numpy as np

from carom import InvalidInput, MassProperties, diagnose_mesh
from carom.stress.case import Group, largest
from carom.stress.exact_mass import inertia_error, moments_error, of_mesh
from carom.stress.motion import about, matrix
from carom.stress.solids import ball_mesh, box_mesh

cases = Group("inertia")


def of_thin_box(extents, shift=(0.0, 0.0, 0.0)) -> float:
    """Worst relative error of a moment, of a box as a mesh."""
    vertices, faces = box_mesh(extents, shift)
    body = MassProperties.mesh(vertices, faces, density=1.0)
    return moments_error(body.inertia, of_mesh(vertices, faces))


@cases.case(
    "a needle 1e-4 as wide as long: its small moment is eight digits below the sums it comes from",
    "worst relative error of a moment against rational arithmetic",
    1e-12,
    "1",
)
def needle_mesh() -> float:
    return of_thin_box((1.0, 1e-4, 1e-4))


@cases.case(
    "a plate 1e-6 as thick as wide",
    "worst relative error of a moment against rational arithmetic",
    1e-12,
    "1",
)
def plate_mesh() -> float:
    return of_thin_box((1.0, 0.7, 1e-6))


@cases.case(
    "a sliver 1e-7 thick, away from the origin: volume is a difference of nearly equal numbers",
    "worst relative error of a moment against rational arithmetic",
    1e-12,
    "1",
)
def sliver_mesh() -> float:
    return of_thin_box((1.0, 1e-7, 1e-3), (0.3, 0.1, -0.2))


@cases.case(
    "a needle askew: every entry of the tensor mixes the small moment with the large ones",
    "error of the tensor over its largest entry, 20 turned needles",
    1e-12,
    "1",
)
def needle_askew() -> float:
    rng, worst = np.random.default_rng(21), 0.0
    for _ in range(20):
        axis = rng.normal(size=3)
        r = matrix(about(axis / np.linalg.norm(axis), rng.uniform(0, 3)))
        vertices, faces = box_mesh((1.0, 1e-4, 1e-4))
        vertices = vertices @ r.T + rng.uniform(-1, 1, 3)
        body = MassProperties.mesh(vertices, faces, density=1.0)
        worst = largest(worst, inertia_error(body.inertia, of_mesh(vertices, faces)))
    return worst


@cases.case(
    "a 1 m box 1000 km from its frame's origin: moments about the origin are 1e12 times larger",
    "error of the tensor over its largest entry, against rational arithmetic",
    1e-9,
    "1",
)
def mesh_a_thousand_kilometres_away() -> float:
    vertices, faces = box_mesh((1.0, 2.0, 3.0), (1e6, -1e6, 1e6))
    body = MassProperties.mesh(vertices, faces, density=1.0)
    return inertia_error(body.inertia, of_mesh(vertices, faces))


@cases.case(
    "the same mesh a nanometre and a million kilometres large",
    "worst relative error of a moment against rational arithmetic",
    1e-14,
    "1",
)
def mesh_of_any_size() -> float:
    worst = 0.0
    for size in (1e-9, 1e9):
        vertices, faces = box_mesh((1.0 * size, 2.0 * size, 3.0 * size))
        body = MassProperties.mesh(vertices, faces, density=1.0)
        worst = largest(worst, moments_error(body.inertia, of_mesh(vertices, faces)))
    return worst


@cases.case(
    "a mesh inside out has negative mass unless somebody looks",
    "of mass and inertia, what differs from the mesh turned right, relative; inf if not said",
    1e-15,
    "1",
)
def inside_out_mesh() -> float:
    vertices, faces = box_mesh((1.0, 2.0, 3.0))
    right = MassProperties.mesh(vertices, faces, density=1.0)
    turned = MassProperties.mesh(vertices, faces[:, ::-1], density=1.0)
    if not turned.warnings or diagnose_mesh(vertices, faces[:, ::-1]).inverted != 1:
        return math.inf
    return float(largest(abs(turned.mass / 6 - 1), np.abs(turned.inertia - right.inertia).max()))


@cases.case(
    "a hollow box, 24 less 6 m^3, as it should be wound and all inside out",
    "relative error of mass and inertia against rational arithmetic, worse of the two",
    1e-14,
    "1",
    note="an inner skin wound outward is a second solid in the first, and warned of; inf if not",
)
def cavity_is_not_mass() -> float:
    outer, faces = box_mesh((2.0, 3.0, 4.0))
    inner, _ = box_mesh((1.0, 2.0, 3.0))
    vertices = np.concatenate([outer, inner])
    hollow = np.concatenate([faces, faces[:, ::-1] + 8])
    if not MassProperties.mesh(vertices, np.concatenate([faces, faces + 8])).warnings:
        return math.inf
    exact, worst = of_mesh(vertices, hollow), 0.0
    for given in (hollow, hollow[:, ::-1]):
        body = MassProperties.mesh(vertices, given, density=1.0)
        mass = abs(Fraction(body.mass) / exact.mass - 1)
        worst = largest(worst, float(mass), inertia_error(body.inertia, exact))
    return worst


@cases.case(
    "a mesh with a hole has no inside",
    "of 12 boxes with one face missing, those taken without a word",
    0,
    "meshes",
)
def open_mesh_is_refused() -> float:
    taken = 0
    vertices, faces = box_mesh((1.0, 2.0, 3.0))
    for left_out in range(12):
        try:
            MassProperties.mesh(vertices, np.delete(faces, left_out, axis=0), density=1.0)
            taken += 1
        except InvalidInput as error:
            taken += "open" not in str(error)
    return taken


@cases.case(
    "faces wound at random and every third one twice, as broken exporters write them",
    "relative error of mass and inertia against the sound mesh; inf if nothing is said",
    1e-14,
    "1",
)
def scrambled_mesh_is_mended() -> float:
    rng = np.random.default_rng(22)
    vertices, faces = ball_mesh(1.0, 2)
    exact = of_mesh(vertices, faces)
    scrambled = np.where(rng.random((len(faces), 1)) < 0.5, faces, faces[:, ::-1])
    body = MassProperties.mesh(vertices, np.concatenate([scrambled, scrambled[::3]]), density=1.0)
    if not body.warnings:
        return math.inf
    mass = abs(Fraction(body.mass) / exact.mass - 1)
    return largest(float(mass), inertia_error(body.inertia, exact))
