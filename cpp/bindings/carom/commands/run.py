# SPDX-License-Identifier: Apache-2.0
"""`carom run`: simulate a scene, say how it ended, what it cost and how wrong it is."""

from __future__ import annotations

import argparse
import contextlib
import csv
import math
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

from carom._core import METHODS, Simulation
from carom.commands.options import add_parser, load_scene, positive_integer, positive_number
from carom.commands.run_result import as_json, as_text
from carom.errors import writable

EXAMPLE = """\
  carom run tower
  carom run scene.yaml --seconds 2 --dt 1/480 --csv path.csv --png end.png
"""

POSE = ["x_m", "y_m", "z_m", "qx", "qy", "qz", "qw"]
TWIST = [f"v{a}_m_per_s" for a in "xyz"] + [f"w{a}_rad_per_s" for a in "xyz"]


def add(subparsers: argparse._SubParsersAction) -> None:
    parser = add_parser(subparsers, "run", "simulate a scene and print how it ended", EXAMPLE)
    option = parser.add_argument
    option("--seconds", type=positive_number, default=5.0, metavar="S", help="simulated (5)")
    option("--dt", type=positive_number, default=1 / 60, metavar="S", help="largest step (1/60)")
    option(
        "--integrator",
        choices=METHODS,
        default="symmetric_top",
        metavar="NAME",
        help="of rotations: " + ", ".join(METHODS),
    )
    option("--csv", type=Path, metavar="FILE", help="write poses and twists of every body")
    option("--every", type=positive_integer, default=1, metavar="N", help="steps per CSV row (1)")
    option("--png", type=Path, metavar="FILE", help="draw the end; needs carom[plot]")
    option("--frames", type=positive_integer, default=1, metavar="N", help="moments drawn (1)")
    option("--size", type=_size, default=(960, 540), metavar="WxH", help="pixels (960x540)")
    option("--quiet", action="store_true", help="no progress bar")
    parser.set_defaults(run=run)


def run(arguments: argparse.Namespace) -> int:
    if arguments.png:
        from carom import render  # fails before the run where its packages are missing

        render.require_packages()
    simulation = Simulation(load_scene(arguments), arguments.dt, integrator=arguments.integrator)
    start = simulation.energy()
    watchers: list[Callable[[int], None]] = []
    with contextlib.ExitStack() as files:
        steps = _step_count(arguments.seconds, arguments.dt)
        if arguments.csv:
            watchers.append(files.enter_context(_recording(arguments, simulation)))
        if arguments.png:
            watchers.append(files.enter_context(_drawing(arguments, simulation, steps)))
        watchers.append(files.enter_context(_progress(arguments, steps)))
        for watch in watchers:
            watch(0)
        for k in range(1, steps + 1):
            simulation.step(arguments.seconds / steps)
            for watch in watchers:
                watch(k)
    (as_json if arguments.json else as_text)(arguments.scene, simulation, start)
    return _verdict(simulation)


def _step_count(seconds: float, dt: float) -> int:
    """Equal steps no longer than dt; a ratio that is whole but for rounding stays whole."""
    ratio = seconds / dt
    whole = math.isclose(ratio, round(ratio), rel_tol=2 * sys.float_info.epsilon)
    return max(1, round(ratio) if whole else math.ceil(ratio))


def _verdict(simulation: Simulation) -> int:
    """1 where a body's state was lost. Solves above their tolerance are told, and are in the
    report: what they left is met again by the next step."""
    report = simulation.report
    if report.contact.gave_up:
        worst = f"worst residual {report.contact.residual:.4g} m/s"
        solves = f"{report.contact.gave_up} contact solves ended above their tolerance"
        print(f"carom: warning: {solves} ({worst})", file=sys.stderr)
    frozen = [body.name for body in simulation.scene.bodies if body.id in report.frozen]
    if frozen:
        names = ", ".join(frozen)
        print(f"carom: the state of {names} went non-finite; held since", file=sys.stderr)
    return 1 if frozen else 0


@contextlib.contextmanager
def _recording(
    arguments: argparse.Namespace, simulation: Simulation
) -> Iterator[Callable[[int], None]]:
    names = simulation.names()
    with writable(arguments.csv, "--csv", "w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(["time_s", "body", *POSE, *TWIST])

        def watch(k: int) -> None:
            if k % arguments.every:
                return
            rows = zip(
                names, simulation.poses().tolist(), simulation.twists().tolist(), strict=True
            )
            for name, pose, twist in rows:
                writer.writerow([simulation.time, name, *pose, *twist])

        yield watch


@contextlib.contextmanager
def _drawing(
    arguments: argparse.Namespace, simulation: Simulation, steps: int
) -> Iterator[Callable[[int], None]]:
    """Keeps the poses of evenly spaced moments, the end among them, and draws them at the end."""
    from carom import render

    writable(arguments.png, "--png", "ab").close()  # said before the run, not after it
    n = arguments.frames
    wanted = {steps if n == 1 else round(i * steps / (n - 1)) for i in range(n)}
    moments = []

    def watch(k: int) -> None:
        if k in wanted:
            moments.append(simulation.poses())

    yield watch
    render.save(arguments.png, simulation.scene, moments, arguments.size)


@contextlib.contextmanager
def _progress(arguments: argparse.Namespace, steps: int) -> Iterator[Callable[[int], None]]:
    if arguments.quiet or not sys.stderr.isatty():
        yield lambda k: None
        return
    from rich.console import Console
    from rich.progress import Progress

    with Progress(console=Console(stderr=True), transient=True) as progress:
        task = progress.add_task(arguments.scene, total=steps)
        yield lambda k: progress.update(task, completed=k)


def _size(text: str) -> tuple[int, int]:
    width, _, height = text.partition("x")
    try:
        size = positive_integer(width), positive_integer(height)
    except argparse.ArgumentTypeError as error:
        raise argparse.ArgumentTypeError(f"{text!r} must be as 960x540") from error
    if max(size) > 4096:
        raise argparse.ArgumentTypeError(f"{text!r} must not exceed 4096 pixels a side")
    return size
