# SPDX-License-Identifier: Apache-2.0
"""The package that colcon builds is the package that pip installs."""

import argparse
import ast
import re
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

from ruamel.yaml import YAML

from carom_ros import command

ROOT = Path(__file__).parents[2]
PACKAGE = ROOT / "ros_pkg"
MANIFEST = ElementTree.parse(PACKAGE / "package.xml").getroot()
# Python names of packages whose manifest name is another.
NAMES = {"numpy": "python3-numpy", "ruamel": "python3-ruamel.yaml"}
LAUNCH_ONLY = {"launch", "launch_ros", "ament_index_python"}


def imported(folder: Path) -> set[str]:
    found = set()
    for path in folder.rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_text())):
            if isinstance(node, ast.Import):
                found |= {alias.name.split(".")[0] for alias in node.names}
            elif isinstance(node, ast.ImportFrom) and node.level == 0:
                found.add(node.module.split(".")[0])
    return found - set(sys.stdlib_module_names) - {"carom_ros"}


def test_the_manifest_names_what_the_code_imports_and_nothing_else() -> None:
    assert MANIFEST.get("format") == "3"
    depends = {each.text for each in MANIFEST.findall("exec_depend")}
    needed = {NAMES.get(name, name) for name in imported(PACKAGE / "carom_ros")}
    needed |= imported(PACKAGE / "launch") & {"launch", "launch_ros"}
    assert depends == needed
    assert imported(PACKAGE / "launch") <= LAUNCH_ONLY


def test_setup_py_and_pyproject_offer_the_same_commands() -> None:
    for line in re.findall(
        r'f"(\w+) = \{NAME\}\.(\S+:add_\w+)"', (PACKAGE / "setup.py").read_text()
    ):
        name, target = line
        assert f'{name} = "carom_ros.{target}"' in (ROOT / "pyproject.toml").read_text()


def test_the_commands_join_the_command_line_of_carom() -> None:
    parser = argparse.ArgumentParser()
    commands = parser.add_subparsers()
    command.add_node_command(commands)
    command.add_topic_command(commands)
    args = parser.parse_args(["node", "tower", "--dt", "1/500", "--ros-args", "-p", "a:=1"])
    assert (args.scene, args.dt, args.ros_args) == ("tower", 0.002, ["-p", "a:=1"])
    assert callable(args.run)
    args = parser.parse_args(["topic", "echo", "/carom/poses", "--once", "--json"])
    assert (args.topic_name, args.once, args.json) == ("/carom/poses", True, True)
    assert callable(args.run)


def test_one_version_everywhere() -> None:
    versions = {
        MANIFEST.findtext("version"),
        ElementTree.parse(ROOT / "package.xml").getroot().findtext("version"),
        re.search(r'version="([\d.]+)"', (PACKAGE / "setup.py").read_text()).group(1),
        re.search(r'^version = "([\d.]+)"', (ROOT / "pyproject.toml").read_text(), re.M).group(1),
    }
    assert len(versions) == 1


def test_the_rviz_layout_shows_topics_the_node_has() -> None:
    layout = YAML(typ="safe", pure=True).load((PACKAGE / "rviz" / "carom.rviz").read_text())
    manager = layout["Visualization Manager"]
    topics = {each["Topic"]["Value"] for each in manager["Displays"] if "Topic" in each}
    contract = (ROOT / "msgs_usage" / "topics.md").read_text()
    assert topics
    assert all(f"`{topic.replace('/carom', '~')}`" in contract for topic in topics)
    assert manager["Global Options"]["Fixed Frame"] == "world"


def test_the_contract_names_every_parameter_with_its_default() -> None:
    from carom_ros.parameters import SPECS

    contract = (ROOT / "msgs_usage" / "topics.md").read_text().split("## Parameters")[1]
    for spec in SPECS:
        assert f"`{spec.name}`" in contract, spec.name
        row = re.search(rf"^\| `{spec.name}` \| (\S+) \|", contract, re.M)
        if row:
            shown = row.group(1)
            value = eval(shown) if "/" in shown else YAML(typ="safe", pure=True).load(shown)
            assert value == spec.default, spec.name
