# SPDX-License-Identifier: Apache-2.0
"""The ROS 2 node: messages in, rigid bodies moving, poses out. There is no physics in this file."""

import threading
import time
from collections.abc import Callable
from pathlib import Path

from diagnostic_msgs.msg import DiagnosticArray
from rclpy.node import Node
from std_srvs.srv import SetBool, Trigger
from visualization_msgs.msg import MarkerArray

import carom
from carom_ros import diagnostics, qos
from carom_ros.inputs import Inputs
from carom_ros.journal import Journal, SceneSource
from carom_ros.markers_out import BodyMarkers, contact_markers
from carom_ros.optional_outputs import Odometries, Transforms
from carom_ros.outputs import Outputs
from carom_ros.parameters import Parameters
from carom_ros.refusal import refusal_of
from carom_ros.requests import Reset
from carom_ros.schedule import Every, Pace
from carom_ros.world import Outcome, World, default_scene

LOG_BYTES = 256 * 1024 * 1024
SAID_PER_TICK = 20
TICK_BUDGET_S = 0.2
"""Steps of one tick end after this, however many are owed, so that requests are still heard."""


class SimulationNode(Node):
    """Steps a World once per tick and publishes it.

    Callbacks only queue; requests apply at the next tick. tick() may run in another thread than the
    executor. Whoever owns the node calls it every `period` seconds; tests call it by hand.
    """

    def __init__(
        self,
        scene: carom.Scene | None = None,
        *,
        source: SceneSource | None = None,
        log: Path | None = None,
        overrides: dict[str, object] | None = None,
        **node_options: object,
    ) -> None:
        super().__init__("carom", **node_options)
        self.p = Parameters(self, overrides)
        if scene is None:
            scene = default_scene()
        dt = self.p.dt_s
        self._journal = Journal(log, source or SceneSource(), dt, LOG_BYTES) if log else None
        self.world = World(scene, dt, max_bodies=self.p.max_bodies, journal=self._journal)
        self.paused = self.p.paused
        self.pace = Pace()
        self.outputs = Outputs(self, self.p.frame_id)
        self.inputs = Inputs(self, self.world, self._refuse, self.p)
        self.on_outcome: Callable[[Outcome], None] = self._say
        self._lock = threading.RLock()
        self._now = 0.0  # s of wall time, as the ticks counted it
        self._followed = -1
        self._guard = self.create_guard_condition(self._follow_bodies)
        self._markers = BodyMarkers(self.p.frame_id)
        self._marker_out = self.create_publisher(MarkerArray, "~/markers", qos.STREAM)
        self._contact_out = self.create_publisher(MarkerArray, "~/contacts", qos.STREAM)
        self._diagnostics_out = self.create_publisher(DiagnosticArray, "/diagnostics", qos.STREAM)
        self._marker_rate, self._diagnostics_rate = Every(), Every()
        self._transforms = Transforms(self, self.p)
        self._odometries = Odometries(self, self.p)
        self.create_service(SetBool, "~/pause", self._on_pause)
        self.create_service(Trigger, "~/step", self._on_step)
        self.create_service(Trigger, "~/reset", self._on_reset)
        self.outputs.publish_names(self.world)
        self._follow_bodies()

    @property
    def period(self) -> float:
        """s of wall time from tick to tick."""
        return 1.0 / max(self.p.publish_rate_hz, self.p.clock_rate_hz, 20.0)

    def tick(self, elapsed: float | None = None) -> None:
        """One step boundary: applies requests, steps what is owed, publishes what is due.

        @param elapsed  s of wall time since the last tick; the period where none is given
        """
        elapsed = self.period if elapsed is None else elapsed
        with self._lock:
            self._now += elapsed
            self._boundary()
            if not self.paused:
                self._advance(elapsed)
            self._publish()

    def close(self) -> None:
        """Ends the command log; the node can then be destroyed."""
        with self._lock:
            if self._journal:
                self._journal.close(self.world.steps, self.world.simulation.state_hash())

    # -- one tick ---------------------------------------------------------------------------

    def _boundary(self) -> None:
        if self.world.dt != self.p.dt_s:
            self.world.set_dt(self.p.dt_s)
        self.world.max_bodies = self.p.max_bodies
        outcomes = self.world.boundary()
        for outcome in outcomes:
            if outcome.refusal is not None:
                self._refuse(outcome.request.source, outcome.refusal)
            if len(outcomes) <= SAID_PER_TICK or self.on_outcome != self._say:
                self.on_outcome(outcome)
        if len(outcomes) > SAID_PER_TICK:
            used = sum(outcome.refusal is None for outcome in outcomes)
            self.get_logger().info(f"{used} of {len(outcomes)} requests used at this step")

    def _advance(self, elapsed: float) -> None:
        world, dt, factor = self.world, self.world.dt, self.p.real_time_factor
        start, taken = time.monotonic(), 0
        if factor > 0:
            owed = self.pace.steps(elapsed, factor, dt, self.p.max_lag_s)
            budget = TICK_BUDGET_S
        else:  # as fast as it goes, leaving a fifth of the time to the messages
            owed, budget = 1_000_000, 0.8 * self.period
        while taken < owed:
            for name in world.step():
                self.get_logger().info(f"{name}: its lifetime is over")
            taken += 1
            if time.monotonic() - start > budget:
                break
        if factor > 0:
            self.pace.took(taken, dt)
        self.pace.measure(elapsed, taken * dt)

    def _publish(self) -> None:
        if self.world.generation != self._followed:
            self._followed = self.world.generation
            self._guard.trigger()
        slack = 0.5 * self.period
        self.outputs.publish(self.world, self._now, slack, self.p)
        if self._marker_rate.due(self._now, self.p.marker_rate_hz, slack):
            if self._marker_out.get_subscription_count():
                self._marker_out.publish(self._markers.array(self.world))
            if self.p.contacts and self._contact_out.get_subscription_count():
                self._contact_out.publish(contact_markers(self.world, self.p.frame_id))
        if self._diagnostics_rate.due(self._now, 1.0, slack):
            self._diagnostics_out.publish(self._diagnostics())
        self._transforms.publish(self.world, self._now, slack)
        self._odometries.publish(self.world)

    def _diagnostics(self) -> DiagnosticArray:
        rejected, now = self.outputs.rejected_count, self.get_clock().now().to_msg()
        return diagnostics.array(self.world, self.pace, rejected, self.paused, now)

    def _refuse(self, source: str, refusal: Exception) -> None:
        told = refusal_of(refusal)
        self.outputs.refuse(source, told)
        text = f"refused {source}: {told}"
        self.get_logger().warning(text, throttle_duration_sec=1.0)

    def _say(self, outcome: Outcome) -> None:
        if outcome.refusal is None and outcome.what not in ("held", "pushed", "moved"):
            name = getattr(outcome.request, "name", "")
            self.get_logger().info(f"{name}: {outcome.what}" if name else outcome.what)

    # -- where the executor runs ------------------------------------------------------------

    def _follow_bodies(self) -> None:
        with self._lock:
            bodies = self.world.bodies
            movable = [name for name in self.world.names if not bodies[name].static]
        without = self.inputs.follow_bodies(movable)
        if without:
            text = (
                f"{without} bodies have no topics of their own (parameter body_topics_max); "
                "~/wrench and ~/impulse reach them all"
            )
            self.get_logger().info(text, once=True)

    def _on_pause(self, request: SetBool.Request, response: SetBool.Response) -> object:
        with self._lock:
            was, self.paused = self.paused, request.data
        now = "paused" if request.data else "running"
        response.success, response.message = True, f"{now} already" if was == request.data else now
        return response

    def _on_step(self, _: Trigger.Request, response: Trigger.Response) -> object:
        with self._lock:
            if not self.paused:
                response.success, response.message = False, "only while paused: call ~/pause first"
                return response
            self._boundary()
            self.world.step()
            self.outputs.publish_names(self.world)
            self.outputs.publish_clock(self.world)
            self.outputs.publish_poses(self.world)
            response.success, response.message = True, f"time {self.world.time:.9g} s"
        return response

    def _on_reset(self, _: Trigger.Request, response: Trigger.Response) -> object:
        with self._lock:
            self.world.submit(Reset("~/reset"))
            self._boundary()
            self.outputs.publish_names(self.world)
            self.outputs.publish_clock(self.world)
            self.outputs.publish_poses(self.world)
        response.success, response.message = True, "back to the start, time 0"
        return response
