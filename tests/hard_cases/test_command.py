# SPDX-License-Identifier: Apache-2.0
"""`carom stress` as a user meets it, and one deliberately wrong case per group that must fail."""

import functools
import json
import math

import pytest

from carom import MassProperties
from carom.cli import main
from carom.commands import stress
from carom.stress import GROUPS, cases_of, run_case
from carom.stress.case import largest

# For each group a case and what breaks it: a worse method, a setting past the bound, a wrong body.
BROKEN = {
    "rotation": ("flips_keep_energy", {"method": "lecture_polar"}),
    "inertia": (
        "point_mass_does_not_turn",
        {"mass_properties": MassProperties.sphere(0.1, mass=2)},
    ),
    "time": ("smaller_steps_err_less", {"method": "lecture_exponential"}),
    "ccd": ("contact_at_corners_and_borders", {"method": "lecture"}),
    "contact": ("brick_sticks_by_a_millionth", {"excess": -1e-6}),
    "roundoff": ("slide_a_thousand_kilometres_away", {"shift": 2.0**40}),
    "input": ("one_bad_face_of_many", {"left_out": 2}),
}


@pytest.mark.parametrize("group", GROUPS)
def test_a_case_that_is_broken_fails_the_command(group, monkeypatch, capsys):
    name, wrong = BROKEN[group]
    (case,) = [case for case in cases_of(group) if case.name == name]
    broken = case._replace(run=functools.partial(case.run, **wrong))
    monkeypatch.setattr(stress, "cases_of", lambda g: (broken,) if g == group else ())
    assert main(["stress", group, "--json"]) == 1
    (row,) = json.loads(capsys.readouterr().out)["cases"]
    assert row["passed"] is False
    assert row["problem"] == ""
    assert row["value"] is None or row["value"] > row["limit"]


def test_the_table_tells_value_limit_unit_and_why(capsys):
    assert main(["stress", "--only", "terminal_speed", "--only", "half_turn_and_ten_turns"]) == 0
    printed = capsys.readouterr()
    lines = printed.out.splitlines()
    assert lines[0].split()[:5] == ["group", "case", "measured", "limit", "unit"]
    assert lines[1].startswith("time   terminal_speed           pass  ")
    assert lines[2].startswith("ccd    half_turn_and_ten_turns  pass  0 ")
    assert lines[-1].startswith("2 cases, 0 failed, ")
    assert printed.err == ""


def test_the_summary_counts_by_group_and_names_the_failed(monkeypatch, capsys):
    good = cases_of("inertia")[0]
    bad = good._replace(name="bad", run=lambda: 3.0, limit=2.0, unit="m")
    monkeypatch.setattr(stress, "cases_of", lambda g: (bad, good) if g == "inertia" else ())
    assert main(["stress", "--summary"]) == 1
    lines = capsys.readouterr().out.splitlines()
    assert lines[1].startswith("inertia  2      1 ")
    assert lines[-1] == f"FAIL bad: 3 m, limit 2; {good.why}"


def test_markdown_has_a_row_per_group_and_names_the_failed(monkeypatch, capsys):
    good = cases_of("inertia")[0]
    bad = good._replace(name="bad", run=lambda: 3.0, limit=2.0, unit="m")
    other = good._replace(group="time")
    chosen = {"inertia": (bad, good), "time": (other,)}
    monkeypatch.setattr(stress, "cases_of", lambda g: chosen.get(g, ()))
    assert main(["stress", "--markdown"]) == 1
    assert capsys.readouterr().out.splitlines()[2:] == [
        f"| `inertia` | {GROUPS['inertia'][0]} | 2 | 1 | `bad` |",
        f"| `time` | {GROUPS['time'][0]} | 1 | 1 |  |",
        "| all |  | 3 | 2 | `bad` |",
    ]


def test_json_has_a_schema_and_every_column(capsys):
    assert main(["stress", "inertia", "--only", "axes_of_a_cube", "--json"]) == 0
    result = json.loads(capsys.readouterr().out)
    assert result["schema"] == "carom.stress/1"
    assert (result["ok"], result["failed"]) == (True, 0)
    (row,) = result["cases"]
    assert row["group"] == "inertia"
    assert row["value"] <= row["limit"]
    assert set(row) == {
        "name", "group", "why", "measures", "value", "limit", "unit", "passed", "seconds", "note",
        "problem",
    }  # fmt: skip


def test_a_case_that_breaks_is_a_failure_with_its_error_and_the_rest_runs(monkeypatch, capsys):
    good = cases_of("inertia")[0]
    bad = good._replace(name="bad", run=lambda: 1 / 0)
    monkeypatch.setattr(stress, "cases_of", lambda g: (bad, good) if g == "inertia" else ())
    assert main(["stress", "inertia"]) == 1
    out = capsys.readouterr().out
    assert "2 cases, 1 failed" in out
    assert "ZeroDivisionError: division by zero" in out


def test_nan_is_never_a_pass():
    assert largest(1.0, math.nan) == largest([math.nan, 1.0]) == largest(0, math.inf) == math.inf
    assert largest(1.0, 3.0, 2.0) == largest(x for x in (3.0, 1.0)) == 3.0
    for value in (math.nan, math.inf, -math.inf):
        assert not run_case(cases_of("inertia")[0]._replace(run=lambda v=value: v)).passed


def test_list_runs_nothing_and_says_why_each_is_hard(monkeypatch, capsys):
    monkeypatch.setattr(stress, "run_case", None)
    assert main(["stress", "--list"]) == 0
    out = capsys.readouterr().out
    for group in GROUPS:
        for case in cases_of(group):
            assert case.name in out
            assert case.why in out
    assert main(["stress", "rotation", "--list", "--json"]) == 0
    assert {row["group"] for row in json.loads(capsys.readouterr().out)["cases"]} == {"rotation"}


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["rotations"], "group: 'rotations', must name one; did you mean rotation?"),
        (
            ["--only", "stack_of_31"],
            "case: 'stack_of_31', must name one; did you mean stack_of_30?",
        ),
        (["time", "--only", "stack_of_30"], "case: 'stack_of_30', must name one"),
        (["--only", "zzz"], "case: 'zzz', must name one; see carom stress --list"),
    ],
)
def test_bad_usage_exits_2(arguments, message, capsys):
    assert main(["stress", *arguments]) == 2
    printed = capsys.readouterr()
    assert message in printed.err
    assert printed.out == ""


def test_help_holds_an_example_and_the_groups(capsys):
    with pytest.raises(SystemExit) as stopped:
        main(["stress", "--help"])
    assert stopped.value.code == 0
    out = capsys.readouterr().out
    assert "example:\n  carom stress\n" in out
    for group, (about, _) in GROUPS.items():
        assert f"{group:9s} {about}" in out
