# SPDX-License-Identifier: Apache-2.0
"""`carom stress`: the named hard cases, what each measured and what it may."""

from __future__ import annotations

import argparse
import contextlib
import difflib
import sys
from collections.abc import Callable, Iterator, Sequence

from carom.commands.output import number, print_json, table
from carom.errors import InvalidInput
from carom.stress import GROUPS, Case, Outcome, cases_of, run_case

EXAMPLE = """\
  carom stress
  carom stress rotation contact
  carom stress --only stack_of_30 --json
  carom stress --summary
  carom stress --markdown
  carom stress --list
"""


def add(subparsers: argparse._SubParsersAction) -> None:
    summary = "run the named hard cases, each against its limit in physical units"
    parser = subparsers.add_parser(
        "stress",
        help=summary,
        description=summary[0].upper() + summary[1:] + ". Exits 1 if any fails.",
        epilog="example:\n" + EXAMPLE + "\n" + _groups(),
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    option = parser.add_argument
    option("groups", nargs="*", metavar="GROUP", help="groups to run (all)")
    option("--only", action="append", metavar="NAME", help="this case; may be given again")
    option("--list", action="store_true", help="print the cases and why each is hard, run none")
    option("--summary", action="store_true", help="a row per group, and those that failed")
    option("--markdown", action="store_true", help="the summary as a table for a README")
    option("--long", action="store_true", help="ten times the length where a case has more to give")
    option("--quiet", action="store_true", help="no progress")
    option("--json", action="store_true", help="print the result as JSON")
    parser.set_defaults(run=run)


def _groups() -> str:
    return "groups:\n" + "\n".join(f"  {name:9s} {about}" for name, (about, _) in GROUPS.items())


def run(arguments: argparse.Namespace) -> int:
    cases = _chosen(arguments.groups, arguments.only)
    if arguments.list:
        _print_list(cases, arguments.json)
        return 0
    with _progress(arguments, len(cases)) as advance:
        outcomes = []
        for case in cases:
            advance(case)
            outcomes.append(run_case(case, arguments.long))
    failed = [outcome for outcome in outcomes if not outcome.passed]
    if arguments.json:
        rows = [as_row(outcome) for outcome in outcomes]
        print_json("carom.stress/1", {"ok": not failed, "failed": len(failed), "cases": rows})
    elif arguments.markdown:
        print(as_markdown(outcomes))
    else:
        print(_by_group(outcomes) if arguments.summary else _by_case(outcomes))
        _print_failed(outcomes, failed)
    return 1 if failed else 0


def _chosen(groups: Sequence[str], only: Sequence[str] | None) -> list[Case]:
    """The cases of the groups, or those named, in the order of the table."""
    for group in groups:
        if group not in GROUPS:
            raise _unknown("group", group, GROUPS)
    cases = [case for group in GROUPS if not groups or group in groups for case in cases_of(group)]
    if only is None:
        return cases
    names = [case.name for case in cases]
    for name in only:
        if name not in names:
            raise _unknown("case", name, names)
    return [case for case in cases if case.name in only]


def _unknown(what: str, name: str, names: Sequence[str] | dict) -> InvalidInput:
    near = difflib.get_close_matches(name, names, 1)
    remedy = f"did you mean {near[0]}?" if near else "see carom stress --list"
    return InvalidInput(what, repr(name), "must name one", remedy)


def as_row(outcome: Outcome) -> dict[str, object]:
    case = outcome.case
    return {
        "name": case.name,
        "group": case.group,
        "why": case.why,
        "measures": case.measures,
        "value": outcome.value,
        "limit": case.limit,
        "unit": case.unit,
        "passed": outcome.passed,
        "seconds": outcome.seconds,
        "note": case.note,
        "problem": outcome.problem,
    }


def _print_list(cases: Sequence[Case], as_json: bool) -> None:
    if as_json:
        keys = ("name", "group", "why", "measures", "limit", "unit", "note")
        rows = [{key: getattr(case, key) for key in keys} for case in cases]
        print_json("carom.stress_list/1", {"cases": rows})
        return
    for group in dict.fromkeys(case.group for case in cases):
        print(f"{group}: {GROUPS[group][0]}")
        mine = [case for case in cases if case.group == group]
        print(table(["  case", "why it is hard"], [["  " + c.name, c.why] for c in mine]) + "\n")


def _by_group(outcomes: Sequence[Outcome]) -> str:
    lines = []
    for group in dict.fromkeys(outcome.case.group for outcome in outcomes):
        mine = [outcome for outcome in outcomes if outcome.case.group == group]
        bad = sum(not outcome.passed for outcome in mine)
        seconds = sum(outcome.seconds for outcome in mine)
        lines.append([group, str(len(mine)), str(bad), f"{seconds:.1f} s", GROUPS[group][0]])
    return table(["group", "cases", "failed", "time", "about"], lines)


def as_markdown(outcomes: Sequence[Outcome]) -> str:
    """A row per group and one for all: how many cases, how many passed, which failed. Without
    times, so that it says the same wherever it is run."""
    lines = ["| group | about | cases | passed | failed |", "|---|---|---|---|---|"]
    for group in dict.fromkeys(outcome.case.group for outcome in outcomes):
        mine = [outcome for outcome in outcomes if outcome.case.group == group]
        lines.append(_markdown_row(f"`{group}` | {GROUPS[group][0]}", mine))
    lines.append(_markdown_row("all | ", outcomes))
    return "\n".join(lines)


def _markdown_row(what: str, outcomes: Sequence[Outcome]) -> str:
    failed = [f"`{outcome.case.name}`" for outcome in outcomes if not outcome.passed]
    passed = len(outcomes) - len(failed)
    return f"| {what} | {len(outcomes)} | {passed} | {', '.join(failed)} |"


def _by_case(outcomes: Sequence[Outcome]) -> str:
    headers = ["group", "case", "", "measured", "limit", "unit", "time", "of"]
    lines = [
        [
            outcome.case.group,
            outcome.case.name,
            "pass" if outcome.passed else "FAIL",
            number(outcome.value),
            number(outcome.case.limit),
            outcome.case.unit,
            f"{outcome.seconds:.2f} s",
            outcome.case.measures,
        ]
        for outcome in outcomes
    ]
    return table(headers, lines)


def _print_failed(outcomes: Sequence[Outcome], failed: Sequence[Outcome]) -> None:
    seconds = sum(outcome.seconds for outcome in outcomes)
    print(f"\n{len(outcomes)} cases, {len(failed)} failed, {seconds:.1f} s")
    for outcome in failed:
        case = outcome.case
        found = f"{number(outcome.value)} {case.unit}, limit {number(case.limit)}"
        print(f"FAIL {case.name}: {outcome.problem or found}; {case.why}")


@contextlib.contextmanager
def _progress(arguments: argparse.Namespace, total: int) -> Iterator[Callable[[Case], None]]:
    """A bar on stderr that names the case being run, where stderr is a terminal."""
    if arguments.quiet or not sys.stderr.isatty():
        yield lambda case: None
        return
    from rich.console import Console
    from rich.progress import Progress as Bar

    with Bar(console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task("stress", total=total)
        done = iter(range(total))
        yield lambda case: bar.update(task, completed=next(done), description=case.name)
