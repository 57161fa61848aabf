#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs the same scenes in every built engine and prints one table.

    run_peers.py --bin DIR --json OUT.json --engines own,physx-pgs --scenes S1,S2 --reps 5
    run_peers.py --bin DIR --json OUT.json --table-only --csv OUT.csv

Every run is its own process. Repeats are interleaved over the engines so that machine load hits
all of them alike; the table shows the median over repeats and the spread. ms/step is process CPU
time per step (shared machine); the JSON also has wall times.
"""

import argparse
import csv
import datetime
import json
import os
import statistics
import subprocess
import sys
from pathlib import Path

# engine id -> (binary, extra driver options)
ENGINES = {
    "box3d": ("box3d_f32_v3", {}),
    "box3d-sse2": ("box3d_f32_sse2", {}),
    "box3d-f64pos": ("box3d_f64_v3", {}),
    "jolt": ("jolt_f32", {}),
    "jolt-f64pos": ("jolt_f64", {}),
    "rapier-f32": ("rapier_f32", {}),
    "rapier-f64": ("rapier_f64", {}),
    "rapier-f32-par": ("rapier_f32_par", {}),
    "rapier-f64-par": ("rapier_f64_par", {}),
    "physx-pgs": ("physx", {}),
    "physx-tgs": ("physx", {"tgs": 1}),
    "bullet-f64": ("bullet_f64", {}),
    "bullet-f32": ("bullet_f32", {}),
    "bullet-f64-deb": ("bullet_f64_deb", {}),
    "bullet-f32-deb": ("bullet_f32_deb", {}),
    "ode-f64": ("ode_f64_deb", {}),
    "mujoco": ("mujoco", {}),
    "mujoco-rk4": ("mujoco", {"integrator": 1}),
    "mujoco-impl": ("mujoco", {"integrator": 3}),
    "own": ("own", {}),
}
# id -> (driver options, seconds allowed, key that the table shows, accuracy keys)
SCENES = {
    "S1-free-1k": (
        {"scene": "free", "n": 1000},
        60,
        ["pos_err_max_m", "rot_energy_err_max", "ang_mom_err_max"],
    ),
    "S1-free-10k": (
        {"scene": "free", "n": 10000},
        90,
        ["pos_err_max_m", "rot_energy_err_max", "ang_mom_err_max"],
    ),
    "S2-pile-1k": (
        {"scene": "pile", "n": 1000},
        150,
        ["ms_cpu_settled", "contacts", "pen_max_mm", "pen_mean_mm", "mean_v2_half", "lost"],
    ),
    "S2-pile-1k-240": (
        {"scene": "pile", "n": 1000, "hz": 240, "steps": 500},
        200,
        ["ms_cpu_settled", "contacts", "pen_max_mm", "pen_mean_mm", "lost"],
    ),
    "S2-pile-5k": (
        {"scene": "pile", "n": 5000, "steps": 200},
        400,
        ["ms_cpu_settled", "contacts", "pen_max_mm", "pen_mean_mm", "mean_v2_half", "lost"],
    ),
    "S2-grid-1k": (
        {"scene": "grid", "n": 1000},
        100,
        ["ms_cpu_settled", "contacts", "overlapping_pairs", "pen_max_mm", "mean_v2_half"],
    ),
    "S3-pyramid-20": (
        {"scene": "pyramid", "n": 20},
        60,
        ["contacts", "top_drift_mm", "top_sink_mm", "pen_max_mm"],
    ),
    "S3-pyramid-30": (
        {"scene": "pyramid", "n": 30},
        100,
        ["contacts", "top_drift_mm", "top_sink_mm", "pen_max_mm"],
    ),
    "S4-spheres-2k": (
        {"scene": "spheres", "n": 2000},
        150,
        ["ms_cpu_settled", "contacts", "pen_max_mm", "pen_mean_mm", "mean_v2_half", "lost"],
    ),
    "S4-spheres-10k": (
        {"scene": "spheres", "n": 10000, "steps": 150},
        400,
        ["ms_cpu_settled", "contacts", "pen_max_mm", "pen_mean_mm", "mean_v2_half", "lost"],
    ),
    "S5-stack-20": (
        {"scene": "stack", "n": 20},
        60,
        ["stands", "top_drift_mm", "top_sink_mm", "pen_max_mm"],
    ),
    "S5-stack-30": (
        {"scene": "stack", "n": 30},
        60,
        ["stands", "top_drift_mm", "top_sink_mm", "pen_max_mm"],
    ),
    "S5-stack10-1:100": (
        {"scene": "stack", "n": 10, "ratio": 100},
        60,
        ["stands", "top_drift_mm", "top_sink_mm", "pen_max_mm"],
    ),
    "S5-stack10-1:1000": (
        {"scene": "stack", "n": 10, "ratio": 1000},
        60,
        ["stands", "top_drift_mm", "top_sink_mm", "pen_max_mm"],
    ),
    "S5-stack10-1:1000000": (
        {"scene": "stack", "n": 10, "ratio": 1000000},
        60,
        ["stands", "top_drift_mm", "top_sink_mm", "pen_max_mm"],
    ),
    "S5-stack20-240": (
        {"scene": "stack", "n": 20, "hz": 240},
        60,
        ["stands", "top_drift_mm", "top_sink_mm", "pen_max_mm"],
    ),
    "S5-stack10-1:1000-240": (
        {"scene": "stack", "n": 10, "ratio": 1000, "hz": 240},
        60,
        ["stands", "top_drift_mm", "top_sink_mm", "pen_max_mm"],
    ),
    "S6-ball-100": (
        {"scene": "bullet", "speed": 100},
        30,
        ["tunnelled", "pen_max_mm", "x_end", "vx_end"],
    ),
    "S6-ball-300": (
        {"scene": "bullet", "speed": 300},
        30,
        ["tunnelled", "pen_max_mm", "x_end", "vx_end"],
    ),
    "S6-ball-1000": (
        {"scene": "bullet", "speed": 1000},
        30,
        ["tunnelled", "pen_max_mm", "x_end", "vx_end"],
    ),
    "S6-rod-spin100": (
        {"scene": "bullet", "kind": "rod", "speed": 0, "spin": 100},
        30,
        ["tunnelled", "pen_max_mm", "x_end", "wz_end"],
    ),
    "S6-rod-spin30-v20": (
        {"scene": "bullet", "kind": "rod", "speed": 20, "spin": 30},
        30,
        ["tunnelled", "pen_max_mm", "x_end", "wz_end"],
    ),
    "S7-dzhanibekov-60": (
        {"scene": "torquefree", "hz": 60},
        60,
        [
            "ang_err_1s_rad",
            "ang_err_10s_rad",
            "ang_err_100s_rad",
            "energy_10s",
            "energy_drift_max",
            "ang_mom_drift_max",
        ],
    ),
    "S7-dzhanibekov-240": (
        {"scene": "torquefree", "hz": 240},
        60,
        [
            "ang_err_1s_rad",
            "ang_err_10s_rad",
            "ang_err_100s_rad",
            "energy_10s",
            "energy_drift_max",
            "ang_mom_drift_max",
        ],
    ),
    "S7-general-60": (
        {"scene": "torquefree", "hz": 60, "axis": "gen"},
        60,
        [
            "ang_err_1s_rad",
            "ang_err_10s_rad",
            "ang_err_100s_rad",
            "energy_10s",
            "energy_drift_max",
            "ang_mom_drift_max",
        ],
    ),
    "S7-general-240": (
        {"scene": "torquefree", "hz": 240, "axis": "gen"},
        60,
        [
            "ang_err_1s_rad",
            "ang_err_10s_rad",
            "ang_err_100s_rad",
            "energy_10s",
            "energy_drift_max",
            "ang_mom_drift_max",
        ],
    ),
    "S8-mesh-20k": (
        {"scene": "mesh", "n": 100},
        150,
        ["ms_cpu_settled", "contacts", "lost", "mean_v2_half"],
    ),
    "S8-mesh-200k": (
        {"scene": "mesh", "n": 316},
        200,
        ["ms_cpu_settled", "contacts", "lost", "mean_v2_half"],
    ),
    "S9-rays-200k": (
        {"scene": "rays", "n": 316},
        200,
        ["rays_per_s_cpu", "hits", "mean_frac", "build_ms"],
    ),
}
QUICK = [
    "S1-free-1k",
    "S2-pile-1k",
    "S2-grid-1k",
    "S3-pyramid-20",
    "S4-spheres-2k",
    "S5-stack-20",
    "S5-stack10-1:100",
    "S6-ball-300",
    "S7-dzhanibekov-60",
    "S8-mesh-20k",
    "S9-rays-200k",
]


def one(binary: Path, options: dict, limit: float) -> dict:
    command = [str(binary)]
    for key, value in options.items():
        command += [f"--{key}", str(value)]
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=limit)
    except subprocess.TimeoutExpired:
        return {"error": f"over {limit} s wall"}
    for line in reversed(done.stdout.splitlines()):
        if line.startswith("{"):
            return json.loads(line)
    return {"error": f"exit {done.returncode} {done.stderr.strip()[-120:]}"}


def summary(runs: list[dict]) -> dict | None:
    """The median run, with the spread over the repeats."""
    good = [run for run in runs if "error" not in run]
    if not good:
        return None
    times = sorted(run.get("ms_cpu_mean", 0) for run in good)
    row = dict(good[0], ms_cpu_mean=statistics.median(times), reps=len(good))
    row["spread"] = times[-1] / times[0] if times[0] else 0
    for key in ("rays_per_s_cpu", "ms_cpu_settled"):
        if key in row:
            row[key] = statistics.median(run[key] for run in good)
    return row


def rank(row: dict | None) -> float:
    if not row:
        return float("inf")
    return -row["rays_per_s_cpu"] if "rays_per_s_cpu" in row else row["ms_cpu_mean"]


def print_table(data: dict[str, list[dict]]) -> None:
    for scene, (options, _, keys) in SCENES.items():
        rows = [
            (*key.split("|")[1:], runs) for key, runs in data.items() if key.split("|")[0] == scene
        ]
        if not rows:
            continue
        print(f"\n{scene}   hz={options.get('hz', 60)}")
        print(f"  {'engine':16} th {'ms/step':>9} {'max/min':>7}  {'  '.join(keys)}")
        rows = [(engine, threads, summary(runs), runs) for engine, threads, runs in rows]
        for engine, threads, row, runs in sorted(rows, key=lambda r: rank(r[2])):
            if not row:
                print(f"  {engine:16} {threads:>2}  {runs[-1]['error']}")
                continue
            time_ms = f"{row['ms_cpu_mean']:9.4f}" if row.get("ms_cpu_mean") else "        -"
            figures = "  ".join(f"{key}={row[key]:.4g}" for key in keys if key in row)
            print(f"  {engine:16} {threads:>2} {time_ms} {row['spread']:7.2f}  {figures}")


FIGURES = ("ms_cpu_mean", "ms_cpu_settled", "stands", "top_drift_mm", "top_sink_mm", "pen_max_mm")
FIGURES += ("pen_mean_mm", "overlapping_pairs", "mean_v2_half")


def write_csv(data: dict[str, list[dict]], path: Path) -> None:
    """Time and quality side by side, a line per scene and engine, with machine and date."""
    info = Path("/proc/cpuinfo").read_text().splitlines()
    model = next(line.split(":")[1].strip() for line in info if line.startswith("model name"))
    with path.open("w", newline="") as file:
        rows = csv.writer(file, lineterminator="\n")
        extra = ("hz", "threads", "repeats", "max_over_min", "machine", "cpus", "date")
        rows.writerow(("scene", "engine", *FIGURES, *extra))
        for key, runs in data.items():
            scene, engine, threads = key.split("|")
            row = summary(runs) or {}
            figures = [f"{row[f]:.4g}" if f in row else "" for f in FIGURES]
            hz = SCENES[scene][0].get("hz", 60)
            end = (hz, threads, row.get("reps", 0), f"{row.get('spread', 0):.2f}")
            today = datetime.date.today().isoformat()
            rows.writerow((scene, engine, *figures, *end, model, os.cpu_count(), today))


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--bin", required=True, type=Path, help="folder of the built drivers")
    parser.add_argument("--json", required=True, type=Path, help="results are added to this file")
    parser.add_argument("--engines", default="", help="comma separated; default all that are built")
    parser.add_argument("--scenes", default="", help="prefixes, comma separated; default all")
    parser.add_argument("--reps", type=int, default=1)
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--quick", action="store_true", help="one scene of each kind")
    parser.add_argument("--table-only", action="store_true", help="print the table of --json")
    parser.add_argument("--csv", type=Path, help="writes what --json holds as one table")
    args = parser.parse_args()
    engines = [
        name
        for name in (args.engines.split(",") if args.engines else ENGINES)
        if (args.bin / ENGINES[name][0]).exists()
    ]
    wanted = args.scenes.split(",") if args.scenes else (QUICK if args.quick else list(SCENES))
    scenes = [s for s in SCENES if any(s.startswith(prefix) for prefix in wanted)]
    data = json.loads(args.json.read_text()) if args.json.exists() else {}
    rounds = 0 if args.table_only else args.reps
    for scene, engine in [(s, e) for _ in range(rounds) for s in scenes for e in engines]:
        binary, extra = ENGINES[engine]
        runs = data.setdefault(f"{scene}|{engine}|{args.threads}", [])
        if runs and "wall" in runs[-1].get("error", ""):
            continue  # too slow once is too slow
        options = {**SCENES[scene][0], "threads": args.threads, **extra}
        run = one(args.bin / binary, options, SCENES[scene][1])
        run["load"] = os.getloadavg()[0]
        runs.append(run)
        print(scene, engine, run.get("ms_cpu_mean", run.get("error", "")), file=sys.stderr)
        args.json.write_text(json.dumps(data, indent=0))
    print_table(data)
    if args.csv:
        write_csv(data, args.csv)


if __name__ == "__main__":
    main()
