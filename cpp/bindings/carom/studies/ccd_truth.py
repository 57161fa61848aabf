# SPDX-License-Identifier: Apache-2.0
"""Compares carom.ccd with exact arithmetic; the full set is one command.

    python -m carom.studies.ccd_truth --queries 200000 --seed 20261122 --summary ccd_truth.json

Prints the seed; exits 1 on any disagreement.
"""

from __future__ import annotations

import argparse
import json
import sys
import time
from collections import Counter
from datetime import datetime, timezone
from pathlib import Path

import numpy as np

from carom import ccd
from carom.studies.ccd_exact import first_contact
from carom.studies.ccd_queries import CATEGORIES, generate

KINDS = ("point_triangle", "edge_edge")
# What the library promises: never late, and within 1e-9 of the step (tolerance::contact_time).
EARLY = 1e-9


def compare(kind: str, queries: np.ndarray) -> Counter:
    """Counts of queries, contacts, misses, false alarms, times late or too early, and statuses."""
    answer = getattr(ccd, kind)(queries)
    counts = Counter(queries=len(queries))
    for q, hit, when, status in zip(queries, answer.hit, answer.time, answer.status, strict=True):
        counts[ccd.Status(int(status)).name] += 1
        truth = first_contact(kind, q)
        if truth is None:
            counts["false_alarms"] += bool(hit)
            counts["time_not_one_without_hit"] += int(not hit and when != 1.0)
            continue
        counts["contacts"] += 1
        if not hit:
            counts["misses"] += 1
        else:
            counts["late"] += truth.minus(float(when)) < 0
            low, _ = truth.narrower_than(34)  # 6e-11
            counts["too_early"] += int(float(low) - when > EARLY)
    return counts


WRONG = ("misses", "false_alarms", "late", "too_early", "time_not_one_without_hit")


def run(total: int, seed: int, report=print) -> dict[str, dict[str, int]]:
    """Half of `total` on random queries and half on the other categories, both kinds."""
    rng = np.random.default_rng(seed)
    rows = {}
    hard = [c for c in CATEGORIES if c != "random"]
    for kind in KINDS:
        for category in CATEGORIES:
            share = total // 4 if category == "random" else total // (4 * len(hard)) + 1
            counts = compare(kind, generate(kind, category, share, rng))
            rows[f"{kind}/{category}"] = dict(sorted(counts.items()))
            report(f"{kind:15s} {category:16s} {rows[f'{kind}/{category}']}")
    return rows


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--queries", type=int, default=200_000)
    parser.add_argument("--seed", type=int, default=20261122)
    parser.add_argument("--summary", type=Path)
    options = parser.parse_args()
    print(f"seed {options.seed}")
    started = time.perf_counter()
    rows = run(options.queries, options.seed)
    total = sum((Counter(r) for r in rows.values()), Counter())
    wrong = sum(total[w] for w in WRONG)
    print(dict(total))
    print(f"{wrong} disagreements, {time.perf_counter() - started:.0f} s")
    if options.summary:
        summary = {
            "command": f"python -m carom.studies.ccd_truth --queries {options.queries} "
            f"--seed {options.seed}",
            "seed": options.seed,
            "date": datetime.now(timezone.utc).date().isoformat(),
            "total": {**dict.fromkeys(WRONG, 0), **total},
            "categories": rows,
        }
        options.summary.write_text(json.dumps(summary, indent=1) + "\n")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
