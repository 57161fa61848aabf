# SPDX-License-Identifier: Apache-2.0
"""Random messages: a request or a refusal, never anything else, and the world stays finite."""

import math
from collections.abc import Callable
from types import SimpleNamespace as Record

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from carom_ros import commands, marker, strict_yaml
from carom_ros.refusal import Refusal
from carom_ros.world import World, default_scene

EXTREME = [0.0, -0.0, 1.0, -1.0, 1e-310, 1e-4, 0.2, 1e5, 1e6, 1e300, math.inf, -math.inf, math.nan]
NUMBER = st.one_of(st.sampled_from(EXTREME), st.floats(width=64))
LIKELY = st.one_of(st.floats(0.1, 2.0), NUMBER)  # so that some messages pass
TEXT = st.one_of(
    st.sampled_from(["", "crate", "{mass: 2}", "{name: a, static: true}", "{velocity: [1, 2, 3]}"]),
    st.text(max_size=40),
    st.text("{}[]:,'\"!&*|>-# \n\t0129eE.+", max_size=60),
)


def vector(number: st.SearchStrategy) -> st.SearchStrategy:
    return st.builds(Record, x=number, y=number, z=number)


ROTATION = st.one_of(
    st.just(Record(x=0.0, y=0.0, z=0.0, w=1.0)),
    st.builds(Record, x=NUMBER, y=NUMBER, z=NUMBER, w=NUMBER),
)
POSE = st.builds(Record, position=vector(LIKELY), orientation=ROTATION)
WRENCH = st.builds(Record, force=vector(LIKELY), torque=vector(LIKELY))
HEADER = st.builds(Record, frame_id=st.one_of(st.sampled_from(["", "world", "box_1"]), TEXT))
FIELDS = {
    "header": HEADER,
    "ns": TEXT,
    "id": st.integers(-(2**31), 2**31 - 1),
    "type": st.one_of(st.sampled_from([0, 1, 2, 3, 10, 11]), st.integers(-(2**31), 2**31 - 1)),
    "action": st.one_of(st.sampled_from([0, 1, 2, 3]), st.integers(-(2**31), 2**31 - 1)),
    "pose": POSE,
    "scale": vector(LIKELY),
    "points": st.lists(vector(LIKELY), max_size=13),
    "lifetime": st.builds(
        Record, sec=st.integers(-(2**31), 2**31 - 1), nanosec=st.integers(0, 2**32 - 1)
    ),
    "color": st.builds(Record, r=NUMBER, g=NUMBER, b=NUMBER, a=NUMBER),
    "text": TEXT,
    "mesh_resource": TEXT,
}


def good_marker() -> Record:
    return Record(
        header=Record(frame_id=""), ns="box", id=1, type=1, action=0, text="", points=[],
        pose=Record(position=Record(x=0, y=0, z=1), orientation=Record(x=0, y=0, z=0, w=1)),
        scale=Record(x=1, y=1, z=1), lifetime=Record(sec=0, nanosec=0), mesh_resource="",
        color=Record(r=0, g=0, b=0, a=0),
    )  # fmt: skip


@st.composite
def markers(draw: st.DrawFn) -> Record:
    """A good marker with up to four of its fields replaced by anything."""
    msg = good_marker()
    for name in draw(st.lists(st.sampled_from(sorted(FIELDS)), max_size=4, unique=True)):
        setattr(msg, name, draw(FIELDS[name]))
    return msg


def attempt(action: Callable[[], object]) -> Refusal | None:
    """What was refused, if it was; any other exception is the test's failure."""
    try:
        action()
    except Refusal as refusal:
        text = str(refusal)
        if not text.isprintable():
            raise AssertionError(f"not printable: {text!r}") from refusal
        return refusal
    return None


@given(st.lists(markers(), min_size=1, max_size=4))
@settings(max_examples=150, deadline=None)
def test_any_markers(messages: list[Record]) -> None:
    world = World(default_scene(), 0.01)
    for msg in messages:
        attempt(lambda msg=msg: world.submit(marker.request_of(msg, "~/spawn")))
    world.boundary()
    assert world.names[:1] == ["ground"]
    assert len(set(world.names)) == len(world.names)
    for _ in range(3):
        world.step()
    assert np.isfinite(world.simulation.poses()).all()


@given(st.builds(Record, header=HEADER, wrench=WRENCH), st.booleans())
@settings(max_examples=150, deadline=None)
def test_any_wrench(msg: Record, once: bool) -> None:
    world = World(default_scene(), 0.01)
    world.submit(marker.request_of(good_marker(), ""))
    if once:
        attempt(lambda: world.submit(commands.stamped_impulse(msg, "~/impulse")))
    else:
        attempt(lambda: world.submit(commands.stamped_wrench(msg, "~/wrench", 1.0)))
    world.boundary()
    for _ in range(3):
        world.step()
    assert np.isfinite(world.simulation.poses()).all()


@given(TEXT)
@settings(max_examples=400, deadline=None)
def test_any_text_is_yaml_or_refused(text: str) -> None:
    attempt(lambda: strict_yaml.load(text, "text", 1000))


def test_the_random_messages_are_not_all_refused() -> None:
    used = []

    @given(markers())
    @settings(max_examples=200, deadline=None, database=None)
    def count(msg: Record) -> None:
        used.append(attempt(lambda: marker.request_of(msg, "")) is None)

    count()
    assert 0.02 < np.mean(used) < 0.98
