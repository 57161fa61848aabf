# SPDX-License-Identifier: Apache-2.0
"""The command line, as another process sees it: output, exit codes, files."""

import csv
import json
import os
import signal
import subprocess
import sys
import time

import pytest

import carom
from carom.cli import main

SCENE = """\
effects: [UniformGravity]
bodies:
  - {name: ground, static: true, shape: {Plane: {normal: [0, 0, 1]}}}
  - {name: ball, shape: {Sphere: {radius: 0.25}}, position: [0, 0, 1.0]}
"""
LONE = "bodies: [{name: brick, shape: {Box: {extents: [1, 2, 3]}}, angular_velocity: [0, 1, 0]}]\n"


@pytest.fixture
def scene(tmp_path):
    path = tmp_path / "scene.yaml"
    path.write_text(SCENE)
    return str(path)


def call(*arguments, **options):
    return subprocess.run(
        [sys.executable, "-m", "carom", *map(str, arguments)],
        capture_output=True, text=True, timeout=120, check=False, **options,
    )  # fmt: skip


def test_run_prints_bodies_energy_contacts_and_stages(scene):
    done = call("run", scene, "--seconds", "0.5", "--dt", "1/100")
    assert done.returncode == 0, done.stderr
    assert done.stderr == ""  # no progress where there is no terminal
    lines = done.stdout.splitlines()
    assert lines[0].startswith(f"{scene}: 2 bodies, 0.5 s in 50 steps, ")
    (ball,) = (line.split() for line in lines if line.startswith("ball "))
    # In free fall until 0.39 s, at rest on its radius after.
    assert float(ball[3]) == pytest.approx(0.25, abs=0.02)
    for start in (
        "ground ",
        "energy J: kinetic ",
        "contacts: ",
        "gravity ",
        "solve ",
        "integrate ",
    ):
        assert any(line.startswith(start) for line in lines), start


def test_run_json_has_a_schema_units_and_the_same_numbers_as_the_library(scene):
    done = call("run", scene, "--seconds", "0.25", "--dt", "0.01", "--json")
    result = json.loads(done.stdout)
    assert result["schema"] == "carom.run/1"
    assert result["ok"] is True
    simulation = carom.Simulation(carom.Scene.load(scene), dt=0.01)
    simulation.advance(0.25)
    assert result["steps"] == 25
    assert result["bodies"][1]["name"] == "ball"
    assert result["bodies"][1]["position_m"] == simulation.poses()[1, :3].tolist()
    assert result["bodies"][1]["velocity_m_per_s"] == simulation.twists()[1, :3].tolist()
    assert result["energy"]["kinetic_j"] == simulation.energy().kinetic
    assert {stage["stage"] for stage in result["stages"]} == {s.stage for s in simulation.plan()}
    assert "NaN" not in done.stdout


def test_run_writes_a_row_per_body_and_moment(scene, tmp_path):
    path = tmp_path / "path.csv"
    done = call("run", scene, "--seconds", "0.1", "--dt", "0.01", "--csv", path, "--every", "5")
    assert done.returncode == 0, done.stderr
    with path.open() as file:
        rows = list(csv.DictReader(file))
    assert [(float(r["time_s"]), r["body"]) for r in rows] == [
        (t, body) for t in (0.0, 0.05, 0.1) for body in ("ground", "ball")
    ]
    speeds = [float(r["vz_m_per_s"]) for r in rows if r["body"] == "ball"]
    assert speeds == pytest.approx([0, -9.81 * 0.05, -9.81 * 0.1], rel=1e-12)


def test_explain_names_only_what_the_scene_needs(tmp_path):
    path = tmp_path / "lone.yaml"
    path.write_text(LONE)
    result = json.loads(call("explain", path, "--json").stdout)
    assert result["schema"] == "carom.explain/1"
    on = [stage for stage in result["stages"] if stage["on"]]
    assert [stage["stage"] for stage in on] == ["integrate"]
    assert "gyroscopic term on" in on[0]["reason"]
    assert result["effects"] == []
    text = call("explain", path).stdout
    runs, _, left_out = text.partition("left out")
    assert "integrate" in runs
    assert "contacts" not in runs
    assert "contacts" in left_out


def test_explain_tells_the_formula_and_energy_of_each_effect(scene):
    text = call("explain", scene).stdout
    assert "UniformGravity  F = m g  U = -m g . x" in text
    assert "acceleration=[0.0, 0.0, -9.81]" in text


def test_bad_input_exits_2_with_the_place(tmp_path):
    path = tmp_path / "bad.yaml"
    path.write_text(SCENE.replace("radius: 0.25", "radius: -1"))
    done = call("run", path)
    assert done.returncode == 2
    assert (
        done.stderr
        == "carom: bad.yaml:4 bodies[1].shape.Sphere.radius: -1 m, must be finite and > 0\n"
    )
    assert done.stdout == ""


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ([], "the following arguments are required: COMMAND"),
        (["fly"], "invalid choice: 'fly'"),
        (["run"], "the following arguments are required: SCENE"),
        (["run", "tower", "--dt", "0"], "'0' must be a number > 0"),
        (["run", "tower", "--seconds", "nan"], "'nan' must be a number > 0"),
        (["run", "tower", "--frames", "0"], "'0' must be a whole number > 0"),
        (["run", "tower", "--size", "9"], "'9' must be as 960x540"),
        (["run", "tower", "--integrator", "best"], "invalid choice: 'best'"),
        (["run", "space", "--csv", "/no/where.csv"], "--csv: /no/where.csv, must be writable"),
        (["run", "space", "--png", "/no/where.png"], "--png: /no/where.png, must be writable"),
        (["run", "towr"], "did you mean tower?"),
    ],
)
def test_bad_usage_exits_2(arguments, message):
    done = call(*arguments)
    assert done.returncode == 2
    assert message in done.stderr


def test_a_failed_scene_exits_1_and_says_why(tmp_path):
    """A speed that overflows: the body is held where it was, the run goes on and the exit tells."""
    path = tmp_path / "fast.yaml"
    path.write_text(
        "bodies: [{name: dart, shape: {Sphere: {radius: 1}}, velocity: [1e308, 0, 0]}]\n"
    )
    done = call("run", path, "--seconds", "100", "--dt", "10")
    assert done.returncode == 1
    assert "the state of dart went non-finite" in done.stderr


def test_a_missing_package_exits_3_with_the_line_that_installs_it(scene, tmp_path):
    (tmp_path / "PIL").mkdir()
    (tmp_path / "PIL" / "__init__.py").write_text("raise ImportError('hidden by the test')\n")
    paths = [str(tmp_path), *filter(None, [os.environ.get("PYTHONPATH")])]
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(paths)}
    done = call("run", scene, "--png", tmp_path / "end.png", env=environment)
    assert done.returncode == 3
    assert "pip install 'carom[plot]'" in done.stderr


def test_an_interrupt_exits_130(scene):
    process = subprocess.Popen(
        [sys.executable, "-m", "carom", "run", scene, "--seconds", "1e6"],
        stderr=subprocess.PIPE,
        # A shell's background job hands down an ignored SIGINT; a person's terminal does not.
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    )
    try:
        time.sleep(2.0)  # it is running by then; were it not, Python itself would exit otherwise
        process.send_signal(signal.SIGINT)
        _, errors = process.communicate(timeout=60)
    finally:
        process.kill()
    assert process.returncode == 130
    assert b"Traceback" not in errors


def test_a_reader_that_leaves_is_no_error(scene):
    command = f"{sys.executable} -m carom run {scene} --seconds 0.1 | head -c 1"
    done = subprocess.run(
        command, shell=True, capture_output=True, text=True, timeout=60, check=False
    )
    assert done.stderr == ""


@pytest.mark.parametrize("command", ["run", "explain"])
def test_help_holds_an_example(command):
    done = call(command, "--help")
    assert done.returncode == 0
    assert f"example:\n  carom {command} tower" in done.stdout


def test_version_names_library_eigen_and_compiler():
    done = call("--version")
    assert done.returncode == 0
    assert done.stdout.startswith(f"carom {carom.__version__}, Eigen 3.")


def test_a_command_of_another_package_is_found_and_one_that_cannot_load_exits_3(
    monkeypatch, capsys
):
    class Point:
        def __init__(self, name, load):
            self.name, self.load = name, load

    def add_wave(subparsers):
        subparsers.add_parser("wave").set_defaults(run=lambda arguments: 42)

    def load_node():
        raise ModuleNotFoundError("No module named 'rclpy'", name="rclpy")

    points = [Point("wave", lambda: add_wave), Point("node", load_node)]
    monkeypatch.setattr("carom.cli.entry_points", lambda group: points)
    assert main(["wave"]) == 42
    assert main(["node", "scene.yaml", "--quiet"]) == 3
    assert "carom node needs rclpy: pip install 'carom[ros]'" in capsys.readouterr().err
