# SPDX-License-Identifier: Apache-2.0
"""What studies share: rows to CSV, JSON and a plot, the machine they ran on, the Pareto front.

A study is a module with `run(progress=None) -> list of rows`; a row is a dict with at least study,
case, method, error, error_unit and seconds, and whatever names its setting (steps, samples, ...).
`progress` is called with (done, in all) or with one line of text. A study may have
`plot(rows, path)`; without one `plot_rows` here draws it.
"""

from __future__ import annotations

import csv
import json
import math
import os
import platform
import statistics
import time
from collections.abc import Callable, Iterable, Sequence
from datetime import datetime, timezone
from pathlib import Path
from typing import TYPE_CHECKING, Any

from carom._core import __version__
from carom.errors import MissingDependency

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Row = dict[str, Any]
Progress = Callable[..., None]


def least_seconds(call: Callable[[], object], batch: float = 0.003, repeats: int = 5) -> float:
    """Least CPU time of one call, s, over batches of `batch` seconds and more.

    The least, and of this process alone: what else runs on the machine can only add.
    """
    count, times = 1, []
    while len(times) < repeats:
        start = time.process_time()
        for _ in range(count):
            call()
        spent = time.process_time() - start
        if spent < batch:
            count *= 2 if spent > batch / 8 else 8
            continue
        times.append(spent / count)
    return min(times)


def machine() -> dict[str, str]:
    """What the times were measured on."""
    model = platform.processor() or platform.machine()
    info = Path("/proc/cpuinfo")
    if info.exists():
        for line in info.read_text().splitlines():
            if line.startswith("model name"):
                model = line.partition(":")[2].strip()
                break
    return {
        "cpu": model,
        "cores": str(os.cpu_count()),
        "system": f"{platform.system()} {platform.machine()}",
        "python": platform.python_version(),
        "carom": __version__,
        "date": datetime.now(timezone.utc).strftime("%Y-%m-%d"),
    }


def columns_of(rows: Iterable[Row]) -> list[str]:
    """Every key of every row, in the order first met."""
    return list(dict.fromkeys(key for row in rows for key in row))


def write_csv(rows: Sequence[Row], path: Path | str) -> None:
    with Path(path).open("w", newline="") as file:
        writer = csv.DictWriter(file, columns_of(rows))
        writer.writeheader()
        writer.writerows(rows)


def write_json(study: str, rows: Sequence[Row], path: Path | str) -> None:
    Path(path).write_text(json.dumps(as_json(study, rows), indent=1, allow_nan=False) + "\n")


def as_json(study: str, rows: Sequence[Row]) -> dict[str, Any]:
    """What write_json writes; a figure that is not finite is null, as JSON has no NaN."""

    def plain(value: Any) -> Any:
        value = value.item() if hasattr(value, "item") else value
        return None if isinstance(value, float) and not math.isfinite(value) else value

    plain_rows = [{key: plain(value) for key, value in row.items()} for row in rows]
    return {"schema": "carom.study/1", "study": study, "machine": machine(), "rows": plain_rows}


def pareto(rows: Iterable[Row], cost: str = "seconds", error: str = "error") -> list[Row]:
    """Rows that no other beats in both cost and error, cheapest first."""
    front: list[Row] = []
    usable = [row for row in rows if math.isfinite(row[error]) and math.isfinite(row[cost])]
    for row in sorted(usable, key=lambda row: (row[cost], row[error])):
        if not front or row[error] < front[-1][error]:
            front.append(row)
    return front


def fitted_slope(rows: Iterable[Row], setting: str, error: str = "error") -> float:
    """Least-squares slope of log error against log of a setting (steps, samples)."""
    points = [(math.log(row[setting]), math.log(row[error])) for row in rows if row[error] > 0]
    mean_x = statistics.fmean(x for x, _ in points)
    mean_y = statistics.fmean(y for _, y in points)
    return sum((x - mean_x) * (y - mean_y) for x, y in points) / sum(
        (x - mean_x) ** 2 for x, _ in points
    )


def pyplot():
    """matplotlib.pyplot, drawing to files only. @raises MissingDependency"""
    try:
        import matplotlib as mpl
    except ImportError as error:
        raise MissingDependency("a plot", "matplotlib", "plot") from error
    mpl.use("Agg")
    from matplotlib import pyplot as plt

    return plt


def draw_lines(
    axes: Axes,
    rows: Sequence[Row],
    style: Callable[[str], dict[str, Any]],
    *,
    cost: str = "seconds",
    scale: float = 1e6,
    floor: float = 0.0,
) -> None:
    """Error against cost, log-log: a line per method through its settings; the front behind."""
    methods = list(dict.fromkeys(row["method"] for row in rows))
    front = pareto(rows, cost)
    axes.plot(
        [scale * row[cost] for row in front],
        [max(row["error"], floor) for row in front],
        color="#f2c14e",
        linewidth=9,
        alpha=0.45,
        solid_capstyle="round",
        zorder=1,
    )
    for method in methods:
        line = [row for row in rows if row["method"] == method]  # in the order of its setting
        x = [scale * row[cost] for row in line]
        y = [max(row["error"], floor) for row in line]
        axes.plot(x, y, label=method.replace("_", " "), zorder=3, **style(method))
    axes.set(xscale="log", yscale="log")
    axes.grid(True, which="major", color="#dddddd", linewidth=0.6, zorder=0)
    axes.tick_params(which="minor", length=2)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)


def spread(places: Sequence[float], gap: float, low: float, high: float) -> list[float]:
    """The places, in order, moved as little as needed to lie `gap` apart between low and high."""
    order = sorted(range(len(places)), key=lambda i: places[i])
    moved = list(places)
    below = low - gap
    for i in order:
        moved[i] = below = max(places[i], below + gap)
    above = high + gap
    for i in reversed(order):
        moved[i] = above = min(moved[i], above - gap)
    return moved


def name_points(
    axes: Axes, labels: Sequence[tuple[float, float, str, str]], *, bold: str = ""
) -> None:
    """Writes (x, y, text, colour) to the right of each point, apart from one another."""
    axes.figure.canvas.draw()
    spots = [axes.transData.transform((x, y)) for x, y, _, _ in labels]
    box = axes.get_window_extent()
    gap = axes.figure.dpi * 0.155
    places = spread([y for _, y in spots], gap, box.y0 + gap / 2, box.y1 - gap / 2)
    for (_, _, text, colour), (x, _), y in zip(labels, spots, places, strict=True):
        axes.annotate(
            text,
            (x + 0.09 * axes.figure.dpi, y),
            xycoords="figure pixels",
            color=colour,
            fontsize=8,
            fontweight="bold" if bold and text.startswith(bold) else "normal",
            va="center",
            annotation_clip=False,
            bbox={"boxstyle": "round,pad=0.1", "color": "white", "alpha": 0.75, "linewidth": 0},
            zorder=5,
        )


def plain_style(method: str, methods: Sequence[str] = ()) -> dict[str, Any]:
    """A colour and a marker of its own for each method."""
    index = list(methods).index(method) if method in methods else 0
    marker = "osD^vPX*<>"[index % 10]
    return {"color": f"C{index % 10}", "marker": marker, "markersize": 5, "linewidth": 1.4}


def plot_rows(rows: Sequence[Row], path: Path | str) -> None:
    """Error against time, one panel per case: for studies that draw nothing of their own."""
    plt = pyplot()
    cases = list(dict.fromkeys(row["case"] for row in rows))
    methods = list(dict.fromkeys(row["method"] for row in rows))
    figure, panels = plt.subplots(
        1, len(cases), figsize=(1.5 + 4.5 * len(cases), 4.6), squeeze=False, layout="constrained"
    )
    for panel, case in zip(panels[0], cases, strict=True):
        mine = [row for row in rows if row["case"] == case and "seconds" in row]
        draw_lines(panel, mine, lambda method: plain_style(method, methods))
        units = dict.fromkeys(row["error_unit"] for row in mine)
        panel.set(title=case, xlabel="time, µs", ylabel=f"error, {' or '.join(units)}")
    handles, labels = panels[0][0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=min(5, len(labels)))
    figure.savefig(path, dpi=150)
    plt.close(figure)
