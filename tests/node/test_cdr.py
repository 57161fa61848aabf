# SPDX-License-Identifier: Apache-2.0
"""Poses written straight to bytes are the messages the ordinary serialiser makes."""

import numpy as np
import pytest
from geometry_msgs.msg import PoseArray
from rclpy.serialization import deserialize_message, serialize_message
from sensor_msgs.msg import MultiDOFJointState

from carom_ros import cdr, plain_messages
from carom_ros.cdr import PoseArrayBytes, StatesBytes

STAMP = (12, 345_678_901)


@pytest.mark.parametrize("frame", ["", "w", "wo", "wor", "world", "été"])
@pytest.mark.parametrize("count", [0, 1, 2, 1000])
def test_pose_bytes_are_the_message(frame: str, count: int) -> None:
    poses = np.random.default_rng(count).normal(size=(count, 7))
    reference = plain_messages.pose_array(frame, *STAMP, poses)
    ours = PoseArrayBytes(frame, count).encode(*STAMP, poses)
    assert deserialize_message(ours, PoseArray) == reference
    # The reader's length is the writer's, so nothing is left over at the end.
    assert len(ours) == len(serialize_message(reference))


@pytest.mark.parametrize("count", [0, 1, 2, 3, 200])
def test_state_bytes_are_the_message(count: int) -> None:
    rows = np.random.default_rng(count).normal(size=(count, 19))
    arrays = (rows[:, :7], rows[:, 7:13], rows[:, 13:])
    names = [f"body{'_' * (row % 7)}{row}" for row in range(count)]
    ours = StatesBytes("world", names).encode(*STAMP, *arrays)
    reference = plain_messages.states("world", names, *STAMP, *arrays)
    assert deserialize_message(ours, MultiDOFJointState) == reference
    assert len(ours) == len(serialize_message(reference))


def test_the_wrong_number_of_poses_is_no_message() -> None:
    with pytest.raises(ValueError, match="shape"):
        PoseArrayBytes("world", 2).encode(0, 0, np.zeros((3, 7)))


def test_the_check_at_the_start_accepts_this_middleware() -> None:
    assert plain_messages.bytes_are_understood("world")


def test_the_check_at_the_start_sees_a_shift(monkeypatch: pytest.MonkeyPatch) -> None:
    # As on a middleware that aligned doubles to 4 bytes, like CDR version 2.
    real = cdr._aligned
    monkeypatch.setattr(cdr, "_aligned", lambda buffer, size: real(buffer, min(size, 4)))
    assert not plain_messages.bytes_are_understood("world")


def test_a_node_that_cannot_use_bytes_publishes_the_ordinary_way(
    make_bench: object, monkeypatch: pytest.MonkeyPatch
) -> None:
    real = cdr._aligned
    monkeypatch.setattr(cdr, "_aligned", lambda buffer, size: real(buffer, min(size, 4)))
    bench = make_bench()
    assert not bench.node.outputs.raw
    poses = bench.listen("/carom/poses", PoseArray)
    bench.until(lambda: poses)
    assert len(poses[0].poses) == 1
    assert poses[0].poses[0].orientation.w == 1.0
