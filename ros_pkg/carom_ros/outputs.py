# SPDX-License-Identifier: Apache-2.0
"""What the node publishes about bodies and time."""

import json
from collections import deque

from geometry_msgs.msg import PoseArray
from rclpy.node import Node
from rclpy.qos_overriding_options import QoSOverridingOptions
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import MultiDOFJointState
from std_msgs.msg import String

from carom_ros import limits, plain_messages, qos
from carom_ros.cdr import PoseArrayBytes, StatesBytes
from carom_ros.refusal import Refusal
from carom_ros.rotate import stamp
from carom_ros.schedule import Every
from carom_ros.world import World


class Outputs:
    """Publishers of poses, states, names, clock and refusals."""

    def __init__(self, node: Node, frame_id: str) -> None:
        options = {"qos_overriding_options": QoSOverridingOptions.with_default_policies()}
        self.poses = node.create_publisher(PoseArray, "~/poses", qos.STREAM, **options)
        self.states = node.create_publisher(MultiDOFJointState, "~/states", qos.STREAM, **options)
        self.names = node.create_publisher(String, "~/names", qos.latched(1))
        self.rejected = node.create_publisher(
            String, "~/rejected", qos.latched(limits.REJECTED_PER_TICK)
        )
        self.clock = node.create_publisher(Clock, "/clock", qos.CLOCK, **options)
        self.raw = plain_messages.bytes_are_understood(frame_id)
        if not self.raw:
            text = "this middleware reads poses otherwise: publishing them the slow, ordinary way"
            node.get_logger().warning(text)
        self._frame_id = frame_id
        self._generation = -1
        self._refusals: deque[tuple[str, Refusal]] = deque()
        self.rejected_count = 0
        self._pose_rate, self._clock_rate = Every(), Every()

    def publish(self, world: World, now: float, slack: float, p: object) -> None:
        """What is due at `now`, s of wall time."""
        self.publish_names(world)
        if self._clock_rate.due(now, p.clock_rate_hz, slack):
            self.publish_clock(world)
        if self._pose_rate.due(now, p.publish_rate_hz, slack):
            self.publish_poses(world)
        self._publish_refusals(world)

    def publish_names(self, world: World) -> None:
        """The order of ~/poses, before the first poses in that order."""
        if world.generation == self._generation:
            return
        self._generation = world.generation
        sec, nanosec = stamp(world.valid_from)
        record = {
            "schema": 1,
            "generation": world.generation,
            "valid_from": {"sec": sec, "nanosec": nanosec},
            "names": world.names,
        }
        self.names.publish(String(data=json.dumps(record)))
        self._pose_bytes = PoseArrayBytes(self._frame_id, len(world.names))
        self._state_bytes = StatesBytes(self._frame_id, world.names)

    def publish_clock(self, world: World) -> None:
        msg = Clock()
        msg.clock.sec, msg.clock.nanosec = stamp(world.time)
        self.clock.publish(msg)

    def publish_poses(self, world: World) -> None:
        when, poses = stamp(world.time), world.simulation.poses()
        if self.raw:
            self.poses.publish(self._pose_bytes.encode(*when, poses))
        else:
            self.poses.publish(plain_messages.pose_array(self._frame_id, *when, poses))
        if not self.states.get_subscription_count():
            return
        arrays = (poses, world.simulation.twists(), world.wrenches())
        if self.raw:
            self.states.publish(self._state_bytes.encode(*when, *arrays))
        else:
            self.states.publish(plain_messages.states(self._frame_id, world.names, *when, *arrays))

    def refuse(self, source: str, refusal: Refusal) -> None:
        """Notes a refusal for the next tick; a flood of them is counted and summed up."""
        self.rejected_count += 1
        if len(self._refusals) < limits.PENDING_REQUESTS:
            self._refusals.append((source, refusal))

    def _publish_refusals(self, world: World) -> None:
        taken = [self._refusals.popleft() for _ in range(len(self._refusals))]
        shown = taken[: limits.REJECTED_PER_TICK - 1]
        if len(taken) > len(shown) + 1:
            rule = f"{len(taken) - len(shown)} more were refused at this step"
            shown.append((taken[-1][0], Refusal("", "", rule, "send more slowly")))
        else:
            shown = taken
        for source, refusal in shown:
            record = {
                "schema": 1,
                "time_s": world.time,
                "source": source,
                "field": refusal.field,
                "value": refusal.value,
                "rule": refusal.rule,
                "remedy": refusal.remedy,
            }
            self.rejected.publish(String(data=json.dumps(record)))
