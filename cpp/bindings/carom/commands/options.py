# SPDX-License-Identifier: Apache-2.0
"""What several commands share: the scene argument, numbers and the parser's form."""

from __future__ import annotations

import argparse
import math
from fractions import Fraction

from carom._core import Scene
from carom.scenes import scene_names, scene_path


def add_parser(
    subparsers: argparse._SubParsersAction, name: str, summary: str, example: str
) -> argparse.ArgumentParser:
    """A parser with the scene argument, `--json` and an example at the end of its help."""
    parser: argparse.ArgumentParser = subparsers.add_parser(
        name,
        help=summary,
        description=summary[0].upper() + summary[1:] + ".",
        epilog="example:\n" + example,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    shipped = ", ".join(scene_names())
    parser.add_argument("scene", metavar="SCENE", help=f"a scene file, or one of {shipped}")
    parser.add_argument("--json", action="store_true", help="print the result as JSON")
    return parser


def load_scene(arguments: argparse.Namespace) -> Scene:
    return Scene.load(scene_path(arguments.scene))


def positive_number(text: str) -> float:
    """A number > 0, also written as a fraction: 1/240."""
    try:
        value = float(Fraction(text.replace(" ", "")))
    except (ValueError, ZeroDivisionError, OverflowError):
        value = math.nan
    if not value > 0:
        raise argparse.ArgumentTypeError(f"{text!r} must be a number > 0, as 0.005 or 1/240")
    return value


def positive_integer(text: str) -> int:
    if not (text.isdecimal() and int(text) > 0):
        raise argparse.ArgumentTypeError(f"{text!r} must be a whole number > 0")
    return int(text)
