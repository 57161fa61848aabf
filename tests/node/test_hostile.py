# SPDX-License-Identifier: Apache-2.0
"""No message can stop the node: each is refused with a reason, and time goes on."""

import json
import math
from collections.abc import Callable

import pytest
from geometry_msgs.msg import Point, Wrench, WrenchStamped
from nav_msgs.msg import Odometry
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.serialization import serialize_message
from std_msgs.msg import String
from visualization_msgs.msg import Marker, MarkerArray

from carom_ros import limits

LATCHED = QoSProfile(depth=2000, durability=DurabilityPolicy.TRANSIENT_LOCAL)


def cube(change: Callable[[Marker], object] | None = None) -> Marker:
    msg = Marker(type=Marker.CUBE, ns="box", id=1)
    msg.pose.position.z = msg.scale.x = msg.scale.y = msg.scale.z = 0.2
    if change is not None:
        change(msg)
    return msg


def put(path: str, value: object) -> Callable[[object], None]:
    """Sets msg.a.b.c, past what the setters would refuse: the wire has no setters."""

    def change(msg: object) -> None:
        *parents, last = path.split(".")
        for name in parents:
            msg = getattr(msg, name)
        setattr(msg, last, value)

    return change


def zero_quaternion(msg: Marker) -> None:
    msg.pose.orientation.w = 0.0


def triangles(count: int, value: float = 0.0) -> Callable[[Marker], None]:
    def change(msg: Marker) -> None:
        msg.type = Marker.TRIANGLE_LIST
        msg.points = [Point(x=value, y=float(row), z=float(row % 2)) for row in range(count)]

    return change


def resource(path: str) -> Callable[[Marker], None]:
    def change(msg: Marker) -> None:
        msg.type, msg.mesh_resource = Marker.MESH_RESOURCE, path

    return change


SPAWNS = [
    (put("pose.position.x", math.nan), "pose.position.x"),
    (put("pose.position.z", math.inf), "pose.position.z"),
    (put("pose.position.y", 1e300), "pose.position.y"),
    (put("pose.orientation.x", math.nan), "pose.orientation.x"),
    (put("pose.orientation.x", 1e300), "pose.orientation.x"),
    (zero_quaternion, "pose.orientation"),
    (put("pose.orientation.w", 2.0), "pose.orientation"),
    (put("scale.x", 0.0), "scale.x"),
    (put("scale.y", -1.0), "scale.y"),
    (put("scale.z", math.nan), "scale.z"),
    (put("scale.x", 1e9), "scale.x"),
    (put("scale.x", 1e-300), "scale.x"),
    (put("type", 0), "type"),
    (put("type", 9), "type"),
    (put("type", -2147483648), "type"),
    (put("action", 1), "action"),
    (put("action", 77), "action"),
    (put("header.frame_id", "map"), "header.frame_id"),
    (put("ns", "a b"), "ns, id"),
    (put("ns", "x" * 100_000), "ns, id"),
    (put("id", -1), "ns, id"),
    (put("ns", "日本"), "ns, id"),
    (put("text", "x" * 1_000_000), "text"),
    (put("text", "[" * 4000), "text"),
    (put("text", "{mass: 0}"), "text.mass"),
    (put("text", "{mass: 1, density: 2}"), "text.density"),
    (put("text", "{name: ground}"), "name"),
    (put("text", "\x1b[2J"), "text"),
    (put("lifetime.sec", -5), "lifetime"),
    (put("color.r", math.nan), "color.r"),
    (triangles(0), "points"),
    (triangles(4), "points"),
    (triangles(3, math.nan), "points[0]"),
    (triangles(3), "points"),
    (triangles(300), "points"),
    (resource("/etc/passwd"), "mesh_resource"),
]


def last_refusal(bench: object, got: list) -> dict:
    bench.until(lambda: got)
    return json.loads(got[-1].data)


@pytest.fixture
def told(bench: object) -> tuple[object, list]:
    got = bench.listen("/carom/rejected", String, LATCHED)
    return bench, got


@pytest.mark.parametrize(("change", "field"), SPAWNS)
def test_a_bad_marker_is_refused_by_field(told: tuple, change: Callable, field: str) -> None:
    bench, got = told
    bench.send("/carom/spawn", cube(change))
    record = last_refusal(bench, got)
    assert (record["source"], record["field"]) == ("~/spawn", field)
    assert record["rule"]
    assert len(got[-1].data) < 1000
    time = bench.world.time
    bench.ticks(3)
    assert bench.world.time > time
    assert bench.world.names == ["ground"]


def wrench(frame: str, x: float) -> WrenchStamped:
    msg = WrenchStamped()
    msg.header.frame_id, msg.wrench.force.x = frame, x
    return msg


def odometry(change: Callable[[Odometry], object]) -> Odometry:
    msg = Odometry(child_frame_id="box_1")
    change(msg)
    return msg


OTHERS = [
    ("/carom/wrench", wrench("", 1.0), "header.frame_id"),
    ("/carom/wrench", wrench("nobody", 1.0), "header.frame_id"),
    ("/carom/wrench", wrench("box_1/handle", 1.0), "header.frame_id"),
    ("/carom/wrench", wrench("ground", 1.0), "header.frame_id"),
    ("/carom/wrench", wrench("../" * 1000, 1.0), "header.frame_id"),
    ("/carom/wrench", wrench("box_1", math.nan), "wrench.force.x"),
    ("/carom/wrench", wrench("box_1", 1e300), "wrench.force.x"),
    ("/carom/impulse", wrench("box_1", -math.inf), "wrench.force.x"),
    ("/carom/impulse", wrench("nobody", 1.0), "header.frame_id"),
    ("/carom/bodies/box_1/wrench", wrench("", math.nan).wrench, "force.x"),
    ("/carom/bodies/box_1/impulse", wrench("", math.inf).wrench, "force.x"),
    ("/carom/set_state", odometry(put("child_frame_id", "no")), "child_frame_id"),
    ("/carom/set_state", odometry(put("header.frame_id", "map")), "header.frame_id"),
    (
        "/carom/set_state",
        odometry(put("pose.pose.position.x", math.nan)),
        "pose.pose.position.x",
    ),
    ("/carom/set_state", odometry(put("pose.pose.orientation.w", 0.0)), "pose.pose.orientation"),
    (
        "/carom/set_state",
        odometry(put("twist.twist.angular.z", 1e300)),
        "twist.twist.angular.z",
    ),
    ("/carom/scene", String(data="bodies: 3"), "bodies"),
    ("/carom/scene", String(data="x" * (limits.SCENE_CHARACTERS + 1)), "data"),
    ("/carom/scene", String(data="a: &x [1]\nb: *x"), "data"),
    ("/carom/scene", String(data="{bodys: []}"), "bodys"),
    (
        "/carom/scene",
        String(data="bodies: [{shape: {Mesh: {path: /etc/passwd}}}]"),
        "path",
    ),
]


def test_bad_commands_are_refused_by_field_and_the_body_goes_on(told: tuple) -> None:
    bench, got = told
    bench.send("/carom/spawn", cube())
    for topic, msg, field in OTHERS:
        got.clear()
        bench.send(topic, msg)
        record = last_refusal(bench, got)
        assert record["source"] == topic.replace("/carom", "~")
        assert field in record["field"], record
        assert bench.world.names == ["ground", "box_1"]
    bench.ticks(100)
    assert abs(bench.world.simulation.poses()[1, 2] - 0.1) < 1e-3  # it rests, unmoved by all that


def test_a_bad_marker_among_good_ones_is_the_only_one_refused(told: tuple) -> None:
    bench, got = told
    markers = [cube(put("id", number)) for number in range(5)]
    markers[2].scale.y = math.nan
    bench.send("/carom/spawn_array", MarkerArray(markers=markers))
    bench.until(lambda: len(bench.world.names) == 5)
    assert bench.world.names == ["ground", "box_0", "box_1", "box_3", "box_4"]
    assert last_refusal(bench, got)["source"] == "~/spawn_array markers[2]"


def test_a_key_of_control_characters_does_not_stop_the_markers_after_it(told: tuple) -> None:
    bench, got = told
    bad = cube(put("text", '{"\\ud800\\e[31m": 1}'))
    bench.send("/carom/spawn_array", MarkerArray(markers=[bad, cube(put("id", 2))]))
    bench.until(lambda: "box_2" in bench.world.names)
    assert last_refusal(bench, got)["source"] == "~/spawn_array markers[0]"
    assert got[-1].data.isprintable()


def test_a_name_no_topic_can_hold_leaves_other_bodies_theirs(told: tuple) -> None:
    bench, _ = told
    for ns in ("ends_", "after"):  # the first becomes ends__1, and topics take no two underscores
        bench.send("/carom/spawn", cube(put("ns", ns)))
    bench.until(lambda: "after_1" in bench.world.names)
    bench.send("/carom/bodies/after_1/impulse", Wrench())
    bench.until(lambda: bench.node.count_subscribers("/carom/bodies/after_1/impulse") == 1)


def told_of(msg: String) -> int:
    words = json.loads(msg.data)["rule"].split(" more were refused")
    return int(words[0]) if len(words) == 2 else 1


def test_a_flood_is_taken_whole_or_counted(told: tuple) -> None:
    bench, got = told
    publisher = bench.publisher("/carom/spawn", Marker)
    for number in range(1000):
        publisher.publish(cube(lambda msg, n=number: put("scale.x", -1.0 - n)(msg)))
    bench.until(lambda: bench.node.outputs.rejected_count == 1000)
    # Each was told by itself or is in the number of a summary.
    bench.until(lambda: sum(map(told_of, got)) == 1000)
    assert len(got) < 1000
    bench.send("/carom/spawn", cube())
    bench.until(lambda: "box_1" in bench.world.names)


def test_bytes_that_are_no_message_are_dropped(told: tuple) -> None:
    bench, _ = told
    publisher = bench.publisher("/carom/spawn", Marker)
    good = serialize_message(cube())
    for junk in (b"", b"\x00\x01\x00\x00", b"\xff" * 64, good[:40], good[:-3]):
        if junk:  # rcl itself refuses to send nothing
            publisher.publish(junk)
    for _ in range(20):
        bench.executor.spin_once(timeout_sec=0.01)
        bench.node.tick()
    bench.send("/carom/spawn", cube())
    bench.until(lambda: "box_1" in bench.world.names)


def test_the_largest_push_leaves_other_bodies_alone(bench: object) -> None:
    bench.send("/carom/spawn", cube())
    bench.send("/carom/spawn", cube(lambda m: (put("id", 2)(m), put("pose.position.x", 5.0)(m))))
    shove = Wrench()
    shove.force.y, shove.torque.x = 7.9 * limits.SPEED_M_S, 0.05 * limits.SPIN_RAD_S  # 8 kg
    bench.send("/carom/bodies/box_1/impulse", shove)
    bench.ticks(200)
    pose = bench.world.simulation.poses()[2]
    assert all(math.isfinite(value) for value in pose)
    assert pose[0] == pytest.approx(5, abs=1e-3)
    assert pose[2] == pytest.approx(0.1, abs=1e-3)


def test_an_exception_nobody_foresaw_is_a_refusal_too(
    told: tuple, monkeypatch: pytest.MonkeyPatch
) -> None:
    bench, got = told

    def broken(*_: object, **__: object) -> None:
        raise RuntimeError("not foreseen")

    monkeypatch.setattr("carom_ros.marker.request_of", broken)
    bench.send("/carom/spawn", cube())
    assert "not foreseen" in last_refusal(bench, got)["value"]
