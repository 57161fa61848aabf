# SPDX-License-Identifier: Apache-2.0
"""The rotation study: its truth has 60 digits, and its figures say what the schemes promise."""

import csv
import json
import math

import pytest

import carom
from carom.cli import main
from carom.studies import common, rotation, top_reference

ORDERS = {
    "lecture_gram_schmidt": 1,
    "lecture_polar": 1,
    "lecture_exponential": 1,
    "lecture_quaternion": 1,
    "lecture_quaternion_sqrt": 1,
    "midpoint": 2,
    "implicit_midpoint": 2,
    "cayley": 2,
    "symmetric_top": 2,
    "symmetric_top_4": 4,
}


@pytest.fixture(scope="module")
def rows():
    """The whole study, with its times measured once instead of five times."""
    patch = pytest.MonkeyPatch()
    patch.setattr(rotation, "least_seconds", lambda call, **_: common.least_seconds(call, 0, 1))
    patch.setattr(rotation, "LONG_STEPS", 20_000)
    yield rotation.run()
    patch.undo()


@pytest.mark.parametrize("case", rotation.CASES, ids=lambda case: case.name)
def test_the_stored_truth_is_the_sixty_digit_one(case) -> None:
    q = top_reference.fly(case.moments, (0, 0, 0, 1), case.w, case.seconds)
    # stored as doubles: half an ulp of each component
    assert top_reference.angle(q, case.truth) < 4 * 2.0**-53


def test_slopes_are_the_orders(rows) -> None:
    found = rotation.slopes(rows)
    assert set(found) == set(ORDERS)
    for method, order in ORDERS.items():
        if order == 1:  # its constant still changes along the ladder
            assert found[method] == pytest.approx(1, abs=0.3), method
        else:
            assert found[method] == pytest.approx(order, abs=0.15), method


def test_the_adaptive_rows_keep_their_tolerance(rows) -> None:
    for row in rows:
        if row["method"] == "taylor":
            assert row["error"] <= row["estimate"]
            assert row["status"] == "below_rounding" or row["error"] <= row["tolerance"]


def test_the_closed_form_is_right_by_the_unstable_axis(rows) -> None:
    (row,) = [r for r in rows if r["case"] == "unstable_axis" and r["method"] == "exact"]
    assert row["error"] <= 1e-9
    others = [r for r in rows if r["case"] == "unstable_axis" and r["method"] != "exact"]
    assert min(r["error"] for r in others) > row["error"]


def test_the_default_beats_every_lecture_row_at_every_price(rows) -> None:
    mine = [r for r in rows if r["case"] == "tumbling"]
    default = {r["steps"]: r["error"] for r in mine if r["method"] == "symmetric_top"}
    for r in mine:
        if r["method"].startswith("lecture") and r["steps"] in default and r["steps"] >= 100:
            assert default[r["steps"]] < r["error"] / 10, r["method"]


def test_splittings_hold_their_energy_where_the_lecture_does_not(rows) -> None:
    error = {r["method"]: r["error"] for r in rows if r["case"] == "energy_after_1e5_steps"}
    assert error["symmetric_top"] < 2e-4
    assert error["cayley"] * 1000 < error["lecture_exponential"]


def test_counted_instructions_keep_their_marks() -> None:
    counted = rotation.instructions()
    assert counted["symmetric_top"] <= 900
    assert counted["cayley"] < counted["lecture_exponential"]


def test_pareto_front_keeps_only_what_nothing_beats() -> None:
    rows = [
        {"method": "a", "seconds": 1.0, "error": 3.0},
        {"method": "b", "seconds": 2.0, "error": 3.0},
        {"method": "c", "seconds": 2.0, "error": 1.0},
        {"method": "d", "seconds": 3.0, "error": math.nan},
        {"method": "e", "seconds": 0.5, "error": 9.0},
    ]
    assert [row["method"] for row in common.pareto(rows)] == ["e", "a", "c"]


def test_cost_prints_a_table_and_writes_csv_json_and_png(tmp_path, capsys, monkeypatch) -> None:
    pytest.importorskip("matplotlib")
    monkeypatch.setattr(rotation, "CASES", (rotation.CASES[0]._replace(steps=(100, 200)),))
    monkeypatch.setattr(rotation, "LONG_STEPS", 1000)
    monkeypatch.setattr(
        rotation, "least_seconds", lambda call, **_: common.least_seconds(call, 0, 1)
    )
    assert main(["cost", "--study", "rotation", "--out", str(tmp_path)]) == 0
    printed = capsys.readouterr()
    assert "symmetric_top" in printed.out
    assert printed.err == ""
    with (tmp_path / "rotation_study.csv").open() as file:
        table = list(csv.DictReader(file))
    assert {row["method"] for row in table} == set(carom.METHODS)
    content = json.loads((tmp_path / "rotation_study.json").read_text())
    assert content["study"] == "rotation"
    assert len(content["rows"]) == len(table)
    assert (tmp_path / "rotation_study.png").read_bytes()[:4] == b"\x89PNG"


def test_cost_lists_its_studies_and_speaks_json(capsys) -> None:
    assert main(["cost", "--list", "--json"]) == 0
    assert "rotation" in json.loads(capsys.readouterr().out)["studies"]
    with pytest.raises(SystemExit) as stopped:
        main(["cost", "--study", "nothing"])
    assert stopped.value.code == 2
