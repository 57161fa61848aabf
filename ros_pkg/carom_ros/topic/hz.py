# SPDX-License-Identifier: Apache-2.0
"""carom topic hz"""

import argparse
import itertools
import math
import sys
import time
from collections import deque

from carom_ros.topic import qos
from carom_ros.topic.graph import graph
from carom_ros.topic.render import to_json
from carom_ros.topic.types import message_class


class Rate:
    """Arrival times of the last `window` messages."""

    def __init__(self, window: int) -> None:
        self._times: deque[float] = deque(maxlen=window)
        self.count = 0

    def add(self, seconds: float) -> None:
        self._times.append(seconds)
        self.count += 1

    def figures(self) -> dict[str, float] | None:
        """rate_hz, min_s, max_s and std_dev_s of the gaps, window; None for fewer than 2."""
        times = list(self._times)
        gaps = [b - a for a, b in itertools.pairwise(times)]
        total = math.fsum(gaps)
        if not gaps or total <= 0:
            return None
        mean = total / len(gaps)
        variance = math.fsum((gap - mean) ** 2 for gap in gaps) / len(gaps)
        return {
            "rate_hz": 1 / mean,
            "min_s": min(gaps),
            "max_s": max(gaps),
            "std_dev_s": math.sqrt(variance),
            "window": len(times),
        }


def run(args: argparse.Namespace) -> int:
    with graph(use_sim_time=args.use_sim_time and not args.wall_time) as g:
        topics = [g.topic(name) for name in args.topic_name]
        rates = {topic: Rate(args.window) for topic in topics}
        simulated = args.use_sim_time and not args.wall_time

        def clock() -> float:
            return g.node.get_clock().now().nanoseconds * 1e-9 if simulated else time.monotonic()

        for topic in topics:
            kind = message_class(g.type_of(topic, args.timeout))
            profile = qos.matching(args, g.node.get_publishers_info_by_topic(topic))
            # Raw: counting needs no message objects, which cost more than their delivery.
            g.node.create_subscription(
                kind, topic, lambda _, rate=rates[topic]: rate.add(clock()), profile, raw=True
            )
        end = None if args.timeout is None else time.monotonic() + args.timeout
        shown, counts = time.monotonic(), dict.fromkeys(topics, 0)
        while end is None or time.monotonic() < end:
            g.spin(0.05)
            if time.monotonic() - shown < args.every:
                continue
            shown = time.monotonic()
            for topic, rate in rates.items():
                _show(args, topic, rate, rate.count > counts[topic])
                counts[topic] = rate.count
    return 0 if all(rate.count for rate in rates.values()) else 1


def _show(args: argparse.Namespace, topic: str, rate: Rate, fresh: bool) -> None:
    figures = rate.figures()
    if figures is None or not fresh:
        print(f"{topic}: no new messages", file=sys.stderr, flush=True)
    elif args.json:
        print(to_json({"topic": topic, **figures}), flush=True)
    else:
        where = f"{topic}: " if len(args.topic_name) > 1 else ""
        print(
            f"{where}average rate: {figures['rate_hz']:.3f}\n\tmin: {figures['min_s']:.3f}s "
            f"max: {figures['max_s']:.3f}s std dev: {figures['std_dev_s']:.5f}s "
            f"window: {figures['window']}",
            flush=True,
        )
