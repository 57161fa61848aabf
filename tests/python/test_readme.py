# SPDX-License-Identifier: Apache-2.0
"""Runs what the README shows, and compares its output with what the README says it prints.

A fenced block may have a note above it: <!-- file: PATH --> (the block is that file),
<!-- node --> (a node runs meanwhile), <!-- not run: REASON -->. A block ```text shows the output of
the block before it; numbers in it may differ, everything else must not.
"""

import os
import re
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
README = (ROOT / "README.md").read_text()
FENCE = re.compile(
    r"(?:^<!-- (?P<note>.+?) -->\n)?^```(?P<kind>\w+)\n(?P<body>.*?)^```", re.M | re.S
)
NUMBER = re.compile(r"[-+]?\d+(\.\d+)?(e[-+]?\d+)?")


@dataclass
class Block:
    kind: str
    note: str
    body: str
    output: str


def blocks() -> list[Block]:
    found: list[Block] = []
    for match in FENCE.finditer(README):
        kind, note, body = match["kind"], match["note"] or "", match["body"]
        if kind == "text" and found:
            found[-1].output = body
        else:
            found.append(Block(kind, note, body, ""))
    return found


BLOCKS = blocks()
ENVIRONMENT = dict(
    os.environ,
    PATH=f"{Path(sys.executable).parent}:{os.environ['PATH']}",
    NO_COLOR="1",
    COLUMNS="100",
    ROS_DOMAIN_ID=str(1 + os.getpid() % 100),
    ROS_AUTOMATIC_DISCOVERY_RANGE="LOCALHOST",
)


def without_numbers(text: str) -> list[str]:
    lines = [re.sub(r"[\s─━-]+", " ", NUMBER.sub("#", line)).strip() for line in text.splitlines()]
    return [line for line in lines if line]


def run(command: list[str], folder: Path = ROOT) -> str:
    done = subprocess.run(
        command, cwd=folder, env=ENVIRONMENT, capture_output=True, text=True, timeout=120
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def of(kind: str, **notes: bool) -> list[Block]:
    node = notes.get("node", False)
    return [
        b
        for b in BLOCKS
        if b.kind == kind and not b.note.startswith("not run") and b.note.startswith("node") == node
    ]


def first_line(block: Block) -> str:
    return block.body.splitlines()[0]


def check_output(block: Block, printed: str) -> None:
    if block.output:
        assert without_numbers(printed) == without_numbers(block.output)


@pytest.mark.parametrize("block", of("python"), ids=first_line)
def test_python_example_prints_what_it_says(block: Block, tmp_path: Path) -> None:
    check_output(block, run([sys.executable, "-c", block.body], tmp_path))


@pytest.mark.parametrize("block", of("sh"), ids=first_line)
def test_command_prints_what_it_says(block: Block) -> None:
    check_output(block, run(["bash", "-euc", block.body]))


@pytest.mark.parametrize("block", of("cpp"), ids=lambda block: block.note)
def test_cpp_example_is_the_file_that_ctest_runs(block: Block) -> None:
    path = ROOT / block.note.removeprefix("file: ")
    assert block.body == path.read_text().split("\n", 1)[1]  # without the licence line
    program = ROOT / "build/release/cpp/examples" / f"example_{path.stem}"
    if program.exists():  # built by tests/run before this
        check_output(block, run([str(program)]))


@pytest.mark.parametrize("block", of("sh", node=True), ids=first_line)
def test_topic_commands_work_on_a_running_node(block: Block) -> None:
    pytest.importorskip("rclpy", reason="the ROS wheels are not installed")
    node = subprocess.Popen(["carom", "node"], cwd=ROOT, env=ENVIRONMENT, stdout=subprocess.DEVNULL)
    try:
        check_output(block, run(["bash", "-euc", block.body]))
        assert node.poll() is None
    finally:
        node.terminate()
        deadline = time.monotonic() + 20
        while node.poll() is None and time.monotonic() < deadline:
            time.sleep(0.1)
        node.kill()
    assert node.returncode == 0


def test_what_is_not_run_says_why() -> None:
    for block in BLOCKS:
        if block.kind in ("sh", "python", "cpp", "cmake"):
            assert not block.note.startswith("not run") or len(block.note) > len("not run: ...")
    assert {block.kind for block in BLOCKS} >= {"sh", "python", "cpp"}
