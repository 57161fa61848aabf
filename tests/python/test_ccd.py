# SPDX-License-Identifier: Apache-2.0
"""carom.ccd against exact arithmetic, closed forms and an independent library."""

import itertools
import json
import subprocess
import sys
import textwrap
from collections import Counter
from fractions import Fraction
from importlib.util import find_spec
from pathlib import Path

import numpy as np
import pytest

from carom import ccd
from carom.studies.ccd_exact import first_contact, roots_in_unit_interval, trim
from carom.studies.ccd_queries import CATEGORIES, generate
from carom.studies.ccd_truth import KINDS, WRONG, compare

SEED = 4
ASK = {kind: getattr(ccd, kind) for kind in KINDS}

FACE = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]


def drop(x, y, z0, z1):
    """A point falling on a resting triangle."""
    return np.array([[[x, y, z0], *FACE, [x, y, z1], *FACE]], float)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("category", CATEGORIES)
def test_no_miss_no_false_alarm_no_late_time(kind, category):
    print("seed", SEED)
    rng = np.random.default_rng([SEED, KINDS.index(kind), list(CATEGORIES).index(category)])
    count = 4000 if category == "random" else 400
    counts = compare(kind, generate(kind, category, count, rng))
    assert {w: counts[w] for w in WRONG} == dict.fromkeys(WRONG, 0), counts
    assert counts["contacts"] > 0, "a category without contacts proves nothing"


def test_the_committed_full_run_covers_every_kind_and_found_nothing():
    summary = json.loads((Path(__file__).parent / "ccd_truth.json").read_text())
    assert summary["total"]["queries"] >= 100_000
    assert {w: summary["total"][w] for w in WRONG} == dict.fromkeys(WRONG, 0)
    assert set(summary["categories"]) == {f"{k}/{c}" for k in KINDS for c in CATEGORIES}


def test_contact_time_of_a_falling_point_is_the_closed_form():
    # z = 0.3 - 1.0 t: contact at 0.3
    r = ccd.point_triangle(drop(0.25, 0.25, 0.3, -0.7))
    assert r.hit[0]
    assert 0.3 - 1e-9 <= r.time[0] <= 0.3
    assert ccd.Status(r.status[0]) == ccd.Status.certified


def test_each_status_is_reported_for_what_it_means():
    inside, corner, in_plane = drop(0.25, 0.25, 1, -1), drop(0, 0, 1, -1), drop(0.25, 0.25, 0, 0)
    r = ccd.point_triangle(np.concatenate([inside, corner, in_plane]))
    assert r.hit.all()
    assert [ccd.Status(int(s)).name for s in r.status] == ["certified", "exact", "coplanar"]
    assert r.time[2] == 0
    grazing = ccd.point_triangle(drop(0.25, 0.25, 1, 0.5), thickness=0.5)
    assert grazing.hit[0]
    assert ccd.Status(grazing.status[0]) == ccd.Status.conservative


@pytest.mark.parametrize("scale", [2.0**-30, 2.0**30, 2.0**-1000, 2.0**900])
@pytest.mark.parametrize("kind", KINDS)
def test_scaling_by_a_power_of_two_changes_nothing(kind, scale):
    rng = np.random.default_rng(SEED)
    q = generate(kind, "integer_grid", 300, rng)
    one, other = ASK[kind](q), ASK[kind](q * scale)
    np.testing.assert_array_equal(one.hit, other.hit)
    # the same contact, each time early by at most 1e-9
    np.testing.assert_allclose(one.time, other.time, rtol=0, atol=1e-9)


@pytest.mark.parametrize("kind", KINDS)
def test_order_of_corners_and_edges_does_not_matter(kind):
    rng = np.random.default_rng(SEED)
    q = generate(kind, "border_ulp", 400, rng)
    orders = (
        [(0, *p) for p in itertools.permutations((1, 2, 3))]
        if kind == "point_triangle"
        else [(0, 1, 2, 3), (1, 0, 2, 3), (0, 1, 3, 2), (2, 3, 0, 1), (3, 2, 1, 0)]
    )
    hits = [ASK[kind](q[:, [*order, *(4 + i for i in order)]]).hit for order in orders]
    for h in hits[1:]:
        np.testing.assert_array_equal(h, hits[0])


@pytest.mark.parametrize("kind", KINDS)
def test_a_batch_answers_as_its_parts_do(kind):
    # lanes take four queries: tails of 1, 2, 3 and whole blocks must agree
    q = generate(kind, "integer_grid", 23, np.random.default_rng(SEED))
    whole = ASK[kind](q)
    for n in (1, 2, 3, 5, 22):
        part = ASK[kind](q[:n])
        np.testing.assert_array_equal(part.hit, whole.hit[:n])
        np.testing.assert_array_equal(part.time, whole.time[:n])
    assert ASK[kind](np.zeros((0, 8, 3))).hit.shape == (0,)


# ---- thickness ----------------------------------------------------------------------------------


def sampled_distance(kind, q, samples=400):
    """The least distance at sampled times: never below the least over the step."""
    t = np.linspace(0, 1, samples)[:, None, None]
    p = (1 - t) * q[None, :4] + t * q[None, 4:]
    if kind == "point_triangle":
        v = p[:, 1:] - p[:, :1]
    else:
        v = np.stack([p[:, a] - p[:, b] for a, b in ((0, 2), (1, 2), (1, 3), (0, 3))], axis=1)

    def rows(a, b):
        return np.einsum("ti,ti->t", a, b)

    n = v.shape[1]
    normal = np.cross(v[:, 1] - v[:, 0], v[:, 2] - v[:, 1])
    inside = rows(normal, normal) > 0
    best = np.inf
    for i in range(n):
        e = v[:, (i + 1) % n] - v[:, i]
        length = rows(e, e)
        s = np.clip(-rows(v[:, i], e) / np.where(length > 0, length, 1), 0, 1)
        best = min(best, np.linalg.norm(v[:, i] + s[:, None] * e, axis=1).min())
        inside &= rows(np.cross(v[:, i], v[:, (i + 1) % n]), normal) > 0
    if inside.any():
        height = np.abs(rows(v[inside, 0], normal[inside]))
        best = min(best, (height / np.linalg.norm(normal[inside], axis=1)).min())
    return best


@pytest.mark.parametrize(
    "category", ["random", "integer_grid", "coplanar", "degenerate", "tangent"]
)
@pytest.mark.parametrize("kind", KINDS)
def test_thickness_never_misses_a_sampled_approach(kind, category):
    rng = np.random.default_rng(SEED)
    q = generate(kind, category, 150, rng)
    bare = ASK[kind](q)
    for thickness in (1e-6, 0.05, 0.4):
        r = ASK[kind](q, thickness=thickness)
        for i in range(len(q)):
            # 1e-14: sampling itself rounds, coordinates are below 8
            if sampled_distance(kind, q[i]) <= thickness - 1e-14:
                assert r.hit[i], (kind, category, i, thickness)
        # what touches is also within any thickness, and no later
        assert (r.hit | ~bare.hit).all()
        assert (r.time[bare.hit] <= bare.time[bare.hit] + 1e-9).all()


def test_thickness_has_no_false_alarm_beyond_the_stated_slack():
    # a falling point stops `gap` above the face: the least distance is known exactly
    for gap, thickness in [(0.25, 0.25 * (1 - 1e-10)), (2.0**-20, 2.0**-20 * 0.999), (1.0, 0.999)]:
        q = drop(0.25, 0.25, 3, gap)
        assert gap > thickness + 1e-12 * (thickness + 3.0), "the case must lie outside the slack"
        assert not ccd.point_triangle(q, thickness=thickness).hit[0]
        assert ccd.point_triangle(q, thickness=gap).hit[0]


def test_thickness_time_is_the_closed_form():
    # z = 1 - t meets 0.25 at t = 0.75
    r = ccd.point_triangle(drop(0.25, 0.25, 1, 0), thickness=0.25)
    assert r.hit[0]
    assert 0.75 - 1e-9 <= r.time[0] <= 0.75


# ---- the lecture's route and the float baseline are selectable, and worse -----------------------


def counts_of(kind, method, category, count=300):
    rng = np.random.default_rng(SEED)
    q = generate(kind, category, count, rng)
    truth = np.array([first_contact(kind, x) is not None for x in q])
    hit = ASK[kind](q, method=method).hit
    return Counter(misses=int((truth & ~hit).sum()), false_alarms=int((~truth & hit).sum()))


@pytest.mark.parametrize("kind", KINDS)
def test_the_plain_methods_agree_on_easy_queries(kind):
    assert counts_of(kind, "lecture", "simulation") == Counter(misses=0, false_alarms=0)
    assert counts_of(kind, "tolerance", "simulation")["misses"] == 0


@pytest.mark.parametrize("kind", KINDS)
def test_the_lecture_route_misses_hard_contacts_and_the_tolerance_cries_wolf(kind):
    assert counts_of(kind, "lecture", "coplanar")["misses"] > 0
    assert counts_of(kind, "tolerance", "tiny")["false_alarms"] > 0


# ---- roots --------------------------------------------------------------------------------------


def exact_cubic_roots(c):
    ratios = [float(x).as_integer_ratio() for x in c]
    top = max(d for _, d in ratios)
    return roots_in_unit_interval(trim([n * (top // d) for n, d in ratios]))


def hard_cubics():
    rng = np.random.default_rng(SEED)
    yield from rng.uniform(-1, 1, (400, 4))
    for a, b, c in rng.integers(0, 9, (300, 3)) / 8:  # triple and double roots, roots at the ends
        exact = np.array([-a * b * c, a * b + b * c + c * a, -(a + b + c), 1])
        yield exact
        yield np.nextafter(exact, rng.choice([-9, 9], 4))
    yield from ([0.25, -1, 1, 1e-300], [-0.5, 1, 0, 0], [1e-320, -1e-319, 0, 0], [1, 0, 0, 0])
    yield from ([1e300, -1e301, 3e300, 0], [0, 0, 0, -1], [0, 1, 0, 0])


def test_roots_are_those_of_exact_isolation():
    cubics = np.array(list(hard_cubics()))
    found = ccd.cubic_roots(cubics)
    # the middle of a bracket of 16 u, ends on a grid of 2^-60
    reach = Fraction(1, 2**50) + Fraction(1, 2**59)
    for c, row in zip(cubics, found.roots, strict=True):
        truth = exact_cubic_roots(c)
        mine = row[~np.isnan(row)]
        assert len(mine) == len(truth), c
        for r, x in zip(truth, mine, strict=True):
            low, high = r.narrower_than(60)
            assert low - reach <= Fraction(float(x)) <= high + reach, c
    assert (found.status == int(ccd.RootStatus.converged)).all()


def test_the_lecture_route_finds_simple_roots_and_counts_its_iterations():
    rng = np.random.default_rng(SEED)
    cubics = rng.uniform(-1, 1, (500, 4))
    exact, lecture = ccd.cubic_roots(cubics), ccd.cubic_roots(cubics, method="lecture")
    np.testing.assert_array_equal(np.isnan(exact.roots), np.isnan(lecture.roots))
    # a root moves by (value error 8u) / slope; the slopes at these roots exceed 1e-4
    np.testing.assert_allclose(lecture.roots, exact.roots, rtol=0, atol=1e-11)
    with_root = ~np.isnan(lecture.roots).all(axis=1)
    assert (lecture.iterations[with_root] > 0).all()
    assert lecture.iterations.max() <= 3 * 64


def test_the_status_tells_cap_and_zero_polynomial():
    roots, status = ccd.cubic_roots([[0, 0, 0, 0]])
    assert np.isnan(roots).all()
    assert ccd.RootStatus(status[0]) == ccd.RootStatus.zero_polynomial
    capped = ccd.cubic_roots([[-0.3, 1, 1, 1]], method="lecture", max_iterations=2)
    assert ccd.RootStatus(capped.status[0]) == ccd.RootStatus.cap
    assert capped.iterations[0] == 2


# ---- refusals -----------------------------------------------------------------------------------


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_what_is_not_finite_is_refused_with_its_row(bad):
    q = np.zeros((7, 8, 3))
    q[5, 6, 1] = bad
    for ask in ASK.values():
        with pytest.raises(ValueError, match=r"queries\[5\].*finite"):
            ask(q)
    with pytest.raises(ValueError, match="finite"):
        ccd.cubic_roots([[0, bad, 0, 0]])


def test_wrong_shapes_thickness_and_methods_are_refused():
    one = np.zeros((1, 8, 3))
    with pytest.raises(ValueError, match="shape"):
        ccd.point_triangle(np.zeros((8, 3)))
    with pytest.raises(ValueError, match="thickness"):
        ccd.edge_edge(one, thickness=-1.0)
    with pytest.raises(ValueError, match="thickness"):
        ccd.edge_edge(one, thickness=np.nan)
    with pytest.raises(ValueError, match="method"):
        ccd.edge_edge(one, method="bogus")
    with pytest.raises(ValueError, match="shape"):
        ccd.cubic_roots(np.zeros(4))


# ---- a second opinion ---------------------------------------------------------------------------

OPINION = textwrap.dedent("""
    import resource, sys
    resource.setrlimit(resource.RLIMIT_AS, (4 << 30, 4 << 30))
    resource.setrlimit(resource.RLIMIT_CPU, (60, 60))
    import ipctk, numpy as np
    data = np.load(sys.argv[1])
    # few iterations: it then answers "hit" when undecided, which is its safe side
    method = ipctk.TightInclusionCCD(1e-6, 10_000, 1.0)
    out = {}
    for kind, f in (("point_triangle", method.point_triangle_ccd),
                    ("edge_edge", method.edge_edge_ccd)):
        out[kind] = np.array([f(*q)[0] for q in data[kind]])
    np.savez(sys.argv[2], **out)
""")


@pytest.mark.skipif(find_spec("ipctk") is None, reason="ipctk is not installed")
def test_tight_inclusion_agrees_on_random_queries(tmp_path):
    # Tight-Inclusion never misses, and alarms falsely only within about its 1e-6. It can loop
    # without limit, hence a child with caps on time and memory.
    rng = np.random.default_rng(SEED)
    queries = {k: generate(k, "random", 300, rng) for k in KINDS}
    np.savez(tmp_path / "in.npz", **queries)
    args = [sys.executable, "-c", OPINION, tmp_path / "in.npz", tmp_path / "out.npz"]
    subprocess.run(args, check=True, timeout=120)
    theirs = np.load(tmp_path / "out.npz")
    for kind in KINDS:
        ours = ASK[kind](queries[kind]).hit
        assert ours.sum() > 5
        assert not (ours & ~theirs[kind]).any()
        assert not (theirs[kind] & ~ASK[kind](queries[kind], thickness=1e-5).hit).any()


# ---- rigid motion -------------------------------------------------------------------------------


def test_a_spinning_rod_meets_a_post_that_its_straight_corner_paths_miss():
    # half a turn: the ends' chords pass through the centre, never near the post at 0.9 m
    ends = np.array([[-1.0, 0, 0], [1, 0, 0]])
    post = np.array([[0, 0.9, -1.0], [0, 0.9, 1]])
    chords = np.concatenate([ends, post, -ends, post])[None]
    assert not ccd.edge_edge(chords, thickness=0.5).hit[0]
    r = ccd.sweep(
        ccd.SweptBody(ends, edges=[[0, 1]], rotation=[0, 0, np.pi]),
        ccd.SweptBody(post, edges=[[0, 1]]),
    )
    assert r.status == ccd.SweepStatus.contact
    assert r.kind == ccd.Feature.edge_edge
    # the rod stands at the post after a quarter turn; early by the gap of 1e-6 m seen from there
    assert 0.5 - 2 * 1e-6 / 0.9 / np.pi <= r.time <= 0.5
    assert 1 < r.intervals < 100


def test_a_sweep_refuses_bad_indices():
    with pytest.raises(ValueError, match=r"a\.edges"):
        ccd.sweep(ccd.SweptBody([[0, 0, 0]], edges=[[0, 1]]), ccd.SweptBody([[1, 0, 0]]))


# ---- the study ----------------------------------------------------------------------------------


def test_the_study_shows_the_certified_method_alone_without_a_wrong_answer(tmp_path):
    from carom.studies import ccd as study

    rows = study.run(random=60, hard=8, peer_seconds=0)  # 0: ipctk's rows hold one query or none
    rows = [r for r in rows if not r["method"].startswith("ipctk")]
    assert {r["method"] for r in rows} == set(study.OURS.values())
    for r in rows:
        assert r["queries"] > 50
        assert r["seconds"] > 0
        if r["method"] == "carom":
            assert r["misses"] == r["false_alarms"] == 0
        elif r["case"].endswith("hard"):
            assert r["misses"] > 0
    if find_spec("matplotlib"):
        study.plot(rows, tmp_path / "ccd.png")
        assert (tmp_path / "ccd.png").stat().st_size > 10_000
