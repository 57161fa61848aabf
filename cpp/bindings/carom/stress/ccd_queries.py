# SPDX-License-Identifier: Apache-2.0
"""Moving triangles and edges against exact rational arithmetic, one kind of trouble per case.

The judge (carom.studies.ccd_exact) isolates roots by Sturm sequences in Python integers and shares
no code with the library. Wrong is: a miss, a false alarm, a time after the first contact or more
than 1e-9 of the step before it.
"""

from __future__ import annotations

import numpy as np

from carom import ccd
from carom.stress.case import Group
from carom.studies.ccd_exact import first_contact
from carom.studies.ccd_queries import generate
from carom.studies.ccd_truth import EARLY

cases = Group("ccd")
KINDS = ("point_triangle", "edge_edge")


def wrong_answers(queries_of_kind: dict[str, np.ndarray], method: str = "certified") -> int:
    """How many answers exact arithmetic contradicts."""
    wrong = 0
    for kind, queries in queries_of_kind.items():
        answer = getattr(ccd, kind)(queries, method=method)
        for query, hit, time in zip(queries, answer.hit, answer.time, strict=True):
            truth = first_contact(kind, query)
            if truth is None or not hit:
                wrong += bool(hit) != (truth is not None)
                continue
            low, _ = truth.narrower_than(34)
            wrong += truth.minus(float(time)) < 0 or float(low) - time > EARLY
    return wrong


def of_categories(names: tuple[str, ...], scale: int, method: str, count: int = 30) -> int:
    rng = np.random.default_rng(41)
    return sum(
        wrong_answers({kind: generate(kind, name, count * scale, rng) for kind in KINDS}, method)
        for name in names
    )


def _declare(name: str, why: str, categories: tuple[str, ...]) -> None:
    """A case that puts 60 queries (30 of each kind) of each category to the library."""

    def run(method: str = "certified", scale: int = 1) -> float:
        return of_categories(categories, scale, method)

    run.__name__ = name
    measures = f"wrong answers of {60 * len(categories)}, by exact arithmetic"
    cases.case(why, measures, 0, "answers", has_long=True)(run)


_declare(
    "coplanar_throughout",
    "everything moves in one plane: the cubic is identically zero and says nothing",
    ("coplanar", "parallel", "rotated_sliding"),
)
_declare(
    "grazing_double_root",
    "touching and leaving at once, with gaps of 0, +-2^-52, +-2^-40 and +-2^-20",
    ("tangent",),
)
_declare(
    "contact_at_corners_and_borders",
    "contact exactly on a corner or an edge, and one to four ulps beside it",
    ("border", "border_ulp"),
)
_declare(
    "contact_at_the_ends_of_the_step",
    "contact exactly at t = 0 or t = 1, and one to four ulps beside it",
    ("ends", "ends_ulp"),
)
_declare(
    "degenerate_primitives",
    "triangles without area, edges without length, corners that coincide, at either end",
    ("degenerate",),
)
_declare(
    "far_from_the_origin",
    "the same shapes a million metres away: products of coordinates lose twelve digits",
    ("far",),
)
_declare(
    "tiny_and_huge",
    "sizes from 2^-1070 to 2^1018 m: squares under- and overflow",
    ("tiny", "huge", "extreme"),
)
_declare(
    "slivers_and_mixed_scales",
    "axes and corners of very different sizes in one query",
    ("slivers", "wide_range"),
)
_declare(
    "paths_a_million_times_the_size",
    "motion of 1e2 to 1e6 times the size: two roots 1e-6 apart",
    ("fast",),
)
_declare(
    "near_misses",
    "translations that stop 1e-16 to 1e-3 short, or go that much too far",
    ("gap", "screw", "static"),
)


@cases.case(
    "parallel edges sliding along one line that overlap, or miss each other by 1e-3",
    "of 40 pairs at scales 2^-30 to 2^30, wrong answers",
    0,
    "answers",
)
def parallel_edges(method: str = "certified") -> float:
    wrong = 0
    for k in (-30, -10, 0, 10, 30):
        size = 2.0**k
        for direction in np.eye(3):
            for sign in (1, -1):
                side = np.roll(direction, 1) * sign
                # b comes from the side and stops on a's line, 1e-3 of its length on or off it
                for overlap in (1e-3, -1e-3):
                    a0, a1 = np.zeros(3), direction
                    b0 = (1 - overlap) * direction
                    b1 = b0 + direction
                    query = np.array([a0, a1, b0 + side, b1 + side, a0, a1, b0, b1]) * size
                    hit = ccd.edge_edge(query[None], method=method).hit[0]
                    wrong += bool(hit) != (overlap > 0)
    return wrong


@cases.case(
    "moving the scene by 2^40 m or scaling it by 2^+-30 is exact, so no answer may change",
    "of 400 contacts, those whose time changes by more than 1e-9 of the step",
    0,
    "answers",
)
def same_time_at_any_scale(method: str = "certified") -> float:
    rng, wrong = np.random.default_rng(42), 0
    for kind in KINDS:
        queries = generate(kind, "integer_grid", 200, rng)
        first = getattr(ccd, kind)(queries, method=method)
        for changed in (queries * 2.0**30, queries * 2.0**-30, queries + 2.0**40, queries + 1e3):
            again = getattr(ccd, kind)(changed, method=method)
            wrong += int((first.hit != again.hit).sum())
            wrong += int((np.abs(first.time - again.time) > 1e-9).sum())
    return wrong
