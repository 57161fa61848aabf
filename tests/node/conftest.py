# SPDX-License-Identifier: Apache-2.0
"""A ROS graph of this test run's own: its domain, its log folder, field checks on."""

import fcntl
import importlib.util
import os
import signal
import subprocess
import sys
import tempfile
import time
import warnings
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TextIO

import pytest

HERE = Path(__file__).parent
HAS_ROS = importlib.util.find_spec("rclpy") is not None

# Message classes read this when they are imported, so it must be set before any test module is.
os.environ["ROS_PYTHON_CHECK_FIELDS"] = "1"
os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST"
os.environ["ROS_LOG_DIR"] = tempfile.mkdtemp(prefix="carom_ros_log_")


_locks: list[TextIO] = []


def pytest_unconfigure() -> None:
    for lock in _locks:
        lock.close()


def _own_domain() -> int:
    """A domain no other test run on this machine uses, for as long as this process lives."""
    for offset in range(101):
        number = 1 + (os.getpid() + offset) % 101
        lock = (Path(tempfile.gettempdir()) / f"carom_ros_domain_{number}.lock").open("w")
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            lock.close()
            continue
        _locks.append(lock)
        return number
    raise RuntimeError("all ROS domains are in use")


os.environ["ROS_DOMAIN_ID"] = str(_own_domain())

if HAS_ROS:
    from carom_ros import discovery

    discovery.prepare()
    with warnings.catch_warnings():  # its parser library imports a module Python deprecates
        warnings.simplefilter("ignore", DeprecationWarning)
        import rosidl_generator_py  # noqa: F401
else:
    collect_ignore_glob = ["test_*.py"]


def pytest_report_header() -> str:
    if not HAS_ROS:
        return "node tests: skipped, rclpy is not installed (pip install 'carom[ros]')"
    return f"node tests: ROS_DOMAIN_ID={os.environ['ROS_DOMAIN_ID']}"


class Bench:
    """A SimulationNode and a peer that talks to it, in one process, stepped by hand."""

    def __init__(self, scene: object = None, **options: object) -> None:
        import rclpy
        from rclpy.executors import SingleThreadedExecutor

        from carom_ros.node import SimulationNode

        self.context = rclpy.Context()
        rclpy.init(args=options.pop("ros_args", None), context=self.context)
        self.node = SimulationNode(scene, context=self.context, **options)
        self.peer = rclpy.create_node("peer", context=self.context)
        self.executor = SingleThreadedExecutor(context=self.context)
        self.executor.add_node(self.node)
        self.executor.add_node(self.peer)
        self._publishers: dict[tuple[str, type], object] = {}

    @property
    def world(self) -> object:
        return self.node.world

    def spin(self) -> None:
        """Handles what is ready."""
        for _ in range(8):
            self.executor.spin_once(timeout_sec=0)

    def until(self, done: Callable[[], bool], seconds: float = 10.0) -> None:
        """Ticks until `done()`; fails after `seconds` of wall time."""
        end = time.monotonic() + seconds
        while not done():
            assert time.monotonic() < end, "nothing came"
            self.executor.spin_once(timeout_sec=0.002)
            self.node.tick()

    def ticks(self, count: int) -> None:
        for _ in range(count):
            self.node.tick()

    def publisher(self, topic: str, kind: type) -> object:
        """A publisher that has found its subscription."""
        key = (topic, kind)
        if key not in self._publishers:
            from carom_ros.qos import COMMANDS

            made = self.peer.create_publisher(kind, topic, COMMANDS)
            end = time.monotonic() + 10
            while not made.get_subscription_count():
                assert time.monotonic() < end, f"nobody listens to {topic}"
                self.executor.spin_once(timeout_sec=0.01)
            self._publishers[key] = made
        return self._publishers[key]

    def send(self, topic: str, msg: object) -> None:
        """Publishes, and ticks until the node has taken it, used or refused."""
        before = self.heard()
        self.publisher(topic, type(msg)).publish(msg)
        self.until(lambda: self.heard() > before)

    def heard(self) -> int:
        return self.node.outputs.rejected_count + self._applied()

    def _applied(self) -> int:
        if not hasattr(self, "outcomes"):
            self.outcomes = []
            self.node.on_outcome = self.outcomes.append
        return sum(outcome.refusal is None for outcome in self.outcomes)

    def listen(self, topic: str, kind: type, qos: object = 100, **options: object) -> list:
        """The messages of a topic as they come, from a subscription that has matched."""
        got: list = []
        self.peer.create_subscription(kind, topic, got.append, qos, **options)
        end = time.monotonic() + 10
        while not any(
            publisher.topic_name == topic and publisher.get_subscription_count()
            for publisher in self.node.publishers
        ):
            assert time.monotonic() < end, f"nobody publishes {topic}"
            self.executor.spin_once(timeout_sec=0.01)
        return got

    def call(self, service: str, kind: type, request: object) -> object:
        client = self.peer.create_client(kind, service)
        end = time.monotonic() + 10
        while not client.service_is_ready():
            assert time.monotonic() < end, f"there is no service {service}"
            self.executor.spin_once(timeout_sec=0.01)
        future = client.call_async(request)
        while not future.done():
            assert time.monotonic() < end, f"{service} did not answer"
            self.executor.spin_once(timeout_sec=0.01)
        self.peer.destroy_client(client)
        return future.result()

    def close(self) -> None:
        import rclpy

        self.node.close()
        self.executor.shutdown()
        self.peer.destroy_node()
        self.node.destroy_node()
        rclpy.try_shutdown(context=self.context)


@pytest.fixture
def make_bench() -> Iterator[Callable[..., Bench]]:
    made: list[Bench] = []

    def make(*args: object, **options: object) -> Bench:
        made.append(Bench(*args, **options))
        return made[-1]

    yield make
    for bench in made:
        bench.close()


@pytest.fixture
def bench(make_bench: Callable[..., Bench]) -> Bench:
    return make_bench()


class NodeProcess:
    """`carom node` in a process of its own."""

    def __init__(self, *args: str) -> None:
        command = [sys.executable, "-m", "carom_ros.node_arguments", *args]
        self.process = subprocess.Popen(
            command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
        )

    def end(self, number: int = signal.SIGINT) -> tuple[int, str]:
        """Exit code and what it wrote to stderr."""
        if self.process.poll() is None:
            self.process.send_signal(number)
        try:
            _, err = self.process.communicate(timeout=20)
        except subprocess.TimeoutExpired:
            self.process.kill()
            _, err = self.process.communicate()
        return self.process.returncode, err


@pytest.fixture(scope="session")
def node_process() -> Iterator[Callable[..., NodeProcess]]:
    made: list[NodeProcess] = []

    def make(*args: str) -> NodeProcess:
        made.append(NodeProcess(*args))
        return made[-1]

    yield make
    for each in made:
        each.end()
