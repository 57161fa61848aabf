# SPDX-License-Identifier: Apache-2.0
"""Steps of every size, refused steps, and clocks that have run for a long time."""

from __future__ import annotations

import itertools
import math

import numpy as np

from carom import Box, InvalidInput, Plane, Scene, Simulation, Sphere, TorsionSpring, UniformGravity
from carom.stress.case import Group, largest
from carom.stress.motion import (
    AT_REST,
    angle,
    lone_body,
    matrix,
    spin_energy,
    spin_momentum,
    top,
)

cases = Group("time")


def _swing(dt: float, seconds: float = 1.0) -> float:
    """rad of error of a ball on a torsion spring, 3 rad/s at the start: sin(w t) in closed form."""
    scene = Scene()
    scene.add(
        Sphere(0.1), name="ball", mass_properties=top((1, 1, 1)), angular_velocity=[0, 0, 3.0]
    )
    scene.effects.append(TorsionSpring(0, 25.0))
    simulation = Simulation(scene, dt=dt)
    simulation.advance(seconds)
    theta = 3.0 / 5.0 * math.sin(5.0 * seconds)
    return angle(simulation.poses()[0, 3:], [0, 0, math.sin(theta / 2), math.cos(theta / 2)])


@cases.case(
    "a torsion pendulum at steps from 0.1 s (half a radian of phase) to 10 us",
    "largest error against sin(w t) after 1 s, five step sizes",
    1e-11,
    "rad",
    note="solved in closed form over each step: only rounding is left, 1e5 steps of it at 10 us",
)
def pendulum_at_any_step() -> float:
    return largest(_swing(dt) for dt in (0.1, 0.01, 1e-3, 1e-4, 1e-5))


# asymmetric top from 0 0 0 1 at 1 1 1 rad/s for 10 s (python -m carom.studies.top_reference)
TUMBLED = (
    0.093325465566093932438,
    -0.18970867325123794526,
    0.95406167930145320635,
    0.21229057647152796068,
)


def _tumble(dt: float, method: str) -> float:
    """rad of error against 60-digit arithmetic."""
    simulation = lone_body((1, 2, 2.5), (1, 1, 1), dt, method)
    simulation.advance(10.0)
    return angle(simulation.poses()[0, 3:], TUMBLED)


@cases.case(
    "steps from 0.1 s to 0.1 ms on one tumbling body: smaller must be better, by the square",
    "largest |slope - 2| of log error against log step, tenfold steps",
    0.1,
    "1",
)
def smaller_steps_err_less(method: str = "symmetric_top") -> float:
    errors = [_tumble(dt, method) for dt in (0.1, 0.01, 1e-3, 1e-4)]
    slopes = [math.log10(a / b) for a, b in itertools.pairwise(errors)]
    return largest(abs(slope - 2) for slope in slopes)


@cases.case(
    "a step backwards, NaN, infinite, or of nothing: none may touch the state",
    "of 5 bad steps, those taken; of these and dt = 0, those that changed a bit",
    0,
    "steps",
)
def bad_steps_are_refused() -> float:
    simulation, wrong = lone_body((1, 2, 3), (1, 2, 3), 0.01), 0
    simulation.step()
    before = simulation.state_hash()
    simulation.step(0.0)
    wrong += simulation.state_hash() != before
    for dt in (-0.01, -1e-300, math.nan, math.inf, -math.inf):
        try:
            simulation.step(dt)
            wrong += 1
        except InvalidInput as error:
            wrong += error.field != "dt"
        wrong += simulation.state_hash() != before
    return wrong


@cases.case(
    "free fall for 10 s at 1 ms: x += v h alone would be 49 mm off",
    "distance to the parabola",
    3e-10,
    "m",
    note="asked was 1e-12; 10 000 additions to a distance of up to 410 m may each lose half an ulp,"
    " 2.8e-14 m, the same way every time",
)
def parabola_is_exact() -> float:
    scene = Scene()
    scene.add(Sphere(0.1), velocity=[-2, 2, 8])
    scene.effects.append(UniformGravity([0, 0, -9.8]))
    simulation = Simulation(scene, dt=1e-3)
    simulation.advance(10.0)
    return float(np.linalg.norm(simulation.poses()[0, :3] - [-20, 20, 80 - 4.9 * 100]))


@cases.case(
    "27 balls fall 1 cm apart: near enough for contacts to be looked for, touching nothing",
    "largest distance to the parabola after 1 s at 60 Hz",
    1e-13,
    "m",
    note="60 additions to at most 5 m, half an ulp (4e-16 m) each: 3e-14",
)
def falling_beside_others(balls: int = 27) -> float:
    scene = Scene()
    scene.effects.append(UniformGravity([0, 0, -9.81]))
    for i in range(balls):
        scene.add(Sphere(0.1), position=[0.21 * (i % 3), 0.21 * (i // 3 % 3), 0.21 * (i // 9)])
    simulation = Simulation(scene)
    start = np.array(simulation.poses()[:, 2])
    simulation.advance(1.0)
    return float(np.abs(simulation.poses()[:, 2] - start + 9.81 / 2).max())


@cases.case(
    "a clock that shows a billion seconds: a step of 1 ms is 8389 ulps, and each sum rounds",
    "error of the clock after 10 000 steps of 1 ms from 1e9 s",
    2.4e-7,
    "s",
    note="2 ulps of 1e9; a running sum is off by up to 6e-8 s each step, 4e-4 s in all",
)
def clock_after_thirty_years() -> float:
    simulation = lone_body((1, 1, 1), (0, 0, 0), 1e8)
    simulation.advance(1e9)
    for _ in range(10_000):
        simulation.step(1e-3)
    return abs(simulation.time - (1e9 + 10))


@cases.case(
    "a step that changes tenfold at random each time: symplectic methods may lose their bound",
    "worst relative energy error in 20 000 steps of 1 to 10 ms",
    1e-2,
    "1",
)
def steps_change_at_random(method: str = "symmetric_top") -> float:
    moments, w = (1.0, 2.0, 3.0), np.array([3.0, 5.0, 2.0])
    simulation = lone_body(moments, w, 0.01, method)
    rng, start, worst = np.random.default_rng(31), spin_energy(moments, AT_REST, w), 0.0
    for dt in 10 ** rng.uniform(-3, -2, 20_000):
        simulation.step(dt)
        now = spin_energy(moments, simulation.poses()[0, 3:], simulation.twists()[0, 3:])
        worst = largest(worst, abs(now / start - 1))
    return worst


@cases.case(
    "a blow between two steps makes a slow body fast: the sub-steps must follow at once",
    "relative energy error in the 60 steps after a blow from 0.1 to about 300 rad/s",
    5e-2,
    "1",
)
def spin_after_a_blow(blow: float = 300.0) -> float:
    moments = (1.0, 1.5, 2.0)
    simulation = lone_body(moments, (0.1, 0, 0), 1 / 60)
    simulation.advance(0.5)
    simulation.apply_angular_impulse("body", [blow, blow, blow])
    q, w = simulation.poses()[0, 3:], simulation.twists()[0, 3:]
    # the blow changes L, so the energy after it is known before the step is taken
    after = spin_momentum(moments, q, w) + blow
    start = float(0.5 * after @ matrix(q) @ ((matrix(q).T @ after) / moments))
    worst = 0.0
    for _ in range(60):
        simulation.step()
        now = spin_energy(moments, simulation.poses()[0, 3:], simulation.twists()[0, 3:])
        worst = largest(worst, abs(now / start - 1))
    return worst


@cases.case(
    "a resting box at steps of 1 us to 0.1 s: a penalty or a bias tuned to one of them fails",
    "largest distance from where it was put down, 200 steps each",
    1e-3,
    "m",
)
def rest_at_any_step() -> float:
    worst = 0.0
    for dt in (1e-6, 1e-4, 1e-3, 1 / 60, 0.1):
        scene = Scene()
        scene.effects.append(UniformGravity([0, 0, -9.81]))
        scene.add(Plane([0, 0, 1], 0), name="ground", static=True)
        scene.add(Box([1, 1, 1]), name="box", position=[0, 0, 0.5])
        simulation = Simulation(scene, dt=dt)
        for _ in range(200):
            simulation.step()
            worst = largest(worst, float(np.linalg.norm(simulation.centres()[1] - [0, 0, 0.5])))
    return worst
