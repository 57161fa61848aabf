# SPDX-License-Identifier: Apache-2.0
"""Runs a command log again, without ROS and as fast as it goes."""

from dataclasses import dataclass
from pathlib import Path

import carom
from carom_ros import journal
from carom_ros.journal import SceneSource
from carom_ros.refusal import Refusal
from carom_ros.world import World, default_scene


@dataclass(frozen=True)
class Replay:
    world: World
    steps: int
    expected: str  # state hash the log ends with; empty when it ends without
    reached: str

    @property
    def same(self) -> bool:
        return self.expected == self.reached


def scene_of(source: SceneSource) -> carom.Scene:
    """The scene a log starts from. @throws InvalidInput"""
    if not source.text:
        return default_scene()
    from carom.scene_file import parse

    folder = Path(source.folder) if source.folder else None
    return parse(source.text, source="log", folder=folder)


def replay(path: Path) -> Replay:
    """@throws Refusal for a file that is no log, or that asks what cannot be done"""
    source, dt, entries = journal.read(path)
    # The log holds what was accepted, so its number of bodies needs no bound here.
    world = World(scene_of(source), dt, max_bodies=2**31)
    expected = ""
    for entry in entries:
        if entry.step < world.steps:
            raise Refusal("log", f"step {entry.step}", "must not go back")
        while world.steps < entry.step:
            world.step()
        if entry.dt is not None:
            world.set_dt(entry.dt)
        for request in entry.requests:
            outcome = world.apply(request)
            if outcome.refusal is not None:
                raise Refusal("log", str(outcome.refusal), f"refused at step {entry.step}")
        world.settle()
        expected = entry.state_hash or expected
    return Replay(world, world.steps, expected, f"{world.simulation.state_hash():016x}")
