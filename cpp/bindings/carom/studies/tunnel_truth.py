# SPDX-License-Identifier: Apache-2.0
"""Shoots fast bodies at walls, cups, funnels and one another and looks who passed through.

    python -m carom.studies.tunnel_truth --runs 10000 --seed 20261126 --summary tunnel_truth.json

First the negative control: the same runs with continuous collision off must tunnel, else the runs
prove nothing. Then with it on: none may. Who passed is told from poses alone (tunnel_judge). Exits
1 if any body did, a pose is not finite, or the control does not tunnel.
"""

from __future__ import annotations

import argparse
import json
import multiprocessing
import sys
import time
from collections import Counter
from datetime import datetime, timezone
from pathlib import Path

import numpy as np

from carom import Simulation
from carom.studies.tunnel_judge import PairJudge
from carom.studies.tunnel_scenes import Run, make_run

CONTROL_SHARE = 0.25
"""Of the control's runs must tunnel at least."""
DEEP = 1e-4
"""m. Overlaps above this are counted, as the mark for a spinning rod is 0.1 mm."""


FINER, SAME_PLACE = 256, 0.5
"""Steps of the second look per step of the run, and how near it has to end to where the run was,
relative to the distance two bodies must keep as they pass: on the other side they would be that
distance away at least."""


def confirmed(run: Run, simulation: Simulation, before: bytes, waited: bool) -> bool:
    """Whether two bodies did pass through each other that seem to, in the step from `before` on.

    Their judge sees where they are after each step and goes back along the last straight piece of
    their paths. Where they were hit again after they had passed beside each other, that piece tells
    nothing of how they passed. So the step is flown again in short ones, of which one holds at most
    a hit. The crossing stands unless they then pass beside each other and end in the same place;
    where bodies `waited` in that step, and so stopped on their way, pass through it.
    """
    judge = run.judges[0]
    if not isinstance(judge, PairJudge):
        return True
    judge.over = False
    dt = run.dt / FINER
    again = Simulation(run.scene, dt=dt)
    again.restore(before)
    rows = [judge.a, judge.b]
    here = np.diff(simulation.poses()[rows, :3], axis=0)
    off = []
    for _ in range(FINER):
        again.step(dt)
        if judge.crossed(again, dt):
            return True
        off.append(np.linalg.norm(np.diff(again.poses()[rows, :3], axis=0) - here))
    return bool((min(off) if waited else off[-1]) > SAME_PLACE * judge.near)


def fly(run: Run) -> Counter:
    """One run: whether something crossed or became non-finite, how deep it got, what was spent."""
    simulation = Simulation(run.scene, dt=run.dt)
    counts: Counter = Counter(runs=1)
    for step in range(run.steps):
        if run.before_step:
            run.before_step(simulation, step)
        before, waits = simulation.save(), simulation.report.sweep.waited
        simulation.step()
        counts["steps"] += 1
        if not (np.isfinite(simulation.poses()).all() and np.isfinite(simulation.twists()).all()):
            counts["not_finite"] += 1
            break
        crossed = [judge.crossed(simulation, run.dt) for judge in run.judges]
        if any(crossed):
            counts["crossed"] += (
                wrong := confirmed(run, simulation, before, simulation.report.sweep.waited > waits)
            )
            counts["seen_twice"] += not wrong
            break
    deepest = max(judge.deepest for judge in run.judges)
    counts["deeper_than_0.1_mm"] += bool(deepest > DEEP)
    report = simulation.report
    counts["frozen"] += bool(report.frozen)
    counts["in_which_a_body_waited"] += report.sweep.waited > 0
    counts["impacts"] += report.sweep.impacts
    counts["sweeps"] += report.sweep.sweeps
    counts["gave_up"] += report.sweep.gave_up
    return counts


def run_all(runs: int, seed: int, ccd: str, first: int = 0) -> tuple[dict[str, Counter], list[int]]:
    """Counts per family and kind of body, and the indices of the runs that went wrong."""
    rows: dict[str, Counter] = {}
    bad = []
    for index in range(first, first + runs):
        run = make_run(seed, index, ccd)
        counts = fly(run)
        if counts["crossed"] or counts["not_finite"]:
            bad.append(index)
            if ccd != "never":
                print(f"run {index} ({run.family}: {', '.join(run.kinds)}) went wrong", flush=True)
        for name in ("total", f"family/{run.family}", *{f"kind/{kind}" for kind in run.kinds}):
            rows.setdefault(name, Counter()).update(counts)
    return dict(sorted(rows.items())), bad


def _share(task: tuple[int, int, str, int]) -> tuple[dict[str, Counter], list[int]]:
    return run_all(*task)


def run_split(
    runs: int, seed: int, ccd: str, first: int, jobs: int
) -> tuple[dict[str, Counter], list[int]]:
    """run_all by several processes: the same counts, as each run has a seed of its own."""
    if jobs == 1:
        return run_all(runs, seed, ccd, first)
    part = 50
    tasks = [
        (min(part, first + runs - at), seed, ccd, at) for at in range(first, first + runs, part)
    ]
    rows: dict[str, Counter] = {}
    bad: list[int] = []
    with multiprocessing.get_context("spawn").Pool(jobs) as pool:
        for done, wrong in pool.imap(_share, tasks):
            bad += wrong
            for name, counts in done.items():
                rows.setdefault(name, Counter()).update(counts)
    return dict(sorted(rows.items())), bad


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    option = parser.add_argument
    option("--runs", type=int, default=10_000)
    option("--seed", type=int, default=20261126)
    option("--first", type=int, default=0, help="index of the first run")
    option("--control", type=int, help="runs of the negative control (all)")
    option("--jobs", type=int, default=1, help="processes to share the runs")
    option("--summary", type=Path, help="JSON file to write")
    options = parser.parse_args()
    control_runs = options.runs if options.control is None else options.control
    print(f"seed {options.seed}")
    started = time.perf_counter()
    control, _ = run_split(control_runs, options.seed, "never", options.first, options.jobs)
    tunnelled = control["total"]["crossed"] / control_runs if control_runs else 1.0
    print(f"control, continuous collision off: {tunnelled:.1%} of {control_runs} runs tunnel")
    rows, bad = run_split(options.runs, options.seed, "auto", options.first, options.jobs)
    for name, counts in rows.items():
        print(f"{name:20s} {dict(counts)}")
    print(f"{len(bad)} bad runs {bad[:20]}, {time.perf_counter() - started:.0f} s")
    if options.summary:
        summary = {
            "command": f"python -m carom.studies.tunnel_truth --runs {options.runs} "
            f"--seed {options.seed}",
            "seed": options.seed,
            "date": datetime.now(timezone.utc).date().isoformat(),
            "control": {"runs": control_runs, "tunnelled_share": round(tunnelled, 4),
                        "families": _shares(control)},
            "total": {"crossed": 0, "not_finite": 0, "frozen": 0, **rows["total"]},
            "bad_runs": bad,
            "rows": {name: dict(counts) for name, counts in rows.items()},
        }  # fmt: skip
        options.summary.write_text(json.dumps(summary, indent=1) + "\n")
    return 1 if bad or tunnelled < CONTROL_SHARE else 0


def _shares(rows: dict[str, Counter]) -> dict[str, float]:
    return {
        name: round(counts["crossed"] / counts["runs"], 4)
        for name, counts in rows.items()
        if name.startswith("family/")
    }


if __name__ == "__main__":
    sys.exit(main())
