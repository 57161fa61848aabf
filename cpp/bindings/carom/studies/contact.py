# SPDX-License-Identifier: Apache-2.0
"""Contact: what small steps, their number and the direct solver cost, and what they hold.

The truth is a scene that stands: every box of a tower, and the top of the pyramid, belongs where it
was put. `error` is how far the worst box strays from there, m; a tower that fell says so by it.
`energy_off` is what the ledger of kinetic, potential and dissipated energy misses, as a share of
the potential energy at the start.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

import carom
from carom.studies.common import pyplot

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Row = dict[str, object]

DT = 1 / 60
SECONDS = 3.0
SETTINGS: tuple[tuple[str, dict[str, object]], ...] = (
    *(
        (f"small_steps_{n}", {"contact_solver": "small_steps", "substeps": n})
        for n in (4, 8, 16, 32)
    ),
    ("direct", {"contact_solver": "direct"}),
    ("automatic", {}),
)
FELL = 0.25  # m: half a box
DIRECT_TOO = ("stack_20", "ten_under_1000", "ten_under_1e6")


def _ground() -> carom.Scene:
    scene = carom.Scene()
    scene.effects.append(carom.UniformGravity([0, 0, -9.81]))
    scene.add(carom.Plane([0, 0, 1], 0), name="ground", static=True)
    return scene


def _tower(count: int, top_density: float) -> carom.Scene:
    scene = _ground()
    for i in range(count):
        density = top_density if i == count - 1 else 1000.0
        scene.add(carom.Box([0.5, 0.5, 0.5]), position=[0, 0, 0.25 + 0.5 * i], density=density)
    return scene


def _pyramid(layers: int) -> carom.Scene:
    """Boxes of 1 m at 1.02 m, as the peers' driver places them."""
    scene = _ground()
    for layer in range(layers):
        for i in range(layers - layer):
            x = 1.02 * (i - 0.5 * (layers - layer - 1))
            scene.add(carom.Box([1, 1, 1]), position=[x, 0, 0.5 + layer])
    return scene


CASES: dict[str, Callable[[], carom.Scene]] = {
    "stack_20": lambda: _tower(20, 1e3),
    "ten_under_1000": lambda: _tower(10, 1e6),
    "ten_under_1e6": lambda: _tower(10, 1e9),
    "pyramid_10": lambda: _pyramid(10),
}


def _measure(case: str, method: str, settings: dict[str, object], duration: float) -> Row:
    simulation = carom.Simulation(CASES[case](), dt=DT, **settings)
    start = np.array(simulation.centres())
    before = simulation.energy()
    clock = time.process_time()
    landing = simulation.advance(0.6 * duration)
    resting = simulation.advance(0.4 * duration)
    seconds = time.process_time() - clock
    after = simulation.energy()
    steps = landing.steps + resting.steps
    parts = (landing.contact, resting.contact)
    gain = (after.kinetic + after.potential) - (before.kinetic + before.potential)
    return {
        "study": "contact",
        "case": case,
        "method": method,
        "steps": steps,
        "error": float(np.linalg.norm(simulation.centres() - start, axis=1).max()),
        "error_unit": "m",
        "seconds": seconds / steps,
        "residual_m_s": resting.contact.residual,
        "deepest_overlap_m": max(part.deepest_overlap for part in parts),
        "energy_gain_j": gain,
        "energy_off": abs(gain + after.dissipated - before.dissipated) / before.potential,
        "iterations_per_step": sum(part.iterations for part in parts) / steps,
        "solver": "direct" if resting.contact.direct_islands else "small steps",
        "gave_up": sum(part.gave_up for part in parts),
    }


def run(
    progress: Callable[[int, int], None] | None = None,
    cases: Sequence[str] = tuple(CASES),
    duration: float = SECONDS,
) -> list[Row]:
    """Measures every case and setting for `duration` simulated seconds; ten seconds of work or so.

    progress: called with (rows done, rows in all) after each row. `seconds` are per step;
    residuals are of the last two fifths, when what stands has come to rest.
    """
    plan = [
        (case, method, settings)
        for case in cases
        for method, settings in SETTINGS
        if method != "direct" or case in DIRECT_TOO  # a wall of boxes is not what it is for
    ]
    rows = []
    for done, (case, method, settings) in enumerate(plan, 1):
        rows.append(_measure(case, method, settings, duration))
        if progress:
            progress(done, len(plan))
    return rows


TITLES = {
    "stack_20": "stack of 20",
    "ten_under_1000": "ten boxes, the top one\n1000 times as heavy",
    "ten_under_1e6": "ten boxes, the top one\na million times as heavy",
    "pyramid_10": "pyramid of 10 rows",
}
# Column, what to call it, the least and the most that is drawn, the mark to keep below.
MEASURES = (
    ("error", "farthest a box\nstrayed, m", 1e-10, 2e3, 1e-3),
    ("deepest_overlap_m", "deepest\noverlap, m", 1e-11, 30.0, 5e-4),
    ("residual_m_s", "Coulomb's law\nmissed by, m/s", 1e-13, 1e3, None),
    ("energy_off", "energy the books\nmiss, share", 1e-12, 1.0, None),
)
SMALL, DIRECT, AUTOMATIC = "#3f7ca6", "#d9582b", "#222222"


def _draw(axes: Axes, rows: list[Row], column: str, floor: float) -> None:
    """One measure of one case against time per step."""
    small = [row for row in rows if row["method"].startswith("small_steps")]

    def x(row: Row) -> float:
        return 1e6 * row["seconds"]

    def y(row: Row) -> float:
        return max(row[column], 2 * floor)

    axes.plot([x(r) for r in small], [y(r) for r in small], "o-", color=SMALL, markersize=5)
    for row in small:
        label = row["method"].rpartition("_")[2]
        axes.annotate(
            label, (x(row), y(row)), xytext=(0, 6), textcoords="offset points", fontsize=7.5,
            ha="center", color=SMALL,
        )  # fmt: skip
    for name, marker, colour, size in (
        ("direct", "D", DIRECT, 7),
        ("automatic", "*", AUTOMATIC, 13),
    ):
        for row in (row for row in rows if row["method"] == name):
            axes.plot(
                x(row), y(row), marker, color=colour, markersize=size, markeredgecolor="white",
                zorder=4 if name == "direct" else 5,
            )  # fmt: skip


def plot(rows: list[Row], path: Path | str) -> None:
    """Four measures (rows) of each case (columns) against the time of a step."""
    plt = pyplot()
    cases = list(dict.fromkeys(row["case"] for row in rows))
    figure, panels = plt.subplots(
        len(MEASURES), len(cases), figsize=(2.6 + 2.75 * len(cases), 10.2), squeeze=False,
        sharex="col", sharey="row",
    )  # fmt: skip
    figure.subplots_adjust(left=0.095, right=0.985, top=0.8, bottom=0.06, wspace=0.08, hspace=0.1)
    figure.suptitle(
        "What accuracy costs: contact that has to stand", x=0.03, y=0.985, ha="left", fontsize=16
    )
    figure.text(
        0.03, 0.945,
        "Lower left is better. Each scene belongs where it was put; in the red it fell. Dashed: "
        f"the mark.\nSteps of 1/60 s for {rows[0]['steps'] * DT:.3g} s, one thread. What is below "
        "a panel is drawn at its lower edge.",
        fontsize=10, color="#444444", va="top",
    )  # fmt: skip
    for i, (column, label, floor, top, mark) in enumerate(MEASURES):
        for axes, case in zip(panels[i], cases, strict=True):
            _draw(axes, [row for row in rows if row["case"] == case], column, floor)
            axes.set(xscale="log", yscale="log", ylim=(floor, top))
            axes.grid(True, which="major", color="#e3e3e3", linewidth=0.6, zorder=0)
            axes.tick_params(which="minor", length=0)
            for side in ("top", "right"):
                axes.spines[side].set_visible(False)
            if mark:
                axes.axhline(mark, color="#777777", linewidth=1, linestyle=(0, (5, 4)), zorder=1)
            if column == "error":
                axes.axhspan(FELL, top, color="#d9582b", alpha=0.13, linewidth=0)
                axes.set_title(TITLES.get(case, case), fontsize=10.5, loc="left")
        panels[i][0].set_ylabel(label, fontsize=10)
    for axes in panels[-1]:
        axes.set_xlabel("time of a step, µs")
        low, high = axes.get_xlim()
        axes.set_xlim(0.8 * low, 1.25 * high)
        ticks = [k * 10**e for e in range(7) for k in (1, 2, 5)]
        ticks = [tick for tick in ticks if 0.8 * low <= tick <= 1.25 * high]
        axes.set_xticks(ticks, [f"{tick:,}".replace(",", " ") for tick in ticks])
        axes.xaxis.set_minor_formatter("")
    handles = [
        plt.Line2D([], [], color=SMALL, marker="o", label="small steps, so many per step"),
        plt.Line2D([], [], color=DIRECT, marker="D", markersize=9, linestyle="",
                   label="direct solver"),
        plt.Line2D([], [], color=AUTOMATIC, marker="*", markersize=10, linestyle="",
                   label="automatic, the default"),
    ]  # fmt: skip
    figure.legend(
        handles=handles, loc="upper left", bbox_to_anchor=(0.022, 0.895), ncols=3, frameon=False
    )
    figure.savefig(path, dpi=110)
    plt.close(figure)
