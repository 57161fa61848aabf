# SPDX-License-Identifier: Apache-2.0
"""carom topic list"""

import argparse

from carom_ros.topic.graph import graph
from carom_ros.topic.render import to_json


def run(args: argparse.Namespace) -> int:
    with graph() as g:
        g.settle(args.spin_time)
        rows = []
        for name, kinds in g.node.get_topic_names_and_types():
            hidden = any(part.startswith("_") for part in name.split("/"))
            if hidden and not args.include_hidden_topics:
                continue
            count = (g.node.count_publishers(name), g.node.count_subscribers(name))
            rows.append({"name": name, "types": kinds, "publishers": count[0],
                         "subscribers": count[1]})  # fmt: skip
    if args.count_topics:
        print(len(rows))
    elif args.json:
        print(to_json({"schema": 1, "topics": rows}))
    elif args.verbose:
        _verbose(rows)
    else:
        for row in rows:
            print(row["name"] + (f" [{', '.join(row['types'])}]" if args.show_types else ""))
    return 0


def _verbose(rows: list[dict]) -> None:
    for title, key in (("Published", "publishers"), ("Subscribed", "subscribers")):
        print(f"{title} topics:")
        for row in rows:
            if row[key]:
                print(f" * {row['name']} [{', '.join(row['types'])}] {row[key]} {key}")
        print()
