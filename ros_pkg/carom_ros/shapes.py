# SPDX-License-Identifier: Apache-2.0
"""Shapes of requests as shapes of the core."""

import numpy as np

import carom
from carom_ros import limits
from carom_ros.refusal import Refusal
from carom_ros.requests import ShapeSpec, Spawn


def core_shape(spec: ShapeSpec, *, static: bool) -> object:
    """@throws Refusal, InvalidInput"""
    if spec.kind == "sphere":
        return carom.Sphere(*spec.size)
    if spec.kind == "box":
        return carom.Box(spec.size)
    if spec.kind == "cylinder":
        cylinder = getattr(carom, "Cylinder", None)
        if cylinder is None:
            remedy = "send it as a TRIANGLE_LIST, type 11"
            raise Refusal("type", "3 CYLINDER", "this build has no cylinders", remedy)
        return cylinder(*spec.size)
    vertices = np.frombuffer(spec.vertices, dtype="<f8").reshape(-1, 3)
    faces = np.frombuffer(spec.faces, dtype="<i4").reshape(-1, 3)
    if not static:
        require_closed(vertices, faces)
    return carom.Mesh(vertices, faces)


def require_closed(vertices: np.ndarray, faces: np.ndarray) -> None:
    """A body that moves needs an inside: each edge runs once each way, and the volume is > 0.

    @throws Refusal
    """
    begin = np.concatenate([faces[:, 0], faces[:, 1], faces[:, 2]]).astype(np.int64)
    end = np.concatenate([faces[:, 1], faces[:, 2], faces[:, 0]]).astype(np.int64)
    count = len(vertices)
    forward, backward = np.sort(begin * count + end), np.sort(end * count + begin)
    if (begin == end).any() or (forward[1:] == forward[:-1]).any() or (forward != backward).any():
        remedy = "close it, orient each face the same way, or give static: true"
        raise Refusal("points", f"{len(faces)} triangles", "must be a closed surface", remedy)
    a, b, c = (vertices[faces[:, corner]] - vertices[0] for corner in range(3))
    volume = float(np.einsum("ij,ij->", a, np.cross(b, c))) / 6
    if not volume > 0:
        remedy = "order the corners counter-clockwise seen from outside"
        raise Refusal("points", f"volume {volume:.4g} m^3", "must enclose a volume > 0", remedy)


def add_arguments(spawn: Spawn) -> dict[str, object]:
    """The keyword arguments of Scene.add and Simulation.add for a spawn."""
    return {
        "name": spawn.name,
        "static": spawn.static,
        "position": spawn.position,
        "orientation": spawn.orientation,
        "velocity": spawn.velocity,
        "angular_velocity": spawn.angular_velocity,
        **spawn.properties,
    }


def checked_body(spawn: Spawn) -> tuple[object, object]:
    """The shape, and the body as a scene of its own describes it: what is wrong with either is
    said before the world changes. @throws Refusal, InvalidInput"""
    shape = core_shape(spawn.shape, static=spawn.static)
    trial = carom.Scene()
    trial.add(shape, **add_arguments(spawn))
    body = trial.bodies[0]
    mass = body.mass_properties.mass
    if not spawn.static and not limits.MASS_MIN_KG <= mass <= limits.MASS_MAX_KG:
        rule = f"must weigh {limits.MASS_MIN_KG:g} to {limits.MASS_MAX_KG:g} kg"
        raise Refusal("mass", f"{mass:.4g} kg", rule, "check the unit of the sizes, or give mass")
    return shape, body
