# SPDX-License-Identifier: Apache-2.0
"""carom topic pub"""

import argparse
import sys
import time
from pathlib import Path

from builtin_interfaces.msg import Time
from rclpy.duration import Duration

from carom_ros import strict_yaml
from carom_ros.refusal import Refusal
from carom_ros.topic import qos
from carom_ros.topic.fill import fill
from carom_ros.topic.graph import graph
from carom_ros.topic.render import plain, to_flow, to_json
from carom_ros.topic.types import message_class

VALUES_CHARACTERS = 50_000_000
ACKNOWLEDGED_S = 5.0


def run(args: argparse.Namespace) -> int:
    kind = message_class(args.message_type)
    values = _values(args)
    fill(kind(), values, Time())  # what is wrong with the values is said before anything starts
    times = 1 if args.once else args.times
    with graph(args.node_name, args.use_sim_time) as g:
        topic = g.topic(args.topic_name)
        publisher = g.node.create_publisher(kind, topic, qos.chosen(args))
        wanted = args.wait_matching_subscriptions
        if wanted is None:
            wanted = 1 if times else 0
        if wanted and not g.wait(lambda: publisher.get_subscription_count() >= wanted, 0.5):
            print(f"waiting for {wanted} subscription(s) of {topic} ...", file=sys.stderr)
            limit = args.max_wait_time_secs
            if not g.wait(lambda: publisher.get_subscription_count() >= wanted, limit):
                raise TimeoutError(f"{topic}: fewer than {wanted} subscription(s) in {limit:g} s")
        if not args.json:
            print("publisher: beginning loop")
        sent, start = 0, time.monotonic()
        while not times or sent < times:
            msg = kind()
            fill(msg, values, g.node.get_clock().now().to_msg())
            publisher.publish(msg)
            sent += 1
            _show(args, msg, sent)
            if times and sent == times:
                break
            _sleep(g, start + sent / args.rate)
        # Reliable data is not gone when publish returns, and leaving would take it along.
        publisher.wait_for_all_acked(Duration(seconds=ACKNOWLEDGED_S))
        if times and args.keep_alive:
            g.wait(lambda: False, args.keep_alive)
    return 0


def _show(args: argparse.Namespace, msg: object, number: int) -> None:
    if (number - 1) % args.print:
        return
    if args.json:
        print(to_json({"number": number, "message": plain(msg)}), flush=True)
    else:
        print(f"publishing #{number}: {to_flow(plain(msg))}\n", flush=True)


def _values(args: argparse.Namespace) -> object:
    given = [bool(args.values), args.stdin, bool(args.yaml_file)]
    if sum(given) > 1:
        raise Refusal("values", "several", "must come from one place")
    text = args.values or ""
    if args.stdin:
        text = sys.stdin.read()
    if args.yaml_file:
        try:
            text = Path(args.yaml_file).read_text(encoding="utf-8")
        except (OSError, ValueError) as error:
            raise Refusal("yaml-file", args.yaml_file, f"cannot be read: {error}") from None
    return strict_yaml.load(text, "values", VALUES_CHARACTERS)


def _sleep(g: object, until: float) -> None:
    while (left := until - time.monotonic()) > 0:
        time.sleep(min(left, 0.5))
