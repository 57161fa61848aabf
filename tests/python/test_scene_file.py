# SPDX-License-Identifier: Apache-2.0
"""Scene files: what they can say, and errors that name file, line, field, value and rule."""

import re

import numpy as np
import pytest

import carom
from carom import scene_file
from carom.scenes import scene_names, scene_path
from carom.signature import parameters

SCENE = """\
effects:
  - UniformGravity
  - AppliedWrench: {body: crate, force: [1, 0, 0]}
bodies:
  - {name: ground, static: true, shape: {Plane: {normal: [0, 0, 1]}}}
  - &crate
    name: crate
    mass: 1e3
    shape: {Box: {extents: [0.2, 0.2, 0.2]}}
    position: [0, 0, 1]
  - {<<: *crate, name: second, position: [1, 0, 1]}
"""


def test_keys_are_the_arguments_of_add_and_of_the_constructors():
    scene = scene_file.parse(SCENE)
    assert [body.name for body in scene.bodies] == ["ground", "crate", "second"]
    assert scene.bodies[0].static
    assert scene.bodies[1].mass_properties.mass == 1000.0  # YAML 1.2: 1e3 is a number
    np.testing.assert_array_equal(scene.bodies[2].position, [1, 0, 1])
    gravity, wrench = scene.effects
    assert gravity.acceleration[2] == -9.81
    assert wrench.body == 1
    np.testing.assert_array_equal(wrench.force, [1, 0, 0])


def test_every_argument_can_be_written():
    """A new argument of add must not be left out here: the file is made from the signature."""
    values = {
        "shape": "{Sphere: {radius: 0.5}}",
        "name": "ball",
        "static": "false",
        "mass": "2",
        "density": "null",
        "mass_properties": None,  # in place of mass and density: has a test of its own
        "position": "[1, 2, 3]",
        "orientation": "[0, 0, 1, 0]",
        "velocity": "[4, 5, 6]",
        "angular_velocity": "[7, 8, 9]",
        "ccd": "always",
        "groups": "3",
        "meets": "5",
        "friction": "0.25",
        "restitution": "0.75",
        "rolling_resistance": "0.01",
        "spinning_resistance": "0.002",
    }
    missing = [name for name in parameters(carom.Scene.add) if name not in values]
    assert not missing, "give these a value above"
    lines = "".join(f"    {key}: {value}\n" for key, value in values.items() if value)
    (body,) = scene_file.parse("bodies:\n  -\n" + lines).bodies
    assert body.shape.radius == 0.5
    assert body.mass_properties.mass == 2
    assert not body.static
    np.testing.assert_array_equal(body.position, [1, 2, 3])
    np.testing.assert_array_equal(body.orientation, [0, 0, 1, 0])
    np.testing.assert_array_equal(body.velocity, [4, 5, 6])
    np.testing.assert_array_equal(body.angular_velocity, [7, 8, 9])
    assert (body.friction, body.restitution) == (0.25, 0.75)
    assert (body.rolling_resistance, body.spinning_resistance) == (0.01, 0.002)
    assert (body.ccd, body.groups, body.meets) == ("always", 3, 5)


def test_mass_properties_are_written_as_their_constructor_takes_them():
    text = (
        "bodies:\n  - shape: {Sphere: {radius: 1}}\n    mass_properties:\n      mass: 2\n"
        "      com: [0, 0, 0.1]\n      inertia: [[1, 0, 0], [0, 2, 0], [0, 0, 2]]\n"
    )
    (body,) = scene_file.parse(text).bodies
    assert body.mass_properties.mass == 2
    np.testing.assert_array_equal(body.mass_properties.com, [0, 0, 0.1])
    np.testing.assert_array_equal(body.mass_properties.inertia, np.diag([1, 2, 2]))
    with pytest.raises(carom.InvalidInput, match=r"scene:4 .*mass_properties.mass: -2"):
        scene_file.parse(text.replace("mass: 2", "mass: -2"))


def test_every_shape_and_effect_has_a_readable_signature():
    for cls in [*scene_file.SHAPES.values(), *scene_file.EFFECTS.values()]:
        assert parameters(cls), cls
    assert parameters(carom.Plane)["offset"].required is False
    assert parameters(carom.Plane)["normal"].required is True


CRATE = "    shape: {Box: {extents: [0.2, 0.2, 0.2]}}"
BAD = [
    ("mass: 1e3", "mass: -2", "tower.yaml:8 bodies[1].mass: -2 kg, must be finite and > 0; give"),
    (
        "mass: 1e3",
        "mas: 2",
        "tower.yaml:8 bodies[1].mas: 'mas', is not a key here; did you mean mass",
    ),
    ("mass: 1e3", "mass: on", "tower.yaml:8 bodies[1].mass: 'on', must be a number"),
    ("mass: 1e3", "mass: true", "tower.yaml:8 bodies[1].mass: True, must be a number"),
    ("static: true", "static: on", "tower.yaml:5 bodies[0].static: 'on', must be true or false"),
    (
        "{Box:",
        "{Bx:",
        "tower.yaml:9 bodies[1].shape.Bx: 'Bx', is not a key here; did you mean Box?",
    ),
    (
        "0.2, 0.2, 0.2",
        "0.2, 0.2",
        "tower.yaml:9 bodies[1].shape.Box.extents: an array of shape (2,)",
    ),
    ("0.2, 0.2, 0.2", "0.2, 0, 0.2", "tower.yaml:9 bodies[1].shape.Box.extents: 0 m, must be"),
    ("body: crate", "body: crat", "tower.yaml:3 effects[1].AppliedWrench.body: 'crat', must name"),
    ("body: crate, ", "", "tower.yaml:3 effects[1].AppliedWrench: no body, must have body"),
    (
        "UniformGravity",
        "UniformGravty",
        "tower.yaml:2 effects[0].UniformGravty: 'UniformGravty', is",
    ),
    ("name: second", "name: crate", "tower.yaml:11 bodies[2].name: 'crate', is taken"),
    ("bodies:", "bodys:", "tower.yaml:4 bodys: 'bodys', is not a key here; did you mean bodies?"),
    ("name: crate", "name: crate: x", "tower.yaml:7: not YAML, mapping values are not allowed"),
    ("mass: 1e3", "mass: 1\n    mass: 2", "tower.yaml:9: not YAML, found duplicate key"),
    ("[0, 0, 1]\n", "[0, 0, [1]]\n", "tower.yaml:10 bodies[1].position: a list, must be a list of"),
    (CRATE, "", "tower.yaml:6 bodies[1]: no shape, must have a shape: Sphere, Box"),
    (
        CRATE,
        "    shape: {Mesh: {path: a.stl}}",
        "shape.Mesh.path: 'a.stl', must not be a file here",
    ),
    (CRATE, "    shape: {Box: {}, Sphere: {}}", "shape: a mapping, must be one of Sphere, Box"),
    ("mass: 1e3", "mass: !!python/name:os.system x", "tower.yaml:8 bodies[1].mass: "),
]


@pytest.mark.parametrize(("old", "new", "message"), BAD)
def test_an_error_says_where_it_is(old, new, message):
    assert old in SCENE
    with pytest.raises(carom.InvalidInput, match=re.escape(message)):
        scene_file.parse(SCENE.replace(old, new), source="tower.yaml")


@pytest.mark.parametrize(
    "text",
    [
        "",
        "[]",
        "a",
        "{",
        "[" * 5000,
        "\x00",
        "bodies: {}",
        "bodies: [3]",
        "? [a]\n: b",
        "\t",
        "&a [*a]",
    ],
)
def test_whatever_the_text_it_is_refused_as_input(text):
    with pytest.raises(carom.InvalidInput):
        scene_file.parse(text)


def test_an_empty_list_is_an_empty_scene():
    assert len(scene_file.parse("bodies:\neffects: []\n")) == 0


def test_a_file_that_is_not_there_or_not_text_is_refused(tmp_path):
    with pytest.raises(carom.InvalidInput, match="must be readable"):
        carom.Scene.load(tmp_path / "none.yaml")
    (tmp_path / "bytes.yaml").write_bytes(b"\xff\xfe\x00")
    with pytest.raises(carom.InvalidInput, match="must be UTF-8"):
        carom.Scene.load(tmp_path / "bytes.yaml")


@pytest.mark.parametrize("name", scene_names())
def test_a_shipped_scene_loads_and_steps(name):
    pytest.importorskip("trimesh", reason="a shipped scene holds a mesh file")
    simulation = carom.Simulation(carom.Scene.load(scene_path(name)), dt=1 / 240)
    assert simulation.advance(0.1).frozen == []
    assert np.isfinite(simulation.poses()).all()


def test_an_unknown_scene_gets_the_nearest_name():
    with pytest.raises(carom.InvalidInput, match="did you mean tower"):
        scene_path("towr")
