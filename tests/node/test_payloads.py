# SPDX-License-Identifier: Apache-2.0
"""Every payload of msgs_usage, published to a node, does what its first lines say."""

import re
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from carom_ros import strict_yaml
from carom_ros.topic.fill import fill
from carom_ros.topic.types import message_class

FOLDER = Path(__file__).parents[2] / "msgs_usage"
PAYLOADS = sorted(FOLDER.glob("*.yaml"))


def read(path: Path) -> tuple[str, object]:
    """The topic and the message of a payload."""
    text = path.read_text()
    head = dict(re.findall(r"^# (topic|type): (\S+)$", text, re.MULTILINE))
    msg = message_class(head["type"])()
    fill(msg, strict_yaml.load(text, path.name, 1_000_000))
    return head["topic"], msg


def send(bench: object, name: str) -> None:
    bench.send(*read(FOLDER / f"{name}.yaml"))


def pose(bench: object, name: str) -> np.ndarray:
    return bench.world.simulation.poses()[bench.world.names.index(name)]


def twist(bench: object, name: str) -> np.ndarray:
    return bench.world.simulation.twists()[bench.world.names.index(name)]


@pytest.fixture
def crate(make_bench: Callable) -> object:
    """A paused node with the crate of spawn.yaml: what a message did is seen before time runs."""
    bench = make_bench(overrides={"paused": True, "dt_s": 0.001})
    send(bench, "spawn")
    bench.until(lambda: "crate" in bench.world.names)
    return bench


def test_every_payload_is_tried_below() -> None:
    tried = set(re.findall(r'send\(\w+, "(\w+)"\)', Path(__file__).read_text()))
    assert {path.stem for path in PAYLOADS} <= tried


@pytest.mark.parametrize("path", PAYLOADS, ids=lambda p: p.stem)
def test_the_commands_in_a_payload_name_its_own_topic_type_and_file(path: Path) -> None:
    text = path.read_text()
    topic, msg = read(path)
    kind = f"{type(msg).__module__.split('.')[0]}/msg/{type(msg).__name__}"
    assert f'# ros2 topic pub --once {topic} {kind} "$(cat msgs_usage/{path.name})"' in text
    yaml_file = f"--yaml-file msgs_usage/{path.name}"
    assert f"# carom topic pub --once {topic} {kind} {yaml_file}" in text


def test_every_input_in_the_contract_has_a_payload() -> None:
    contract = (FOLDER / "topics.md").read_text()
    section = contract.split("## In\n")[1].split("### ")[0]
    topics = {row.replace("~", "/carom") for row in re.findall(r"^\| `(~/[^`]+)`", section, re.M)}
    assert {read(path)[0].replace("/crate/", "/<name>/") for path in PAYLOADS} == topics


def test_spawn(crate: object) -> None:
    body = crate.world.bodies["crate"]
    assert pose(crate, "crate").tolist() == [0, 0, 1, 0, 0, 0, 1]
    assert crate.world.simulation.scene.bodies[1].mass_properties.mass == pytest.approx(2)
    assert body.frames == {"handle": (0, 0, 0.1)}
    crate.node.paused = False
    crate.ticks(20)
    assert pose(crate, "crate")[2] < 1
    generation = crate.world.generation
    send(crate, "spawn")  # the same identity again
    assert crate.world.generation == generation
    assert pose(crate, "crate")[2] == pytest.approx(1, abs=1e-3)


def test_spawn_sphere(crate: object) -> None:
    send(crate, "spawn_sphere")
    # One step of 1 ms has at most been begun: paused, so velocity is as given.
    assert twist(crate, "ball_7").tolist() == [3, 0, 2, 0, 0, 0]
    assert crate.world.bodies["ball_7"].shape.radius == 0.15


def test_spawn_mesh(crate: object) -> None:
    send(crate, "spawn_mesh")
    mesh = crate.world.bodies["wedge"].shape
    assert (len(mesh.vertices), len(mesh.faces)) == (4, 4)
    mass = crate.world.simulation.scene.bodies[-1].mass_properties.mass
    assert mass == pytest.approx(500 * 0.4**3 / 6, rel=1e-12)  # a corner of a cube, cut off


def test_spawn_array(crate: object) -> None:
    send(crate, "spawn_array")
    crate.until(lambda: len(crate.world.names) == 6)
    assert crate.world.names[2:] == ["brick_1", "brick_2", "brick_3", "step"]
    assert crate.world.bodies["step"].static


def test_wrench(crate: object) -> None:
    send(crate, "wrench")
    crate.world.step()
    # (30 N / 2 kg - 9.81 m/s^2) * 1 ms; rounding of a handful of operations on numbers near 0.01
    assert twist(crate, "crate")[2] == pytest.approx((15 - 9.81) * 0.001, rel=1e-12)


def test_impulse(crate: object) -> None:
    send(crate, "impulse")
    crate.world.step()
    # 1 N s at 0.1 m above the centre: v = J / m; omega = r x J / I, I = m a^2 / 6 = 2 * 0.04 / 6.
    # A cube's tensor is a multiple of one, so the step's own rotation does not change omega.
    assert twist(crate, "crate")[0] == pytest.approx(0.5, rel=1e-12)
    assert twist(crate, "crate")[4] == pytest.approx(0.1 / (2 * 0.04 / 6), rel=1e-9)


def test_bodies_wrench(crate: object) -> None:
    send(crate, "bodies_wrench")
    crate.world.step()
    assert twist(crate, "crate")[1] == pytest.approx(5 / 2 * 0.001, rel=1e-12)


def test_bodies_impulse(crate: object) -> None:
    send(crate, "bodies_impulse")
    crate.world.step()
    assert twist(crate, "crate")[0] == pytest.approx(2, rel=1e-12)


def test_set_state(crate: object) -> None:
    send(crate, "set_state")
    assert pose(crate, "crate")[2] == 2
    # 1 m/s along the body's x, which points along the world's y; sqrt(1/2) is rounded to 2^-53.
    assert twist(crate, "crate")[:3] == pytest.approx([0, 1, 0], abs=1e-15)


def test_delete(crate: object) -> None:
    send(crate, "delete")
    assert crate.world.names == ["ground"]


def test_delete_all(crate: object) -> None:
    send(crate, "spawn_array")
    send(crate, "delete_all")
    crate.until(lambda: crate.world.names == ["ground"])


def test_scene(crate: object) -> None:
    send(crate, "scene")
    assert crate.world.names == ["moon", "probe"]
    crate.world.step()
    assert twist(crate, "probe")[2] == pytest.approx(-1.62 * 0.001, rel=1e-12)
