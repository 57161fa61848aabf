# SPDX-License-Identifier: Apache-2.0
"""Messages to plain values and back through JSON."""

import json
import math

import numpy as np
import pytest
from geometry_msgs.msg import Point, WrenchStamped
from hypothesis import given, settings
from hypothesis import strategies as st
from visualization_msgs.msg import Marker

from carom_ros import commands, marker, spawn_text, strict_yaml
from carom_ros.refusal import Refusal
from carom_ros.requests import Impulse, Spawn, from_plain, to_plain
from carom_ros.world import read_scene_text


def cube(**fields: object) -> Marker:
    msg = Marker(type=Marker.CUBE, ns="box", id=1, **fields)
    msg.scale.x = msg.scale.y = msg.scale.z = 0.2
    return msg


def test_a_marker_becomes_a_body_named_after_its_identity() -> None:
    request = marker.request_of(cube(), "~/spawn")
    assert (request.name, request.shape.kind, request.shape.size) == ("box_1", "box", (0.2,) * 3)
    assert request.orientation == (0, 0, 0, 1)


def test_a_marker_without_a_namespace_still_gets_a_name() -> None:
    assert marker.default_name("", 3) == "marker_3"


def test_the_diameter_of_a_marker_is_twice_the_radius() -> None:
    msg = cube()
    msg.type = Marker.SPHERE
    assert marker.request_of(msg, "").shape.size == (0.1,)
    msg.type = Marker.CYLINDER
    assert marker.request_of(msg, "").shape.size == (0.1, 0.2)


def test_the_corners_a_triangle_list_repeats_become_one_vertex() -> None:
    corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], dtype=float)
    faces = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]
    msg = cube(points=[Point(x=x, y=y, z=z) for f in faces for x, y, z in corners[f].tolist()])
    msg.type, msg.scale.x = Marker.TRIANGLE_LIST, 0.4
    shape = marker.request_of(msg, "").shape
    vertices = np.frombuffer(shape.vertices).reshape(-1, 3)
    index = np.frombuffer(shape.faces, dtype=np.int32).reshape(-1, 3)
    assert len(vertices) == 4
    assert np.array_equal(vertices[index], corners[faces] * [0.4, 0.2, 0.2])


def test_a_request_is_the_same_after_json() -> None:
    msg = cube(text="{mass: 0.1, velocity: [1e-300, -0.0, 3.3], frames: {h: [0, 0, 0.1]}}")
    request = marker.request_of(msg, "~/spawn")
    assert from_plain(json.loads(json.dumps(to_plain(request)))) == request
    assert isinstance(request, Spawn)


@given(st.lists(st.floats(allow_nan=False, allow_infinity=False), min_size=6, max_size=6))
@settings(max_examples=50, deadline=None)
def test_json_keeps_every_bit_of_a_number(numbers: list[float]) -> None:
    request = Impulse("s", "b", tuple(numbers[:3]), tuple(numbers[3:]))
    back = from_plain(json.loads(json.dumps(to_plain(request))))
    assert np.array([*back.force, *back.torque]).tobytes() == np.array(numbers).tobytes()


def test_frame_id_names_body_and_frame() -> None:
    assert commands.body_and_frame("crate") == ("crate", "")
    assert commands.body_and_frame("crate/handle") == ("crate", "handle")
    for bad in ("", "/crate", "crate/", "crate/a/b", "1a", "a b", "crate\n", "é"):
        with pytest.raises(Refusal, match=r"header\.frame_id"):
            commands.body_and_frame(bad)


def test_a_stamped_wrench_acts_in_the_axes_of_its_body() -> None:
    msg = WrenchStamped()
    msg.header.frame_id, msg.wrench.force.x, msg.wrench.torque.z = "crate/handle", 2.0, 3.0
    request = commands.stamped_wrench(msg, "~/wrench", 0.5)
    assert (request.body, request.frame, request.in_body_axes) == ("crate", "handle", True)
    assert (request.force, request.torque, request.hold) == ((2, 0, 0), (0, 0, 3), 0.5)


def test_yaml_scalars_are_those_of_version_1_2() -> None:
    assert strict_yaml.load("{a: 1e3, b: on, c: 0o17}", "t", 100) == {"a": 1e3, "b": "on", "c": 15}


@pytest.mark.parametrize(
    ("text", "field"),
    [
        ("{mas: 2}", r"text\.mas: .*did you mean mass"),
        ("{mass: .nan}", r"text\.mass"),
        ("{mass: -1}", r"text\.mass"),
        ("{mass: two}", r"text\.mass"),
        ("{mass: true}", r"text\.mass"),
        ("{mass: " + "9" * 400 + "}", r"text\.mass"),
        ("{restitution: 1.5}", r"text\.restitution"),
        ("{static: on}", r"text\.static"),
        ("{velocity: [1, 2]}", r"text\.velocity"),
        ("{velocity: [1, 2, .inf]}", r"text\.velocity\.z"),
        ("{name: 'a b'}", r"text\.name"),
        ("{frames: {'a b': [0, 0, 0]}}", r"text\.frames"),
        ("{mass: 1, mass: 2}", "duplicate key"),
        ("name=crate", "YAML mapping"),
        ("[" * 1000, "levels"),
        ("{a: &x [1], b: *x}", "anchors"),
        ("!!python/object/apply:os.system [ls]", "tags"),
        ("{mass: 2026-13-45}", "usable"),
        ('"\\UFFFFFFFF"', "YAML"),
        ("\x00", "YAML"),
        ("x" * 4097, "4096"),
    ],
)
def test_text_that_cannot_be_used_says_why(text: str, field: str) -> None:
    with pytest.raises(Refusal, match=field):
        spawn_text.parse(text)


def test_a_refusal_shows_no_control_characters() -> None:
    refusal = Refusal("name", "\x1b[2J\ud800" + "x" * 1000, "must be a name")
    assert str(refusal).isprintable()
    assert len(str(refusal)) < 200


def test_no_part_of_a_refusal_carries_control_characters() -> None:
    refusal = Refusal("\x1b[31m\ud800", "\x07", "must\nbe \x1b[0m", "say\x1b")
    for part in (refusal.field, refusal.value, refusal.rule, refusal.remedy, str(refusal)):
        assert part.isprintable()
        part.encode()  # a lone surrogate has no UTF-8


@pytest.mark.parametrize(
    ("line", "field"),
    [
        (
            "{shape: {Sphere: {radius: 1}}, position: [1e300, 0, 0]}",
            "bodies[0].position.x",
        ),
        ("{name: a, shape: {Sphere: {radius: 1}}, velocity: [0, 1e6, 0]}", "bodies[0].velocity.y"),
        ("{name: a, shape: {Sphere: {radius: 1}}, density: 1e300}", "bodies[0].mass"),
        ("{name: " + 65 * "x" + ", shape: {Sphere: {radius: 1}}}", "bodies[0].name"),
    ],
)
def test_a_scene_is_held_to_the_limits_of_a_marker(line: str, field: str) -> None:
    with pytest.raises(Refusal) as caught:
        read_scene_text(f"bodies:\n- {line}\n")
    assert caught.value.field == field


def test_gravity_of_a_scene_has_a_limit() -> None:
    with pytest.raises(Refusal, match="acceleration"):
        read_scene_text("effects:\n- UniformGravity: {acceleration: [0, 0, -1e300]}\n")


def test_an_orientation_is_normalised_only_when_it_nearly_is_already() -> None:
    msg = cube()
    msg.pose.orientation.z, msg.pose.orientation.w = 0.707, 0.707  # three typed digits
    assert math.hypot(*marker.request_of(msg, "").orientation) == pytest.approx(1, abs=2**-52)
    msg.pose.orientation.w = 1.0  # norm 1.22: a slip, not rounding
    with pytest.raises(Refusal, match=r"send x 0 y 0 z 0\.5773 w 0\.8165"):
        marker.request_of(msg, "")
