# SPDX-License-Identifier: Apache-2.0
"""Trees against the grid: what each bounding volume, build quality and cell size costs.

    python -m carom.studies.trees --plot trees.png

Every row is one method on one mesh and one kind of query: build time, queries per second, memory,
and how many answers differ from a loop over all faces (`wrong`, which must be 0 everywhere). Times
are those of the processor, one thread, so that a busy machine shows little.
"""

from __future__ import annotations

import argparse
import json
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np

from carom import Bvh, HashGrid
from carom.broad import AllFaces

CASES = ("even", "mixed", "flat")
QUERIES = ("short", "long", "closest", "overlaps")
CELL_FACTORS = (0.25, 0.5, 1.0, 2.0, 4.0, 8.0)  # of the automatic size
SAMPLE = 40  # queries also asked of all faces


def mesh(case: str, faces: int, seed: int = 20261122) -> tuple[np.ndarray, np.ndarray]:
    """A test mesh of about `faces` faces: a bumpy sphere of even faces; the same with one face in a
    thousand forty times as large; a terrain ten times as wide as high."""
    n = max(int(np.sqrt(faces / 2)), 4)
    u, v = np.meshgrid(np.linspace(0, 1, n + 1), np.linspace(0, 1, n + 1), indexing="ij")
    u, v = u.ravel(), v.ravel()
    if case == "flat":
        height = 0.3 * np.sin(17 * u) * np.cos(13 * v) + 0.1 * np.sin(61 * u + 40 * v)
        vertices = np.stack([10 * u, 10 * v, height], 1)
    else:
        theta, phi = np.pi * u, 2 * np.pi * v
        r = 1 + 0.2 * np.sin(5 * phi) * np.sin(7 * theta)
        vertices = (
            r * np.stack([np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)])
        ).T
    i, j = np.meshgrid(np.arange(n), np.arange(n), indexing="ij")
    a, b = (i * (n + 1) + j).ravel(), ((i + 1) * (n + 1) + j).ravel()
    triangles = np.concatenate([np.stack([a, b, b + 1], 1), np.stack([a, b + 1, a + 1], 1)])
    if case == "mixed":
        rng = np.random.default_rng(seed)
        large = vertices[
            triangles[rng.permutation(len(triangles))[: max(len(triangles) // 1000, 2)]]
        ]
        large = large.mean(1, keepdims=True) + 40 * (large - large.mean(1, keepdims=True))
        extra = len(vertices) + np.arange(large.shape[0] * 3).reshape(-1, 3)
        vertices = np.concatenate([vertices, large.reshape(-1, 3)])
        triangles = np.concatenate([triangles, extra])
    return vertices, triangles.astype(np.int32)


def queries(vertices: np.ndarray, count: int, seed: int) -> dict[str, tuple[np.ndarray, ...]]:
    """Arguments of each kind of query, in the box of the mesh: segments of 2 % of its diagonal near
    the surface, segments across, points, boxes of 1 %."""
    rng = np.random.default_rng(seed)
    low, high = vertices.min(0), vertices.max(0)
    diagonal = np.linalg.norm(high - low)

    def anywhere() -> np.ndarray:
        return low + (high - low) * rng.random((count, 3))

    near = vertices[rng.integers(len(vertices), size=count)]
    start = near + rng.normal(0, 0.01 * diagonal, (count, 3))
    step = rng.normal(0, 1, (count, 3))
    step *= 0.02 * diagonal / np.linalg.norm(step, axis=1, keepdims=True)
    return {
        "short": (start, start + step),
        "long": (anywhere(), anywhere()),
        "closest": (start,),
        "overlaps": (start - 0.005 * diagonal, start + 0.005 * diagonal),
    }


def _ask(index: Bvh | HashGrid | AllFaces, kind: str, arguments: tuple[np.ndarray, ...]) -> tuple:
    call = {"closest": index.closest, "overlaps": index.overlaps}.get(kind, index.segments)
    return call(*arguments)


def _wrong(index: Bvh | HashGrid, truth: AllFaces, kind: str, arguments: tuple) -> int:
    few = tuple(a[:SAMPLE] for a in arguments)
    ours, theirs = _ask(index, kind, few), _ask(truth, kind, few)
    if kind == "overlaps":
        return int(any(not np.array_equal(a, b) for a, b in zip(ours, theirs, strict=True)))
    return int(np.sum((ours[0] != theirs[0]) | (ours[1] != theirs[1])))


def _timed(call: Callable[[], object], least: float = 0.02) -> float:
    """Seconds per call, the fastest of at least three repeats over at least `least` seconds.

    Where the clock's ticks are longer than a call, the mean.
    """
    best, spent, repeats = np.inf, 0.0, 0
    while spent < least or repeats < 3:
        repeats += 1
        begin = time.thread_time()
        call()
        took = time.thread_time() - begin
        best, spent = min(best, took), spent + took
    return best if best > 0 else spent / repeats


def _methods(
    vertices: np.ndarray, faces: np.ndarray
) -> Iterator[tuple[str, Callable, float | None]]:
    for quality in ("low", "medium", "high"):
        yield f"bvh box {quality}", lambda q=quality: Bvh(vertices, faces, quality=q), None
    for volume in ("sphere", "oriented_box"):
        yield f"bvh {volume}", lambda v=volume: Bvh(vertices, faces, volume=v), None
    automatic = HashGrid(vertices, faces).cell_size
    for factor in CELL_FACTORS:
        size = automatic * factor
        name = "grid automatic" if factor == 1 else f"grid x {factor:g}"
        yield name, lambda s=size: HashGrid(vertices, faces, s), size


def run(
    progress: Callable[[str], None] | None = None,
    *,
    faces: int = 20000,
    count: int = 2000,
    seed: int = 20261122,
) -> list[dict]:
    """Rows of the study. progress: called with a line per method."""
    rows = []
    for case in CASES:
        vertices, triangles = mesh(case, faces, seed)
        asked = queries(vertices, count, seed + 1)
        truth = AllFaces(vertices, triangles)
        methods = [("all faces", lambda v=vertices, t=triangles: AllFaces(v, t), None)]
        for name, build, cell_size in [*methods, *_methods(vertices, triangles)]:
            if progress is not None:
                progress(f"{case}: {name}")
            index = build()
            build_s = _timed(build)
            for kind in QUERIES:
                arguments = asked[kind]
                if name == "all faces":
                    arguments = tuple(a[:SAMPLE] for a in arguments)
                seconds = _timed(lambda i=index, k=kind, a=arguments: _ask(i, k, a))
                wrong = 0 if name == "all faces" else _wrong(index, truth, kind, arguments)
                rows.append(
                    {
                        "study": "trees",
                        "case": case,
                        "method": name,
                        "query": kind,
                        "faces": len(triangles),
                        "cell_size": cell_size,  # m
                        "queries": len(arguments[0]),
                        "error": float(wrong),
                        "error_unit": f"wrong of {SAMPLE}",
                        "seconds": seconds,  # for all queries
                        "build_s": build_s,
                        "queries_per_s": len(arguments[0]) / seconds,
                        "memory_bytes": index.memory_bytes,
                        "wrong": wrong,
                    }
                )
    return rows


def grid_wins(rows: list[dict]) -> list[dict]:
    """Per case and query the best grid beside the best tree: queries per second, and up to how many
    queries per build (in whole decades up to 1e6) some grid is sooner done than every tree, its
    build included; 0: never."""
    out = []
    for case in dict.fromkeys(r["case"] for r in rows):
        for kind in QUERIES:
            here = [r for r in rows if r["case"] == case and r["query"] == kind]
            grids = [r for r in here if r["cell_size"]]
            trees = [r for r in here if r["method"].startswith("bvh")]
            grid = max(grids, key=lambda r: r["queries_per_s"])
            tree = max(trees, key=lambda r: r["queries_per_s"])
            sooner = [n for n in DECADES if _all_in(grids, n) < _all_in(trees, n)]
            out.append(
                {
                    "case": case,
                    "query": kind,
                    "grid": grid["method"],
                    "tree": tree["method"],
                    "ratio": grid["queries_per_s"] / tree["queries_per_s"],
                    "grid_wins": grid["queries_per_s"] > tree["queries_per_s"],
                    "sooner_up_to": max(sooner, default=0),
                }
            )
    return out


DECADES = tuple(10**k for k in range(7))


def _all_in(methods: list[dict], count: int) -> float:
    """Seconds of one build and `count` queries by the method that is then the soonest done."""
    return min(r["build_s"] + count / r["queries_per_s"] for r in methods)


def volume_ratios(rows: list[dict]) -> dict[str, float]:
    """Rays (short and long, geometric mean) per second of each volume over those of boxes."""
    rate = {}
    for volume in ("box medium", "sphere", "oriented_box"):
        rates = [
            r["queries_per_s"]
            for r in rows
            if r["method"] == f"bvh {volume}" and r["query"] in ("short", "long")
        ]
        rate[volume] = float(np.exp(np.mean(np.log(rates))))
    return {v: rate[v] / rate["box medium"] for v in ("sphere", "oriented_box")}


def as_text(rows: list[dict]) -> str:
    """One line per method: what it costs, and thousands of queries per second of each kind. Then
    where the best grid beats the best tree."""
    from carom.commands.output import table

    headers = ["case", "method", "cell, m", "build, ms", "memory, MB"]
    lines = []
    for case in dict.fromkeys(r["case"] for r in rows):
        for method in dict.fromkeys(r["method"] for r in rows if r["case"] == case):
            mine = {r["query"]: r for r in rows if (r["case"], r["method"]) == (case, method)}
            any_row = mine[QUERIES[0]]
            lines.append(
                [
                    case,
                    method,
                    f"{any_row['cell_size']:.3g}" if any_row["cell_size"] else "",
                    f"{1e3 * any_row['build_s']:.3g}",
                    f"{any_row['memory_bytes'] / 1e6:.3g}",
                    *(f"{mine[kind]['queries_per_s'] / 1e3:.4g}" for kind in QUERIES),
                    str(sum(r["wrong"] for r in mine.values())),
                ]
            )
    text = [table([*headers, *(f"{kind}, k/s" for kind in QUERIES), "wrong"], lines), ""]
    for w in grid_wins(rows):
        verdict = "the grid wins" if w["grid_wins"] else "the tree wins"
        up_to = w["sooner_up_to"]
        with_build = f"up to {up_to:g} queries some grid is ahead" if up_to else "no grid is ahead"
        text.append(
            f"{w['case']}, {w['query']}: {verdict}; {w['grid']} answers {w['ratio']:.2g} times as "
            f"many queries per second as {w['tree']}; build included, {with_build}"
        )
    ratios = volume_ratios(rows)
    text.append(
        f"rays walk spheres and oriented boxes one by one, boxes in lanes: {ratios['sphere']:.2g} "
        f"and {ratios['oriented_box']:.2g} times as many per second"
    )
    return "\n".join(text)


# Columns of the plot: key, unit factor, label.
PANELS = (
    ("queries_per_s", 1e-3, "thousand queries per second"),
    ("build_s", 1e3, "build / ms"),
    ("memory_bytes", 1e-6, "memory / MB"),
)


def plot(rows: list[dict], path: str | Path) -> None:
    """Queries per second, build time and memory of the grid over its cell size; the tree of medium
    quality as dashed lines of the same colours."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot as plt
    from matplotlib.lines import Line2D
    from matplotlib.ticker import FixedLocator, LogLocator, NullLocator, StrMethodFormatter

    cases = list(dict.fromkeys(r["case"] for r in rows))
    figure, axes = plt.subplots(
        len(PANELS),
        len(cases),
        figsize=(3.8 * len(cases), 9),
        squeeze=False,
        sharex=True,
        sharey="row",
        layout="constrained",
    )
    for c, case in enumerate(cases):
        here = [r for r in rows if r["case"] == case]
        for a, (key, factor, label) in enumerate(PANELS):
            axis = axes[a][c]
            for k, kind in enumerate(QUERIES if key == "queries_per_s" else QUERIES[:1]):
                mine = {r["method"]: r for r in here if r["query"] == kind}
                colour = f"C{k}" if key == "queries_per_s" else "0.2"
                sizes = [m for m in mine if m.startswith("grid")]
                axis.loglog(
                    [_factor(m) for m in sizes],
                    [factor * mine[m][key] for m in sizes],
                    "o-",
                    color=colour,
                )
                # Dashes that begin at different places, so that equal rates do not hide each other.
                dashes = (2.5 * k, (5, 5))
                axis.axhline(factor * mine["bvh box medium"][key], ls=dashes, color=colour)
            axis.grid(which="major", alpha=0.3)
            axis.xaxis.set_major_locator(FixedLocator(CELL_FACTORS))
            axis.xaxis.set_major_formatter(StrMethodFormatter("{x:g}"))
            axis.xaxis.set_minor_locator(NullLocator())
            axis.yaxis.set_major_locator(LogLocator(subs=(1, 2, 5) if a > 0 else (1,)))
            axis.yaxis.set_major_formatter(StrMethodFormatter("{x:g}"))
            axis.yaxis.set_minor_locator(NullLocator())
            if c == 0:
                axis.set_ylabel(label)
        axes[0][c].set_title(f"{case}, {here[0]['faces']} faces")
        axes[-1][c].set_xlabel("cell size / automatic cell size")
    names = {
        "short": "short segments",
        "long": "long segments",
        "closest": "closest points",
        "overlaps": "overlaps of boxes",
    }
    handles = [Line2D([], [], color=f"C{k}", lw=4, label=names[q]) for k, q in enumerate(QUERIES)]
    handles.append(Line2D([], [], color="0.2", marker="o", label="grid"))
    handles.append(Line2D([], [], color="0.2", ls="--", label="tree of boxes, medium quality"))
    figure.legend(handles=handles, loc="outside upper center", ncols=len(handles), fontsize=9)
    figure.savefig(path, dpi=120)
    plt.close(figure)


def _factor(method: str) -> float:
    """Cell size of a grid's name in automatic sizes."""
    return 1.0 if method.endswith("automatic") else float(method.split()[-1])


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--faces", type=int, default=20000)
    parser.add_argument("--plot", type=Path)
    parser.add_argument("--json", type=Path)
    options = parser.parse_args()
    rows = run(faces=options.faces)
    print(as_text(rows))
    if options.plot:
        plot(rows, options.plot)
    if options.json:
        options.json.write_text(json.dumps(rows, indent=1))
    return int(any(r["wrong"] for r in rows))


if __name__ == "__main__":
    raise SystemExit(main())
