# SPDX-License-Identifier: Apache-2.0
"""carom topic: messages from YAML and back, and the verbs against a running node."""

import array
import contextlib
import io
import json
import math
from collections.abc import Callable

import numpy as np
import pytest
from builtin_interfaces.msg import Time
from diagnostic_msgs.msg import DiagnosticStatus
from geometry_msgs.msg import Pose, PoseArray, PoseWithCovariance, Vector3
from ruamel.yaml import YAML
from sensor_msgs.msg import Image, JointState, LaserScan
from shape_msgs.msg import SolidPrimitive
from std_msgs.msg import ByteMultiArray, Header, Int8, String, UInt8MultiArray
from visualization_msgs.msg import Marker

from carom_ros.refusal import Refusal
from carom_ros.topic.arguments import main
from carom_ros.topic.fill import fill
from carom_ros.topic.render import pick, plain, shorten, to_csv, to_flow, to_json, to_yaml
from carom_ros.topic.types import message_class


def filled(kind: type, values: object, **options: object) -> object:
    msg = kind()
    fill(msg, values, **options)
    return msg


def test_nested_messages_arrays_and_defaults() -> None:
    msg = filled(PoseArray, {"poses": [{"position": {"x": 1}}, {}], "header": {"frame_id": "w"}})
    assert msg.header.frame_id == "w"
    assert msg.poses == [Pose(), Pose()] or msg.poses[0].position.x == 1.0
    assert (msg.poses[0].position.x, msg.poses[1].orientation.w) == (1.0, 1.0)


def test_an_int_in_a_double_field_is_that_number() -> None:
    # rclpy itself would send 5e-324 for it.
    assert filled(Vector3, {"x": 3}).x == 3.0
    assert isinstance(filled(Vector3, {"x": 3}).x, float)


def test_arrays_of_every_kind() -> None:
    assert filled(PoseWithCovariance, {"covariance": list(range(36))}).covariance[35] == 35
    assert filled(JointState, {"position": [1, 2.5]}).position == array.array("d", [1, 2.5])
    assert filled(JointState, {"name": ["a", "b"]}).name == ["a", "b"]
    assert filled(UInt8MultiArray, {"data": [0, 255]}).data == array.array("B", [0, 255])
    assert filled(ByteMultiArray, {"data": [0, 255]}).data == [b"\x00", b"\xff"]
    assert filled(DiagnosticStatus, {"level": 2}).level == b"\x02"
    assert filled(LaserScan, {"ranges": [math.inf]}).ranges[0] == math.inf
    assert list(filled(SolidPrimitive, {"dimensions": [1, 2, 3]}).dimensions) == [1, 2, 3]


def test_auto_and_now_are_the_present() -> None:
    now = Time(sec=7, nanosec=8)
    assert filled(PoseArray, {"header": "auto"}, now=now).header.stamp == now
    assert filled(Header, {"stamp": "now"}, now=now).stamp == now


@pytest.mark.parametrize(
    ("kind", "values", "words"),
    [
        (Vector3, {"x": "1"}, "x: 1, must be a number"),
        (Vector3, {"x": True}, "must be a number"),
        (Vector3, {"q": 1}, "is no field of geometry_msgs/msg/Vector3"),
        (Vector3, [1, 2, 3], "mapping"),
        (Vector3, 3, "mapping"),
        (Vector3, {"x": 10**400}, "too large"),
        (Int8, {"data": 128}, "-128 to 127"),
        (Int8, {"data": 1.0}, "whole number"),
        (String, {"data": 5}, "quote it: '5'"),
        (LaserScan, {"angle_min": 1e39}, "too large for a float"),
        (LaserScan, {"ranges": 3}, "must be a list"),
        (PoseWithCovariance, {"covariance": [1]}, "must have 36"),
        (SolidPrimitive, {"dimensions": [1, 2, 3, 4]}, "at most 3"),
        (SolidPrimitive, {"type": 256}, "0 to 255"),
        (DiagnosticStatus, {"level": 256}, "0 to 255"),
        (PoseArray, {"poses": [{}, {"position": {"x": None}}]}, r"poses\[1\]\.position\.x"),
        (PoseArray, {"header": {"frame": "x"}}, r"header\.frame: .*did you mean frame_id"),
        (Header, {"stamp": {"sec": 2**31}}, r"stamp\.sec"),
    ],
)
def test_a_value_that_does_not_fit_is_refused_by_field(
    kind: type, values: object, words: str
) -> None:
    with pytest.raises(Refusal, match=words):
        filled(kind, values)


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("Pose", "must be like"),
        ("geometry_msg/msg/Pose", "did you mean geometry_msgs"),
        ("geometry_msgs/msg/Poze", "did you mean Pose"),
        ("os/msg/path", "no message package"),
        ("geometry_msgs/srv/Pose", "must be like"),
        ("../x/msg/Y", "must be like"),
    ],
)
def test_a_type_that_is_not_there_is_refused_with_the_nearest(name: str, words: str) -> None:
    with pytest.raises(Refusal, match=words):
        message_class(name)


def test_both_spellings_of_a_type() -> None:
    assert message_class("geometry_msgs/Pose") is message_class("geometry_msgs/msg/Pose") is Pose


def samples() -> list[object]:
    image = Image(height=1, width=2, data=array.array("B", [1, 2]), encoding="rgb8")
    texts = [String(data=t) for t in ("", "a b", "true", "3", "a: b", "- x", "'", '"\n', "é", "#")]
    numbers = [Vector3(x=x) for x in (0.1, 1e300, -0.0, math.nan, math.inf, -math.inf, 5e-324)]
    pair = PoseArray(poses=[Pose(), Pose()])
    return [image, pair, PoseArray(), PoseWithCovariance(), Marker(), *texts, *numbers]


@pytest.mark.parametrize("msg", samples(), ids=lambda m: type(m).__name__)
def test_what_is_printed_reads_back_as_the_message(msg: object) -> None:
    for text in ("\n".join(to_yaml(plain(msg))), to_flow(plain(msg))):
        back = filled(type(msg), YAML(typ="safe", pure=True).load(text))
        np.testing.assert_equal(plain(back), plain(msg))


def test_json_has_no_nan() -> None:
    assert json.loads(to_json(plain(Vector3(x=math.nan, y=1.5)))) == {"x": None, "y": 1.5, "z": 0.0}


def test_csv_quotes_only_what_needs_it() -> None:
    assert to_csv({"a": 'x,"y"', "b": [1, 2.5], "c": {"d": True}}) == '"x,""y""",1,2.5,true'


def test_a_part_of_a_message_by_its_path() -> None:
    msg = filled(PoseArray, {"poses": [{}, {"position": {"z": 4}}]})
    assert pick(msg, "poses[1].position.z") == 4
    for bad in (
        "poses[2]",
        "pose",
        "poses.x",
        "poses[1].q",
        "poses[",
        ".",
        "poses[-1]",
        "header[0]",
    ):
        with pytest.raises(Refusal, match="field"):
            pick(msg, bad)


def test_long_arrays_and_texts_are_cut_only_when_asked() -> None:
    value = {"a": list(range(5)), "b": "x" * 5}
    assert shorten(value, 2, arrays=True, texts=True) == {"a": [0, 1, "..."], "b": "xx..."}
    assert shorten(value, None, arrays=True, texts=True) == value
    assert shorten(value, None, arrays=False, texts=False)["a"] == "<sequence, length 5>"


# -- the verbs, against a node in another process -------------------------------------------


@pytest.fixture(scope="module")
def running(node_process: Callable) -> object:
    node = node_process("--no-log")
    with contextlib.redirect_stdout(io.StringIO()):  # its names are latched: waits for the node
        assert (
            main(["echo", "/carom/names", "std_msgs/msg/String", "--once", "--timeout", "20"]) == 0
        )
    yield node
    code, err = node.end()
    assert code == 0, err


Run = Callable[..., tuple[int, str, str]]


@pytest.fixture
def topic(running: object, capsys: pytest.CaptureFixture) -> Run:
    def run(*args: str) -> tuple[int, str, str]:
        code = main(args)
        out, err = capsys.readouterr()
        return code, out, err

    return run


CRATE = """{type: 1, ns: box, id: 1, pose: {position: {x: 3, z: 1}}, scale: {x: 1, y: 1, z: 1},
            text: '{name: crate}'}"""


def test_list_shows_the_topics_of_the_node(topic: Run) -> None:
    code, out, _ = topic("list", "-t")
    assert code == 0
    assert "/carom/poses [geometry_msgs/msg/PoseArray]" in out.splitlines()
    code, out, _ = topic("list", "--json")
    rows = {row["name"]: row for row in json.loads(out)["topics"]}
    assert rows["/carom/spawn"]["subscribers"] == 1
    assert rows["/carom/poses"]["publishers"] == 1


def test_pub_spawns_and_echo_shows_it(topic: Run) -> None:
    code, out, _ = topic("pub", "--once", "/carom/spawn", "visualization_msgs/msg/Marker", CRATE)
    assert code == 0
    assert "publishing #1" in out
    # Latched, and read as such without any option.
    code, out, _ = topic("echo", "--once", "/carom/names", "--json", "--timeout", "20")
    assert code == 0
    while "crate" not in json.loads(json.loads(out)["data"])["names"]:
        code, out, _ = topic("echo", "--once", "/carom/names", "--json", "--timeout", "20")
    field = "transforms[1].translation"
    code, out, _ = topic("echo", "--once", "/carom/states", "--field", field, "--timeout", "20")
    assert code == 0
    # It falls straight down and lands within micrometres of there.
    assert YAML(typ="safe", pure=True).load(out[:-4])["x"] == pytest.approx(3, abs=1e-4)
    assert out.endswith("---\n")


def test_pub_repeats_at_its_rate(topic: Run) -> None:
    code, out, _ = topic(
        "pub", "-t", "3", "-r", "100", "-p", "2", "-w", "1", "--json", "/carom/impulse",
        "geometry_msgs/msg/WrenchStamped", "{header: {frame_id: crate}}",
    )  # fmt: skip
    assert code == 0
    assert [json.loads(line)["number"] for line in out.splitlines()] == [1, 3]


def test_pub_reads_a_file_and_stdin(
    topic: Run, tmp_path: object, monkeypatch: pytest.MonkeyPatch
) -> None:
    kind = "geometry_msgs/msg/WrenchStamped"
    path = tmp_path / "w.yaml"
    path.write_text("header: {frame_id: from_file}")
    _, out, _ = topic("pub", "--once", "/carom/wrench", kind, "--yaml-file", str(path))
    assert "from_file" in out
    monkeypatch.setattr("sys.stdin", io.StringIO("header: {frame_id: from_stdin}"))
    _, out, _ = topic("pub", "--once", "/carom/wrench", kind, "--stdin")
    assert "from_stdin" in out
    code, out, _ = topic("echo", "/carom/rejected", "--timeout", "1.5", "--full-length")
    assert code == 0
    assert "from_file" in out  # both refused, for there are no such bodies; a late joiner sees it
    assert "from_stdin" in out


def test_echo_takes_styles_filters_and_limits(topic: Run) -> None:
    poses = "/carom/poses"
    _, out, _ = topic("echo", "--once", poses, "--csv")
    assert out.count(",") >= 9
    assert "world" in out
    _, out, _ = topic("echo", "--once", poses, "--flow-style")
    assert out.startswith("{header: {stamp: {sec:")
    _, out, _ = topic("echo", "--once", poses, "--no-arr")
    assert "<sequence, length " in out
    code, out, err = topic("echo", "--timeout", "0.5", poses, "--filter", "len(m.poses) > 1000")
    assert (code, out) == (1, "")
    assert "no message" in err


def test_hz_measures_the_rate_of_the_node(topic: Run) -> None:
    code, out, _ = topic("hz", "/carom/poses", "--timeout", "2.5", "--json")
    assert code == 0
    # 100 a second asked for; a busy machine may give fewer, and never more than it was asked.
    assert 2 < json.loads(out.splitlines()[-1])["rate_hz"] < 110


@pytest.mark.parametrize(
    ("args", "code", "words"),
    [
        (("pub", "--once", "/x", "geometry_msgs/msg/Poze"), 2, "did you mean Pose"),
        (("pub", "--once", "/x", "geometry_msgs/msg/Pose", "{position: 3}"), 2, "position"),
        (("pub", "--once", "/x", "geometry_msgs/msg/Pose", "{"), 2, "YAML"),
        (("pub", "--once", "/x y", "geometry_msgs/msg/Pose"), 2, "topic"),
        (("echo", "--once", "/nobody", "--timeout", "0.3"), 1, "not published"),
        (("echo", "--once", "/carom/poses", "--field", "pose"), 2, "no field"),
        (("echo", "--once", "/carom/poses", "--filter", "1 +"), 2, "expression"),
        (
            ("pub", "--once", "/nobody", "std_msgs/msg/String", "--max-wait-time-secs", "0.3"),
            1,
            "fewer than 1",
        ),
    ],
)
def test_what_cannot_be_is_told_with_its_exit_code(
    topic: Run, args: tuple, code: int, words: str
) -> None:
    got, _, err = topic(*args)
    assert got == code
    assert words in err


@pytest.mark.parametrize("args", [("pub",), ("echo", "/x", "--qos-depth", "-1"), (), ("sing",)])
def test_bad_usage_is_2(args: tuple, capsys: pytest.CaptureFixture) -> None:
    with pytest.raises(SystemExit) as caught:
        main(args)
    assert caught.value.code == 2
    assert "usage" in capsys.readouterr().err


@pytest.mark.parametrize("verb", ["list", "pub", "echo", "hz"])
def test_help_has_examples(verb: str, capsys: pytest.CaptureFixture) -> None:
    with pytest.raises(SystemExit) as caught:
        main([verb, "--help"])
    assert caught.value.code == 0
    assert "carom topic echo /carom/poses" in capsys.readouterr().out


def test_without_ros_it_says_how_to_get_it(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture
) -> None:
    monkeypatch.setattr("importlib.util.find_spec", lambda _: None)
    assert main(["list"]) == 3
    assert "pip install 'carom[ros]'" in capsys.readouterr().err
