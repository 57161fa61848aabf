# SPDX-License-Identifier: Apache-2.0
"""What requests do to bodies, against closed forms; and the log that replays them."""

import dataclasses
import json
from pathlib import Path

import numpy as np
import pytest

import carom
from carom_ros.journal import Journal, SceneSource
from carom_ros.refusal import Refusal
from carom_ros.replay import replay
from carom_ros.requests import (
    Delete,
    DeleteAll,
    Impulse,
    LoadScene,
    Request,
    Reset,
    SetState,
    ShapeSpec,
    Spawn,
    Wrench,
)
from carom_ros.world import World, default_scene

DT = 1 / 256  # a power of two: times of steps are exact
# A dozen operations on numbers of one size, each wrong by 2^-53 of it: 1e-14 leaves room for ten.
ROUNDING = 1e-14


def ball(name: str = "ball", id_: int = 1, **changes: object) -> Spawn:
    spawn = Spawn(
        "test", "t", id_, name, ShapeSpec("sphere", (0.5,)), (0, 0, 10), (0, 0, 0, 1),
        properties={"mass": 2.0},
    )  # fmt: skip
    return dataclasses.replace(spawn, **changes)


def do(world: World, *requests: Request) -> None:
    for request in requests:
        world.submit(request)
    for outcome in world.boundary():
        assert outcome.refusal is None, outcome.refusal


def refused(world: World, request: Request) -> Refusal:
    world.submit(request)
    (outcome,) = world.boundary()
    assert outcome.refusal is not None
    return outcome.refusal


def run(world: World, seconds: float) -> None:
    for _ in range(round(seconds / world.dt)):
        world.step()


def twist(world: World, name: str = "ball") -> np.ndarray:
    return world.simulation.twists()[world.names.index(name)]


@pytest.fixture
def space() -> World:
    """Nothing: no gravity, no ground."""
    return World(carom.Scene(), DT)


def test_a_node_without_a_scene_has_gravity_and_a_ground() -> None:
    world = World(default_scene(), DT)
    assert world.names == ["ground"]
    assert world.bodies["ground"].static
    do(world, ball())
    run(world, 0.5)
    assert twist(world)[2] == pytest.approx(-9.81 * 0.5, rel=ROUNDING * 128)  # 128 sums


def test_a_held_wrench_ends_after_its_time(space: World) -> None:
    do(space, ball(), Wrench("t", "ball", (4, 0, 0), (0, 0, 0), hold=0.5))
    run(space, 2)
    assert twist(space)[0] == pytest.approx(4 / 2 * 0.5, rel=ROUNDING * 128)
    assert not space.wrenches().any()


def test_a_wrench_without_an_end_is_held_until_zeros_clear_it(space: World) -> None:
    do(space, ball(), Wrench("t", "ball", (4, 0, 0), (0, 0, 0), hold=0))
    run(space, 2)
    assert space.wrenches()[0].tolist() == [4, 0, 0, 0, 0, 0]
    do(space, Wrench("t", "ball", (0, 0, 0), (0, 0, 0), hold=0))
    run(space, 1)
    assert twist(space)[0] == pytest.approx(4 / 2 * 2, rel=ROUNDING * 512)


def test_a_second_wrench_replaces_the_first(space: World) -> None:
    do(space, ball(), Wrench("t", "ball", (4, 0, 0), (0, 0, 0)))
    do(space, Wrench("t", "ball", (0, 6, 0), (0, 0, 0)))
    run(space, 1)
    assert twist(space)[:3] == pytest.approx([0, 3, 0], rel=ROUNDING * 256)


def test_a_wrench_in_body_axes_turns_with_the_body(space: World) -> None:
    half = np.sqrt(0.5)  # a quarter turn about z takes the body's x to the world's y
    do(space, ball(orientation=(0, 0, half, half)), Wrench("t", "ball", (4, 0, 0), (0, 0, 0)))
    assert space.wrenches()[0, :3] == pytest.approx([0, 4, 0], abs=4 * ROUNDING)
    run(space, 1)
    assert twist(space)[:3] == pytest.approx([0, 2, 0], abs=2 * ROUNDING * 256)


def test_an_impulse_at_a_frame_turns_the_body(space: World) -> None:
    frames = {"rim": (0.0, 0.5, 0.0)}
    do(space, ball(frames=frames), Impulse("t", "ball", (1, 0, 0), (0, 0, 0), frame="rim"))
    space.step()
    inertia = 0.4 * 2 * 0.5**2
    assert twist(space)[:3] == pytest.approx([0.5, 0, 0], abs=ROUNDING)
    assert twist(space)[3:] == pytest.approx([0, 0, -0.5 / inertia], rel=1e-9, abs=ROUNDING)


def test_a_frame_counts_from_the_body_frame_not_from_the_centre_of_mass(space: World) -> None:
    # A box drawn as a mesh with its corner at the origin: its centre of mass is (1, 1, 1) / 2.
    corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], dtype="<f8")
    faces = np.array(
        [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1],
         [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]], dtype="<i4",
    )  # fmt: skip
    shape = ShapeSpec("mesh", (), corners.tobytes(), faces.tobytes())
    push = Impulse("t", "ball", (1, 0, 0), (0, 0, 0), frame="middle")
    do(space, ball(shape=shape, frames={"middle": (0.5, 0.5, 0.5)}), push)
    space.step()
    assert twist(space)[3:] == pytest.approx([0, 0, 0], abs=1e-13)
    assert twist(space)[0] == pytest.approx(0.5, rel=1e-13)


def test_requests_of_one_boundary_do_not_depend_on_which_topic_was_read_first(space: World) -> None:
    do(space, Impulse("t", "ball", (2, 0, 0), (0, 0, 0)), ball())
    space.step()
    assert twist(space)[0] == pytest.approx(1, rel=ROUNDING)


def test_the_same_identity_never_makes_a_second_body(space: World) -> None:
    do(space, ball(), Impulse("t", "ball", (2, 0, 0), (0, 0, 0)))
    run(space, 1)
    do(space, ball())
    assert space.names == ["ball"]
    assert twist(space).tolist() == [0] * 6  # moved back, velocity zeroed
    do(space, ball(properties={"mass": 4.0}))
    assert space.names == ["ball"]
    assert space.simulation.scene.bodies[0].mass_properties.mass == pytest.approx(4)


def test_a_name_that_is_taken_is_refused_and_nothing_changes(space: World) -> None:
    do(space, ball())
    before = space.simulation.state_hash()
    assert refused(space, ball(id_=2)).field == "name"
    assert space.simulation.state_hash() == before


def test_a_body_that_cannot_be_made_leaves_the_one_it_would_replace(space: World) -> None:
    do(space, ball())
    assert refused(space, ball(properties={"mass": -1.0}))
    assert space.names == ["ball"]


def test_a_lifetime_is_simulated_time(space: World) -> None:
    do(space, ball(lifetime=0.25), ball("other", 2))
    run(space, 0.25 - DT)
    assert space.names == ["ball", "other"]
    generation = space.generation
    assert space.step() == ["ball"]
    assert space.names == ["other"]
    assert space.generation == generation + 1


def test_delete_by_identity_by_name_and_all() -> None:
    world = World(default_scene(), DT)
    do(world, ball("a", 1), ball("b", 2), ball("c", 3), ball("d", 4, ns="other"))
    do(world, Delete("t", "t", 1))
    assert world.names == ["ground", "b", "c", "d"]
    do(world, Delete("t", "", 0, "b"))
    assert world.names == ["ground", "c", "d"]
    do(world, DeleteAll("t", "other"))
    assert world.names == ["ground", "c"]
    do(world, DeleteAll("t"))
    assert world.names == ["ground"]
    do(world, Delete("t", "", 0, "ground"))
    assert world.names == []
    do(world, ball("a", 1))  # what was deleted can come again
    assert world.names == ["a"]


@pytest.mark.parametrize(
    ("request_", "field"),
    [
        (Wrench("t", "bal", (1, 0, 0), (0, 0, 0)), "header.frame_id"),
        (Wrench("t", "ball", (1, 0, 0), (0, 0, 0), frame="rim"), "header.frame_id"),
        (Wrench("t", "ground", (1, 0, 0), (0, 0, 0)), "header.frame_id"),
        (Impulse("t", "nobody", (1, 0, 0), (0, 0, 0)), "header.frame_id"),
        (Impulse("t", "ball", (2.1e5, 0, 0), (0, 0, 0)), "force"),  # 2 kg: 105 km/s
        (Impulse("t", "ball", (0, 0, 0), (0, 2.1e4, 0)), "torque"),  # 0.2 kg m^2
        (Wrench("t", "ball", (0, 2.1e7, 0), (0, 0, 0)), "force"),
        (Wrench("t", "ball", (0, 0, 0), (0, 0, 2.1e7)), "torque"),
        (SetState("t", "no", (0, 0, 0), (0, 0, 0, 1), (0, 0, 0), (0, 0, 0)), "child_frame_id"),
        (Delete("t", "t", 77), "ns, id"),
        (Delete("t", "", 0, "no"), "name"),
        (LoadScene("t", "bodies: [{shape: {Sphere: {radius: -1}}}]"), "radius"),
        (ball("new", 2, shape=ShapeSpec("sphere", (1e5,))), "mass"),
    ],
)
def test_what_cannot_be_done_is_refused_and_changes_nothing(request_: Request, field: str) -> None:
    world = World(default_scene(), DT, max_bodies=10)
    do(world, ball())
    before, names = world.simulation.state_hash(), world.names
    if field == "mass":
        request_ = dataclasses.replace(request_, properties={"density": 1000.0})
    refusal = refused(world, request_)
    assert field in refusal.field
    assert (world.simulation.state_hash(), world.names) == (before, names)


def test_no_more_than_max_bodies() -> None:
    world = World(default_scene(), DT, max_bodies=2)
    do(world, ball())
    assert "max_bodies" in refused(world, ball("b", 2)).rule


def test_an_open_mesh_may_stand_still_but_not_move(space: World) -> None:
    corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], dtype="<f8").tobytes()
    sheet = ShapeSpec("mesh", (), corners, np.array([[0, 1, 2]], dtype="<i4").tobytes())
    assert "closed" in refused(space, ball(shape=sheet)).rule
    do(space, ball(shape=sheet, static=True, properties={}))


def test_a_mesh_turned_inside_out_is_refused(space: World) -> None:
    corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], dtype="<f8").tobytes()
    faces = np.array([[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]], dtype="<i4")
    refusal = refused(space, ball(shape=ShapeSpec("mesh", (), corners, faces.tobytes())))
    assert "volume" in refusal.rule
    outward = np.ascontiguousarray(faces[:, ::-1])
    do(space, ball(shape=ShapeSpec("mesh", (), corners, outward.tobytes())))


def test_reset_goes_back_to_the_start() -> None:
    world = World(default_scene(), DT)
    start = world.simulation.state_hash()
    do(world, ball())
    run(world, 0.5)
    generation = world.generation
    do(world, Reset("t"))
    assert (world.time, world.names) == (0, ["ground"])
    assert world.simulation.state_hash() == start
    assert world.generation > generation  # readers must not mistake the new list for the old
    do(world, ball())


def logged_run(path: Path) -> World:
    """Every kind of request, some of them refused, with steps of two lengths."""
    world = World(default_scene(), DT, journal=Journal(path, SceneSource(), DT, 10**8))
    do(world, ball(position=(0, 0, 0.7), velocity=(0.1, 0.2, 0.3)), ball("b", 2, lifetime=0.3))
    run(world, 0.25)
    do(world, Impulse("t", "ball", (0.1, 1 / 3, 0), (0.1, 0, 0)))
    refused(world, ball("ball", 9))
    do(world, Wrench("t", "ball", (1, 0, 2), (0, 0.1, 0), hold=0.1))
    run(world, 0.25)
    world.set_dt(1 / 300)
    turned = (0.0, 0.0, 0.6, 0.8)
    do(world, SetState("t", "ball", (1, 2, 0.49), turned, (1, 0, 0), (0, 0, 3)))
    run(world, 0.5)
    do(world, Delete("t", "", 0, "ball"), ball("c", 3, position=(0.1, 0, 0.6)))
    run(world, 0.5)
    world.journal.close(world.steps, world.simulation.state_hash())
    return world


def test_a_log_replays_to_the_same_bits(tmp_path: Path) -> None:
    world = logged_run(tmp_path / "run.jsonl")
    result = replay(tmp_path / "run.jsonl")
    assert result.same
    assert result.steps == world.steps
    assert np.array_equal(result.world.simulation.poses(), world.simulation.poses())


def test_a_log_with_one_bit_changed_does_not(tmp_path: Path) -> None:
    logged_run(tmp_path / "run.jsonl")
    text = (tmp_path / "run.jsonl").read_text()
    third = repr(1 / 3)
    assert text.count(third) == 1
    changed = text.replace(third, repr(np.nextafter(1 / 3, 1).item()))
    (tmp_path / "run.jsonl").write_text(changed)
    assert not replay(tmp_path / "run.jsonl").same


def test_a_file_that_is_no_log_is_refused(tmp_path: Path) -> None:
    for text in ("", "{}", "[]", "x", '{"carom_log": 99}', json.dumps({"carom_log": 1})):
        (tmp_path / "no.jsonl").write_text(text)
        with pytest.raises(Refusal, match="log"):
            replay(tmp_path / "no.jsonl")


def test_a_log_ends_before_it_outgrows_its_limit(tmp_path: Path) -> None:
    world = World(
        default_scene(), DT, journal=Journal(tmp_path / "l", SceneSource(), DT, limit=1000)
    )
    for number in range(20):
        do(world, ball(f"b{number}", number))
    assert world.journal.full
    assert (tmp_path / "l").stat().st_size <= 1000
    assert len(world.names) == 21
    world.journal.close(0, 0)
