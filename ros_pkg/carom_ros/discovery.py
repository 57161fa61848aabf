# SPDX-License-Identifier: Apache-2.0
"""Middleware settings that must be in the environment before rclpy starts."""

import importlib.util
import os
from pathlib import Path

PROFILE = Path(__file__).parent / "fast_discovery.xml"

INSTALL_ROS = "pip install 'carom[ros]', or source a ROS 2 Jazzy installation"


def prepare() -> None:
    """Announces a new process quickly, unless the user has a profile of their own.

    A process that joins late is otherwise found after up to 3 s, the period of Fast DDS's
    announcements; until then its messages are not seen, which looks like loss.
    """
    chosen = ("FASTRTPS_DEFAULT_PROFILES_FILE", "FASTDDS_DEFAULT_PROFILES_FILE")
    if not any(os.environ.get(name) for name in chosen):
        for name in chosen:
            os.environ[name] = str(PROFILE)


def missing() -> str:
    """Why ROS cannot be used here, with the remedy; empty when it can.

    A middleware that is not installed ends the process inside rclpy.init, with no exception, so it
    is looked for beforehand where its packages are Python wheels.
    """
    if importlib.util.find_spec("rclpy") is None:
        return f"rclpy is not installed: {INSTALL_ROS}"
    for package in ("geometry_msgs", "visualization_msgs", "sensor_msgs", "nav_msgs"):
        if importlib.util.find_spec(package) is None:
            return f"the message package {package} is not installed: {INSTALL_ROS}"
    wanted = os.environ.get("RMW_IMPLEMENTATION", "")
    in_wheels = importlib.util.find_spec("rmw_fastrtps_cpp") is not None
    sourced = os.environ.get("AMENT_PREFIX_PATH")
    if wanted and in_wheels and not sourced and wanted != "rmw_fastrtps_cpp":
        return f"RMW_IMPLEMENTATION={wanted} is not installed: unset it, or use rmw_fastrtps_cpp"
    return ""
