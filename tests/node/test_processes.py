# SPDX-License-Identifier: Apache-2.0
"""The node in a process of its own: nothing is lost after the match, and it ends cleanly."""

import json
import re
import signal
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.qos import DurabilityPolicy, QoSProfile
from rosgraph_msgs.msg import Clock
from std_msgs.msg import String
from std_srvs.srv import SetBool, Trigger
from visualization_msgs.msg import Marker

from carom_ros.node_arguments import main
from carom_ros.qos import COMMANDS

MATCH_S = 20.0  # a process is found within 0.7 s; a machine with all cores busy may take longer


class Peer:
    def __init__(self) -> None:
        self.context = rclpy.Context()
        rclpy.init(context=self.context)
        self.node = rclpy.create_node("peer", context=self.context)
        self.executor = SingleThreadedExecutor(context=self.context)
        self.executor.add_node(self.node)

    def until(self, done: Callable[[], bool], what: str) -> None:
        end = time.monotonic() + MATCH_S
        while not done():
            assert time.monotonic() < end, what
            self.executor.spin_once(timeout_sec=0.02)

    def call(self, client: object, request: object) -> object:
        future = client.call_async(request)
        self.until(future.done, f"{client.srv_name} did not answer")
        return future.result()

    def close(self) -> None:
        self.executor.shutdown()
        self.node.destroy_node()
        rclpy.try_shutdown(context=self.context)


@pytest.fixture
def peer() -> Iterator[Peer]:
    made = Peer()
    yield made
    made.close()


def crate(number: int) -> Marker:
    msg = Marker(type=Marker.CUBE, ns="box", id=number)
    msg.pose.position.x, msg.pose.position.z = float(number), 0.1
    msg.scale.x = msg.scale.y = msg.scale.z = 0.2
    return msg


def test_after_the_match_every_message_arrives_in_both_directions(
    node_process: Callable, peer: Peer
) -> None:
    node = node_process("--no-log", "--paused")
    publisher = peer.node.create_publisher(Marker, "/carom/spawn", COMMANDS)
    names: list[list[str]] = []
    latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    peer.node.create_subscription(
        String, "/carom/names", lambda msg: names.append(json.loads(msg.data)["names"]), latched
    )
    # Waited for: the match, never a time.
    peer.until(lambda: publisher.get_subscription_count() == 1, "the node was not found")
    count = 300
    for number in range(count):
        publisher.publish(crate(number))
    wanted = {"ground", *(f"box_{number}" for number in range(count))}
    peer.until(lambda: names and set(names[-1]) == wanted, "spawns are missing")
    # One publisher, reliable and kept: they arrive in the order they were sent, so rows ascend.
    assert names[-1] == ["ground", *(f"box_{number}" for number in range(count))]

    stamps: list[int] = []
    peer.node.create_subscription(
        Clock, "/clock", lambda m: stamps.append(m.clock.sec * 10**9 + m.clock.nanosec), 1000
    )
    peer.until(lambda: bool(stamps), "no clock")
    step = peer.node.create_client(Trigger, "/carom/step")
    peer.until(step.service_is_ready, "no ~/step")
    steps = 60
    for _ in range(steps):
        assert peer.call(step, Trigger.Request()).success
    last = round(steps * 1e9 / 240)
    peer.until(lambda: stamps[-1] == last, "the last step's clock is missing")
    # Each step publishes its time: the numbers heard are the whole range, none is missing.
    assert sorted(set(stamps)) == [round(k * 1e9 / 240) for k in range(steps + 1)]
    assert node.end(signal.SIGTERM)[0] == 0


def test_the_log_of_a_run_replays_to_its_last_bit(
    node_process: Callable, peer: Peer, tmp_path: Path, capsys: pytest.CaptureFixture
) -> None:
    log = tmp_path / "run.jsonl"
    node = node_process("--log", str(log), "--ros-args", "-p", "real_time_factor:=5.0")
    publisher = peer.node.create_publisher(Marker, "/carom/spawn", COMMANDS)
    peer.until(lambda: publisher.get_subscription_count() == 1, "the node was not found")
    for number in range(5):
        thrown = crate(number % 3)
        thrown.text = "{restitution: 0.5, velocity: [0.3, 0.1, 2], angular_velocity: [1, 2, 3]}"
        publisher.publish(thrown)
        end = time.monotonic() + 0.2
        peer.until(lambda end=end: time.monotonic() > end, "never")
    code, _ = node.end()
    assert code == 0
    assert main(["--replay", str(log), "--json"]) == 0
    record = json.loads(capsys.readouterr().out)
    assert record["same"]
    assert set(record["poses"]) == {"ground", "box_0", "box_1", "box_2"}
    assert record["steps"] > 240


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_ends_it_with_0_and_without_a_traceback(
    node_process: Callable, peer: Peer, number: int
) -> None:
    node = node_process("--no-log")
    pause = peer.node.create_client(SetBool, "/carom/pause")
    peer.until(pause.service_is_ready, "the node did not start")
    code, err = node.end(number)
    assert code == 0
    assert "Traceback" not in err
    assert "see it" in err  # a newcomer is told how to look
    assert re.search(r"t \d+\.\d+ s .*ended", err)  # and that it moved


def test_it_ends_by_itself_after_its_duration(node_process: Callable) -> None:
    node = node_process("--no-log", "--duration", "0.3")
    node.process.wait(timeout=20)
    assert node.end()[0] == 0


@pytest.mark.parametrize(
    ("args", "code", "words"),
    [
        (("no_such_scene",), 2, "no_such_scene"),
        (("--dt", "1"), 2, "1e-5 to 0.1"),
        (("--no-log", "--ros-args", "-p", "dt_s:=5.0"), 2, "dt_s"),
        (("--no-log", "--ros-args", "-p", "publish_rate_hz:=50"), 2, "publish_rate_hz"),
        (("--no-log", "--ros-args", "-r", "nonsense"), 2, "nonsense"),
        (("--replay", "/nonexistent/run.jsonl"), 2, "run.jsonl"),
    ],
)
def test_bad_usage_is_told_and_is_2(
    node_process: Callable, args: tuple, code: int, words: str
) -> None:
    node = node_process(*args)
    node.process.wait(timeout=20)
    got, err = node.end()
    assert got == code, err
    assert words in err
    assert "Traceback" not in err
