# SPDX-License-Identifier: Apache-2.0
"""The --qos-* options of `ros2 topic`, without importing rclpy."""

import argparse

PROFILES = ("system_default", "default", "sensor_data", "services_default", "parameters",
            "best_available")  # fmt: skip


def add_options(parser: argparse.ArgumentParser, default: str) -> None:
    group = parser.add_argument_group("quality of service")
    group.add_argument("--qos-profile", choices=PROFILES, help=f"profile to start from ({default})")
    group.add_argument("--qos-depth", type=_natural, metavar="N", help="messages kept")
    group.add_argument("--qos-history", choices=("keep_last", "keep_all", "system_default"))
    group.add_argument(
        "--qos-reliability",
        choices=("reliable", "best_effort", "system_default", "best_available"),
    )
    group.add_argument(
        "--qos-durability",
        choices=("transient_local", "volatile", "system_default", "best_available"),
    )
    group.add_argument(
        "--qos-liveliness", choices=("automatic", "manual_by_topic", "system_default")
    )
    group.add_argument("--qos-liveliness-lease-duration-seconds", type=float, metavar="S")
    parser.set_defaults(qos_default=default)


def _natural(text: str) -> int:
    value = int(text)
    if value < 0:
        raise argparse.ArgumentTypeError("must be >= 0")
    return value
