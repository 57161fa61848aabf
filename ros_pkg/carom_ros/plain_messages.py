# SPDX-License-Identifier: Apache-2.0
"""The same messages as cdr.py by the ordinary way: the reference it is checked against, and what
is published where the two differ."""

from collections.abc import Callable

import numpy as np
from geometry_msgs.msg import Pose, PoseArray, Transform, Twist, Wrench
from rclpy.serialization import deserialize_message
from sensor_msgs.msg import MultiDOFJointState

from carom_ros.cdr import PoseArrayBytes, StatesBytes


def pose_array(frame_id: str, sec: int, nanosec: int, poses: np.ndarray) -> PoseArray:
    msg = PoseArray()
    _stamp(msg, frame_id, sec, nanosec)
    for row in poses.tolist():
        pose = Pose()
        _fill(pose.position, "xyz", row[:3])
        _fill(pose.orientation, "xyzw", row[3:])
        msg.poses.append(pose)
    return msg


def states(
    frame_id: str,
    names: list[str],
    sec: int,
    nanosec: int,
    poses: np.ndarray,
    twists: np.ndarray,
    wrenches: np.ndarray,
) -> MultiDOFJointState:
    msg = MultiDOFJointState()
    _stamp(msg, frame_id, sec, nanosec)
    msg.joint_names = list(names)
    rows = zip(poses.tolist(), twists.tolist(), wrenches.tolist(), strict=True)
    for pose, twist, wrench in rows:
        transform, speed, push = Transform(), Twist(), Wrench()
        _fill(transform.translation, "xyz", pose[:3])
        _fill(transform.rotation, "xyzw", pose[3:])
        _fill(speed.linear, "xyz", twist[:3])
        _fill(speed.angular, "xyz", twist[3:])
        _fill(push.force, "xyz", wrench[:3])
        _fill(push.torque, "xyz", wrench[3:])
        msg.transforms.append(transform)
        msg.twist.append(speed)
        msg.wrench.append(push)
    return msg


def bytes_are_understood(frame_id: str) -> bool:
    """Whether this middleware reads our bytes as the very messages they stand for.

    Equal after deserialising, not byte by byte: rclpy leaves its padding uninitialised. Counts 0 to
    3 and names of 1 to 8 letters go through every alignment.
    """
    return all(
        _understood(f"{frame_id}{'x' * extra}", count) for extra in range(4) for count in range(4)
    )


def _understood(frame_id: str, count: int) -> bool:
    names = [f"body{'_' * row}"[row:] for row in range(count)]
    # Every double distinct and with all bytes in use, so that no shift goes unseen.
    values = np.sqrt(np.arange(2.0, 2.0 + 19 * count)).reshape(count, 19)
    poses, twists, wrenches = values[:, :7], values[:, 7:13], values[:, 13:]
    stamp = (1_234_567_890, 987_654_321)
    checks: list[tuple[type, Callable[[], bytes], object]] = [
        (
            PoseArray,
            lambda: PoseArrayBytes(frame_id, count).encode(*stamp, poses),
            pose_array(frame_id, *stamp, poses),
        ),
        (
            MultiDOFJointState,
            lambda: StatesBytes(frame_id, names).encode(*stamp, poses, twists, wrenches),
            states(frame_id, names, *stamp, poses, twists, wrenches),
        ),
    ]
    try:
        return all(deserialize_message(make(), kind) == want for kind, make, want in checks)
    except Exception:  # what it raises is the middleware's own affair
        return False


def _stamp(msg: object, frame_id: str, sec: int, nanosec: int) -> None:
    msg.header.frame_id = frame_id
    msg.header.stamp.sec, msg.header.stamp.nanosec = sec, nanosec


def _fill(target: object, parts: str, values: list[float]) -> None:
    for part, value in zip(parts, values, strict=True):
        setattr(target, part, value)
