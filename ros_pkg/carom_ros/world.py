# SPDX-License-Identifier: Apache-2.0
"""The simulation behind the node: applies requests at step boundaries. No ROS in this file."""

import math
from collections import deque
from dataclasses import dataclass, field

import numpy as np

import carom
from carom_ros import limits
from carom_ros.checks import nearest, require_scene_in_limits
from carom_ros.journal import Journal
from carom_ros.refusal import Refusal, refusal_of
from carom_ros.requests import (
    ORDER,
    Delete,
    DeleteAll,
    Impulse,
    LoadScene,
    Request,
    Reset,
    SetState,
    Spawn,
    Wrench,
)
from carom_ros.rotate import rotated
from carom_ros.shapes import add_arguments, checked_body


@dataclass
class Known:
    """What the world keeps of a body besides its state."""

    shape: object
    static: bool
    com: np.ndarray  # m, body frame
    mass: float  # kg
    moment: float  # kg m^2, the largest principal one
    spawn: Spawn | None = None  # the request that made it; None for the scene's own
    wrench: Wrench | None = None
    wrench_until: float = math.inf
    frames: dict[str, tuple[float, float, float]] = field(default_factory=dict)


def known_of(body: carom.Body) -> Known:
    properties = body.mass_properties
    moment = float(np.linalg.eigvalsh(properties.inertia)[-1])
    com = np.array(properties.com)
    return Known(body.shape, body.static, com, float(properties.mass), moment)


@dataclass(frozen=True)
class Outcome:
    request: Request
    refusal: Refusal | None
    what: str = ""  # "spawned", "moved", ...


class World:
    """One simulation that requests change. Not thread-safe but for submit."""

    def __init__(
        self,
        scene: carom.Scene,
        dt: float,
        *,
        max_bodies: int = 10_000,
        journal: Journal | None = None,
    ) -> None:
        self.dt, self.max_bodies = dt, max_bodies
        self.journal = journal
        self.steps = 0  # since the node started; a reset does not take it back
        self.generation = 0  # of the list of names
        self._pending: deque[Request] = deque()
        self._start(scene)

    def _start(self, scene: carom.Scene) -> None:
        simulation = carom.Simulation(scene, dt=self.dt)  # may refuse; nothing has changed then
        self._scene, self.simulation = scene, simulation
        self._identities: dict[tuple[str, int], str] = {}
        self._ends: dict[str, float] = {}  # s of simulated time; bodies with a lifetime only
        self.bodies: dict[str, Known] = {body.name: known_of(body) for body in scene.bodies}
        self._changed = True
        self.settle()

    def settle(self) -> None:
        """Renews the list of names if bodies came or went: once for all requests of a boundary."""
        if not self._changed:
            return
        self._changed = False
        self.names = self.simulation.names()
        self.generation += 1
        self.valid_from = self.simulation.time

    # -- requests ---------------------------------------------------------------------------

    def submit(self, request: Request) -> None:
        """Queues a request for the next step boundary. @throws Refusal when there are too many"""
        if len(self._pending) >= limits.PENDING_REQUESTS:
            rule = f"at most {limits.PENDING_REQUESTS} requests wait for a step"
            raise Refusal(request.source, "one more", rule, "send more slowly")
        self._pending.append(request)

    def boundary(self) -> list[Outcome]:
        """Applies what is queued, in the order of requests.ORDER and then as it came."""
        batch = [self._pending.popleft() for _ in range(len(self._pending))]
        batch.sort(key=lambda request: ORDER[type(request)])
        outcomes = [self.apply(request) for request in batch]
        self.settle()
        applied = [each.request for each in outcomes if each.refusal is None]
        if applied and self.journal:
            self.journal.requests(self.steps, applied)
        return outcomes

    def apply(self, request: Request) -> Outcome:
        """Applies one request now. Never raises what a request can cause."""
        try:
            return Outcome(request, None, _APPLY[type(request)](self, request))
        except Exception as error:  # a request may fail in any way; the node goes on
            return Outcome(request, refusal_of(error, request.source))

    def _spawn(self, request: Spawn) -> str:
        identity = (request.ns, request.id)
        old_name = self._identities.get(identity)
        if request.name in self.bodies and request.name != old_name:
            remedy = "give another name, or delete that body first"
            raise Refusal("name", request.name, "another body has it", remedy)
        shape, body = checked_body(request)
        if old_name is not None and _same_body(self.bodies[old_name].spawn, request):
            self.simulation.set_state(
                old_name,
                position=request.position,
                orientation=request.orientation,
                velocity=request.velocity,
                angular_velocity=request.angular_velocity,
            )
            known, what = self.bodies[old_name], "moved"
        else:
            if old_name is None and len(self.bodies) >= self.max_bodies:
                rule = f"there are {self.max_bodies} bodies, the most parameter max_bodies allows"
                raise Refusal("name", request.name, rule, "delete some first")
            if old_name is not None:
                self._remove(old_name)
            self.simulation.add(shape, **add_arguments(request))
            self._changed = True
            known = self.bodies[request.name] = known_of(body)
            self._identities[identity] = request.name
            what = "spawned" if old_name is None else "replaced"
        known.spawn, known.frames = request, request.frames
        self._ends.pop(request.name, None)
        if request.lifetime > 0:
            self._ends[request.name] = self.simulation.time + request.lifetime
        return what

    def _delete(self, request: Delete) -> str:
        if request.name:
            self._require(request.name, "name")
            name = request.name
        else:
            found = self._identities.get((request.ns, request.id))
            if found is None:
                remedy = "a body of the scene is deleted by text: '{name: crate}'"
                raise Refusal("ns, id", f"{request.ns!r} {request.id}", "no such body", remedy)
            name = found
        self._remove(name)
        return f"deleted {name}"

    def _delete_all(self, request: DeleteAll) -> str:
        chosen = [name for (ns, _), name in self._identities.items() if request.ns in ("", ns)]
        for name in chosen:
            self._remove(name)
        return f"deleted {len(chosen)} bodies"

    def _remove(self, name: str) -> None:
        self.simulation.remove(name)
        self._changed = True
        known = self.bodies.pop(name)
        self._ends.pop(name, None)
        if known.spawn is not None:
            self._identities.pop((known.spawn.ns, known.spawn.id), None)

    def _set_state(self, request: SetState) -> str:
        self._require(request.body, "child_frame_id")
        self.simulation.set_state(
            request.body,
            position=request.position,
            orientation=request.orientation,
            velocity=rotated(request.orientation, request.velocity),
            angular_velocity=rotated(request.orientation, request.angular_velocity),
        )
        return "moved"

    def _wrench(self, request: Wrench) -> str:
        known = self._movable(request.body)
        _require_sane(known, request, limits.ACCELERATION, "m/s^2", limits.SPIN_UP, "rad/s^2")
        hold = request.hold if request.hold > 0 else math.inf
        until = self.simulation.time + hold
        self.simulation.hold_wrench(
            request.body,
            request.force,
            request.torque,
            point_b=self._arm(known, request.frame),
            in_body_axes=request.in_body_axes,
            until=until,
        )
        held = any(request.force) or any(request.torque)
        known.wrench, known.wrench_until = (request if held else None), until
        return "held" if held else "cleared"

    def _impulse(self, request: Impulse) -> str:
        known = self._movable(request.body)
        _require_sane(known, request, limits.SPEED_M_S, "m/s", limits.SPIN_RAD_S, "rad/s")
        pose = self.simulation.poses()[self.simulation.row(request.body)]
        force, torque, point = request.force, request.torque, None
        if request.in_body_axes:
            force, torque = rotated(pose[3:], force), rotated(pose[3:], torque)
        if request.frame:
            arm = known.com + self._arm(known, request.frame)
            point = pose[:3] + rotated(pose[3:], arm)
        self.simulation.apply_impulse(request.body, force, point)
        self.simulation.apply_angular_impulse(request.body, torque)
        return "pushed"

    def _load(self, request: LoadScene) -> str:
        self._start(request.scene or read_scene_text(request.text))
        return f"loaded a scene of {len(self.bodies)} bodies"

    def _reset(self, _: Reset) -> str:
        self._start(self._scene)
        return "reset"

    # -- lookups ----------------------------------------------------------------------------

    def _require(self, name: str, field_name: str) -> Known:
        known = self.bodies.get(name)
        if known is None:
            raise Refusal(field_name, name, "there is no such body", nearest(name, self.bodies))
        return known

    def _movable(self, name: str) -> Known:
        known = self._require(name, "header.frame_id")
        if known.static:
            raise Refusal("header.frame_id", name, "is static: nothing moves it")
        return known

    def _arm(self, known: Known, frame: str) -> np.ndarray:
        """From the centre of mass to a frame of the body, m, body axes."""
        if not frame:
            return np.zeros(3)
        if frame not in known.frames:
            remedy = nearest(frame, known.frames) if known.frames else "give frames in spawn's text"
            raise Refusal("header.frame_id", frame, "the body has no such frame", remedy)
        return np.array(known.frames[frame]) - known.com

    # -- time -------------------------------------------------------------------------------

    @property
    def time(self) -> float:
        return self.simulation.time

    def set_dt(self, dt: float) -> None:
        self.dt = dt
        if self.journal:
            self.journal.dt(self.steps, dt)

    def step(self) -> list[str]:
        """One step, and then the end of bodies whose lifetime is over: their names."""
        self.simulation.step(self.dt)
        self.steps += 1
        if not self._ends:
            return []
        now = self.simulation.time
        over = [name for name, end in self._ends.items() if end <= now]
        for name in over:
            self._remove(name)
        self.settle()
        return over

    def wrenches(self) -> np.ndarray:
        """(N, 6) held force and torque of each row, world axes."""
        rows = np.zeros((len(self.names), 6))
        held = {name: known for name, known in self.bodies.items() if known.wrench is not None}
        if not held:
            return rows
        poses, now = self.simulation.poses(), self.simulation.time
        for row, name in enumerate(self.names):
            known = held.get(name)
            if known is None or now >= known.wrench_until:
                continue
            wrench = known.wrench
            pair = (wrench.force, wrench.torque)
            if wrench.in_body_axes:
                pair = tuple(rotated(poses[row, 3:], part) for part in pair)
            rows[row] = np.concatenate(pair)
        return rows


def read_scene_text(text: str) -> carom.Scene:
    """A scene sent as text; files are not read for it. @throws InvalidInput"""
    from carom.scene_file import parse

    scene = parse(text, source="~/scene")
    require_scene_in_limits(scene)
    return scene


def default_scene() -> carom.Scene:
    """Gravity and a static plane at z = 0: what a node without a scene starts with."""
    scene = carom.Scene()
    scene.effects.append(carom.UniformGravity([0, 0, -9.81]))
    scene.add(carom.Plane([0, 0, 1], 0.0), name="ground", static=True)
    return scene


def _require_sane(
    known: Known, request: Wrench | Impulse, linear: float, unit: str, angular: float, turn: str
) -> None:
    """Refuses what would throw a body out of the world, as a slip of units does.

    @throws Refusal
    """
    parts = (
        ("force", request.force, known.mass, linear, unit),
        ("torque", request.torque, known.moment, angular, turn),
    )
    for field_name, value, inertia, limit, unit_name in parts:
        size = math.hypot(*value)
        if size > limit * inertia:
            gain = size / inertia if inertia > 0 else math.inf
            rule = f"would change it by {gain:.3g} {unit_name}, the most is {limit:g}"
            raise Refusal(field_name, f"{size:.4g} on {request.body}", rule, "check the unit")


def _same_body(old: Spawn | None, new: Spawn) -> bool:
    """Whether two requests differ only in where the body is and how it moves."""
    parts = ("name", "shape", "properties", "static")
    return old is not None and all(getattr(old, part) == getattr(new, part) for part in parts)


_APPLY = {
    Spawn: World._spawn,
    Delete: World._delete,
    DeleteAll: World._delete_all,
    SetState: World._set_state,
    Wrench: World._wrench,
    Impulse: World._impulse,
    LoadScene: World._load,
    Reset: World._reset,
}
