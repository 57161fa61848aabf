# SPDX-License-Identifier: Apache-2.0
"""The Python face of the simulation: shapes, dtypes, order, what it copies, and threads."""

import math
import threading
import time

import numpy as np
import pytest

import carom

G = 9.81
U = 2.0**-53


def falling_box(**arguments):
    scene = carom.Scene()
    scene.effects.append(carom.UniformGravity([0, 0, -G]))
    scene.add(carom.Plane([0, 0, 1], 0), name="ground", static=True)
    scene.add(carom.Box([0.2, 0.3, 0.4]), name="crate", position=[0, 0, 1], **arguments)
    return scene


def test_arrays_are_float64_with_a_row_per_body_static_ones_included():
    simulation = carom.Simulation(falling_box())
    for array, width in (
        (simulation.poses(), 7),
        (simulation.centres(), 3),
        (simulation.twists(), 6),
    ):
        assert array.dtype == np.float64
        assert array.shape == (2, width)
        assert array.flags.c_contiguous
    assert simulation.momentum().shape == (3,)
    assert simulation.angular_momentum().shape == (3,)
    assert simulation.ids().tolist() == [0, 1]
    assert simulation.names() == ["ground", "crate"]
    np.testing.assert_array_equal(simulation.poses()[1], [0, 0, 1, 0, 0, 0, 1])


def test_a_box_lands_on_the_plane_and_rests():
    simulation = carom.Simulation(falling_box(), dt=1 / 240)
    report = simulation.advance(2.0)
    assert report.steps == 480
    assert report.time == simulation.time == 2.0
    # Half its height above the plane. The solver may leave a deepest overlap, which it reports.
    assert abs(simulation.poses()[1, 2] - 0.2) <= report.contact.deepest_overlap + 4 * U
    # At rest: below the speed that gravity gives in one step.
    assert np.abs(simulation.twists()[1]).max() < G / 240
    contacts = simulation.contacts()
    assert set(contacts["a"]) | set(contacts["b"]) == {0, 1}
    # What holds the box up in a step is its weight times the step.
    weight = 0.2 * 0.3 * 0.4 * 1000 * G
    assert contacts["impulse"][:, 2].sum() == pytest.approx(weight / 240, rel=1e-3)


def test_an_effect_appended_changes_the_scene_and_a_removed_one_no_longer_acts():
    scene = falling_box()
    assert len(scene.effects) == 1
    scene.effects.clear()
    simulation = carom.Simulation(scene)
    simulation.advance(1.0)
    np.testing.assert_array_equal(simulation.poses()[1], [0, 0, 1, 0, 0, 0, 1])


def test_the_effects_behave_as_a_list():
    effects = carom.Scene().effects
    moon, earth = carom.UniformGravity([0, 0, -1.62]), carom.UniformGravity([0, 0, -G])
    effects.extend([moon, earth])
    effects.insert(0, earth)
    effects[1] = earth
    assert [e.acceleration[2] for e in effects] == [-G, -G, -G]
    assert effects.pop().acceleration[2] == -G
    del effects[0]
    assert len(effects) == 1
    with pytest.raises(IndexError):
        effects[1]


def test_a_refused_effect_leaves_the_list_alone():
    scene = falling_box()
    with pytest.raises(ValueError, match="acceleration"):
        scene.effects.append(carom.UniformGravity([0, 0, math.nan]))
    assert len(scene.effects) == 1


def test_the_effect_list_keeps_its_scene_alive():
    effects = carom.Scene().effects
    effects.append(carom.UniformGravity())
    assert len(effects) == 1


def test_a_simulation_keeps_its_own_copy_of_the_scene():
    scene = falling_box()
    simulation = carom.Simulation(scene)
    scene.effects.clear()
    scene.remove("crate")
    assert len(simulation) == 2
    assert simulation.step() is None
    assert simulation.twists()[1, 2] < 0


def test_free_fall_keeps_the_energy_ledger():
    simulation = carom.Simulation(falling_box(), dt=1 / 1000)
    start = simulation.energy()
    simulation.advance(0.3)  # 0.44 m: it has not landed
    energy = simulation.energy()
    assert energy.kinetic == pytest.approx(
        0.5 * 24.0 * (G * 0.3) ** 2, rel=2e-3
    )  # first order in dt
    assert energy.balance == energy.kinetic + energy.potential + energy.dissipated - energy.work
    assert start.kinetic == 0


def test_a_force_acts_for_one_step_and_an_impulse_once():
    scene = carom.Scene()
    ball = scene.add(carom.Sphere(0.1), mass=2.0)
    simulation = carom.Simulation(scene, dt=0.01)
    simulation.apply_force(ball, [3, 0, 0])
    simulation.advance(0.05)
    # F dt / m: one rounding each in force times step, division and addition.
    assert simulation.twists()[0, 0] == pytest.approx(3 * 0.01 / 2, rel=4 * U)
    simulation.apply_impulse("body_0", [0, 4, 0])
    simulation.step()
    assert simulation.twists()[0, 1] == pytest.approx(2.0, rel=4 * U)
    assert simulation.momentum() == pytest.approx([0.03, 4, 0], rel=8 * U)


def test_a_force_off_centre_turns_the_body():
    scene = carom.Scene()
    ball = scene.add(carom.Sphere(0.1), mass=2.0)
    simulation = carom.Simulation(scene, dt=0.01)
    simulation.apply_impulse(ball, [0, 1, 0], point=[0.1, 0, 0])
    simulation.step()
    inertia = 0.4 * 2.0 * 0.1**2
    assert simulation.twists()[0, 5] == pytest.approx(0.1 / inertia, rel=16 * U)
    # About the world origin: r x p with r = 0 at the start, so the spin alone.
    assert simulation.angular_momentum()[2] == pytest.approx(0.1, rel=16 * U)


def test_a_torque_and_an_angular_impulse_turn_the_body():
    scene = carom.Scene()
    ball = scene.add(carom.Sphere(0.1), mass=2.0)
    simulation = carom.Simulation(scene, dt=0.01)
    simulation.apply_torque(ball, [0, 0, 1])
    simulation.apply_angular_impulse(ball, [0.02, 0, 0])
    simulation.step()
    inertia = 0.4 * 2.0 * 0.1**2
    expected = np.array([0.02, 0, 0.01]) / inertia
    # One step may turn the axis only at second order of a sphere's (absent) gyroscopic term.
    assert simulation.twists()[0, 3:] == pytest.approx(expected, rel=1e-12, abs=1e-12)


def test_a_held_wrench_acts_until_its_time_and_zero_clears_it():
    scene = carom.Scene()
    ball = scene.add(carom.Sphere(0.1), mass=1.0)
    simulation = carom.Simulation(scene, dt=0.125)  # a power of two: the clock is exact
    simulation.hold_wrench(ball, [1, 0, 0], until=0.5)
    simulation.advance(1.0)
    assert simulation.twists()[0, 0] == pytest.approx(0.5, rel=16 * U)
    simulation.hold_wrench(ball, [1, 0, 0])
    simulation.advance(1.0)
    simulation.hold_wrench(ball)
    simulation.advance(1.0)
    assert simulation.twists()[0, 0] == pytest.approx(1.5, rel=32 * U)


def test_removal_closes_rows_up_and_never_reuses_an_id():
    simulation = carom.Simulation(falling_box())
    simulation.add(carom.Sphere(0.1), name="ball", position=[5, 0, 1])
    simulation.remove("crate")
    assert simulation.names() == ["ground", "ball"]
    assert simulation.row("ball") == 1
    assert simulation.add(carom.Sphere(0.1)) == 3
    assert simulation.ids().tolist() == [0, 2, 3]
    assert len(simulation.scene) == 3


def test_set_state_keeps_what_is_not_given():
    simulation = carom.Simulation(falling_box(velocity=[1, 0, 0], angular_velocity=[0, 2, 0]))
    simulation.set_state("crate", position=[0, 0, 5])
    np.testing.assert_allclose(simulation.poses()[1], [0, 0, 5, 0, 0, 0, 1], atol=8 * U)
    np.testing.assert_allclose(simulation.twists()[1], [1, 0, 0, 0, 2, 0], atol=8 * U)
    simulation.set_state("crate", velocity=[0, 0, 0], angular_velocity=[0, 0, 0])
    assert not simulation.twists().any()


def test_a_restored_state_goes_on_with_the_same_bits():
    simulation = carom.Simulation(falling_box(angular_velocity=[1, 2, 3]))
    simulation.advance(0.3)
    saved = simulation.save()
    assert isinstance(saved, bytes)
    simulation.advance(0.5)
    first = simulation.state_hash()
    simulation.restore(saved)
    assert simulation.state_hash() != first
    simulation.advance(0.5)
    assert simulation.state_hash() == first


def test_the_plan_names_what_runs_and_with_off_what_does_not():
    scene = carom.Scene()
    scene.add(carom.Box([0.1, 0.2, 0.3]))
    simulation = carom.Simulation(scene)
    simulation.step()
    ((stage, reason, bodies, seconds),) = simulation.plan()
    assert stage == "integrate"
    assert "gyroscopic" in reason
    assert bodies == 1
    assert seconds > 0
    off = {s.stage: s.reason for s in simulation.plan(off=True)}
    assert {"gravity", "pairs", "contacts", "solve"} <= set(off)
    assert all(off.values())
    planned = carom.compile(scene)
    assert [s.stage for s in planned.stages if s.on] == ["integrate"]
    assert "integrate" in str(planned)


def test_other_threads_run_while_it_advances():
    """With the GIL held throughout, this thread would stand still for the whole advance."""
    scene = carom.Scene()
    for i in range(200):
        scene.add(carom.Box([0.1, 0.2, 0.3]), position=[i, 0, 0], angular_velocity=[1, 2, 3])
    simulation = carom.Simulation(scene, dt=1e-3)
    walls = []
    thread = threading.Thread(target=lambda: walls.append(simulation.advance(5.0).wall_seconds))
    thread.start()
    ticks = [time.perf_counter()]
    while thread.is_alive():
        ticks.append(time.perf_counter())
    assert np.diff(ticks).max() < 0.5 * walls[0]


def test_a_reader_in_another_thread_sees_whole_steps():
    """Readings lock the simulation out: time and pose belong to one moment between advances."""
    scene = carom.Scene()
    scene.add(carom.Sphere(0.1), velocity=[1, 0, 0])
    simulation = carom.Simulation(scene, dt=2.0**-10)
    thread = threading.Thread(target=simulation.advance, args=(8.0,))
    thread.start()
    while thread.is_alive():
        assert simulation.poses()[0, 0] in (0.0, 8.0)  # powers of two: no rounding on the way
    thread.join()
    assert simulation.poses()[0, 0] == 8.0


def test_threads_of_the_solver_change_no_bit():
    def hash_after(threads):
        scene = falling_box()
        for i in range(40):
            place = [0.15 * (i % 4), 0.15 * (i // 4 % 3), 0.3 + 0.25 * (i // 12)]
            scene.add(carom.Box([0.2, 0.2, 0.2]), name=f"box_{i}", position=place)
        simulation = carom.Simulation(scene, threads=threads, contact_solver="small_steps")
        for _ in range(10):
            simulation.step()
        return simulation.state_hash()

    assert hash_after(2) == hash_after(1)
    with pytest.raises(ValueError, match="threads"):
        carom.Simulation(falling_box(), threads=0)
