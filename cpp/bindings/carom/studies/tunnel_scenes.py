# SPDX-License-Identifier: Apache-2.0
"""Random and adversarial runs of fast bodies against walls, cups, funnels and one another.

`make_run(seed, index, ccd)` gives the same run for the same seed and index. Speeds are 1 to 1e4
m/s, spins 0 to 1e3 rad/s, steps 1e-3 to 0.1 s, walls 10 cm to nothing thick.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from carom import Box, Compound, Mesh, Part, Scene
from carom.studies.tunnel_bodies import KINDS, Mover, make
from carom.studies.tunnel_judge import CavityJudge, PairJudge, WallJudge, rotation

HALF = 3.0
"""m, half the edge of a wall; bodies are aimed at its middle third."""


class Run(NamedTuple):
    family: str
    kinds: tuple[str, ...]
    scene: Scene
    dt: float
    steps: int
    judges: list[Any]
    before_step: Callable[[Any, int], None] | None
    about: dict[str, float]
    """speed_m_s, spin_rad_s, thickness_m: for whoever looks into one run."""


def _log(rng, low: float, high: float) -> float:
    return float(low * (high / low) ** rng.random())


def _direction(rng) -> np.ndarray:
    v = rng.normal(size=3)
    return v / np.linalg.norm(v)


def _orientation(rng) -> np.ndarray:
    q = rng.normal(size=4)
    return q / np.linalg.norm(q)


def _thickness(rng) -> float:
    """m: a third of the walls are sheets without any, the others 10 cm to 1 micrometre."""
    return 0.0 if rng.random() < 1 / 3 else _log(rng, 1e-6, 0.1)


def _mover(rng) -> Mover:
    return make(str(rng.choice(list(KINDS))), rng, _log(rng, 0.02, 0.3))


def _spin(rng, mover: Mover, normal: np.ndarray) -> np.ndarray:
    """rad/s, world: none, about any axis, or about one in the wall, whose far end sweeps in."""
    how = rng.random()
    if how < 0.15:
        return np.zeros(3)
    axis = _direction(rng)
    if how < 0.5:
        axis = np.cross(normal, axis)
    return axis / np.linalg.norm(axis) * _log(rng, 0.1, 1e3)


def _material(rng) -> dict[str, float]:
    return {
        "restitution": float(rng.choice([0.0, 0.5, 1.0])),
        "friction": float(rng.choice([0.0, 0.3, 1.0])),
    }


def sheet(half: float, cells: int) -> Mesh:
    """A square of no thickness at z = 0, 2 cells^2 triangles: an open mesh."""
    line = np.linspace(-half, half, cells + 1)
    points = [[x, y, 0.0] for y in line for x in line]
    faces = []
    for j in range(cells):
        for i in range(cells):
            a = j * (cells + 1) + i
            b = a + cells + 1
            faces += [(a, a + 1, b + 1), (a, b + 1, b)]
    return Mesh(points, faces)


def _add_wall(scene: Scene, rng, thickness: float, half: float, **where: Any) -> int:
    if thickness == 0:
        return scene.add(sheet(half, int(rng.choice([1, 2, 5]))), static=True, **where)
    return scene.add(Box([2 * half, 2 * half, thickness]), static=True, **where)


def _wall(rng, ccd: str) -> Run:
    """One wall, anyhow turned; one body aimed at its middle, at up to 70 degrees to its normal."""
    scene, mover, thickness = Scene(), _mover(rng), _thickness(rng)
    q = _orientation(rng) if rng.random() < 0.8 else np.array([0.0, 0, 0, 1])
    frame = rotation(q)
    middle = rng.uniform(-5, 5, 3) if rng.random() < 0.8 else np.zeros(3)
    speed, dt = _log(rng, 1, 1e4), _log(rng, 1e-3, 0.1)
    slant = math.radians(rng.choice([0.0, rng.uniform(0, 70)]))
    turn = rng.uniform(0, 2 * math.pi)
    v = -np.array(
        [math.sin(slant) * math.cos(turn), math.sin(slant) * math.sin(turn), math.cos(slant)]
    )
    # corners and edges of the sheet's triangles are among the targets
    target = np.append(rng.choice([rng.uniform(-1, 1), 0.0, 0.6], 2), 0.0)
    clear = (mover.outer + thickness / 2 + 1e-3) / math.cos(slant)
    # how many steps to the wall: any number, or just so that one ends with the centre in it
    wait = rng.uniform(0, 3) if rng.random() < 0.7 else float(rng.integers(1, 4))
    way = max(clear, wait * speed * dt)
    wall = _add_wall(scene, rng, thickness, HALF, position=middle, orientation=q, **_material(rng))
    spin = _spin(rng, mover, frame[:, 2])
    body = scene.add(
        mover.shape,
        position=middle + frame @ (target - way * v),
        orientation=_orientation(rng),
        velocity=frame @ v * speed,
        angular_velocity=spin,
        ccd=ccd,
        **_material(rng),
    )
    judge = WallJudge(wall, body, mover, HALF, thickness)
    about = {
        "speed_m_s": speed,
        "spin_rad_s": float(np.linalg.norm(spin)),
        "thickness_m": thickness,
    }
    steps = math.ceil(way / (speed * dt)) + 5
    family = "wall" if thickness > 0 else "sheet"
    return Run(family, (mover.kind,), scene, dt, min(steps, 400), [judge], None, about)


AXES = [s * e for e in np.eye(3) for s in (1.0, -1.0)]


def _facing(normal: np.ndarray) -> np.ndarray:
    """A quaternion that turns z to a unit axis of the frame."""
    if normal[2] < -0.5:
        return np.array([1.0, 0, 0, 0])
    q = np.append(np.cross([0, 0, 1.0], normal), 1 + normal[2])
    return q / np.linalg.norm(q)


def _cup(rng, ccd: str) -> Run:
    """A closed box of six walls, one to three bodies inside."""
    scene, thickness = Scene(), _thickness(rng)
    half = rng.uniform(0.5, 1.5)
    for normal in AXES:
        place = normal * (half + thickness / 2)
        _add_wall(
            scene, rng, thickness, half + thickness, position=place, orientation=_facing(normal),
            **_material(rng),
        )  # fmt: skip
    bodies, kinds, speeds = [], [], []
    for i in range(int(rng.integers(1, 4))):
        mover = make(str(rng.choice(list(KINDS))), rng, _log(rng, 0.02, half / 8))
        speeds.append(_log(rng, 1, 1e4))
        row = scene.add(
            mover.shape, position=[(i - 1) * half / 1.8, *rng.uniform(-0.5, 0.5, 2) * half],
            orientation=_orientation(rng), velocity=_direction(rng) * speeds[-1],
            angular_velocity=_spin(rng, mover, _direction(rng)), ccd=ccd, **_material(rng),
        )  # fmt: skip
        bodies.append((row, mover))
        kinds.append(mover.kind)
    judge = CavityJudge(None, bodies, AXES, [half] * 6, thickness)
    about = {"speed_m_s": max(speeds), "spin_rad_s": math.nan, "thickness_m": thickness}
    return Run("cup", tuple(kinds), scene, _log(rng, 1e-3, 0.1), 8, [judge], None, about)


def _funnel(rng, ccd: str) -> Run:
    """A pyramid of sheets, open at the top, and a body shot in: ever narrower, ever more hits."""
    scene, sides, height = Scene(), int(rng.integers(3, 9)), 3.0
    slope = math.radians(rng.uniform(8, 60))  # between axis and side
    rim = [
        [height * math.tan(slope) / math.cos(math.pi / sides) * f(2 * math.pi * (k - 0.5) / sides)
         for f in (math.cos, math.sin)] + [height]
        for k in range(sides)
    ]  # fmt: skip
    scene.add(
        Mesh([[0, 0, 0], *rim], [(0, k + 1, (k + 1) % sides + 1) for k in range(sides)]),
        static=True, **_material(rng),
    )  # fmt: skip
    normals = [
        [math.cos(slope) * math.cos(a), math.cos(slope) * math.sin(a), -math.sin(slope)]
        for a in 2 * math.pi * np.arange(sides) / sides
    ]
    room = 2.0 * math.sin(slope)  # distance of the sides from the axis at z = 2
    mover = make(str(rng.choice(list(KINDS))), rng, _log(rng, 0.02, min(0.3, room / 4)))
    speed, dt = _log(rng, 1, 1e4), _log(rng, 1e-3, 0.1)
    tilt = rng.uniform(0, 0.2) * np.append(_direction(rng)[:2], 0)
    v = tilt - [0, 0, 1.0]
    spin = _spin(rng, mover, np.array([0, 0, 1.0]))
    row = scene.add(
        mover.shape, position=[*rng.uniform(-0.3, 0.3, 2) * room, 2.2],
        orientation=_orientation(rng), velocity=v / np.linalg.norm(v) * speed,
        angular_velocity=spin, ccd=ccd, **_material(rng),
    )  # fmt: skip
    judge = CavityJudge(
        None, [(row, mover)], [*normals, [0, 0, 1.0]], [0.0] * sides + [height], 0.0, mouth=sides
    )
    about = {"speed_m_s": speed, "spin_rad_s": float(np.linalg.norm(spin)), "thickness_m": 0.0}
    steps = min(40, math.ceil(2.5 / (speed * dt)) + 5)
    return Run("funnel", (mover.kind,), scene, dt, steps, [judge], None, about)


def _pair(rng, ccd: str) -> Run:
    """Two bodies head on, masses 1 : 1000 at most, no farther aside than the balls inside them."""
    scene, movers = Scene(), [_mover(rng), _mover(rng)]
    d, dt = _direction(rng), _log(rng, 1e-3, 0.1)
    speeds = [_log(rng, 1, 1e4), _log(rng, 1, 1e4) if rng.random() < 0.8 else 0.0]
    aside = np.cross(d, _direction(rng))
    aside *= rng.choice([0.0, 0.5]) * (movers[0].inner + movers[1].inner) / np.linalg.norm(aside)
    clear = movers[0].outer + movers[1].outer + 1e-3
    way = max(clear, rng.uniform(0, 3) * sum(speeds) * dt)
    spins = [_spin(rng, m, d) for m in movers]
    rows = [
        scene.add(
            mover.shape, mass=_log(rng, 0.03, 30), position=s * d * way / 2 + (s > 0) * aside,
            orientation=_orientation(rng), velocity=-s * d * speed, angular_velocity=spin, ccd=ccd,
            **_material(rng),
        )
        for mover, s, speed, spin in zip(movers, (-1, 1), speeds, spins, strict=True)
    ]  # fmt: skip
    judge = PairJudge(*rows, movers, d)
    spin = max(float(np.linalg.norm(s)) for s in spins)
    about = {"speed_m_s": max(speeds), "spin_rad_s": spin, "thickness_m": math.nan}
    steps = min(400, math.ceil(way / (sum(speeds) * dt)) + 4)
    kinds = tuple(m.kind for m in movers)
    return Run("pair", kinds, scene, dt, steps, [judge], None, about)


def _shaken(rng, ccd: str) -> Run:
    """A heavy closed box that moves itself, jerked to and fro and turned, with bodies inside."""
    scene, half, thickness = Scene(), rng.uniform(0.3, 1.0), _log(rng, 1e-3, 0.1)
    edge = 2 * (half + thickness)
    parts = [
        Part(Box([edge, edge, thickness]), n * (half + thickness / 2), _facing(n)) for n in AXES
    ]
    cup = scene.add(Compound(parts), mass=1e6, ccd=ccd, **_material(rng))
    bodies = []
    for i in range(int(rng.integers(1, 4))):
        mover = make(str(rng.choice(list(KINDS))), rng, _log(rng, 0.02, half / 8))
        row = scene.add(
            mover.shape, mass=1.0,
            position=[(i - 1) * half / 1.8, *rng.uniform(-0.4, 0.4, 2) * half],
            orientation=_orientation(rng), ccd=ccd, **_material(rng),
        )  # fmt: skip
        bodies.append((row, mover))
    speed, turn = _log(rng, 1, 1e4), rng.choice([0.0, _log(rng, 0.1, 30)])
    jerks = [(_direction(rng) * speed, _direction(rng) * turn) for _ in range(4)]

    def jerk(simulation: Any, step: int) -> None:
        v, w = jerks[step % 4]
        simulation.set_state(cup, velocity=v, angular_velocity=w)

    judge = CavityJudge(cup, bodies, AXES, [half] * 6, thickness)
    about = {"speed_m_s": speed, "spin_rad_s": float(turn), "thickness_m": thickness}
    kinds = tuple(m.kind for _, m in bodies)
    return Run("shaken_cup", kinds, scene, _log(rng, 1e-3, 0.1), 8, [judge], jerk, about)


FAMILIES = {"wall": _wall, "cup": _cup, "funnel": _funnel, "pair": _pair, "shaken_cup": _shaken}
SHARES = (0.5, 0.15, 0.12, 0.15, 0.08)


def make_run(seed: int, index: int, ccd: str = "auto") -> Run:
    """Run `index` of a seed; ccd: of every moving body ("auto", "always" or "never")."""
    rng = np.random.default_rng([seed, index])
    return FAMILIES[str(rng.choice(list(FAMILIES), p=SHARES))](rng, ccd)
