# SPDX-License-Identifier: Apache-2.0
"""The commands `carom node` and `carom topic`, found by carom's entry-point group."""

import argparse

from carom_ros import node_arguments
from carom_ros.topic import arguments as topic_arguments


def add_node_command(commands: object) -> None:
    parser = commands.add_parser(
        "node",
        help="run the ROS 2 node",
        description=node_arguments.ABOUT,
        epilog=node_arguments.EXAMPLES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    node_arguments.add_arguments(parser)
    parser.set_defaults(run=node_arguments.run)


def add_topic_command(commands: object) -> None:
    about = "The verbs of `ros2 topic`, for people whose ROS came as wheels."
    parser = commands.add_parser(
        "topic",
        help="list, publish, print and measure topics",
        description=about,
        epilog=topic_arguments.EXAMPLES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    topic_arguments.add_verbs(parser)
    parser.set_defaults(run=topic_arguments.run)
