# SPDX-License-Identifier: Apache-2.0
"""Wrench, impulse and state messages as requests."""

from carom_ros import checks, limits
from carom_ros.marker import require_world
from carom_ros.refusal import Refusal
from carom_ros.requests import Impulse, SetState, Wrench


def body_and_frame(frame_id: str) -> tuple[str, str]:
    """`body` or `body/frame`, as header.frame_id names where a wrench acts. @throws Refusal"""
    if not frame_id:
        remedy = "header: {frame_id: crate}"
        raise Refusal("header.frame_id", "empty", "must name the body", remedy)
    body, _, frame = frame_id.partition("/")
    checks.body_name(body, "header.frame_id")
    if frame or frame_id.endswith("/"):
        checks.body_name(frame, "header.frame_id")
    return body, frame


def stamped_wrench(msg: object, source: str, hold: float) -> Wrench:
    body, frame = body_and_frame(msg.header.frame_id)
    force, torque = _pair(msg.wrench, "wrench.", "N", "N m")
    return Wrench(source, body, force, torque, frame, in_body_axes=True, hold=hold)


def stamped_impulse(msg: object, source: str) -> Impulse:
    body, frame = body_and_frame(msg.header.frame_id)
    force, torque = _pair(msg.wrench, "wrench.", "N s", "N m s")
    return Impulse(source, body, force, torque, frame, in_body_axes=True)


def world_wrench(msg: object, body: str, source: str, hold: float) -> Wrench:
    return Wrench(source, body, *_pair(msg, "", "N", "N m"), in_body_axes=False, hold=hold)


def world_impulse(msg: object, body: str, source: str) -> Impulse:
    return Impulse(source, body, *_pair(msg, "", "N s", "N m s"), in_body_axes=False)


def state(msg: object, source: str, world_frame: str) -> SetState:
    """nav_msgs/Odometry; covariances are not looked at."""
    require_world(msg.header.frame_id, world_frame)
    pose, twist = msg.pose.pose, msg.twist.twist
    linear = checks.vector(twist.linear, "twist.twist.linear", limits.SPEED_M_S, "m/s")
    angular = checks.vector(twist.angular, "twist.twist.angular", limits.SPIN_RAD_S, "rad/s")
    return SetState(
        source=source,
        body=checks.body_name(msg.child_frame_id, "child_frame_id"),
        position=checks.vector(pose.position, "pose.pose.position", limits.COORDINATE_M, "m"),
        orientation=checks.orientation(pose.orientation, "pose.pose.orientation"),
        velocity=linear,
        angular_velocity=angular,
    )


def _pair(wrench: object, prefix: str, force_unit: str, torque_unit: str) -> tuple:
    return (
        checks.vector(wrench.force, f"{prefix}force", limits.WRENCH, force_unit),
        checks.vector(wrench.torque, f"{prefix}torque", limits.WRENCH, torque_unit),
    )
