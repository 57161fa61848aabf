# SPDX-License-Identifier: Apache-2.0
"""The inertia study: orders of accuracy are asserted on what it measures."""

import pytest

from carom.studies import inertia


@pytest.fixture(scope="module")
def rows():
    return inertia.run()


def test_rows_are_complete_and_progress_is_told(monkeypatch):
    monkeypatch.setattr(inertia, "COUNTS", (100, 800))
    monkeypatch.setattr(inertia, "SEEDS", 2)
    told = []
    rows = inertia.run(lambda done, total: told.append((done, total)))
    assert told == [(i + 1, len(rows)) for i in range(len(rows))]
    keys = {"study", "case", "method", "samples", "error", "error_unit", "seconds"}
    assert all(set(row) == keys for row in rows)
    assert all(row["seconds"] > 0 and row["error"] > 0 for row in rows)


# An rms of 12 seeds is off by 1/sqrt(24) = 20 %, for a norm of 6 numbers rather less; over a factor
# of 512 in samples the fitted slope is off by 0.2 / ln(512) * 1.3 = 0.04. Twice that is allowed.
SLACK = 0.08


def test_monte_carlo_falls_as_the_root_of_the_samples(rows):
    for (_, method), slope in inertia.slopes(rows).items():
        if method == "monte_carlo":
            assert slope == pytest.approx(-0.5, abs=SLACK)


def test_stratified_falls_steeper(rows):
    # -2/3: only the cells cut by the surface err, N^(2/3) of them, each by its own 1/N
    for (_, method), slope in inertia.slopes(rows).items():
        if method == "stratified":
            assert slope == pytest.approx(-2 / 3, abs=SLACK)


def test_facets_err_as_the_square_of_their_edge(rows):
    # one over the number of faces; the next term is in its square, 1 % at a thousand faces
    for (_, method), slope in inertia.slopes(rows).items():
        if method == "mesh":
            assert slope == pytest.approx(-1, abs=0.02)


def test_mesh_sums_beat_samples_at_the_same_time(rows):
    best = {
        method: min(r["error"] for r in rows if r["case"] == "ball" and r["method"] == method)
        for method in inertia.METHODS
    }
    assert best["mesh"] < best["stratified"] < best["monte_carlo"]
