# SPDX-License-Identifier: Apache-2.0
"""The command log: every request that was applied, at the step it was applied before.

JSON lines. The first holds the scene, the rest {"step": n, ...}; numbers are written so that they
read back as the same bits, so a replay ends in the same state (same build).
"""

import json
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TextIO

from carom_ros.refusal import Refusal
from carom_ros.requests import Request, from_plain, to_plain

VERSION = 1


@dataclass(frozen=True)
class SceneSource:
    """Where a scene came from, enough to read it again."""

    text: str = ""
    folder: str = ""  # where its mesh files are; empty: it has none


class Journal:
    """Writes a log, at most `limit` bytes of it."""

    def __init__(self, path: Path, scene: SceneSource, dt: float, limit: int) -> None:
        self.path, self.full = path, False
        self._left = limit
        path.parent.mkdir(parents=True, exist_ok=True)
        self._file: TextIO | None = path.open("w", encoding="utf-8")
        self._line({"carom_log": VERSION, "scene": scene.text, "folder": scene.folder, "dt_s": dt})

    def requests(self, step: int, applied: list[Request]) -> None:
        self._line({"step": step, "requests": [to_plain(request) for request in applied]})

    def dt(self, step: int, dt: float) -> None:
        self._line({"step": step, "dt_s": dt})

    def close(self, step: int, state_hash: int) -> None:
        if self._file is not None:
            self._line({"step": step, "end": True, "state_hash": f"{state_hash:016x}"})
            self._file.close()
            self._file = None

    def _line(self, record: dict[str, object]) -> None:
        if self._file is None or self.full:
            return
        line = json.dumps(record, separators=(",", ":")) + "\n"
        self._left -= len(line)
        if self._left < 0:
            self.full = True  # a log with a hole replays something else: it ends here instead
            return
        try:
            self._file.write(line)
            self._file.flush()
        except OSError:  # the disk is full; the simulation is not to stop for it
            self.full = True


@dataclass(frozen=True)
class Entry:
    step: int
    requests: tuple[Request, ...] = ()
    dt: float | None = None
    state_hash: str = ""  # of the last line of a log that was closed


def read(path: Path) -> tuple[SceneSource, float, list[Entry]]:
    """The scene, the step and the entries of a log. @throws Refusal"""
    try:
        lines = [json.loads(line) for line in path.read_text(encoding="utf-8").splitlines()]
        head = lines[0]
        if head["carom_log"] != VERSION:
            raise Refusal("log", str(path), f"must be of version {VERSION}")
        entries = list(_entries(lines[1:]))
        return SceneSource(head["scene"], head["folder"]), float(head["dt_s"]), entries
    except OSError as error:
        raise Refusal("log", str(path), f"cannot be read: {error.strerror}") from None
    except (ValueError, KeyError, IndexError, TypeError) as error:
        if isinstance(error, Refusal):
            raise
        raise Refusal("log", str(path), f"is no log of the node: {error!r}") from None


def _entries(lines: list[dict]) -> Iterator[Entry]:
    for line in lines:
        yield Entry(
            step=line["step"],
            requests=tuple(from_plain(each) for each in line.get("requests", ())),
            dt=line.get("dt_s"),
            state_hash=line.get("state_hash", ""),
        )
