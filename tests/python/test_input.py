# SPDX-License-Identifier: Apache-2.0
"""Input that cannot be used: the message names field, value, unit, rule and remedy."""

import copy
import math
import pickle

import numpy as np
import pytest

import carom


def scene():
    made = carom.Scene()
    made.add(carom.Sphere(0.1), name="ball")
    return made


def add(**arguments):
    return lambda: scene().add(carom.Sphere(0.1), name="crate", **arguments)


REFUSED = {
    "mass below zero": (add(mass=-2), "crate.mass: -2 kg, must be finite and > 0; give density"),
    "mass and density": (add(mass=1, density=2), "crate.mass: 2 ways, give one of"),
    "short position": (
        add(position=[1, 2]),
        r"crate.position: an array of shape \(2,\), must be 3",
    ),
    "text for a position": (add(position="up"), "crate.position: 'up', must be 3 numbers"),
    "position with NaN": (add(position=[0, math.nan, 0]), "crate.position: .* m, must be finite"),
    "zero quaternion": (
        add(orientation=[0, 0, 0, 0]),
        "crate.orientation: 0 0 0 0, must be a unit",
    ),
    "quaternion of three": (add(orientation=[0, 0, 1]), "crate.orientation: .* must be 4 numbers"),
    "complex velocity": (add(velocity=[1j, 0, 0]), "crate.velocity: .* must be 3 numbers"),
    "ragged velocity": (add(velocity=[[1], [2, 3]]), "crate.velocity: .* must be 3 numbers"),
    "bool spin": (add(angular_velocity=[True, False, True]), "angular_velocity: .* must be 3"),
    "friction below zero": (add(friction=-1), "crate.friction: -1 *, must be finite and >= 0"),
    "restitution above one": (add(restitution=1.5), "crate.restitution: 1.5, must be from 0 to 1"),
    "name with a space": (
        lambda: scene().add(carom.Sphere(1), name="my box"),
        "name: 'my box', must match",
    ),
    "name twice": (lambda: scene().add(carom.Sphere(1), name="ball"), "name: 'ball', is taken"),
    "moving plane": (lambda: scene().add(carom.Plane([0, 0, 1])), "shape: plane, cannot move; set"),
    "radius": (lambda: carom.Sphere(-1), "Sphere.radius: -1 m, must be finite and > 0"),
    "flat box": (lambda: carom.Box([1, 0, 1]), "Box.extents: 0 m, must be finite and > 0"),
    "zero normal": (lambda: carom.Plane([0, 0, 0]), "Plane.normal: .* not zero"),
    "vertices": (lambda: carom.Mesh([[0, 0]], [[0, 0, 0]]), r"Mesh.vertices: .* shape \(V, 3\)"),
    "float faces": (lambda: carom.Mesh(np.eye(3), np.eye(3)), "Mesh.faces: .* whole numbers"),
    "face index": (
        lambda: carom.Mesh(np.eye(3), [[0, 1, 3]]),
        r"faces\[0\]: 3, .* vertices 0 to 2",
    ),
    "face index beyond 32 bit": (
        lambda: carom.Mesh(np.eye(3), [[0, 1, 2**32 + 2]]),
        r"Mesh.faces\[0\]: 4294967298, must index",
    ),
    "no face": (
        lambda: carom.Mesh(np.eye(3), np.zeros((0, 3), int)),
        "Mesh.faces: none, must hold",
    ),
    "step": (lambda: carom.Simulation(scene(), dt=0), "dt: 0 s, must be finite and > 0"),
    "step back": (
        lambda: carom.Simulation(scene()).step(-1),
        "dt: -1 s, .* time only runs forward",
    ),
    "body name": (
        lambda: carom.Simulation(scene()).apply_force("bal", [0, 0, 1]),
        "body: 'bal', must name a body of the scene; did you mean ball?",
    ),
    "body id": (lambda: carom.Simulation(scene()).row(7), "body: 7, must be the id of a body"),
    "negative id": (lambda: carom.Simulation(scene()).remove(-1), "body: -1, must be the id"),
    "huge id": (lambda: carom.Simulation(scene()).remove(2**80), "body: 1208925819614629174706176"),
    "force": (
        lambda: carom.Simulation(scene()).apply_force(0, [math.inf, 0, 0]),
        "force: .* N, must be finite",
    ),
    "saved bytes": (lambda: carom.Simulation(scene()).restore(b"abc"), "bytes: 3 bytes, "),
    "wrench time": (lambda: carom.AppliedWrench(0, until=-1), "AppliedWrench.until: -1 s, must be"),
}


@pytest.mark.parametrize("case", REFUSED)
def test_it_is_refused_by_name(case):
    call, message = REFUSED[case]
    with pytest.raises(carom.InvalidInput, match=message) as caught:
        call()
    assert isinstance(caught.value, ValueError)
    assert caught.value.field
    assert caught.value.rule


def test_a_refused_body_changes_nothing():
    made = scene()
    with pytest.raises(carom.InvalidInput):
        made.add(carom.Sphere(0.1), mass=-1)
    assert len(made) == 1
    assert made.add(carom.Sphere(0.1)) == 1


@pytest.mark.parametrize(
    "array", [[1, 2, 3], (1.0, 2.0, 3.0), np.arange(1, 4, dtype=np.float32), np.array([1, 2, 3])]
)
def test_anything_numpy_reads_as_numbers_is_taken(array):
    made = scene()
    made.add(carom.Sphere(1), position=array)
    np.testing.assert_array_equal(made.bodies[1].position, [1, 2, 3])


def test_strided_arrays_are_read_by_their_strides():
    vertices = np.zeros((4, 6))[:, ::2]
    vertices[:] = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
    faces = np.asfortranarray([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
    mesh = carom.Mesh(vertices, faces)
    np.testing.assert_array_equal(mesh.vertices, vertices)
    np.testing.assert_array_equal(mesh.faces, faces)


def test_mesh_arrays_are_views_that_cannot_be_written_and_outlive_the_mesh():
    mesh = carom.Mesh(np.eye(3), [[0, 1, 2]])
    vertices = mesh.vertices
    assert vertices.base is not None
    del mesh
    np.testing.assert_array_equal(vertices, np.eye(3))
    with pytest.raises(ValueError, match="read-only"):
        vertices[0, 0] = 2


def test_a_scene_can_be_copied():
    made = scene()
    for twin in (copy.copy(made), copy.deepcopy(made)):
        twin.add(carom.Sphere(1), name="other")
        twin.effects.append(carom.UniformGravity())
    assert len(made) == 1
    assert len(made.effects) == 0


def test_the_error_survives_pickling():
    error = carom.InvalidInput("crate.mass", "-2 kg", "must be > 0", "give density")
    twin = pickle.loads(pickle.dumps(error))
    assert str(twin) == str(error) == "crate.mass: -2 kg, must be > 0; give density"
    assert (twin.field, twin.value, twin.rule, twin.remedy) == error.__reduce__()[1]
