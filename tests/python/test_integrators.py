# SPDX-License-Identifier: Apache-2.0
"""integrate_free as Python users meet it. What each scheme does numerically is tested in C++."""

import pickle

import numpy as np
import pytest

import carom
from carom.studies import top_reference

BODY = carom.MassProperties.box([0.4, 0.9, 0.1], density=10)
AT_REST = [0, 0, 0, 1]
W = [0.1, 5, 0.1]


def test_methods_is_the_tuple_of_names() -> None:
    assert carom.METHODS[:2] == ("lecture_gram_schmidt", "lecture_polar")
    assert "symmetric_top" in carom.METHODS
    assert len(set(carom.METHODS)) == len(carom.METHODS) == 12


def test_exact_agrees_with_sixty_digits() -> None:
    # moments of the box as the library has them: both fly the same body
    moments = np.diag(BODY.inertia)
    q = top_reference.fly(moments, AT_REST, W, 10)
    flight = carom.integrate_free(BODY, AT_REST, W, 10, method="exact")
    error = top_reference.angle(q, flight.orientation)
    assert error <= flight.error
    assert error <= 1e-12  # 50 rad, some u each, and the moments' own rounding


@pytest.mark.parametrize("tolerance", [1e-3, 1e-6, 1e-9, 1e-11])
def test_adaptive_error_is_within_the_tolerance(tolerance: float) -> None:
    q = top_reference.fly(np.diag(BODY.inertia), AT_REST, W, 10)
    flight = carom.integrate_free(BODY, AT_REST, W, 10, method="taylor", tolerance=tolerance)
    assert flight.status == "ok"
    assert top_reference.angle(q, flight.orientation) <= flight.error <= tolerance


@pytest.mark.parametrize("method", carom.METHODS)
def test_what_goes_in_comes_out(method: str) -> None:
    flight = carom.integrate_free(BODY, AT_REST, W, 1, steps=1000, method=method)
    orientation, velocity = flight
    assert orientation.shape == (4,)
    assert velocity.shape == (3,)
    assert orientation.dtype == velocity.dtype == np.float64
    assert flight.steps >= 1
    assert flight.status == "ok"
    assert (flight.error is None) == (method not in ("taylor", "exact"))
    exact = carom.integrate_free(BODY, AT_REST, W, 1, method="exact").orientation
    assert top_reference.angle(orientation, exact) < 0.1  # 1000 steps: even order 1 is near
    again = pickle.loads(pickle.dumps(flight))
    assert np.array_equal(again.orientation, orientation)
    assert again.status == flight.status


@pytest.mark.parametrize("method", ["symmetric_top", "cayley", "exact", "taylor"])
def test_energy_and_momentum_of_a_body_with_its_centre_elsewhere(method: str) -> None:
    frame = np.array([[0, -1, 0], [0.6, 0, -0.8], [0.8, 0, 0.6]])
    body = BODY.transformed(frame, [1, 2, 3]) if hasattr(BODY, "transformed") else BODY
    flight = carom.integrate_free(body, AT_REST, W, 3, steps=300, method=method)
    x, y, z, w = flight.orientation
    r = np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )
    before, after = body.inertia, r @ body.inertia @ r.T
    np.testing.assert_allclose(
        after @ flight.angular_velocity, before @ np.array(W), rtol=0, atol=1e-13
    )
    energy = flight.angular_velocity @ after @ flight.angular_velocity
    # bounded error of a second-order splitting at |dt w| = 0.05
    assert energy == pytest.approx(np.array(W) @ before @ W, rel=2e-4)


@pytest.mark.parametrize(
    ("arguments", "names"),
    [
        ({"method": "rk4"}, ["integrator", "rk4", "symmetric_top"]),
        ({"steps": 0}, ["steps"]),
        ({"tolerance": -1.0}, ["tolerance", "rad"]),
        ({"seconds": float("nan")}, ["seconds"]),
        ({"orientation": [0, 0, 0, 2]}, ["orientation"]),
        ({"angular_velocity": [0, float("inf"), 0]}, ["angular_velocity"]),
    ],
)
def test_bad_input_is_a_value_error_that_names_it(arguments, names) -> None:
    good = {"orientation": AT_REST, "angular_velocity": W, "seconds": 1.0}
    with pytest.raises(ValueError) as caught:  # noqa: PT011
        carom.integrate_free(BODY, **{**good, **arguments})
    for name in names:
        assert name in str(caught.value)


def test_a_simulation_takes_any_of_them() -> None:
    for method in carom.METHODS:
        scene = carom.Scene()
        scene.add(carom.Box([0.4, 0.9, 0.1]), density=10, angular_velocity=W, position=[0, 0, 0])
        simulation = carom.Simulation(scene, dt=1e-3, integrator=method)
        simulation.advance(1.0)
        exact = carom.integrate_free(BODY, AT_REST, W, 1, method="exact").orientation
        error = top_reference.angle(simulation.poses()[0, 3:], exact)
        assert error < (1e-9 if method in ("taylor", "exact") else 0.1), method
    with pytest.raises(ValueError, match="integrator"):
        carom.Simulation(scene, integrator="euler")


def test_the_report_tells_of_sub_steps() -> None:
    scene = carom.Scene()
    scene.add(carom.Box([0.4, 0.9, 0.1]), angular_velocity=[300, 200, 100])
    scene.add(carom.Sphere(0.1), position=[5, 0, 0], angular_velocity=[1e6, 0, 0])
    report = carom.Simulation(scene, dt=1 / 60).advance(1 / 60)
    assert 1 < report.rotation.most_substeps <= 256
    assert report.rotation.capped == 0


def test_the_judge_agrees_with_itself_at_other_settings() -> None:
    _, moments, w, seconds = top_reference.CASES[0]
    a = top_reference.fly(moments, AT_REST, w, seconds)
    b = top_reference.fly(moments, AT_REST, w, seconds, digits=70, order=60, turn=0.7)
    assert top_reference.angle(a, b) < 1e-30  # a double holds no smaller difference worth knowing
