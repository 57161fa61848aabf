# SPDX-License-Identifier: Apache-2.0
"""The table of hard cases, one test each."""

from pathlib import Path

import pytest

from carom.commands.stress import as_markdown
from carom.stress import GROUPS, Outcome, cases_of, run_case

CASES = [case for group in GROUPS for case in cases_of(group)]


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_it_keeps_its_limit(case):
    outcome = run_case(case)
    assert not outcome.problem
    assert outcome.passed, f"{outcome.value:g} {case.unit}, limit {case.limit:g}: {case.measures}"


def test_names_are_unique_and_rows_complete():
    names = [case.name for case in CASES]
    assert len(set(names)) == len(names) >= 60
    for case in CASES:
        assert case.group in GROUPS
        assert case.limit >= 0
        assert len(case.why) > 20
        assert len(case.measures) > 10
        assert case.unit


README = (Path(__file__).parents[2] / "README.md").read_text()
MARK = "<!-- carom stress --markdown -->\n"


def test_the_readme_holds_what_the_command_prints():
    """The tests above run every case; here it is enough that the table says the same as they do."""
    outcomes = [Outcome(case, 0.0, True, 0.0) for case in CASES]
    assert README.partition(MARK)[2].startswith(as_markdown(outcomes) + "\n")
