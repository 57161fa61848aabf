# SPDX-License-Identifier: Apache-2.0
"""Continuous collision: wrong answers and time of every method, on random and on hard queries.

Truth is exact integer arithmetic (ccd_exact), a route of its own. Times are those of the processor,
one thread, so that a busy machine shows little; means per query over queries whose swept boxes
overlap, best of several passes for ours. Ours answers a batch
in one call and, for the slowest single query, one call each; ipctk answers one query a call, so the
cost of its empty call is subtracted and shown.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
import time
from importlib.util import find_spec
from pathlib import Path

import numpy as np

from carom import ccd
from carom.studies import ccd_peers
from carom.studies.ccd_exact import first_contact
from carom.studies.ccd_queries import CATEGORIES, generate

KINDS = ("point_triangle", "edge_edge")
OURS = {"certified": "carom", "lecture": "lecture_cubic", "tolerance": "float_tolerance_1e-6"}
SEED = 20261122


def boxes_overlap(kind: str, q: np.ndarray) -> np.ndarray:
    split = 1 if kind == "point_triangle" else 2

    def box(rows):
        both = np.concatenate([q[:, rows], q[:, [4 + r for r in rows]]], axis=1)
        return both.min(axis=1), both.max(axis=1)

    low_a, high_a = box(list(range(split)))
    low_b, high_b = box(list(range(split, 4)))
    return ((low_a <= high_b) & (low_b <= high_a)).all(axis=1)


def query_sets(random: int, hard: int, seed: int) -> dict[str, np.ndarray]:
    """ "<kind>/random" and "<kind>/hard": boxes overlapping; hard is `hard` of each category."""
    rng = np.random.default_rng(seed)
    sets = {}
    for kind in KINDS:
        easy = generate(kind, "random", 3 * random, rng)
        sets[f"{kind}/random"] = easy[boxes_overlap(kind, easy)][:random]
        parts = []
        for category in CATEGORIES:
            if category != "random":
                q = generate(kind, category, 4 * hard, rng)
                parts.append(q[boxes_overlap(kind, q)][:hard])
        # interleaved, so that a method stopped by its time cap has seen all kinds
        sets[f"{kind}/hard"] = np.concatenate(parts)[rng.permutation(sum(map(len, parts)))]
    return sets


def best_seconds(call, repeats=7) -> float:
    best = np.inf
    for _ in range(repeats):
        started = time.thread_time()
        call()
        best = min(best, time.thread_time() - started)
    return best


def slowest_query(ask, queries, empty: float) -> float:
    """Seconds of the slowest single query, best of 5 each, less an empty call."""
    return max(0.0, max(best_seconds(lambda q=q: ask(q[None]), 5) for q in queries) - empty)


def row(name, method, hit, truth, seconds, **more):
    n = len(hit)
    misses = int((truth[:n] & ~hit).sum())
    false_alarms = int((~truth[:n] & hit).sum())
    return {
        "study": "ccd",
        "case": name,
        "method": method,
        "queries": n,
        "contacts": int(truth[:n].sum()),
        "misses": misses,
        "false_alarms": false_alarms,
        "error": (misses + false_alarms) / max(n, 1),
        "error_unit": "wrong answers per query",
        "seconds": seconds,
        "seconds_of": "one query",
        **more,
    }


def our_rows(name: str, queries: np.ndarray, truth: np.ndarray) -> list[dict]:
    ask = getattr(ccd, name.split("/")[0])
    rows = []
    for method, label in OURS.items():
        empty = best_seconds(lambda m=method: ask(queries[:0], method=m))
        whole = best_seconds(lambda m=method: ask(queries, method=m))
        answer = ask(queries, method=method)
        more = {"empty_call_seconds": empty}
        if method == "certified":
            more["slowest_query_seconds"] = slowest_query(ask, queries[:2000], empty)
            status = np.bincount(answer.status, minlength=4) / len(queries)
            more["decided_in_doubles"] = float(status[int(ccd.Status.certified)])
        rows.append(row(name, label, answer.hit, truth, (whole - empty) / len(queries), **more))
    return rows


def peer_rows(sets, truth, seconds: float) -> list[dict]:
    """ipctk's rows, of the sets its child finished; none when it is not installed."""
    if find_spec("ipctk") is None:
        return []
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        np.savez(folder / "queries.npz", **sets)
        command = [sys.executable, "-m", "carom.studies.ccd_peers"]
        command += [folder / "queries.npz", folder, str(seconds)]
        rows = []
        try:
            # The child limits its own processor time; this is for one that no longer gets any.
            limit = 20 * len(sets) * (seconds + ccd_peers.ONE_MORE)
            subprocess.run(command, check=True, timeout=limit, capture_output=True)
        except (subprocess.SubprocessError, OSError) as problem:
            rows.append({"study": "ccd", "method": "ipctk", "case": "all", "note": str(problem)})
        for file in sorted(folder.glob("ipctk*.npz")):
            with np.load(file) as found:
                empty, each = float(found["empty_call"]), found["seconds"]
                rows.append(
                    row(
                        str(found["name"]),
                        str(found["label"]),
                        found["hit"],
                        truth[str(found["name"])],
                        float(each.mean()) - empty,
                        empty_call_seconds=empty,
                        slowest_query_seconds=float(each.max()) - empty,
                        gave_up=int(found["gave_up"]),
                    )
                )
        return rows


def run(
    progress=None,
    *,
    random: int = 2000,
    hard: int = 100,
    peer_seconds: float = 10.0,
    seed: int = SEED,
) -> list[dict]:
    """Rows: study, case, method, queries, contacts, misses, false_alarms, error, seconds, ..."""
    say = progress or (lambda _text: None)
    sets = query_sets(random, hard, seed)
    truth, rows = {}, []
    for name, queries in sets.items():
        say(f"exact truth of {len(queries)} queries, {name}")
        kind = name.split("/")[0]
        truth[name] = np.array([first_contact(kind, q) is not None for q in queries])
        say(f"our methods, {name}")
        rows += our_rows(name, queries, truth[name])
    say("ipctk, in a child process")
    rows += peer_rows(sets, truth, peer_seconds)
    mine = {r["case"]: r["seconds"] for r in rows if r["method"] == OURS["certified"]}
    for r in rows:
        if "seconds" in r:
            r["seconds_relative_to_carom"] = r["seconds"] / mine[r["case"]]
    return rows


def _cases(rows) -> list[str]:
    return list(dict.fromkeys(r["case"] for r in rows))


def plot(rows, path) -> None:
    """Wrong answers against time per query: one panel for random queries, one for hard ones. A
    method that ran out of its time says how many queries it got through."""
    import matplotlib as mpl

    mpl.use("Agg")
    from matplotlib import pyplot as plt

    rows = [r for r in rows if "seconds" in r]
    methods = sorted({r["method"] for r in rows}, key=lambda m: (m != OURS["certified"], m))
    markers = dict(zip(KINDS, "o^", strict=True))
    figure, panels = plt.subplots(1, 2, figsize=(11, 4.6), sharey=True, layout="constrained")
    floor = 3e-5
    asked = {case: max(r["queries"] for r in rows if r["case"] == case) for case in _cases(rows)}
    for panel, case in zip(panels, ("random", "hard"), strict=True):
        for colour, method in enumerate(methods):
            for r in rows:
                kind, of = r["case"].split("/")
                if of != case or r["method"] != method:
                    continue
                panel.plot(
                    1e6 * r["seconds"],
                    max(r["error"], floor),
                    markers[kind],
                    color=f"C{colour}",
                    markersize=9,
                    markeredgecolor="white",
                    label=method if kind == KINDS[0] else None,
                )
                if r["queries"] < asked[r["case"]]:
                    panel.annotate(
                        f"{r['queries']} of {asked[r['case']]}",
                        (1e6 * r["seconds"], max(r["error"], floor)),
                        xytext=(0, 8 if kind == KINDS[0] else -15),
                        textcoords="offset points",
                        ha="center",
                        fontsize=8,
                        color=f"C{colour}",
                    )
        panel.axhspan(floor / 2, floor * 1.6, color="0.93", zorder=0)
        panel.set(
            xscale="log",
            yscale="log",
            ylim=(floor / 2, 1),
            xlabel="time per query / µs",
            title=f"{case} queries, boxes overlapping",
        )
        panel.grid(which="major", alpha=0.3)
    for panel in panels:
        where = panel.get_yaxis_transform()
        panel.text(0.6, floor, "none wrong", va="center", ha="center", transform=where)
    panels[0].set_ylabel("wrong answers per query (misses + false alarms)")
    shown = {}  # of both panels: a peer may have run out of time before the hard queries
    for panel in panels:
        for handle, label in zip(*panel.get_legend_handles_labels(), strict=True):
            shown.setdefault(label, handle)
    panels[1].legend(
        [shown[m] for m in methods if m in shown],
        [m for m in methods if m in shown],
        title="● point-triangle  ▲ edge-edge",
        fontsize=9,
        loc="center right",
    )
    figure.savefig(path, dpi=130)
    plt.close(figure)
