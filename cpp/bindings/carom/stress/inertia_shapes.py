# SPDX-License-Identifier: Apache-2.0
"""Bodies with too little, too much or too uneven inertia."""

from __future__ import annotations

import math
from fractions import Fraction

import numpy as np

from carom import InvalidInput, MassProperties, Scene, Simulation, Sphere
from carom.stress.case import Group, largest
from carom.stress.exact_mass import inertia_error, of_particles
from carom.stress.motion import AT_REST, about, lone_body, matrix, spin_energy

cases = Group("inertia")


@cases.case(
    "a single particle: no moment at all, and torque must not become infinite spin",
    "spin after a blow beside a point mass",
    0,
    "rad/s",
)
def point_mass_does_not_turn(mass_properties: MassProperties | None = None) -> float:
    scene = Scene()
    body = mass_properties or MassProperties.point([0, 0, 0], 2.0)
    assert mass_properties or body.rank == 0
    scene.add(Sphere(0.1), name="body", mass_properties=body)
    simulation = Simulation(scene)
    simulation.apply_impulse("body", [1, 0, 0], [0, 0.05, 0])
    simulation.advance(1.0)
    twist = simulation.twists()[0]
    assert abs(twist[0] - 0.5) < 1e-12, "2 kg and 1 N s make 0.5 m/s"
    return float(np.abs(twist[3:]).max())


@cases.case(
    "particles on a line that is no axis of the frame: rank 2, and nothing resists along it",
    "spin about the line, after a blow with torque along and across it",
    1e-14,
    "rad/s",
)
def rod_does_not_spin_along_itself() -> float:
    along = np.array([1.0, 2.0, -2.0]) / 3
    positions = np.outer([-1.0, 0.5, 1.0, 2.0], along)
    body = MassProperties.particles(positions, [1.0, 2.0, 3.0, 0.5])
    if body.rank != 2:
        return math.inf
    scene = Scene()
    scene.add(Sphere(0.1), name="rod", mass_properties=body)
    simulation = Simulation(scene, dt=0.01)
    simulation.apply_angular_impulse("rod", [3.0, -1.0, 2.0])
    worst = 0.0
    for _ in range(200):
        simulation.step()
        line = matrix(simulation.poses()[0, 3:]) @ along
        worst = largest(worst, abs(float(simulation.twists()[0, 3:] @ line)))
    return worst


@cases.case(
    "moments 1 : 1 : 1e-12: a blow off the axis spins a hair a million times too fast",
    "worst relative energy error in 1000 steps of 0.01 s",
    1e-3,
    "1",
)
def moments_of_a_hair(method: str = "symmetric_top") -> float:
    moments, w = (1.0, 1.0 + 0.9e-12, 1e-12), np.array([1.0, 0.5, 1e4])
    simulation = lone_body(moments, w, 0.01, method)
    start, worst = spin_energy(moments, AT_REST, w), 0.0
    for _ in range(1000):
        simulation.step()
        now = spin_energy(moments, simulation.poses()[0, 3:], simulation.twists()[0, 3:])
        worst = largest(worst, abs(now / start - 1))
    return worst


@cases.case(
    "1e12 kg and 1 kg in one body: the small one is twelve digits down",
    "largest relative error of mass, centre and inertia against rational sums",
    1e-12,
    "1",
)
def mass_ratio_of_a_trillion(combine=MassProperties.combined) -> float:
    positions = np.array([[0.1, -0.2, 0.3], [7.0, 1.0, -5.0], [3.0, 3.0, 3.0]])
    masses = [1e12, 1.0, 1e-3]
    exact = of_particles(positions, masses)
    whole = combine([MassProperties.point(p, m) for p, m in zip(positions, masses, strict=True)])
    far = largest(abs(c) for c in exact.com)
    centre = largest(abs(Fraction(float(whole.com[i])) - exact.com[i]) for i in range(3)) / far
    mass = abs(Fraction(whole.mass) / exact.mass - 1)
    return largest(float(centre), float(mass), inertia_error(whole.inertia, exact))


@cases.case(
    "ten thousand parts in another order: a running sum would show it",
    "largest relative difference of the inertia between two orders",
    1e-13,
    "1",
)
def order_of_parts_does_not_matter(combine=MassProperties.combined) -> float:
    rng = np.random.default_rng(11)
    parts = [
        MassProperties.sphere(0.1, mass=float(m)).transformed(np.eye(3), p)
        for p, m in zip(
            rng.uniform(-5, 5, (10_000, 3)), 10 ** rng.uniform(-6, 6, 10_000), strict=True
        )
    ]
    forth, back = combine(parts), combine(parts[::-1])
    return float(np.abs(forth.inertia - back.inertia).max() / np.abs(forth.inertia).max())


@cases.case(
    "a tensor no distribution of mass has (1, 1, 5): the sum of two is below the third",
    "of 5 impossible tensors, those taken",
    0,
    "tensors",
)
def impossible_tensors_are_refused() -> float:
    taken = 0
    for tensor in (
        np.diag([1.0, 1, 5]),
        np.diag([1.0, -1, 1]),
        np.diag([1.0, 1, 2 + 1e-9]),
        np.array([[1, 0.5, 0], [-0.5, 1, 0], [0, 0, 1.0]]),
        np.diag([1.0, 1, math.nan]),
    ):
        try:
            MassProperties(1.0, [0, 0, 0], tensor)
            taken += 1
        except InvalidInput as error:
            taken += "inertia" not in error.field
    return taken


@cases.case(
    "a cube has no axes of its own: any basis will do, if it is one",
    "worst |R^T R - 1| and |det R - 1| of the principal axes of 200 turned cubes",
    1e-14,
    "1",
)
def axes_of_a_cube() -> float:
    rng, worst = np.random.default_rng(12), 0.0
    cube = MassProperties.box([0.3, 0.3, 0.3], mass=2)
    for _ in range(200):
        axis = rng.normal(size=3)
        turned = cube.transformed(matrix(about(axis / np.linalg.norm(axis), 2.0)), [0, 0, 0])
        _, axes = turned.principal()
        worst = largest(worst, float(np.abs(axes.T @ axes - np.eye(3)).max()))
        worst = largest(worst, abs(float(np.linalg.det(axes)) - 1))
    return worst


@cases.case(
    "two moments apart by 1e-15 to 1e-3: eigenvectors turn wildly, the tensor must not",
    "worst relative error of axes diag(moments) axes^T, 300 tensors",
    4e-15,
    "1",
    note="eight roundings of a 3 x 3 product",
)
def nearly_equal_moments() -> float:
    rng, worst = np.random.default_rng(13), 0.0
    for i in range(300):
        split = 10.0 ** (-15 + 12 * i / 299)
        axis = rng.normal(size=3)
        r = matrix(about(axis / np.linalg.norm(axis), rng.uniform(0, 3)))
        tensor = r @ np.diag([1.0, 1 + split, 1.5]) @ r.T
        body = MassProperties(1.0, [0, 0, 0], (tensor + tensor.T) / 2)
        moments, axes = body.principal()
        worst = largest(worst, float(np.abs(axes @ np.diag(moments) @ axes.T - body.inertia).max()))
    return worst / 1.5


@cases.case(
    "sampling says how wrong it is; an estimate that is too small would be worse than none",
    "largest error of the mass over its own standard error, 40 seeds of a ball",
    4.5,
    "standard errors",
    note="the largest of 40 normal deviations stays below 4.5 with probability 0.9997; the seeds "
    "are fixed",
)
def sampling_error_is_honest(samples: int = 4000) -> float:
    worst = 0.0
    for seed in range(40):
        body = MassProperties.sampled(
            lambda p: (p * p).sum(1) < 1, [-1] * 3, [1] * 3, 1.0, samples, seed=seed
        )
        worst = largest(worst, abs(body.mass - 4 * math.pi / 3) / body.error.mass)
    return worst
