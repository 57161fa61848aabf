# SPDX-License-Identifier: Apache-2.0
"""Topics, services and parameters of the node, in one process, by hand-made ticks."""

import json
import math
from collections.abc import Callable

import numpy as np
import pytest
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import PoseArray, Wrench
from nav_msgs.msg import Odometry
from rcl_interfaces.msg import ParameterType
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import MultiDOFJointState
from std_msgs.msg import String
from std_srvs.srv import SetBool, Trigger
from visualization_msgs.msg import Marker, MarkerArray

import carom
from carom_ros.optional_outputs import transforms
from carom_ros.parameters import SPECS

LATCHED = QoSProfile(depth=100, durability=DurabilityPolicy.TRANSIENT_LOCAL)


def crate(x: float = 0.0, number: int = 1) -> Marker:
    msg = Marker(type=Marker.CUBE, ns="box", id=number)
    msg.pose.position.x, msg.pose.position.z = float(x), 1.0
    msg.scale.x = msg.scale.y = msg.scale.z = 0.2
    return msg


def seconds(stamp: object) -> float:
    return stamp.sec + 1e-9 * stamp.nanosec


def rows(msg: PoseArray) -> np.ndarray:
    parts = [(pose.position, pose.orientation) for pose in msg.poses]
    return np.array([[p.x, p.y, p.z, q.x, q.y, q.z, q.w] for p, q in parts])


def test_a_crate_falls_lands_and_rests(bench: object) -> None:
    poses = bench.listen("/carom/poses", PoseArray)
    bench.send("/carom/spawn", crate())
    bench.ticks(10)
    bench.until(lambda: poses and len(poses[-1].poses) == 2)
    assert poses[-1].header.frame_id == "world"
    bench.ticks(200)
    poses.clear()
    bench.until(lambda: poses)
    assert rows(poses[-1])[1, :3] == pytest.approx([0, 0, 0.1], abs=1e-4)  # the contact gap
    assert rows(poses[-1])[0].tolist() == [0, 0, 0, 0, 0, 0, 1]


def test_names_tell_a_late_joiner_the_order_of_poses_and_since_when(bench: object) -> None:
    bench.send("/carom/spawn", crate())
    bench.send("/carom/spawn", crate(1.0, 2))
    bench.ticks(5)
    got = bench.listen("/carom/names", String, LATCHED)  # joins now
    poses = bench.listen("/carom/poses", PoseArray)
    bench.until(lambda: got and poses)
    record = json.loads(got[-1].data)
    assert record["names"] == ["ground", "box_1", "box_2"]
    assert record["generation"] == bench.world.generation == 3
    since = record["valid_from"]["sec"] + 1e-9 * record["valid_from"]["nanosec"]
    assert since == pytest.approx(bench.world.valid_from, abs=1e-9)
    assert seconds(poses[0].header.stamp) >= since
    assert rows(poses[-1])[2, 0] == pytest.approx(1.0, abs=1e-6)
    bench.send("/carom/spawn", Marker(ns="box", id=1, action=Marker.DELETE))
    bench.until(lambda: len(got) == 2)
    assert json.loads(got[-1].data)["names"] == ["ground", "box_2"]


def test_every_poses_message_has_the_names_of_its_stamp(bench: object) -> None:
    names = bench.listen("/carom/names", String, LATCHED)
    poses = bench.listen("/carom/poses", PoseArray, 1000)
    bench.until(lambda: len(names) == 1)
    for number in range(5):
        bench.send("/carom/spawn", crate(number, number))
        bench.ticks(3)
        # Names are kept one deep for late joiners: a reader that lags may miss one in between.
        bench.until(lambda: len(names) == number + 2)  # noqa: B023  (called at once)
    bench.until(lambda: poses and len(poses[-1].poses) == 6)
    lists = [json.loads(msg.data) for msg in names]
    starts = [s["valid_from"]["sec"] + 1e-9 * s["valid_from"]["nanosec"] for s in lists]
    for msg in poses:
        stamp, count = seconds(msg.header.stamp), len(msg.poses)
        before = [len(s["names"]) for s, start in zip(lists, starts, strict=True) if start < stamp]
        at = [len(s["names"]) for s, start in zip(lists, starts, strict=True) if start == stamp]
        assert count == before[-1] if not at else count in (*before[-1:], *at)


def test_states_hold_names_transforms_twists_and_wrenches(bench: object) -> None:
    got = bench.listen("/carom/states", MultiDOFJointState)
    bench.send("/carom/spawn", crate())
    push = Wrench()
    push.force.x = 3.0
    bench.send("/carom/bodies/box_1/wrench", push)
    bench.until(lambda: got and len(got[-1].joint_names) == 2 and got[-1].wrench[1].force.x)
    msg = got[-1]
    assert msg.joint_names == ["ground", "box_1"]
    assert msg.wrench[1].force.x == 3
    assert (msg.twist[0].linear.x, msg.transforms[0].rotation.w) == (0, 1)
    # From rest, in step with gravity: v_x / v_z = F / (m g) once the same steps were taken. The
    # wrench came later than gravity, so only its sign and the fall are fixed.
    assert msg.twist[1].linear.z < 0 < msg.twist[1].linear.x


def test_clock_runs_with_the_simulation(make_bench: Callable) -> None:
    bench = make_bench(overrides={"real_time_factor": 2.0})
    got = bench.listen("/clock", Clock)
    bench.ticks(100)
    bench.until(lambda: len(got) > 10)
    times = [seconds(msg.clock) for msg in got]
    assert times == sorted(times)
    # 100 ticks of 10 ms at twice real time, in whole steps; until() ticks on.
    assert bench.world.time >= 2.0 - 2 * bench.world.dt


def test_a_tick_catches_up_no_more_than_it_may(make_bench: Callable) -> None:
    bench = make_bench(overrides={"max_lag_s": 0.05, "dt_s": 0.01})
    bench.node.tick(10.0)
    assert bench.world.steps == 5
    assert bench.node.pace.overruns == 1
    assert bench.node.pace.dropped == pytest.approx(9.95)
    bench.node.tick(0.01)
    assert bench.world.steps == 6


@pytest.mark.parametrize("dt", [0.001, 1 / 240, 0.003, 0.05])
def test_no_step_is_lost_or_won_to_rounding(make_bench: Callable, dt: float) -> None:
    bench = make_bench(overrides={"dt_s": dt})
    for _ in range(300):
        bench.node.tick(0.01)
    assert bench.world.steps == round(3 / dt)


def test_pause_step_and_run(bench: object) -> None:
    clock = bench.listen("/clock", Clock)
    bench.send("/carom/spawn", crate())
    assert not bench.call("/carom/step", Trigger, Trigger.Request()).success
    assert bench.call("/carom/pause", SetBool, SetBool.Request(data=True)).success
    steps = bench.world.steps
    bench.ticks(20)
    assert bench.world.steps == steps
    bench.until(lambda: clock and seconds(clock[-1].clock) == pytest.approx(bench.world.time))
    clock.clear()
    for number in range(1, 6):
        answer = bench.call("/carom/step", Trigger, Trigger.Request())
        assert answer.success
        assert bench.world.steps == steps + number
    bench.until(lambda: len({seconds(msg.clock) for msg in clock}) == 5)  # one clock per step
    assert bench.call("/carom/pause", SetBool, SetBool.Request(data=False)).message == "running"
    bench.ticks(10)
    assert bench.world.steps > steps + 5


def test_reset_tells_the_new_list_and_the_old_time(bench: object) -> None:
    names = bench.listen("/carom/names", String, LATCHED)
    bench.send("/carom/spawn", crate())
    bench.ticks(50)
    assert bench.call("/carom/reset", Trigger, Trigger.Request()).success
    assert bench.world.time == 0
    bench.until(lambda: json.loads(names[-1].data)["names"] == ["ground"])
    assert json.loads(names[-1].data)["valid_from"] == {"sec": 0, "nanosec": 0}


def test_a_body_brings_its_topics_and_takes_them_along(bench: object) -> None:
    def heard(topic: str) -> int:
        return bench.node.count_subscribers(topic)

    bench.send("/carom/spawn", crate())
    bench.until(lambda: heard("/carom/bodies/box_1/wrench") == 1)
    assert heard("/carom/bodies/box_1/impulse") == 1
    assert heard("/carom/bodies/ground/wrench") == 0  # nothing moves it
    bench.send("/carom/spawn", Marker(ns="box", id=1, action=Marker.DELETE))
    bench.until(lambda: heard("/carom/bodies/box_1/wrench") == 0)


def test_bodies_beyond_the_limit_have_no_topics_but_are_reached(make_bench: Callable) -> None:
    bench = make_bench(overrides={"body_topics_max": 2})
    for number in range(4):
        bench.send("/carom/spawn", crate(number, number))
    bench.until(lambda: bench.node.count_subscribers("/carom/bodies/box_1/wrench") == 1)
    bench.spin()
    assert bench.node.count_subscribers("/carom/bodies/box_2/wrench") == 0
    bench.send("/carom/spawn", Marker(ns="box", id=0, action=Marker.DELETE))
    bench.until(lambda: bench.node.count_subscribers("/carom/bodies/box_2/wrench") == 1)


def test_markers_draw_every_body_as_it_is(make_bench: Callable) -> None:
    scene = carom.Scene()
    scene.add(carom.Plane([0, 0, 2], 0.5), name="floor", static=True)
    scene.add(carom.Sphere(0.25), name="ball", position=[1, 2, 3])
    corners = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
    faces = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]
    scene.add(carom.Mesh(corners, faces), name="wedge", position=[5, 0, 0])
    bench = make_bench(scene, overrides={"paused": True})
    got = bench.listen("/carom/markers", MarkerArray)
    bench.until(lambda: got)
    first = got[0].markers
    assert first[0].action == Marker.DELETEALL
    floor, ball, wedge = first[1:]
    assert [m.ns for m in (floor, ball, wedge)] == ["floor", "ball", "wedge"]
    assert (ball.type, ball.scale.x, ball.pose.position.y) == (Marker.SPHERE, 0.5, 2)
    assert wedge.type == Marker.TRIANGLE_LIST
    assert [[p.x, p.y, p.z] for p in wedge.points] == [corners[i] for face in faces for i in face]
    # The upper face of the slab is where the plane is.
    assert floor.pose.position.z + floor.scale.z / 2 == pytest.approx(0.5, abs=1e-15)
    assert all(m.color.a == 1 for m in first[1:])


def test_diagnostics_hold_the_plan_and_its_reasons(bench: object) -> None:
    got = bench.listen("/diagnostics", DiagnosticArray)
    bench.send("/carom/spawn", crate())
    bench.ticks(50)
    got.clear()
    bench.until(lambda: got)
    simulation, plan = got[-1].status
    values = {each.key: each.value for each in simulation.values}
    assert values["bodies"] == "2"
    assert values["frozen"] == "none"
    assert float(values["time_s"]) > 0
    stages = {each.key for each in plan.values}
    assert {"gravity", "integrate"} <= stages
    assert any(stage.endswith("(off)") for stage in stages)


def test_odometry_is_published_for_the_bodies_asked_for(bench: object) -> None:
    half = math.sqrt(0.5)
    spin = crate()
    spin.pose.orientation.z = spin.pose.orientation.w = half
    spin.text = "{velocity: [0, 2, 0]}"
    bench.send("/carom/spawn", spin)
    bench.node.set_parameters([Parameter("odom", value="box_1 nobody")])
    bench.ticks(1)
    got = bench.listen("/carom/odom/box_1", Odometry)
    bench.until(lambda: got)
    assert (got[0].header.frame_id, got[0].child_frame_id) == ("world", "box_1")
    # 2 m/s along the world's y is along its own x.
    assert got[0].twist.twist.linear.x == pytest.approx(2, abs=1e-6)
    assert got[0].twist.twist.linear.y == pytest.approx(0, abs=1e-6)


def test_contacts_are_published_when_asked_for(bench: object) -> None:
    bench.send("/carom/spawn", crate())
    bench.node.set_parameters([Parameter("contacts", value=True)])
    bench.ticks(200)
    got = bench.listen("/carom/contacts", MarkerArray)
    bench.until(lambda: got)
    told = [json.loads(m.text) for m in got[-1].markers[1:]]
    assert {(each["a"], each["b"]) for each in told} == {("ground", "box_1")}
    weight = 1000 * 0.2**3 * 9.81
    total = sum(each["force_n"][2] for each in told)
    assert abs(total) == pytest.approx(weight, rel=0.01)  # at rest; the solver's own residual


def test_transforms_are_those_of_the_poses(bench: object) -> None:
    bench.send("/carom/spawn", crate(3.0))
    made = transforms(bench.world, "world", "sim/")
    assert [each.child_frame_id for each in made] == ["sim/ground", "sim/box_1"]
    assert made[1].transform.translation.x == bench.world.simulation.poses()[1, 0]
    assert made[1].header.frame_id == "world"


def test_parameters_change_while_running_and_refuse_what_cannot_be(bench: object) -> None:
    def set_one(name: str, value: object) -> object:
        return bench.node.set_parameters([Parameter(name, value=value)])[0]

    assert set_one("dt_s", 0.01).successful
    bench.node.tick(0.1)
    assert bench.world.steps == 10
    for name, value in (
        ("dt_s", 0.0),
        ("dt_s", math.nan),
        ("real_time_factor", math.inf),
        ("real_time_factor", -1.0),
        ("publish_rate_hz", 1e9),
        ("max_bodies", 0),
        ("frame_id", "map"),
    ):
        assert not set_one(name, value).successful, (name, value)
    assert bench.node.p.dt_s == 0.01


def test_several_parameters_are_set_together_or_not_at_all(bench: object) -> None:
    good, bad = Parameter("wrench_hold_s", value=9.0), Parameter("dt_s", value=math.nan)
    assert not bench.node.set_parameters_atomically([good, bad]).successful
    assert bench.node.p.wrench_hold_s == 1.0


def test_every_parameter_is_described_and_bounded(bench: object) -> None:
    for spec in SPECS:
        described = bench.node.describe_parameter(spec.name)
        assert described.description
        assert described.read_only == spec.fixed
        if described.type == ParameterType.PARAMETER_DOUBLE:
            assert len(described.floating_point_range) == 1


def test_a_namespace_moves_every_topic_of_the_node(make_bench: Callable) -> None:
    bench = make_bench(ros_args=["--ros-args", "-r", "carom:__ns:=/w1"])
    assert bench.node.get_fully_qualified_name() == "/w1/carom"
    bench.send("/w1/carom/spawn", crate())
    bench.until(lambda: "box_1" in bench.world.names)


def test_quality_of_service_can_be_overridden(make_bench: Callable) -> None:
    name = "qos_overrides./carom/poses.publisher.depth"
    bench = make_bench(ros_args=["--ros-args", "-p", f"{name}:=3"])
    (info,) = bench.node.get_publishers_info_by_topic("/carom/poses")
    assert bench.node.get_parameter(name).value == 3
    assert info.topic_type == "geometry_msgs/msg/PoseArray"
