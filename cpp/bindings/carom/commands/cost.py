# SPDX-License-Identifier: Apache-2.0
"""`carom cost`: what accuracy costs in time, method by method."""

from __future__ import annotations

import argparse
import contextlib
import importlib
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path

from carom.commands.output import print_json, table
from carom.studies import STUDIES
from carom.studies.common import Progress, Row, as_json, columns_of, machine, pareto, plot_rows
from carom.studies.common import write_csv as save_csv
from carom.studies.common import write_json as save_json

EXAMPLE = """\
  carom cost --list
  carom cost --study rotation
  carom cost --study rotation --out results --no-plot
"""


def add(subparsers: argparse._SubParsersAction) -> None:
    summary = "show what accuracy costs in time, as a table, CSV, JSON and a plot"
    parser = subparsers.add_parser(
        "cost",
        help=summary,
        description=summary[0].upper() + summary[1:] + ".",
        epilog="example:\n" + EXAMPLE,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    which = parser.add_mutually_exclusive_group(required=True)
    which.add_argument("--study", choices=sorted(STUDIES), metavar="NAME", help=_names())
    which.add_argument("--list", action="store_true", help="print the studies and stop")
    option = parser.add_argument
    option("--out", type=Path, default=Path(), metavar="DIR", help="folder of the files (here)")
    option("--no-plot", action="store_true", help="no PNG; else needs carom[plot]")
    option("--no-files", action="store_true", help="only print; write nothing")
    option("--quiet", action="store_true", help="no progress bar")
    option("--json", action="store_true", help="print the result as JSON")
    parser.set_defaults(run=run)


def _names() -> str:
    return "one of " + ", ".join(sorted(STUDIES))


def run(arguments: argparse.Namespace) -> int:
    if arguments.list:
        if arguments.json:
            print_json("carom.studies/1", {"studies": STUDIES})
        else:
            print(table(["study", "shows"], sorted(STUDIES.items())))
        return 0
    name = arguments.study
    draws = not (arguments.no_plot or arguments.no_files)
    if draws:
        from carom.studies.common import pyplot

        pyplot()  # fails before the work where it is missing
    study = importlib.import_module(f"carom.studies.{name}")
    with _progress(arguments) as progress:
        rows = study.run(progress)
    written = [] if arguments.no_files else _write(arguments, study, rows, draws)
    if arguments.json:
        print_json("carom.cost/1", {**as_json(name, rows), "files": list(map(str, written))})
        return 0
    own_table = getattr(study, "as_text", None)
    if own_table is not None:
        print(own_table(rows))
    else:
        _print_table(rows)
    about = machine()
    print(f"\n{about['cpu']}, {about['cores']} cores, {about['system']}, carom {about['carom']}")
    if own_table is None:
        print("* on the Pareto front of its case: no method is both faster and more accurate")
    for path in written:
        print(f"wrote {path}")
    return 0


def _write(arguments: argparse.Namespace, study, rows: list[Row], draws: bool) -> list[Path]:
    arguments.out.mkdir(parents=True, exist_ok=True)
    base = arguments.out / f"{arguments.study}_study"
    written = [base.with_suffix(".csv"), base.with_suffix(".json")]
    save_csv(rows, written[0])
    save_json(arguments.study, rows, written[1])
    if draws:
        written.append(base.with_suffix(".png"))
        getattr(study, "plot", plot_rows)(rows, written[-1])
    return written


SETTINGS = ("steps", "samples", "queries", "tolerance")


def _print_table(rows: Sequence[Row]) -> None:
    """One row per measurement, by case and time; the Pareto front of each case is starred."""
    if not any("seconds" in row and "error" in row for row in rows):
        columns = columns_of(rows)  # a study with measures of its own
        print(table(columns, [[_plain(row.get(column)) for column in columns] for row in rows]))
        return
    setting = next((key for key in SETTINGS if any(key in row for row in rows)), None)
    headers = ["case", "method", *([setting] if setting else []), "error", "unit", "time"]
    counted = any(row.get("instructions") for row in rows)
    lines = []
    for case in dict.fromkeys(row["case"] for row in rows):
        mine = [r for r in rows if r["case"] == case and "seconds" in r and "error" in r]
        front = [id(row) for row in pareto(mine)]
        for row in sorted(mine, key=lambda row: row["seconds"]):
            star = " *" if id(row) in front else ""
            line = [case, row["method"] + star]
            if setting:
                line.append(f"{row.get(setting, ''):g}" if row.get(setting) is not None else "")
            line += [f"{row['error']:.2e}", row.get("error_unit", ""), _time(row["seconds"])]
            if counted:
                line.append(str(row.get("instructions") or ""))
            lines.append(line)
    print(table([*headers, *(["instructions/step"] if counted else [])], lines))


def _plain(value: object) -> str:
    return f"{value:.4g}" if isinstance(value, float) else "" if value is None else str(value)


def _time(seconds: float) -> str:
    for unit, size in (("s", 1.0), ("ms", 1e-3), ("µs", 1e-6)):
        if seconds >= size:
            return f"{seconds / size:.3g} {unit}"
    return f"{seconds / 1e-9:.3g} ns"


@contextlib.contextmanager
def _progress(arguments: argparse.Namespace) -> Iterator[Progress | None]:
    """A bar on stderr for (done, in all), a line of text for a study that names its parts."""
    if arguments.quiet or not sys.stderr.isatty():
        yield None
        return
    from rich.console import Console
    from rich.progress import Progress as Bar

    with Bar(console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task(arguments.study, total=None)

        def progress(done: int | str, total: int | None = None) -> None:
            if isinstance(done, str):
                bar.update(task, description=done)
            else:
                bar.update(task, completed=done, total=total)

        yield progress
