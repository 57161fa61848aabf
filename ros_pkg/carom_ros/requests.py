# SPDX-License-Identifier: Apache-2.0
"""What can be asked of the world, as plain values: checked, comparable, and exact through JSON."""

import base64
import dataclasses
from dataclasses import dataclass, field

Vector = tuple[float, float, float]


@dataclass(frozen=True)
class ShapeSpec:
    """kind: sphere (radius), box (three extents), cylinder (radius, length), mesh; metres.

    A mesh is held as bytes, little-endian, so that it compares and logs as one value.
    """

    kind: str
    size: tuple[float, ...] = ()
    vertices: bytes = b""  # float64, three to a vertex
    faces: bytes = b""  # int32, three to a face


@dataclass(frozen=True)
class Spawn:
    """A new body, or the same one moved when its identity already lives."""

    source: str
    ns: str
    id: int
    name: str
    shape: ShapeSpec
    position: Vector
    orientation: tuple[float, float, float, float]
    velocity: Vector = (0.0, 0.0, 0.0)
    angular_velocity: Vector = (0.0, 0.0, 0.0)
    properties: dict[str, float] = field(default_factory=dict)  # mass, density, friction, ...
    static: bool = False
    frames: dict[str, Vector] = field(default_factory=dict)
    lifetime: float = 0.0  # s of simulated time, 0 for ever
    colour: tuple[float, float, float, float] = (0.0, 0.0, 0.0, 0.0)


@dataclass(frozen=True)
class Delete:
    source: str
    ns: str
    id: int
    name: str = ""  # where given, this body, whoever made it


@dataclass(frozen=True)
class DeleteAll:
    """Every spawned body, or those of one namespace; the scene's own stay."""

    source: str
    ns: str = ""


@dataclass(frozen=True)
class SetState:
    """Pose in the world; twist of the body frame's origin in the body's axes, as Odometry has."""

    source: str
    body: str
    position: Vector
    orientation: tuple[float, float, float, float]
    velocity: Vector
    angular_velocity: Vector


@dataclass(frozen=True)
class Wrench:
    """Held force and torque, at the centre of mass or at a named frame of the body."""

    source: str
    body: str
    force: Vector
    torque: Vector
    frame: str = ""
    in_body_axes: bool = True
    hold: float = 0.0  # s of simulated time, 0 for ever


@dataclass(frozen=True)
class Impulse:
    """N s and N m s, once."""

    source: str
    body: str
    force: Vector
    torque: Vector
    frame: str = ""
    in_body_axes: bool = True


@dataclass(frozen=True)
class LoadScene:
    """A whole scene as YAML text; replaces what there is."""

    source: str
    text: str
    scene: object = field(default=None, compare=False, repr=False)  # already read, or None


@dataclass(frozen=True)
class Reset:
    """Back to the scene as it was at the start, time 0."""

    source: str


Request = LoadScene | Reset | Spawn | Delete | DeleteAll | SetState | Wrench | Impulse

# Requests of one step boundary are applied by kind in this order, then as they came. Topics have
# no order among themselves, so a spawn and the wrench for it, sent together, must not depend on
# which subscription was read first.
ORDER: dict[type, int] = {
    LoadScene: 0, Reset: 0, Spawn: 1, Delete: 1, DeleteAll: 1, SetState: 2, Wrench: 3, Impulse: 4
}  # fmt: skip

_KINDS = {kind.__name__: kind for kind in ORDER}


def to_plain(request: Request) -> dict[str, object]:
    """For JSON: Python writes a double so that reading it gives the same bits."""
    parts = {each.name: getattr(request, each.name) for each in dataclasses.fields(request)}
    plain: dict[str, object] = {"request": type(request).__name__, **parts}
    plain.pop("scene", None)
    if isinstance(request, Spawn):
        plain["shape"] = dataclasses.asdict(request.shape)
        for key in ("vertices", "faces"):
            plain["shape"][key] = base64.b64encode(plain["shape"][key]).decode("ascii")
    return plain


def from_plain(plain: dict[str, object]) -> Request:
    """The request that to_plain made this of, after a trip through JSON."""
    values = {key: _tuples(value) for key, value in plain.items() if key != "request"}
    if "shape" in values:
        shape = values["shape"]
        decoded = {key: base64.b64decode(shape[key]) for key in ("vertices", "faces")}
        values["shape"] = ShapeSpec(**{**shape, **decoded})
    return _KINDS[plain["request"]](**values)


def _tuples(value: object) -> object:
    if isinstance(value, list):
        return tuple(_tuples(item) for item in value)
    if isinstance(value, dict):
        return {key: _tuples(item) for key, item in value.items()}
    return value
