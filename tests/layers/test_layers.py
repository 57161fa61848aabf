# SPDX-License-Identifier: Apache-2.0
"""A file includes its own folder or a lower layer; nothing below the node knows ROS.

Reads the #include and import lines, so the list of layers in the README cannot go stale.
"""

import ast
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
LAYERS = ["numerics", "geometry", "bodies", "scene", "state", "broad narrow", "contact", "step"]
LEVEL = {name: level for level, names in enumerate(LAYERS) for name in names.split()}
INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', re.MULTILINE)


def violations(layer: str, text: str) -> list[str]:
    """The includes of `text`, a file of `layer`, that it may not have."""
    bad = []
    for header in INCLUDE.findall(text):
        parts = header.removeprefix("carom/").split("/")
        if parts[0] in LEVEL and len(parts) > 1:
            if parts[0] != layer and LEVEL[parts[0]] >= LEVEL[layer]:
                bad.append(header)
        elif "/" in header and not header.startswith(("Eigen/", "bits/", "sys/")):
            bad.append(header)  # Eigen, the standard library, the OS
    return bad


def core_files() -> list[Path]:
    roots = [ROOT / "cpp/include/carom", ROOT / "cpp/src"]
    return sorted(p for r in roots for p in r.rglob("*.[chi]*") if p.parent != r)


@pytest.mark.parametrize("path", core_files(), ids=lambda p: str(p.relative_to(ROOT)))
def test_includes_point_down(path: Path) -> None:
    layer = path.relative_to(ROOT / "cpp").parts[1 if "src" in path.parts else 2]
    assert violations(layer, path.read_text()) == []


def test_an_upward_a_sideways_and_a_foreign_include_are_seen() -> None:
    assert violations("geometry", '#include "carom/step/plan.hpp"') == ["carom/step/plan.hpp"]
    assert violations("narrow", '#include "broad/bvh.hpp"') == ["broad/bvh.hpp"]
    assert violations("scene", "#include <rclcpp/rclcpp.hpp>") == ["rclcpp/rclcpp.hpp"]
    assert violations("step", '#include "carom/numerics/rotation.hpp"\n#include <vector>') == []


def imports(path: Path) -> set[str]:
    names = set()
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.Import):
            names |= {alias.name.split(".")[0] for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.level == 0:
            names.add((node.module or "").split(".")[0])
    return names


@pytest.mark.parametrize("path", sorted((ROOT / "cpp").rglob("*.py")), ids=lambda p: p.name)
def test_the_python_package_knows_no_ros(path: Path) -> None:
    ros = {"rclpy", "carom_ros", "geometry_msgs", "std_msgs", "visualization_msgs"}
    assert imports(path) & ros == set()
