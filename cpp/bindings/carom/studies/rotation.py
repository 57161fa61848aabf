# SPDX-License-Identifier: Apache-2.0
"""Free flight: error of the final orientation against time, for every method of METHODS.

The truth is 60-digit arithmetic (top_reference), stored here and recomputed by a test: never a
finer run of the same code. Times are of whole flights, less the price of an empty Python call.
`instructions` are per step of one body, counted by callgrind (cpp/bench/count_instructions.sh),
so they do not depend on the load of the machine.
"""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from carom._core import METHODS, MassProperties
from carom.free_flight import integrate_free
from carom.studies.common import (
    Progress,
    Row,
    draw_lines,
    fitted_slope,
    least_seconds,
    name_points,
    pyplot,
)

AT_REST = (0.0, 0.0, 0.0, 1.0)


class Case(NamedTuple):
    name: str
    title: str
    moments: tuple[float, float, float]
    """kg m^2"""
    w: tuple[float, float, float]
    """rad/s"""
    seconds: float
    truth: tuple[float, float, float, float]
    """x y z w after the flight from 0 0 0 1"""
    steps: tuple[int, ...]


def _doubling(first: int, count: int) -> tuple[int, ...]:
    return tuple(first << i for i in range(count))


CASES = (
    Case(
        "tumbling",
        "a tumbling box, 10 s",
        (1, 2, 2.5),
        (1, 1, 1),
        10,
        (
            0.093325465566093932438,
            -0.18970867325123794526,
            0.95406167930145320635,
            0.21229057647153796068,
        ),
        _doubling(25, 10),
    ),
    Case(
        "unstable_axis",
        "twice past the unstable axis, 40 s",
        (1, 2, 3),
        (1e-6, 2, -1e-6),
        40,
        (
            -0.12977793781541107879,
            0.73557369443374233417,
            -0.61952779770540370328,
            0.2414007762700177045,
        ),
        _doubling(200, 9),
    ),
    Case(
        "spinning_disk",
        "a disk, almost round, 200 rad/s, 1 s",
        (0.5, 0.50025, 1),
        (0.5, 0.1, 200),
        1,
        (
            -0.0010600324693581832098,
            0.0004277566883240014133,
            -0.50622489588069576086,
            0.86240074683754665483,
        ),
        _doubling(120, 9),
    ),
)
TOLERANCES = tuple(10.0**-k for k in range(2, 13))
LONG_STEPS = 100_000
LONG_TURN = 0.1
"""rad per step"""


def _body(case: Case) -> MassProperties:
    return MassProperties(1.0, np.zeros(3), np.diag(np.array(case.moments, dtype=float)))


def angle_between(a: np.ndarray, b: np.ndarray) -> float:
    """rad, also where the cosine has lost it."""
    a, b = np.asarray(a, dtype=float), np.asarray(b, dtype=float)
    b = b if a @ b >= 0 else -b
    return 4 * math.atan2(float(np.linalg.norm(a - b)), float(np.linalg.norm(a + b)))


def instructions() -> dict[str, int]:
    """Per body and step, counted by callgrind; in lanes of four under "lanes/<method>"."""
    path = Path(__file__).with_name("rotation_instructions.json")
    return dict(json.loads(path.read_text())["instructions_per_step"])


def _settings(case: Case) -> list[tuple[str, dict[str, Any]]]:
    """Every method with each of its settings."""
    runs: list[tuple[str, dict[str, Any]]] = []
    for method in METHODS:
        if method == "exact":
            runs.append((method, {}))
        elif method == "taylor":
            runs += [(method, {"tolerance": tolerance}) for tolerance in TOLERANCES]
        else:
            runs += [(method, {"steps": steps}) for steps in case.steps]
    return runs


def _energy(case: Case, orientation: np.ndarray, w: np.ndarray) -> float:
    x, y, z, s = orientation
    v = np.array([-x, -y, -z])
    turned = w + 2 * np.cross(v, np.cross(v, w) + s * w)
    return 0.5 * float(turned @ (np.array(case.moments) * turned))


def run(progress: Progress | None = None) -> list[Row]:
    """Error in rad against seconds for each case and method, then the energy after 1e5 steps."""
    counted = instructions()
    plan = [(case, *setting) for case in CASES for setting in _settings(case)]
    long_runs = [method for method in METHODS if method not in ("taylor", "exact")]
    total = len(plan) + len(long_runs)
    at_hand = _body(CASES[0])
    empty = least_seconds(lambda: integrate_free(at_hand, AT_REST, CASES[0].w, 0.0))
    rows: list[Row] = []
    for case, method, setting in plan:
        body = _body(case)

        def fly(body=body, case=case, method=method, setting=setting):
            return integrate_free(body, AT_REST, case.w, case.seconds, method=method, **setting)

        flight = fly()
        whole = least_seconds(fly)
        seconds = max(whole - empty, 0.1 * whole)  # the difference of two times: not below noise
        rows.append(
            {
                "study": "rotation",
                "case": case.name,
                "method": method,
                "steps": flight.steps,
                "error": angle_between(case.truth, flight.orientation),
                "error_unit": "rad",
                "seconds": seconds,
                "instructions": counted.get(method),
                "tolerance": setting.get("tolerance"),
                "estimate": flight.error,
                "status": flight.status,
            }
        )
        if progress is not None:
            progress(len(rows), total)
    for method in long_runs:
        rows.append(_long_run(method, counted))
        if progress is not None:
            progress(len(rows), total)
    return rows


def _long_run(method: str, counted: dict[str, int]) -> Row:
    """Relative energy error after 1e5 steps of 0.1 rad, of the body with moments 1, 2, 3."""
    case = CASES[0]._replace(moments=(1, 2, 3))
    seconds = LONG_TURN / float(np.linalg.norm(case.w)) * LONG_STEPS
    body = _body(case)

    def fly():
        return integrate_free(body, AT_REST, case.w, seconds, steps=LONG_STEPS, method=method)

    flight = fly()
    before = _energy(case, np.array(AT_REST), np.array(case.w, dtype=float))
    after = _energy(case, flight.orientation, flight.angular_velocity)
    return {
        "study": "rotation",
        "case": "energy_after_1e5_steps",
        "method": method,
        "steps": LONG_STEPS,
        "error": abs(after / before - 1),
        "error_unit": "relative energy",
        "seconds": least_seconds(fly, repeats=3),
        "instructions": counted.get(method),
        "status": flight.status,
    }


def slopes(rows: list[Row]) -> dict[str, float]:
    """Measured order of each fixed-step method on the tumbling box: minus the slope of its errors.

    The last four errors below 0.3 rad, where the law holds, and above 1e-10, clear of rounding.
    """
    found = {}
    for method in METHODS:
        line = [
            row
            for row in rows
            if row["case"] == "tumbling" and row["method"] == method and 1e-10 < row["error"] < 0.3
        ]
        if method not in ("taylor", "exact") and len(line) >= 3:
            found[method] = -fitted_slope(line[-4:], "steps")
    return found


COLOURS = {
    "lecture_gram_schmidt": "#b08968",
    "lecture_polar": "#9c6644",
    "lecture_exponential": "#7f5539",
    "lecture_quaternion": "#a5a58d",
    "lecture_quaternion_sqrt": "#6b705c",
    "midpoint": "#8e9aaf",
    "implicit_midpoint": "#5c677d",
    "cayley": "#2a9d8f",
    "symmetric_top": "#d62828",
    "symmetric_top_4": "#e76f51",
    "taylor": "#4361ee",
    "exact": "#111111",
}


def _style(method: str) -> dict[str, Any]:
    lecture = method.startswith("lecture")
    marker = {"exact": "*", "taylor": "D", "symmetric_top": "o", "symmetric_top_4": "s"}
    default = method == "symmetric_top"
    return {
        "color": COLOURS[method],
        "linestyle": ":" if lecture else "-",
        "marker": marker.get(method, "x" if lecture else "^"),
        "markersize": 12 if method == "exact" else 6 if default else 4,
        "linewidth": 2.6 if default else 1.3,
    }


GROUPED = ("lecture_polar", "lecture_exponential", "lecture_quaternion", "lecture_quaternion_sqrt")
"""Rows that lie on one another: named together."""


def _name_lines(axes, rows: list[Row], scale: float) -> None:
    """Each line's name at its most accurate end."""
    ends = {row["method"]: row for row in rows}  # settings ascend: the last one
    ends["lecture_polar"] = max((ends.pop(m) for m in GROUPED), key=lambda row: row["seconds"])
    name_points(
        axes,
        [
            (
                scale * row["seconds"],
                max(row["error"], FLOOR),
                "lecture: polar, exp., quaternions"
                if method == "lecture_polar"
                else method.replace("_", " ") + (" (default)" if method == DEFAULT else ""),
                COLOURS[method],
            )
            for method, row in ends.items()
        ],
        bold="symmetric top (",
    )


DEFAULT = "symmetric_top"
FLOOR = 1e-15
"""rad; smaller errors are drawn here"""


def plot(rows: list[Row], path: Path | str) -> None:
    """Three work-precision panels and one of energy against time per step."""
    plt = pyplot()
    figure, panels = plt.subplots(2, 2, figsize=(13.5, 10.5), dpi=110)
    figure.subplots_adjust(left=0.07, right=0.86, wspace=0.55, hspace=0.32, top=0.885, bottom=0.07)
    figure.suptitle(
        "What accuracy costs: free rotation of one rigid body", x=0.07, ha="left", fontsize=16
    )
    figure.text(
        0.07,
        0.925,
        "Lower left is better. Yellow: the Pareto front, where no method is both faster and more "
        "accurate. Truth: 60-digit arithmetic. One thread.",
        fontsize=10,
        color="#444444",
    )
    for axes, case in zip(panels.flat, CASES, strict=False):
        mine = [row for row in rows if row["case"] == case.name]
        draw_lines(axes, mine, _style, floor=FLOOR)
        axes.set(ylim=(FLOOR / 2, 10))
        axes.set_title(case.title, loc="left", fontsize=11)
        axes.set_xlabel("time of the whole flight, µs")
        axes.set_ylabel("error of the final orientation, rad")
        _name_lines(axes, mine, 1e6)
    _draw_energy(panels[1][1], [row for row in rows if row["case"] == "energy_after_1e5_steps"])
    figure.savefig(path, dpi=110)
    plt.close(figure)


def _within(value: float, limits: tuple[float, float]) -> bool:
    return limits[0] <= value <= limits[1]


def _draw_energy(axes, rows: list[Row]) -> None:
    points = [{**row, "seconds": row["seconds"] / row["steps"]} for row in rows]
    for row in points:
        row["error"] = max(row["error"], FLOOR)
    draw_lines(axes, points, _style, scale=1e9)
    axes.set_title("energy after 100 000 steps of 0.1 rad", loc="left", fontsize=11)
    axes.set_xlabel("time of one step, ns")
    axes.set_ylabel("relative error of the energy")
    axes.set(ylim=(1e-9, 10))
    ticks = [tick for tick in (10, 30, 100, 300, 1000, 3000) if _within(tick, axes.get_xlim())]
    axes.set_xticks(ticks, [str(tick) for tick in ticks])
    axes.xaxis.set_minor_formatter("")
    _name_lines(axes, points, 1e9)
