# SPDX-License-Identifier: Apache-2.0
"""Sets of particles against every shape by the lecture's rules: the push out of an overlap, what it
adds, and that no speed carries a particle through."""

import numpy as np
import pytest

import carom
from carom import Scene, Simulation

DT, RADIUS, DEPTH, MASS = 1 / 60, 0.02, 0.005, 0.1
TOP = 0.5
"""m, height at which every shape below ends, above the origin"""

CORNERS = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]) * 0.5


def grid():
    return carom.Sdf(cube_mesh(), 0.05)


def cube_mesh():
    hull = carom.ConvexHull(CORNERS)
    return carom.Mesh(np.array(hull.vertices), np.array(hull.faces))


SHAPES = {
    "plane": lambda: carom.Plane([0, 0, 1], TOP),
    "sphere": lambda: carom.Sphere(0.5),
    "box": lambda: carom.Box([1, 1, 1]),
    "capsule": lambda: carom.Capsule(0.2, 0.6),
    "cylinder": lambda: carom.Cylinder(0.4, 1),
    "cone": lambda: carom.Cone(0.4, 2 / 3),  # its tip is 3/4 of the length above its origin
    "ellipsoid": lambda: carom.Ellipsoid([0.3, 0.4, 0.5]),
    "hull": lambda: carom.ConvexHull(CORNERS),
    "mesh": cube_mesh,
    "sheet": lambda: carom.Mesh([[-1, -1, TOP], [1, -1, TOP], [0, 1, TOP]], [[0, 1, 2]]),
    "sdf": grid,
    "height_field": lambda: carom.HeightField(np.full((5, 5), TOP), 0.25),
    "compound": lambda: carom.Compound([carom.Part(carom.Box([1, 1, 1]))]),
    "particles": lambda: carom.Particles([[0, 0, 0], [0, 0, TOP - 0.1]], 0.1),
}


def beads_above(shape, height, speed=0.0, **beads):
    """Two beads, one over the other, the lower one `height` m above the shape's top."""
    scene = Scene()
    position = [-0.5, -0.5, 0] if isinstance(shape, carom.HeightField) else [0, 0, 0]
    scene.add(shape, static=True, position=position, friction=0)
    scene.add(
        carom.Particles([[0, 0, 0], [0, 0, 0.05]], RADIUS), mass=MASS, friction=0,
        position=[0, 0, TOP + RADIUS + height], velocity=[0, 0, -speed], **beads,
    )  # fmt: skip
    return scene


@pytest.mark.parametrize("kind", SHAPES)
def test_an_overlap_is_pushed_out_by_its_depth_over_the_step(kind):
    """Rule L2: dv = depth / dt along the normal, here 0.3 m/s, so m dv^2 / 2 of energy, booked."""
    scene = beads_above(SHAPES[kind](), -DEPTH)
    scene.effects.append(carom.Repulsion(bounded=False))
    simulation = Simulation(scene, dt=DT)
    simulation.step()
    # iterations end at 1e-9 of the speed; a grid of 5 cm is exact over a flat face
    np.testing.assert_allclose(simulation.twists()[1, :3], [0, 0, DEPTH / DT], atol=1e-6)
    energy = 0.5 * MASS * (DEPTH / DT) ** 2
    assert simulation.energy().repulsion == pytest.approx(energy, rel=1e-5)
    report = simulation.report.repulsion
    assert report.pushed >= 1
    assert report.capped == report.stagnated == 0
    assert report.fastest == pytest.approx(DEPTH / DT, rel=1e-5)


@pytest.mark.parametrize("kind", SHAPES)
def test_no_speed_carries_beads_through(kind):
    """A hit at its time, the gap between a micrometre and half as much again; then it rests."""
    simulation = Simulation(beads_above(SHAPES[kind](), 1.234, 300.0), dt=DT)
    for _ in range(3):
        simulation.step()
        assert simulation.centres()[1, 2] > TOP + 0.9 * RADIUS
    assert simulation.report.sweep.impacts >= 1
    assert simulation.report.sweep.gave_up == 0


def test_without_it_they_are_through():
    for kind in ("sheet", "box"):
        simulation = Simulation(beads_above(SHAPES[kind](), 1.234, 300.0, ccd="never"), dt=DT)
        simulation.step()
        assert simulation.centres()[1, 2] < -TOP


def test_of_beads_in_a_grid_each_is_counted_by_where_its_normal_is_from():
    """Rule L1: both came through the top at 12 m/s, 0.2 m a step. Below its middle the gradient of
    the distance is its normal; in the corner the side is nearer, 5 cm against 10, and only the way
    the bead came tells the right face."""
    scene = Scene()
    scene.add(grid(), static=True)
    scene.add(
        carom.Particles([[0, 0, 0.45], [0.45, 0.013, 0.4]], 0.01), mass=MASS,
        velocity=[0, 0, -12.0], friction=0, ccd="never",
    )  # fmt: skip
    scene.effects.append(carom.Repulsion())
    simulation = Simulation(scene, dt=DT)
    simulation.step()
    report = simulation.report.repulsion
    assert (report.gradient, report.swept_hit, report.velocity, report.kept) == (1, 1, 0, 0)
    assert report.pushed == 2
