# SPDX-License-Identifier: Apache-2.0
"""Forces stiffer than the step: an explicit update would explode."""

from __future__ import annotations

import math

import numpy as np

from carom import InvalidInput, LinearDrag, Scene, Simulation, Sphere, TorsionSpring, UniformGravity
from carom.stress.case import Group, largest
from carom.stress.motion import top

cases = Group("time")
STIFFNESS = (1e-3, 0.1, 1.0, 2.1, 10.0, 1e4, 1e8)
"""k dt; explicit updates diverge above 2."""


def _dragged(k_dt: float, dt: float = 0.01, wind=(0.0, 0.0, 0.0), gravity: float = 0.0):
    scene = Scene()
    scene.add(Sphere(0.1), name="ball", mass=1.0, velocity=[10, 0, 0], angular_velocity=[0, 0, 5])
    scene.effects.append(LinearDrag(k_dt / dt, wind=wind))
    if gravity:
        scene.effects.append(UniformGravity([0, 0, -gravity]))
    return Simulation(scene, dt=dt)


@cases.case(
    "drag up to 1e8 per step: explicit growth is 1e200 in 50 steps",
    "largest error of the speed against v0 exp(-k t), over v0, k dt from 1e-3 to 1e8",
    1e-13,
    "1",
    note="50 steps whose factor exp(-k dt) is off by 2 u (1 + k dt), where anything is left of it",
)
def drag_at_any_stiffness() -> float:
    worst = 0.0
    for k_dt in STIFFNESS:
        simulation = _dragged(k_dt)
        for n in range(1, 51):
            simulation.step()
            v = simulation.twists()[0, 0]
            worst = largest(worst, abs(v - 10 * math.exp(-k_dt * n)) / 10)
    return worst


@cases.case(
    "the way travelled under drag is a difference of near-equals at small k dt",
    "largest relative error of the distance, k dt from 1e-3 to 1e8",
    1e-12,
    "1",
)
def distance_under_drag() -> float:
    worst = 0.0
    for k_dt in STIFFNESS:
        simulation = _dragged(k_dt)
        simulation.advance(0.5)
        k = k_dt / 0.01
        expected = -10 / k * math.expm1(-k * 0.5)
        worst = largest(worst, abs(simulation.poses()[0, 0] / expected - 1))
    return worst


@cases.case(
    "terminal speed m g / c at any c: operator splitting gives g dt or 0 instead",
    "largest relative error of the terminal speed, k dt from 0.1 to 1e8",
    1e-12,
    "1",
)
def terminal_speed() -> float:
    worst = 0.0
    for k_dt in STIFFNESS[1:]:
        simulation = _dragged(k_dt, gravity=9.81)
        simulation.advance(largest(0.5, 40 * 0.01 / k_dt))
        worst = largest(worst, abs(simulation.twists()[0, 2] / (-9.81 * 0.01 / k_dt) - 1))
    return worst


@cases.case(
    "a gust of 1e4 m/s from one step to the next, k dt = 1e4",
    "how far the ball's speed ever exceeds the wind's",
    1e-11,
    "m/s",
    note="two roundings of 1e4 m/s are 3.6e-12",
)
def gust_does_not_overshoot() -> float:
    simulation = _dragged(1e4, wind=(1e4, 0, 0))
    worst = -math.inf
    for _ in range(50):
        simulation.step()
        worst = largest(worst, simulation.twists()[0, 0] - 1e4)
    if abs(simulation.twists()[0, 0] - 1e4) > 1e-9:
        return math.inf
    return worst


@cases.case(
    "rotational drag up to 1e8 per step on an asymmetric body: stiff torque must go implicit",
    "largest growth of the rotational energy from any step to the next, over the first",
    1e-15,
    "1",
)
def spin_drag_at_any_stiffness() -> float:
    worst = -math.inf
    for k_dt in STIFFNESS:
        scene = Scene()
        scene.add(Sphere(0.1), mass_properties=top((1, 2, 2.5)), angular_velocity=[3.0, 2.0, 1.0])
        scene.effects.append(LinearDrag(0.0, angular_coefficient=k_dt / 0.01))
        simulation = Simulation(scene, dt=0.01)
        first = last = simulation.energy().kinetic
        for _ in range(200):
            simulation.step()
            now = simulation.energy().kinetic
            worst = largest(worst, (now - last) / first)
            last = now
    return worst


@cases.case(
    "a torsion spring of 1e9 N m/rad: 5000 rad of its own phase in one step",
    "largest gain of energy over the first, 1000 steps of 1/60 s",
    1e-4,
    "1",
    note="the spring's axes are held over a step in which the body turns by up to its amplitude, "
    "w sqrt(I / k) = 5e-5 rad: twice that of the energy",
)
def spring_too_stiff_for_the_step() -> float:
    scene = Scene()
    scene.add(Sphere(0.1), mass_properties=top((1, 2, 2.5)), angular_velocity=[1.0, 0.5, 0.2])
    scene.effects.append(TorsionSpring(0, 1e9))
    simulation = Simulation(scene)
    first = simulation.energy().kinetic + simulation.energy().potential
    worst = 0.0
    for _ in range(1000):
        simulation.step()
        energy = simulation.energy()
        worst = largest(worst, (energy.kinetic + energy.potential) / first - 1)
    return worst


@cases.case(
    "drag and damping that push forward would feed a scene without end",
    "of 4 negative or non-finite coefficients, those taken",
    0,
    "coefficients",
)
def anti_damping_is_refused() -> float:
    taken = 0
    for make in (
        lambda: LinearDrag(-1.0),
        lambda: LinearDrag(math.nan),
        lambda: LinearDrag(1.0, angular_coefficient=-1.0),
        lambda: TorsionSpring(0, 1.0, -1.0),
    ):
        scene = Scene()
        scene.add(Sphere(0.1))
        try:
            scene.effects.append(make())
            taken += 1
        except InvalidInput:
            pass
    return taken


@cases.case(
    "light wind on a falling ball, the lecture's own case, with steps of 1 s",
    "largest distance to the closed form over 60 s",
    1e-9,
    "m",
)
def drag_and_gravity_at_long_steps(dt: float = 1.0) -> float:
    k, g, wind = 0.05, 9.81, np.array([3.0, 0, 0])
    scene = Scene()
    scene.add(Sphere(0.1), mass=1.0, velocity=[10.0, 0, 20.0])
    scene.effects.append(LinearDrag(k, wind=wind))
    scene.effects.append(UniformGravity([0, 0, -g]))
    simulation, worst = Simulation(scene, dt=dt), 0.0
    limit = wind + np.array([0, 0, -g / k])
    for n in range(1, round(60 / dt) + 1):
        simulation.step()
        t = n * dt
        x = limit * t + (np.array([10.0, 0, 20.0]) - limit) * -math.expm1(-k * t) / k
        worst = largest(worst, float(np.linalg.norm(simulation.poses()[0, :3] - x)))
    return worst
