#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Instructions per body and step of every rotation method, by callgrind, so free of noise.

    count_instructions.py build/release --out cpp/bindings/carom/studies/rotation_instructions.json

Builds rotation_steps.cpp against the library of that build, runs each method for N and 2 N steps
and divides the difference. Methods that run in lanes are counted a second time there, per body.
"""

from __future__ import annotations

import argparse
import json
import re
import subprocess
import tempfile
from pathlib import Path

HERE = Path(__file__).parent
METHODS = [
    "lecture_gram_schmidt",
    "lecture_polar",
    "lecture_exponential",
    "lecture_quaternion",
    "lecture_quaternion_sqrt",
    "midpoint",
    "implicit_midpoint",
    "cayley",
    "symmetric_top",
    "symmetric_top_4",
]
LANES = [m for m in METHODS if m not in METHODS[:2] and m != "implicit_midpoint"]


def collected(program: Path, *arguments: object) -> int:
    command = ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", str(program)]
    done = subprocess.run(
        [*command, *map(str, arguments)], capture_output=True, text=True, check=True
    )
    found = re.search(r"Collected : (\d+)", done.stderr)
    assert found, done.stderr
    return int(found[1])


def eigen_of(build: Path) -> str:
    cache = (build / "CMakeCache.txt").read_text()
    found = re.search(r"^Eigen3_DIR:\w+=(.*)/share/eigen3/cmake$", cache, re.MULTILINE)
    return f"{found[1]}/include/eigen3" if found else "/usr/include/eigen3"


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("build", type=Path, help="a CMake build folder with libcarom.a")
    parser.add_argument("--out", type=Path, help="JSON; without it only the table is printed")
    arguments = parser.parse_args()
    counts: dict[str, int] = {}
    with tempfile.TemporaryDirectory() as folder:
        program = Path(folder) / "rotation_steps"
        include = [f"-I{HERE.parent / 'include'}", "-isystem", eigen_of(arguments.build)]
        source = [str(HERE / "rotation_steps.cpp"), str(arguments.build / "libcarom.a")]
        flags = ["g++", "-std=c++20", "-O2"]
        subprocess.run([*flags, *include, *source, "-o", str(program)], check=True)
        for method in METHODS:
            few, many = (collected(program, method, n) for n in (1000, 2000))
            counts[method] = round((many - few) / 1000)
        for method in LANES:
            few, many = (collected(program, method, n, 64) for n in (50, 100))
            counts[f"lanes/{method}"] = round((many - few) / 50 / 64)
    for name, count in counts.items():
        print(f"{name:32} {count:6}")
    compiler = subprocess.run(["g++", "--version"], capture_output=True, text=True, check=True)
    if arguments.out:
        content = {
            "compiler": compiler.stdout.splitlines()[0],
            "body": "moments 1, 2, 3 kg m^2, 0.1 rad per step",
            "instructions_per_step": counts,
        }
        arguments.out.write_text(json.dumps(content, indent=1) + "\n")


if __name__ == "__main__":
    main()
