# SPDX-License-Identifier: Apache-2.0
"""A short-lived node on the graph, and waiting for what it must find there."""

import os
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.signals import SignalHandlerOptions
from rclpy.validate_full_topic_name import validate_full_topic_name

from carom_ros.refusal import Refusal

POLL_S = 0.02
SETTLED_S = 0.7
"""A graph that has not changed for this long is taken as known: with the fast announcements of
fast_discovery.xml every process was found within 0.67 s."""


class Graph:
    """A node without parameters or log topic, spun by hand."""

    def __init__(self, name: str, use_sim_time: bool = False) -> None:
        self.context = rclpy.Context()
        # Python's own KeyboardInterrupt is what ends the verbs.
        rclpy.init(context=self.context, signal_handler_options=SignalHandlerOptions.NO)
        options = []
        if use_sim_time:
            options.append(rclpy.parameter.Parameter("use_sim_time", value=True))
        self.node = rclpy.create_node(
            name,
            context=self.context,
            start_parameter_services=False,
            enable_rosout=False,
            parameter_overrides=options,
        )
        self._executor = SingleThreadedExecutor(context=self.context)
        self._executor.add_node(self.node)

    def spin(self, seconds: float) -> None:
        """Handles at most one message, waiting at most this long for it."""
        self._executor.spin_once(timeout_sec=seconds)

    def wait(self, done: Callable[[], bool], seconds: float | None = None) -> bool:
        """Spins until `done()`; False when the time is over first."""
        end = None if seconds is None else time.monotonic() + seconds
        while not done():
            if end is not None and time.monotonic() >= end:
                return False
            self.spin(POLL_S)
        return True

    def settle(self, seconds: float | None = None) -> None:
        """Waits `seconds`, or until the graph has stopped changing."""
        if seconds is not None:
            self.wait(lambda: False, seconds)
            return
        last, since = None, time.monotonic()
        while time.monotonic() - since < SETTLED_S:
            now = self.node.get_topic_names_and_types()
            if now != last:
                last, since = now, time.monotonic()
            self.spin(POLL_S)

    def topic(self, name: str) -> str:
        """The full name, as `ros2 topic` reads it: relative to the root. @throws Refusal"""
        full = name if name.startswith("/") else f"/{name}"
        try:
            validate_full_topic_name(full)
        except Exception as error:
            problem = str(error).splitlines()[0]
            raise Refusal("topic", name, problem, "for example /carom/poses") from None
        return full

    def type_of(self, topic: str, seconds: float | None) -> str:
        """The type the topic is published with, waiting for it. @throws Refusal"""
        found: list[str] = []

        def known() -> bool:
            found[:] = [
                kind
                for name, kinds in self.node.get_topic_names_and_types()
                if name == topic
                for kind in kinds
            ]
            return bool(found)

        if not self.wait(known, 2.0):
            left = "" if seconds is None else f" for {seconds:g} s"
            print(f"waiting{left} for {topic} to be published ...", file=sys.stderr, flush=True)
            if not self.wait(known, seconds):
                raise TimeoutError(f"{topic} is not published; carom topic list shows what is")
        if len(found) > 1:
            raise Refusal("topic", topic, f"has several types: {', '.join(found)}", "name one")
        return found[0]

    def close(self) -> None:
        self._executor.shutdown()
        self.node.destroy_node()
        rclpy.try_shutdown(context=self.context)


@contextmanager
def graph(name: str = "", use_sim_time: bool = False) -> Iterator[Graph]:
    opened = Graph(name or f"_carom_topic_{os.getpid()}", use_sim_time)
    try:
        yield opened
    finally:
        opened.close()
