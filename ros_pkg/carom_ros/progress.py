# SPDX-License-Identifier: Apache-2.0
"""What a person in front of the node sees: a live line on a terminal, plain lines elsewhere."""

import os
import sys
import time

import numpy as np

from carom_ros.node import SimulationNode

LIVE_S, PLAIN_S = 0.25, 10.0


def prepare_log_lines() -> None:
    """Lets log lines wipe the live line. Before rclpy starts."""
    if sys.stderr.isatty():
        name = "RCUTILS_CONSOLE_OUTPUT_FORMAT"
        os.environ.setdefault(name, "\r\x1b[2K[{severity}] [{time}] [{name}]: {message}")


class Progress:
    def __init__(self, node: SimulationNode, *, quiet: bool) -> None:
        self._node, self._quiet = node, quiet
        self._live = sys.stderr.isatty()
        self._next = time.monotonic()

    def show(self, now: float) -> None:
        if self._quiet or now < self._next:
            return
        self._next = now + (LIVE_S if self._live else PLAIN_S)
        if not self._live:
            print(summary(self._node), file=sys.stderr, flush=True)
            return
        width = os.get_terminal_size(sys.stderr.fileno()).columns
        line = summary(self._node)[: max(width - 1, 1)]
        print(f"\r\x1b[2K{line}", end="", file=sys.stderr, flush=True)

    def end(self) -> None:
        if self._quiet:
            return
        wipe = "\r\x1b[2K" if self._live else ""
        print(f"{wipe}{summary(self._node)}  ended", file=sys.stderr, flush=True)


def summary(node: SimulationNode) -> str:
    """Time, speed and what moves most, in one line."""
    world = node.world
    moving = [row for row, name in enumerate(world.names) if not world.bodies[name].static]
    factor = "paused" if node.paused else f"x{node.pace.factor:.2f}"
    parts = [
        f"t {world.time:.2f} s {factor}",
        f"{len(world.names)} bodies, {len(moving)} can move",
        f"{world.simulation.report.contact.points} contacts",
        f"{node.outputs.rejected_count} refused",
    ]
    if moving:
        speeds = np.linalg.norm(world.simulation.twists()[moving, :3], axis=1)
        fastest = moving[int(np.argmax(speeds))]
        x, y, z = world.simulation.poses()[fastest, :3]
        where = f"at {x:.3f} {y:.3f} {z:.3f} m"
        parts.append(f"{world.names[fastest]} {where}, {speeds.max():.2f} m/s")
    return "  |  ".join(parts)
