# SPDX-License-Identifier: Apache-2.0
"""Qualities of service of the node's topics.

Everything is published reliable, which serves reliable and best-effort readers alike. Commands are
kept deep: a burst of 1000 spawns sent at once must all arrive, and a queue keeps only its last.
"""

from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy

COMMANDS = QoSProfile(depth=1000, reliability=ReliabilityPolicy.RELIABLE)
STREAM = QoSProfile(depth=10, reliability=ReliabilityPolicy.RELIABLE)
CLOCK = QoSProfile(depth=1, reliability=ReliabilityPolicy.RELIABLE)


def latched(depth: int) -> QoSProfile:
    """For late joiners: the last `depth` messages."""
    return QoSProfile(
        depth=depth,
        reliability=ReliabilityPolicy.RELIABLE,
        durability=DurabilityPolicy.TRANSIENT_LOCAL,
    )
