# SPDX-License-Identifier: Apache-2.0
"""Owns the process of the node: signals, the thread of the executor, the ticks."""

import argparse
import gc
import os
import shutil
import signal
import sys
import threading
import time
from pathlib import Path

import rclpy
from rclpy.exceptions import ParameterException
from rclpy.executors import SingleThreadedExecutor
from rclpy.signals import SignalHandlerOptions

import carom
from carom_ros.journal import SceneSource
from carom_ros.node import SimulationNode
from carom_ros.progress import Progress, prepare_log_lines
from carom_ros.refusal import Refusal
from carom_ros.replay import scene_of

SLICE_S = 0.05
"""Longest sleep, so that a signal is answered soon."""


FAILURES = 10
"""Ticks in a row that may fail before the node gives up."""


class Stop:
    """Set by signals. A plain flag: a threading.Event may be held by the very code the signal
    interrupts."""

    def __init__(self) -> None:
        self.asked = False
        for number in (signal.SIGINT, signal.SIGTERM):
            signal.signal(number, self._ask)

    def _ask(self, *_: object) -> None:
        self.asked = True


def run(args: argparse.Namespace, source: SceneSource) -> int:
    """Runs until a signal or the end of --duration: exit code 0. @throws InvalidInput"""
    scene = scene_of(source)  # what is wrong with the scene is said before ROS starts
    stop = Stop()
    prepare_log_lines()
    context = rclpy.Context()
    log = None if args.no_log else Path(args.log) if args.log else default_log()
    try:
        node = _start(args, context, scene, source, log)
    except (RuntimeError, ParameterException, OSError) as error:  # rclpy's own are of these kinds
        rclpy.try_shutdown(context=context)
        remedy = "write 50.0 for 50" if "DOUBLE" in str(error) else ""
        raise Refusal("start", "the node", f"cannot start: {error}", remedy) from None
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(node)
    thread = threading.Thread(target=_spin, args=(executor, node, stop), name="executor")
    thread.start()
    progress = Progress(node, quiet=args.quiet)
    try:
        if not args.quiet:
            _greet(node, args, log)
        gc.collect()
        gc.freeze()  # what lives as long as the node need not be looked at in every collection
        sys.setswitchinterval(0.001)  # a tick waits this long at most for a callback's bytecode
        _tick(node, stop, progress, args.duration)
    finally:
        stop.asked = True
        thread.join()
        progress.end()
        node.close()
        executor.shutdown()
        node.destroy_node()
        rclpy.try_shutdown(context=context)
    return 0


def _start(
    args: argparse.Namespace,
    context: rclpy.Context,
    scene: carom.Scene,
    source: SceneSource,
    log: Path | None,
) -> SimulationNode:
    # rclpy's own handlers make the context invalid in the middle of a callback.
    ros_args = ["--ros-args", *args.ros_args] if args.ros_args else []
    rclpy.init(args=ros_args, context=context, signal_handler_options=SignalHandlerOptions.NO)
    overrides: dict[str, object] = {"paused": args.paused}
    if args.dt is not None:
        overrides["dt_s"] = args.dt
    return SimulationNode(scene, source=source, log=log, overrides=overrides, context=context)


def _tick(node: SimulationNode, stop: Stop, progress: Progress, duration: float | None) -> None:
    begin = last = due = time.monotonic()
    failures = 0
    while not stop.asked and (duration is None or last - begin < duration):
        due += node.period
        while not stop.asked and (left := due - time.monotonic()) > 0:
            time.sleep(min(left, SLICE_S))
        now = time.monotonic()
        try:
            node.tick(now - last)
            failures = 0
        except Exception as error:  # not the readers' loss, unless it stays
            failures += 1
            if failures >= FAILURES:
                raise
            node.get_logger().error(f"a tick failed: {error!r}", throttle_duration_sec=1.0)
        progress.show(now)
        last, due = now, max(due, now)


def _spin(executor: SingleThreadedExecutor, node: SimulationNode, stop: Stop) -> None:
    while not stop.asked and executor.context.ok():
        try:
            executor.spin_once(timeout_sec=2 * SLICE_S)
        except Exception as error:  # such as a subscription destroyed while it was being read
            node.get_logger().warning(f"a callback failed: {error!r}", throttle_duration_sec=1.0)
            time.sleep(0.001)


def default_log() -> Path:
    """Beside ROS's own logs."""
    home = Path(os.environ.get("ROS_HOME") or Path.home() / ".ros")
    folder = Path(os.environ.get("ROS_LOG_DIR") or home / "log")
    return folder / f"carom-{time.strftime('%Y%m%d-%H%M%S')}-{os.getpid()}.jsonl"


def _greet(node: SimulationNode, args: argparse.Namespace, log: Path | None) -> None:
    topic, world = f"{node.get_fully_qualified_name()}", node.world
    moving = sum(not known.static for known in world.bodies.values())
    lines = [
        f"carom {carom.__version__}: {len(world.names)} bodies, {moving} can move, "
        f"step {1e3 * world.dt:.4g} ms, scene {args.scene or 'of a ground plane alone'}",
        f"  see it    carom topic echo {topic}/poses --field poses --once",
    ]
    layout = rviz_layout()
    if shutil.which("rviz2") and layout:
        lines.append(f"            rviz2 -d {layout}")
    box = "{type: 1, ns: box, id: 1, scale: {x: 0.2, y: 0.2, z: 0.2}, pose: {position: {z: 1.0}}}"
    kind = "visualization_msgs/msg/Marker"
    lines.append(f"  drop one  carom topic pub --once {topic}/spawn {kind} '{box}'")
    if log is not None:
        lines.append(f"  replay    carom node --replay {log}")
    lines.append("  end       Ctrl-C")
    print("\n".join(lines), file=sys.stderr, flush=True)


def rviz_layout() -> Path | None:
    """The RViz layout of an installed carom_ros, or of a checkout."""
    here = Path(__file__).resolve().parent
    prefixes = [Path(p) for p in os.environ.get("AMENT_PREFIX_PATH", "").split(os.pathsep) if p]
    candidates = [prefix / "share" / "carom_ros" / "rviz" / "carom.rviz" for prefix in prefixes]
    candidates.append(here.parent / "rviz" / "carom.rviz")
    return next((path for path in candidates if path.is_file()), None)
