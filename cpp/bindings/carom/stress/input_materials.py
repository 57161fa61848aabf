# SPDX-License-Identifier: Apache-2.0
"""Masses, frictions, orientations and hulls that no body has."""

from __future__ import annotations

import numpy as np

from carom import (
    ConvexHull,
    InvalidInput,
    Plane,
    Simulation,
    Sphere,
)
from carom.stress.case import Group
from carom.stress.input_refused import a_scene, taken

cases = Group("input")


@cases.case(
    "masses, frictions and restitutions no body has, each with a place it could hide in",
    "of 16 values, those taken",
    0,
    "values",
)
def impossible_materials() -> float:
    scene = a_scene()
    calls = [("mass", lambda m=m: scene.add(Sphere(1), mass=m)) for m in (0.0, -1.0, -1e-300)]
    calls += [("density", lambda d=d: scene.add(Sphere(1), density=d)) for d in (0.0, -1.0)]
    calls += [("friction", lambda f=f: scene.add(Sphere(1), friction=f)) for f in (-0.1, -1e-300)]
    calls += [
        ("restitution", lambda e=e: scene.add(Sphere(1), restitution=e))
        for e in (-0.1, 1.0 + 1e-9, 2.0)
    ]
    calls += [
        ("mass", lambda: scene.add(Sphere(1), mass=1, density=1)),
        ("rolling_resistance", lambda: scene.add(Sphere(1), rolling_resistance=-1e-9)),
        ("spinning_resistance", lambda: scene.add(Sphere(1), spinning_resistance=-1)),
        ("shape", lambda: scene.add(Plane([0, 0, 1]))),
        ("name", lambda: scene.add(Sphere(1), name="ball")),
        ("name", lambda: scene.add(Sphere(1), name="two words")),
    ]
    return taken(calls) + (len(scene) - 1)


@cases.case(
    "quaternions that are no rotation: zero, far from unit length, nearly so",
    "of 5 quaternions, wrong answers (2e-4 off is normalised, 1 % off and zero are refused)",
    0,
    "answers",
)
def quaternions_that_are_none() -> float:
    scene, wrong = a_scene(), 0
    for q, good in (
        ([0, 0, 0, 0], False),
        ([0, 0, 0, 1.01], False),
        ([1e-200, 0, 0, 0], False),
        ([0, 0, 0, 1.0002], True),
        ([0.5, -0.5, 0.5, 0.4999], True),
    ):
        try:
            body = scene.add(Sphere(1), orientation=q)
            found = Simulation(scene).poses()[-1, 3:]
            wrong += not good or abs(float(np.linalg.norm(found)) - 1) > 4e-16
            scene.remove(body)
        except InvalidInput as error:
            wrong += good or "orientation" not in error.field
    return wrong


@cases.case(
    "points all in one plane, on one line, in one place: a hull without volume",
    "of 4 sets of points, those taken",
    0,
    "hulls",
)
def flat_hulls() -> float:
    rng = np.random.default_rng(71)
    flat = rng.uniform(-1, 1, (20, 3))
    flat[:, 2] = flat[:, 0] + flat[:, 1]
    line = np.outer(rng.uniform(-1, 1, 20), [1, 2, 3])
    sets = (flat, line, np.ones((5, 3)), np.eye(3))
    return taken([("points", lambda p=p: ConvexHull(p)) for p in sets])
