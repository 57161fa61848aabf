# SPDX-License-Identifier: Apache-2.0
"""Topics the node listens to. A callback turns a message into requests and never raises."""

from collections.abc import Callable, Iterable
from pathlib import Path

from geometry_msgs.msg import Wrench, WrenchStamped
from nav_msgs.msg import Odometry
from rclpy.exceptions import InvalidTopicNameException
from rclpy.node import Node
from std_msgs.msg import String
from visualization_msgs.msg import Marker, MarkerArray

from carom_ros import commands, limits, marker, qos, strict_yaml
from carom_ros.refusal import Refusal, refusal_of
from carom_ros.requests import LoadScene, Request
from carom_ros.world import World, read_scene_text

Refuse = Callable[[str, Refusal], None]
DRAIN = 1000


class Inputs:
    """Subscriptions; what cannot be used goes to `refuse`, the rest to world.submit."""

    def __init__(self, node: Node, world: World, refuse: Refuse, p: object) -> None:
        self._node, self._world, self._refuse, self._p = node, world, refuse, p
        self._bodies: dict[str, list] = {}
        folder = str(p.mesh_dir)
        self._mesh_dir = Path(folder).expanduser() if folder else None
        self._listen("~/spawn", Marker, self._spawn)
        self._listen("~/spawn_array", MarkerArray, self._spawn_array)
        self._listen("~/scene", String, self._scene)
        self._listen("~/set_state", Odometry, self._set_state)
        self._listen("~/wrench", WrenchStamped, self._wrench)
        self._listen("~/impulse", WrenchStamped, self._impulse)

    # Each yields the requests of one message. @throws Refusal

    def _spawn(self, msg: Marker, source: str) -> Iterable[Request]:
        frame = self._p.frame_id
        yield marker.request_of(msg, source, world_frame=frame, mesh_dir=self._mesh_dir)

    def _spawn_array(self, msg: MarkerArray, source: str) -> Iterable[Request]:
        for row, each in enumerate(msg.markers):
            try:
                yield from self._spawn(each, f"{source} markers[{row}]")
            except ValueError as error:  # the others are still good
                self._refuse(f"{source} markers[{row}]", refusal_of(error))

    def _scene(self, msg: String, source: str) -> Iterable[Request]:
        strict_yaml.check(msg.data, "data", limits.SCENE_CHARACTERS)
        scene = read_scene_text(msg.data)
        if len(scene) > self._p.max_bodies:
            rule = f"must be at most {self._p.max_bodies} (parameter max_bodies)"
            raise Refusal("bodies", f"{len(scene)} bodies", rule)
        yield LoadScene(source, msg.data, scene)

    def _set_state(self, msg: Odometry, source: str) -> Iterable[Request]:
        yield commands.state(msg, source, self._p.frame_id)

    def _wrench(self, msg: WrenchStamped, source: str) -> Iterable[Request]:
        yield commands.stamped_wrench(msg, source, self._p.wrench_hold_s)

    def _impulse(self, msg: WrenchStamped, source: str) -> Iterable[Request]:
        yield commands.stamped_impulse(msg, source)

    def _listen(self, topic: str, kind: type, read: Callable) -> object:
        def callback(msg: object) -> None:
            self._take(topic, read, msg)
            # The executor hands over one message and then builds its whole wait set anew: what
            # else has come is taken here, or a burst would take seconds.
            for _ in range(DRAIN):
                try:
                    following = holder[0].handle.take_message(kind, False)
                except Exception:  # the subscription is just being destroyed, or junk was sent
                    return
                if following is None:
                    return
                self._take(topic, read, following[0])

        holder = [self._node.create_subscription(kind, topic, callback, qos.COMMANDS)]
        return holder[0]

    def _take(self, topic: str, read: Callable, msg: object) -> None:
        try:
            for request in read(msg, topic):
                self._world.submit(request)
        except Exception as error:  # nothing a message holds may end the node
            self._refuse(topic, refusal_of(error))

    def follow_bodies(self, movable: list[str]) -> int:
        """Gives each body its own two topics and takes away those of bodies that are gone.

        To be called where the executor runs. Returns how many bodies went without: each
        subscription slows every wait, so there are at most body_topics_max.
        """
        wanted = set(movable[: self._p.body_topics_max])
        for name in [name for name in self._bodies if name not in wanted]:
            for subscription in self._bodies.pop(name):
                self._node.destroy_subscription(subscription)
        without = len(movable) - len(wanted)
        for name in movable:
            if name not in wanted or name in self._bodies:
                continue
            try:
                self._bodies[name] = self._body_topics(name)
            except InvalidTopicNameException:  # a scene's names may hold what a topic's may not
                self._bodies[name] = []
                without += 1
        return without

    def _body_topics(self, name: str) -> list:
        def wrench(msg: Wrench, source: str) -> Iterable[Request]:
            yield commands.world_wrench(msg, name, source, self._p.wrench_hold_s)

        def impulse(msg: Wrench, source: str) -> Iterable[Request]:
            yield commands.world_impulse(msg, name, source)

        return [
            self._listen(f"~/bodies/{name}/wrench", Wrench, wrench),
            self._listen(f"~/bodies/{name}/impulse", Wrench, impulse),
        ]
