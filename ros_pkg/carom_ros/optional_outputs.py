# SPDX-License-Identifier: Apache-2.0
"""Outputs not every user wants: transforms, where tf2_msgs is installed, and odometry by name."""

import numpy as np
from geometry_msgs.msg import TransformStamped
from nav_msgs.msg import Odometry
from rclpy.node import Node
from rclpy.publisher import Publisher

from carom_ros import qos
from carom_ros.rotate import rotated, stamp
from carom_ros.schedule import Every
from carom_ros.world import World


def transforms(world: World, frame_id: str, prefix: str) -> list[TransformStamped]:
    """World to body frame, of every body."""
    sec, nanosec = stamp(world.time)
    result = []
    for name, pose in zip(world.names, world.simulation.poses().tolist(), strict=True):
        each = TransformStamped(child_frame_id=f"{prefix}{name}")
        each.header.frame_id = frame_id
        each.header.stamp.sec, each.header.stamp.nanosec = sec, nanosec
        to = each.transform.translation
        to.x, to.y, to.z = pose[:3]
        turn = each.transform.rotation
        turn.x, turn.y, turn.z, turn.w = pose[3:]
        result.append(each)
    return result


class Transforms:
    """/tf, where its message is installed; the wheels have none, which is said once."""

    def __init__(self, node: Node, p: object) -> None:
        self._p, self._rate = p, Every()
        self._out: Publisher | None = None
        try:
            from tf2_msgs.msg import TFMessage
        except ImportError:
            node.get_logger().info(
                "tf2_msgs is not installed: no /tf; ~/poses and ~/states have all"
            )
            return
        self._kind = TFMessage
        self._out = node.create_publisher(TFMessage, "/tf", qos.STREAM)

    def publish(self, world: World, now: float, slack: float) -> None:
        if self._out is None or not self._rate.due(now, self._p.tf_rate_hz, slack):
            return
        listed = transforms(world, self._p.frame_id, self._p.frame_prefix)
        self._out.publish(self._kind(transforms=listed))


class Odometries:
    """~/odom/<name> of the bodies that parameter odom names."""

    def __init__(self, node: Node, p: object) -> None:
        self._node, self._p = node, p
        self._out: dict[str, Publisher] = {}

    def publish(self, world: World) -> None:
        if not self._p.odom and not self._out:
            return
        wanted = [name for name in str(self._p.odom).split() if name in world.bodies]
        for name in [name for name in self._out if name not in wanted]:
            self._node.destroy_publisher(self._out.pop(name))
        for name in wanted:
            if name not in self._out:
                topic = f"~/odom/{name}"
                self._out[name] = self._node.create_publisher(Odometry, topic, qos.STREAM)
            self._out[name].publish(odometry(world, name, self._p.frame_id))


def odometry(world: World, name: str, frame_id: str) -> Odometry:
    """Pose in the world, twist of the body frame's origin in the body's axes."""
    row = world.simulation.row(name)
    pose, twist = world.simulation.poses()[row], world.simulation.twists()[row]
    msg = Odometry(child_frame_id=name)
    msg.header.frame_id = frame_id
    msg.header.stamp.sec, msg.header.stamp.nanosec = stamp(world.time)
    at, turn = msg.pose.pose.position, msg.pose.pose.orientation
    at.x, at.y, at.z, turn.x, turn.y, turn.z, turn.w = pose.tolist()
    back = pose[3:] * np.array([-1.0, -1.0, -1.0, 1.0])
    linear, angular = msg.twist.twist.linear, msg.twist.twist.angular
    linear.x, linear.y, linear.z = rotated(back, twist[:3]).tolist()
    angular.x, angular.y, angular.z = rotated(back, twist[3:]).tolist()
    return msg
