# SPDX-License-Identifier: Apache-2.0
"""What cannot be used: it is refused by the name of the field, and nothing has changed."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from carom import (
    AppliedWrench,
    Box,
    Capsule,
    Cone,
    ConvexHull,
    Cylinder,
    Ellipsoid,
    HeightField,
    InvalidInput,
    LinearDrag,
    MassProperties,
    Mesh,
    Particles,
    Plane,
    Scene,
    Sdf,
    Simulation,
    Sphere,
    TorsionSpring,
    UniformGravity,
)
from carom.stress.case import Group
from carom.stress.solids import box_mesh

cases = Group("input")

BAD = (math.nan, math.inf, -math.inf)


def a_scene() -> Scene:
    scene = Scene()
    scene.add(Sphere(0.1), name="ball", velocity=[1, 2, 3])
    return scene


def taken(calls: list[tuple[str, Callable[[], object]]]) -> int:
    """How many calls are not refused with an InvalidInput that names the field."""
    count = 0
    for field, call in calls:
        try:
            call()
            count += 1
        except InvalidInput as error:
            count += field not in error.field
    return count


@cases.case(
    "NaN and infinity in every number of a body, component by component",
    "of 75 values, those taken, or refused under another name, or that left a body behind",
    0,
    "values",
)
def nan_in_every_field_of_a_body() -> float:
    scene, calls = a_scene(), []
    for bad in BAD:
        for field, size in (
            ("position", 3),
            ("orientation", 4),
            ("velocity", 3),
            ("angular_velocity", 3),
        ):
            for k in range(size):
                value = [0.0] * size
                value[-1] = 1.0
                value[k] = bad
                calls.append((field, lambda f=field, v=value: scene.add(Sphere(1), **{f: v})))
        for field in ("mass", "density", "friction", "restitution"):
            calls.append((field, lambda f=field, b=bad: scene.add(Sphere(1), **{f: b})))
        for field in ("rolling_resistance", "spinning_resistance"):
            calls.append((field, lambda f=field, b=bad: scene.add(Sphere(1), **{f: b})))
        calls += [("mass", lambda b=bad: MassProperties(b, [0, 0, 0], np.eye(3)))]
        calls += [("com", lambda b=bad: MassProperties(1, [0, b, 0], np.eye(3)))]
        calls += [("inertia", lambda b=bad: MassProperties(1, [0, 0, 0], np.diag([1.0, 1.0, b])))]
    return taken(calls) + (len(scene) - 1)


@cases.case(
    "NaN, infinity, zero and negative sizes of every shape",
    "of all sizes tried, those taken",
    0,
    "sizes",
)
def shapes_without_size() -> float:
    vertices, faces = box_mesh([1.0] * 3)
    calls: list[tuple[str, Callable[[], object]]] = []
    for bad in (*BAD, 0.0, -1.0):
        calls += [
            ("radius", lambda b=bad: Sphere(b)),
            ("extents", lambda b=bad: Box([1, b, 1])),
            ("radius", lambda b=bad: Capsule(b, 1)),
            ("radius", lambda b=bad: Cylinder(b, 1)),
            ("length", lambda b=bad: Cylinder(1, b)),
            ("radius", lambda b=bad: Cone(b, 1)),
            ("length", lambda b=bad: Cone(1, b)),
            ("radii", lambda b=bad: Ellipsoid([1, 1, b])),
            ("radius", lambda b=bad: Particles([[0, 0, 0]], b)),
            ("spacing", lambda b=bad: HeightField(np.zeros((3, 3)), b)),
            ("spacing", lambda b=bad: Sdf(Mesh(vertices, faces), b)),
        ]
    for bad in BAD:
        broken = vertices.copy()
        broken[3, 1] = bad
        heights = np.zeros((3, 3))
        heights[1, 1] = bad
        calls += [
            ("length", lambda b=bad: Capsule(1, b)),
            ("normal", lambda b=bad: Plane([0, b, 1])),
            ("offset", lambda b=bad: Plane([0, 0, 1], b)),
            ("vertices", lambda v=broken: Mesh(v, faces)),
            ("points", lambda v=broken: ConvexHull(v)),
            ("positions", lambda b=bad: Particles([[0, b, 0]], 1)),
            ("heights", lambda h=heights: HeightField(h, 1)),
        ]
    return taken(calls)


@cases.case(
    "NaN and infinity in every effect, force and impulse of a running simulation",
    "of all values tried, those taken or that changed a bit of the state",
    0,
    "values",
)
def nan_in_every_force() -> float:
    simulation = Simulation(a_scene())
    simulation.step()
    before = simulation.state_hash()
    calls: list[tuple[str, Callable[[], object]]] = []
    for bad in BAD:
        v = [0.0, bad, 0.0]
        calls += [
            ("force", lambda v=v: simulation.apply_force("ball", v)),
            ("point", lambda v=v: simulation.apply_force("ball", [1, 0, 0], v)),
            ("torque", lambda v=v: simulation.apply_torque("ball", v)),
            ("impulse", lambda v=v: simulation.apply_impulse("ball", v)),
            ("impulse", lambda v=v: simulation.apply_angular_impulse("ball", v)),
            ("force", lambda v=v: simulation.hold_wrench("ball", v)),
            ("torque", lambda v=v: simulation.hold_wrench("ball", torque=v)),
            ("position", lambda v=v: simulation.set_state("ball", position=v)),
            ("velocity", lambda v=v: simulation.set_state("ball", velocity=v)),
            ("acceleration", lambda v=v: UniformGravity(v)),
            ("force", lambda v=v: AppliedWrench(0, v)),
            ("coefficient", lambda b=bad: LinearDrag(b)),
            ("wind", lambda v=v: LinearDrag(1, v)),
            ("stiffness", lambda b=bad: TorsionSpring(0, b)),
            ("seconds", lambda b=bad: simulation.advance(b)),
        ]
    return taken(calls) + (simulation.state_hash() != before)
