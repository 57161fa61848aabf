# SPDX-License-Identifier: Apache-2.0
"""Arguments of carom topic: those of `ros2 topic`, and --json.

rclpy is not imported here, so that help and mistakes of usage are told at once and without ROS.
"""

import argparse
import importlib
import sys
from collections.abc import Callable, Sequence

from carom_ros import discovery
from carom_ros.refusal import Refusal
from carom_ros.topic import qos_options

EXAMPLES = """examples:
  carom topic list -t
  carom topic echo /carom/poses --once
  carom topic echo /carom/states --field transforms[1].translation.z
  carom topic echo /carom/rejected
  carom topic hz /carom/poses
  carom topic pub --once /carom/spawn visualization_msgs/msg/Marker \\
    '{type: 1, ns: box, id: 1, scale: {x: 0.2, y: 0.2, z: 0.2}, pose: {position: {z: 1.0}}}'
  carom topic pub -r 20 /carom/wrench geometry_msgs/msg/WrenchStamped \\
    '{header: {frame_id: box_1}, wrench: {force: {z: 100.0}}}'
"""


def add_verbs(parser: argparse.ArgumentParser) -> None:
    verbs = parser.add_subparsers(dest="verb", metavar="VERB", required=True)
    for add in (_list, _pub, _echo, _hz):
        add(verbs)


def _verb(verbs: object, name: str, about: str) -> argparse.ArgumentParser:
    verb = verbs.add_parser(
        name,
        help=about,
        description=about,
        epilog=EXAMPLES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    verb.add_argument("--json", action="store_true", help="one line of JSON each")
    verb.add_argument("-s", "--use-sim-time", action="store_true", help="times from /clock")
    return verb


def _list(verbs: object) -> None:
    verb = _verb(verbs, "list", "list topics")
    verb.add_argument("-t", "--show-types", action="store_true", help="with their types")
    verb.add_argument("-c", "--count-topics", action="store_true", help="only how many")
    verb.add_argument("-v", "--verbose", action="store_true", help="publishers and subscribers")
    verb.add_argument(
        "--include-hidden-topics", action="store_true", help="those with _ in front too"
    )
    verb.add_argument("--spin-time", type=positive, metavar="S", help="look for exactly so long")
    verb.set_defaults(verb_module="list")


def _pub(verbs: object) -> None:
    verb = _verb(verbs, "pub", "publish a message")
    verb.add_argument("topic_name", metavar="TOPIC", help="for example /carom/spawn")
    verb.add_argument("message_type", metavar="TYPE", help="for example geometry_msgs/msg/Wrench")
    verb.add_argument("values", metavar="VALUES", nargs="?", help="the fields, as YAML")
    verb.add_argument("--stdin", action="store_true", help="read the values from stdin")
    verb.add_argument("--yaml-file", metavar="FILE", help="read the values from a file")
    verb.add_argument("-r", "--rate", type=positive, default=1.0, metavar="HZ", help="(1)")
    verb.add_argument("-p", "--print", type=natural, default=1, metavar="N", help="show every Nth")
    count = verb.add_mutually_exclusive_group()
    count.add_argument("-1", "--once", action="store_true", help="publish one message and end")
    count.add_argument("-t", "--times", type=natural, default=0, metavar="N", help="N, and end")
    verb.add_argument(
        "-w", "--wait-matching-subscriptions", type=int, metavar="N",
        help="wait for N subscriptions first (1 with --once and --times, else 0)",
    )  # fmt: skip
    verb.add_argument(
        "--max-wait-time-secs", type=positive, metavar="S", help="give up waiting after this"
    )
    verb.add_argument(
        "--keep-alive", type=float, default=0.0, metavar="S", help="stay so long after the last"
    )
    verb.add_argument("-n", "--node-name", default="", metavar="NAME", help="of the publisher")
    verb.set_defaults(verb_module="pub")
    qos_options.add_options(verb, "default")


def _echo(verbs: object) -> None:
    verb = _verb(verbs, "echo", "print messages")
    verb.add_argument("topic_name", metavar="TOPIC", help="for example /carom/poses")
    verb.add_argument("message_type", metavar="TYPE", nargs="?", help="(as published)")
    verb.add_argument("--once", action="store_true", help="print one message and end")
    verb.add_argument("--timeout", type=positive, metavar="S", help="end after this")
    verb.add_argument("--field", metavar="PATH", help="only this part, e.g. poses[0].position")
    verb.add_argument("--filter", metavar="EXPR", help="only where this Python over m is true")
    verb.add_argument("--csv", action="store_true", help="one line of values each")
    verb.add_argument("--flow-style", action="store_true", help="YAML in one line")
    verb.add_argument("-f", "--full-length", action="store_true", help="cut nothing")
    verb.add_argument(
        "-l", "--truncate-length", type=natural, default=128, metavar="N", help="cut after (128)"
    )
    verb.add_argument("--no-arr", action="store_true", help="leave out arrays")
    verb.add_argument("--no-str", action="store_true", help="leave out texts")
    verb.add_argument("--raw", action="store_true", help="the bytes as they came")
    verb.add_argument("--include-message-info", action="store_true", help="times of transport too")
    verb.add_argument("--clear", action="store_true", help="clear the terminal before each")
    verb.set_defaults(verb_module="echo")
    qos_options.add_options(verb, "sensor_data")


def _hz(verbs: object) -> None:
    verb = _verb(verbs, "hz", "measure how often messages come")
    verb.add_argument("topic_name", metavar="TOPIC", nargs="+")
    verb.add_argument(
        "-w", "--window", type=natural, default=10_000, metavar="N", help="over the last N"
    )
    verb.add_argument("--wall-time", action="store_true", help="never the time of /clock")
    verb.add_argument("--every", type=positive, default=1.0, metavar="S", help="print every (1)")
    verb.add_argument("--timeout", type=positive, metavar="S", help="end after this")
    verb.set_defaults(verb_module="hz")
    qos_options.add_options(verb, "sensor_data")


def run(args: argparse.Namespace) -> int:
    """Exit code of one verb: 0 ok, 1 nothing came, 2 bad usage, 3 no ROS, 130 interrupted."""
    problem = discovery.missing()
    if problem:
        print(f"carom topic: {problem}", file=sys.stderr)
        return 3
    discovery.prepare()
    try:
        return verb_function(args.verb_module)(args)
    except Refusal as refusal:
        print(f"carom topic {args.verb_module}: {refusal}", file=sys.stderr)
        return 2
    except TimeoutError as error:
        print(f"carom topic {args.verb_module}: {error}", file=sys.stderr)
        return 1
    except BrokenPipeError:  # the reader, such as head, has had enough
        sys.stdout = None
        return 0
    except KeyboardInterrupt:
        return 130


def verb_function(name: str) -> Callable[[argparse.Namespace], int]:
    return importlib.import_module(f"carom_ros.topic.{name}").run


def positive(text: str) -> float:
    value = float(text)
    if not 0 < value < float("inf"):
        raise argparse.ArgumentTypeError("must be > 0")
    return value


def natural(text: str) -> int:
    value = int(text)
    if value < 1:
        raise argparse.ArgumentTypeError("must be at least 1")
    return value


def main(argv: Sequence[str] | None = None) -> int:
    """`ros2 run carom_ros topic`"""
    parser = argparse.ArgumentParser(
        prog="topic", epilog=EXAMPLES, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    add_verbs(parser)
    return run(parser.parse_args(argv))


if __name__ == "__main__":
    sys.exit(main())
