# SPDX-License-Identifier: Apache-2.0
"""carom topic echo"""

import argparse
import sys
import time

from carom_ros.refusal import Refusal
from carom_ros.topic import qos
from carom_ros.topic.graph import graph
from carom_ros.topic.render import pick, plain, shorten, to_csv, to_flow, to_json, to_yaml
from carom_ros.topic.types import message_class


def run(args: argparse.Namespace) -> int:
    keep = _filter(args.filter)
    with graph(use_sim_time=args.use_sim_time) as g:
        topic = g.topic(args.topic_name)
        kind = message_class(args.message_type or g.type_of(topic, args.timeout))
        if args.field:
            pick_from_type(kind, args.field)
        seen = [0]

        def show(msg: object, info: dict) -> None:
            if args.once and seen[0]:
                return
            if not args.raw and keep is not None and not keep(msg):
                return
            seen[0] += 1
            print(_text(args, msg, info), flush=True)

        # Nothing comes before there is a publisher, and whether it is latched must be known first.
        if not g.wait(lambda: bool(g.node.count_publishers(topic)), args.timeout):
            raise TimeoutError(f"{topic} is not published")
        publishers = g.node.get_publishers_info_by_topic(topic)
        profile = qos.matching(args, publishers)
        g.node.create_subscription(kind, topic, show, profile, raw=args.raw)
        end = None if args.timeout is None else time.monotonic() + args.timeout
        while not (args.once and seen[0]):
            if end is not None and time.monotonic() > end:
                if seen[0]:
                    return 0
                raise TimeoutError(f"{topic}: no message in {args.timeout:g} s")
            g.spin(0.1)
    return 0


def pick_from_type(kind: type, path: str) -> None:
    """Refuses a path whose first name is no field, before any message has come."""
    name = path.split(".")[0].split("[")[0]
    known = kind.get_fields_and_field_types()
    if name not in known:
        pick(kind(), name)


def _filter(expression: str | None) -> object:
    """The user's own Python expression over `m`, as in `ros2 topic echo --filter`."""
    if expression is None:
        return None
    try:
        code = compile(expression, "<filter>", "eval")
    except SyntaxError as error:
        raise Refusal("filter", expression, f"is not an expression: {error.msg}") from None

    def keep(msg: object) -> bool:
        try:
            return bool(eval(code, {"m": msg}))
        except Exception as error:
            raise Refusal("filter", expression, f"failed: {error}") from None

    return keep


def _text(args: argparse.Namespace, msg: object, info: dict) -> str:
    if args.raw:
        return f"{msg!r}\n---"
    part = pick(msg, args.field) if args.field else msg
    value = plain(part)
    if args.json:
        return to_json(value)
    length = None if args.full_length or args.csv else args.truncate_length
    value = shorten(value, length, arrays=not args.no_arr, texts=not args.no_str)
    if args.csv:
        return to_csv(value)
    lines = [to_flow(value)] if args.flow_style else list(to_yaml(value))
    if args.include_message_info:
        lines[:0] = [f"{key}: {item}" for key, item in info.items()]
    if args.clear and sys.stdout.isatty():
        lines[:0] = ["\x1b[2J\x1b[H"]
    return "\n".join([*lines, "---"])
