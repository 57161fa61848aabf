# SPDX-License-Identifier: Apache-2.0
"""Who meets whom, and the lecture's repulsion, from Python and from scene files."""

import pytest

import carom
from carom.scene_file import parse

GROUND = "- {name: ground, static: true, shape: {Plane: {normal: [0, 0, 1]}}}"


def test_groups_and_named_pairs_from_a_scene_file():
    scene = parse(
        f"""
effects: [UniformGravity]
never_meet: [[ground, dropped]]
bodies:
  {GROUND}
  - {{name: held, shape: {{Sphere: {{radius: 0.1}}}}, position: [0, 0, 0.3]}}
  - {{name: ghost, meets: 0, shape: {{Sphere: {{radius: 0.1}}}}, position: [1, 0, 0.3]}}
  - {{name: apart, groups: 2, meets: 0x2, shape: {{Sphere: {{radius: 0.1}}}},
     position: [2, 0, 0.3]}}
  - {{name: dropped, shape: {{Sphere: {{radius: 0.1}}}}, position: [3, 0, 0.3]}}
"""
    )
    assert scene.never == [(0, 4)]
    assert [body.groups for body in scene.bodies] == [1, 1, 1, 2, 1]
    simulation = carom.Simulation(scene)
    simulation.advance(1)
    heights = simulation.poses()[1:, 2]
    assert heights[0] == pytest.approx(0.1, abs=5e-4)  # tolerance::soft_sink
    # Free fall for a second, to the rounding of 60 steps.
    assert heights[1:] == pytest.approx([0.3 - 9.81 / 2] * 3, abs=1e-9)
    reason = next(stage.reason for stage in simulation.plan() if stage.stage == "pairs")
    assert reason.endswith("filters on: groups of 2 bodies, 1 pair that never meet")


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("never_meet: [[ground, grund]]", r"never_meet\[0\]: 'grund', must name a body"),
        ("never_meet: [[ground, ground]]", r"never_meet.*must be two bodies"),
        ("never_meet: [ground]", r"never_meet\[0\]: 'ground', must be two names"),
        ("never_meet: [[ground, wall]]", "static bodies never meet"),
    ],
)
def test_nonsense_about_pairs_is_refused_with_its_line(line, said):
    wall = "- {name: wall, static: true, shape: {Sphere: {radius: 1}}}"
    with pytest.raises(carom.InvalidInput, match=f"scene:1.*{said}"):
        parse(f"{line}\nbodies:\n  {GROUND}\n  {wall}\n")


@pytest.mark.parametrize(("groups", "meets"), [(0, 1), (-1, 1), (1, 2**32), (2**32, 1)])
def test_groups_are_32_bits_and_at_least_one(groups, meets):
    scene = carom.Scene()
    with pytest.raises(carom.InvalidInput, match=r"groups|meets"):
        scene.add(carom.Sphere(1), groups=groups, meets=meets)
    assert len(scene) == 0


def test_repulsion_and_its_energy_are_told():
    speeds = {}
    for name, effect in (
        ("none", ""),
        ("bounded", "effects: [Repulsion: {cap: 1}]"),
        ("unbounded", "effects: [Repulsion: {bounded: false}]"),
    ):
        ball = "- {mass: 1, shape: {Sphere: {radius: 0.5}}, position: [0, 0, 0.4]}"
        simulation = carom.Simulation(parse(f"{effect}\nbodies:\n  {GROUND}\n  {ball}\n"))
        simulation.step(1 / 60)
        energy, report = simulation.energy(), simulation.report.repulsion
        speeds[name] = simulation.twists()[1, 2]
        assert energy.repulsion == pytest.approx(0.5 * report.fastest**2, rel=1e-8)
        assert energy.balance == pytest.approx(0, abs=1e-6 if name != "none" else 1)
    # The lecture's dv = depth / dt: 0.1 m * 60 / s; the sweeps end at 1e-9 of it.
    assert speeds["unbounded"] == pytest.approx(6, abs=1e-7)
    assert speeds["bounded"] == pytest.approx(1, abs=1e-7)
    # Without it the solver moves bodies and lets them keep no speed of the push to speak of: less
    # than a tenth of the bounded form's.
    assert speeds["none"] < 0.1
