# SPDX-License-Identifier: Apache-2.0
"""ipctk's methods on given queries, in this process alone: its Tight-Inclusion can repeat without
limit, so the study starts this as a child with caps on time and memory.

    python -m carom.studies.ccd_peers queries.npz folder seconds_per_set

Reads one (N, 8, 3) array per set, named "<kind>/<case>"; for each set and method writes an .npz
into the folder as soon as it is done: hit and seconds per query, for as many queries as the seconds
allowed (processor time, like all here). A query below 1 ms is timed three times and the best
counts; one that exhausts the memory counts as given up and, on the safe side, as a hit. One call
per query is all ipctk offers, so the cost of an empty call (four points at rest, far apart) is
measured and written beside the figures.
"""

from __future__ import annotations

import sys
import time
from pathlib import Path

import numpy as np

MEMORY = 2 << 30  # bytes
# Iterations as in its own default, but few enough to end: undecided then counts as a hit.
MAX_ITERATIONS = 10_000
ONE_MORE = 15.0  # s for the query that is under way when the time of a set is over


def methods():
    import ipctk

    ipctk.set_logger_level(ipctk.LoggerLevel.error)
    return {
        "ipctk_tight_inclusion": ipctk.TightInclusionCCD(1e-6, MAX_ITERATIONS, 1.0),
        "ipctk_additive": ipctk.AdditiveCCD(MAX_ITERATIONS, 0.9),
    }


def ask(method, kind, query):
    call = method.point_triangle_ccd if kind == "point_triangle" else method.edge_edge_ccd
    return call(*query)


def empty_call(method, kind) -> float:
    rest = np.array([[0, 0, 5], [0, 0, 0], [1, 0, 0], [0, 1, 0]], float)
    if kind == "edge_edge":
        rest = np.array([[0, 0, 5], [1, 0, 5], [0, 0, 0], [0, 1, 0]], float)
    query = np.concatenate([rest, rest])
    best = np.inf
    for _ in range(1000):  # each by itself, like the queries: the clock's own cost goes with it
        started = time.thread_time()
        ask(method, kind, query)
        best = min(best, time.thread_time() - started)
    return best


def measure(method, kind, queries, seconds) -> dict:
    rows = []
    stop = time.thread_time() + seconds
    for q in queries:
        started = time.thread_time()
        if started > stop:
            break
        gave_up, best = False, np.inf
        for _ in range(3):
            started = time.thread_time()
            try:
                hit = ask(method, kind, q)[0]
            except MemoryError:
                hit = gave_up = True
            best = min(best, time.thread_time() - started)
            if best > 1e-3:
                break
        rows.append((hit, gave_up, best))
    hit, gave_up, each = np.array(rows, float).T
    return {
        "hit": hit.astype(bool),
        "gave_up": int(gave_up.sum()),
        "seconds": each,
        "empty_call": empty_call(method, kind),
    }


def main() -> int:
    source, folder, seconds = sys.argv[1], Path(sys.argv[2]), float(sys.argv[3])
    with np.load(source) as sets:
        if sys.platform != "win32":
            import resource

            resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
            most = int(2 * len(sets.files) * (seconds + ONE_MORE))
            resource.setrlimit(resource.RLIMIT_CPU, (most, most))
        for name in sets.files:
            for label, method in methods().items():
                answers = measure(method, name.split("/")[0], sets[name], seconds)
                file = f"{label}.{name.replace('/', '.')}.npz"
                np.savez(folder / file, label=label, name=name, **answers)
    return 0


if __name__ == "__main__":
    sys.exit(main())
