# SPDX-License-Identifier: Apache-2.0
"""Message classes by the names people type."""

import importlib
import pkgutil
import re

from carom_ros.checks import nearest
from carom_ros.refusal import Refusal

_TYPE = re.compile(r"([a-z][a-z0-9_]*)/(?:msg/)?([A-Za-z][A-Za-z0-9]*)\Z")


def message_class(name: str) -> type:
    """The class of geometry_msgs/msg/Pose or geometry_msgs/Pose. @throws Refusal"""
    match = _TYPE.match(name)
    if not match:
        raise Refusal("type", name, "must be like geometry_msgs/msg/Pose")
    package, kind = match.groups()
    try:
        module = importlib.import_module(f"{package}.msg")
    except ImportError:
        remedy = nearest(package, message_packages())
        raise Refusal("type", name, f"there is no message package {package}", remedy) from None
    found = getattr(module, kind, None)
    if not hasattr(found, "get_fields_and_field_types"):
        remedy = nearest(kind, (word for word in dir(module) if word[0].isupper()))
        raise Refusal("type", name, f"{package} has no message {kind}", remedy)
    return found


def message_packages() -> list[str]:
    """Installed packages that look like message packages."""
    endings = ("_msgs", "_interfaces", "_srvs")
    return sorted({m.name for m in pkgutil.iter_modules() if m.ispkg and m.name.endswith(endings)})
