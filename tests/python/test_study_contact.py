# SPDX-License-Identifier: Apache-2.0
"""The contact study: its rows say what stands and what falls, and its plot draws every measure."""

import math

import pytest

from carom.studies import contact as study


@pytest.fixture(scope="module")
def rows():
    return study.run(cases=("ten_under_1000", "pyramid_10"), duration=1.0)


def row(rows, case, method):
    return next(r for r in rows if r["case"] == case and r["method"] == method)


def test_the_direct_solver_holds_what_small_steps_let_down(rows):
    soft = row(rows, "ten_under_1000", "small_steps_8")
    direct = row(rows, "ten_under_1000", "direct")
    automatic = row(rows, "ten_under_1000", "automatic")
    assert soft["error"] > 0.05  # m, after a second
    # Below 1 mm of move and 0.5 mm of overlap: the marks; 1e-7 m/s is what it solves to.
    for held in (direct, automatic):
        assert held["error"] < 1e-3
        assert held["deepest_overlap_m"] < 5e-4
        assert held["residual_m_s"] < 1e-6
        assert held["solver"] == "direct"
        assert held["gave_up"] == 0
    assert soft["solver"] == "small steps"


def test_more_small_steps_sink_less(rows):
    methods = [f"small_steps_{n}" for n in (4, 8, 16, 32)]
    sunk = [row(rows, "pyramid_10", method)["deepest_overlap_m"] for method in methods]
    assert sunk == sorted(sunk, reverse=True)
    # A soft contact sinks by force / (mass (2 pi f)^2) with f in proportion to their number.
    assert sunk[0] / sunk[3] > 16


def test_each_row_is_complete(rows):
    for r in rows:
        for key in ("error", "seconds", "residual_m_s", "deepest_overlap_m", "energy_off"):
            assert math.isfinite(r[key])
            assert r[key] >= 0
        assert r["iterations_per_step"] > 0


def test_the_plot_is_a_picture(rows, tmp_path):
    pytest.importorskip("matplotlib")
    study.plot(rows, tmp_path / "contact.png")
    assert (tmp_path / "contact.png").read_bytes()[:4] == b"\x89PNG"
