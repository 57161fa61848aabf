# SPDX-License-Identifier: Apache-2.0
"""`carom explain`: what a step of a scene computes and why, and what it leaves out."""

from __future__ import annotations

import argparse
from typing import Any

from carom._core import Scene, compile, effects_table
from carom.commands.options import add_parser, load_scene
from carom.commands.output import print_json, table

EXAMPLE = """\
  carom explain tower
  carom explain scene.yaml --json
"""


def add(subparsers: argparse._SubParsersAction) -> None:
    summary = "say what a step of the scene computes and why, and what is off and why"
    add_parser(subparsers, "explain", summary, EXAMPLE).set_defaults(run=run)


def run(arguments: argparse.Namespace) -> int:
    scene = load_scene(arguments)
    stages, effects = compile(scene).stages, _effects(scene)
    if arguments.json:
        rows = [
            {"stage": s.stage, "on": s.on, "reason": s.reason, "bodies": s.bodies} for s in stages
        ]
        print_json("carom.explain/1", {"scene": arguments.scene, "stages": rows, **effects})
        return 0
    on = [(s.stage, str(s.bodies), s.reason) for s in stages if s.on]
    off = [(s.stage, "", s.reason) for s in stages if not s.on]
    print(table(["a step runs", "bodies", "because"], on) if on else "a step runs nothing")
    if off:
        print("\n" + table(["left out", "      ", "because"], off))
    if effects["effects"]:
        columns = ["effect", "force", "energy or power", "as given"]
        keys = ["name", "formula", "energy", "given"]
        print("\n" + table(columns, [[e[key] for key in keys] for e in effects["effects"]]))
    return 0


def _effects(scene: Scene) -> dict[str, Any]:
    """The effects of the scene with their rows of the effects table."""
    info = {row.name: row for row in effects_table()}
    used = [(type(effect).__name__, repr(effect)) for effect in scene.effects]
    rows = [
        {
            "name": name,
            "stage": info[name].stage,
            "formula": info[name].formula,
            "energy": info[name].energy,
            "given": given.partition("(")[2].removesuffix(")"),
        }
        for name, given in used
    ]
    names = {name for name, _ in used}
    return {"effects": rows, "effects_not_used": [n for n in info if n not in names]}
