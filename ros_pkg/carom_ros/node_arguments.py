# SPDX-License-Identifier: Apache-2.0
"""Arguments of carom node. Neither rclpy nor the simulation is imported for help and mistakes."""

import argparse
import json
import sys
from collections.abc import Sequence
from fractions import Fraction
from pathlib import Path

from carom_ros import discovery
from carom_ros.refusal import Refusal

ABOUT = """Runs the ROS 2 node `carom`: messages in, rigid bodies moving, poses out.

Without a scene: gravity and a static plane `ground` at z = 0. Topics, services and parameters are
in msgs_usage/topics.md."""

EXAMPLES = """examples:
  carom node
  carom node scene.yaml --dt 0.002
  carom node --ros-args -p real_time_factor:=2.0 -r __ns:=/w1
  carom node --log run.jsonl     and then     carom node --replay run.jsonl
"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("scene", metavar="SCENE", nargs="?", help="a scene file, or a shipped one")
    parser.add_argument("--dt", type=_step, metavar="S", help="s, simulated time of a step (1/240)")
    parser.add_argument("--paused", action="store_true", help="start paused")
    parser.add_argument("--duration", type=_positive, metavar="S", help="end after S wall seconds")
    parser.add_argument("--quiet", action="store_true", help="no greeting and no progress")
    logs = parser.add_mutually_exclusive_group()
    logs.add_argument("--log", metavar="FILE", help="where requests are logged (ROS's log folder)")
    logs.add_argument("--no-log", action="store_true", help="log no requests")
    logs.add_argument("--replay", metavar="FILE", help="run a log again, without ROS, and end")
    parser.add_argument("--json", action="store_true", help="print the result of --replay as JSON")
    parser.add_argument(
        "--ros-args", nargs=argparse.REMAINDER, metavar="...", help="the rest is for ROS"
    )


def run(args: argparse.Namespace) -> int:
    """Exit code: 0 ended by Ctrl-C, SIGTERM or --duration; 1 replay differs; 2 bad input; 3 no ROS.

    @throws InvalidInput for the scene
    """
    try:
        if args.replay:
            return _replay(args)
        problem = discovery.missing()
        if problem:
            print(f"carom node: {problem}", file=sys.stderr)
            return 3
        discovery.prepare()
        source = _source(args.scene)
        from carom_ros import run as process  # rclpy takes half a second to import

        return process.run(args, source)
    except Refusal as refusal:
        print(f"carom node: {refusal}", file=sys.stderr)
        return 2


def _source(scene: str | None) -> object:
    from carom_ros.journal import SceneSource

    if scene is None:
        return SceneSource()
    from carom.scenes import scene_path

    path = Path(scene_path(scene))
    try:
        return SceneSource(path.read_text(encoding="utf-8"), str(path.resolve().parent))
    except (OSError, UnicodeDecodeError) as error:
        raise Refusal("scene", scene, f"cannot be read: {error}") from None


def _replay(args: argparse.Namespace) -> int:
    from carom_ros.replay import replay

    result = replay(Path(args.replay))
    world = result.world
    if args.json:
        poses = dict(zip(world.names, world.simulation.poses().tolist(), strict=True))
        record = {"schema": 1, "steps": result.steps, "time_s": world.time, "poses": poses}
        print(json.dumps({**record, "state_hash": result.reached, "same": result.same}))
    else:
        verdict = "the same as logged" if result.same else "not the same as logged"
        if not result.expected:
            verdict = "the log has no end to compare with"
        print(f"{result.steps} steps, {world.time:.4f} s, state {result.reached}: {verdict}")
        for name, pose in zip(world.names, world.simulation.poses().tolist(), strict=True):
            print(f"  {name:20} " + " ".join(f"{value:10.4g}" for value in pose))
    return 0 if result.same or not result.expected else 1


def main(argv: Sequence[str] | None = None) -> int:
    """`ros2 run carom_ros node`"""
    parser = argparse.ArgumentParser(
        prog="node",
        description=ABOUT,
        epilog=EXAMPLES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    add_arguments(parser)
    args = parser.parse_args(argv)
    try:
        return run(args)
    except ValueError as error:
        print(f"node: {error}", file=sys.stderr)
        return 2


def _step(text: str) -> float:
    value = _positive(text)
    if not 1e-5 <= value <= 0.1:
        raise argparse.ArgumentTypeError("must be from 1e-5 to 0.1 s")
    return value


def _positive(text: str) -> float:
    try:
        value = float(Fraction(text))
    except (ValueError, ZeroDivisionError, OverflowError):
        value = 0.0
    if not value > 0:
        raise argparse.ArgumentTypeError(f"{text!r} must be a number > 0, as 0.005 or 1/240")
    return value


if __name__ == "__main__":
    sys.exit(main())
