# SPDX-License-Identifier: Apache-2.0
"""The node's parameters: names, ranges, descriptions and their values as one record."""

import math
from dataclasses import dataclass

from rcl_interfaces.msg import (
    FloatingPointRange,
    IntegerRange,
    ParameterDescriptor,
    SetParametersResult,
)
from rclpy.node import Node


@dataclass(frozen=True)
class Spec:
    name: str
    default: object
    about: str
    low: float | None = None
    high: float | None = None
    fixed: bool = False  # cannot change while the node runs


SPECS = (
    Spec("frame_id", "world", "frame of every published pose", fixed=True),
    Spec("dt_s", 1 / 240, "s, simulated time of one step", 1e-5, 0.1),
    Spec("real_time_factor", 1.0, "simulated per wall second; 0: as fast as it goes", 0.0, 1000.0),
    Spec("max_lag_s", 0.1, "s of wall time a late tick catches up; the rest is dropped", 0.0, 10.0),
    Spec("publish_rate_hz", 100.0, "~/poses and ~/states per wall second", 0.1, 1000.0),
    Spec("clock_rate_hz", 100.0, "/clock per wall second", 0.1, 1000.0),
    Spec("marker_rate_hz", 10.0, "~/markers per wall second, while somebody listens", 0.1, 100.0),
    Spec("tf_rate_hz", 30.0, "/tf per wall second, where tf2_msgs is installed", 0.1, 1000.0),
    Spec("wrench_hold_s", 1.0, "s of simulated time a wrench lasts; 0: for ever", 0.0, 1e9),
    Spec("paused", False, "start paused; ~/pause changes it", fixed=True),
    Spec("mesh_dir", "", "folder MESH_RESOURCE may read from; empty: none", fixed=True),
    Spec("frame_prefix", "", "put before the names of bodies in /tf", fixed=True),
    Spec("max_bodies", 10_000, "most bodies at a time", 1, 1_000_000),
    Spec("body_topics_max", 64, "most bodies with topics of their own, ~/bodies/<name>/...",
         0, 1000),
    Spec("contacts", False, "publish ~/contacts"),
    Spec("odom", "", "names of bodies that publish ~/odom/<name>, separated by spaces"),
)  # fmt: skip


class Parameters:
    """Declares SPECS on a node and reads them; `p.dt_s` is the value now."""

    def __init__(self, node: Node, overrides: dict[str, object] | None = None) -> None:
        self._node = node
        self._values: dict[str, object] = {}
        for spec in SPECS:
            default = (overrides or {}).get(spec.name, spec.default)
            value = node.declare_parameter(spec.name, default, _descriptor(spec)).value
            reason = unfit(spec, value)
            if reason:
                raise ValueError(f"parameter {spec.name}: {value}, {reason}")
            self._values[spec.name] = value
        node.add_on_set_parameters_callback(self._set)

    def __getattr__(self, name: str) -> object:
        try:
            return self.__dict__["_values"][name]
        except KeyError:
            raise AttributeError(name) from None

    def _set(self, parameters: list) -> SetParametersResult:
        specs = {spec.name: spec for spec in SPECS}
        for parameter in parameters:
            spec = specs.get(parameter.name)
            reason = unfit(spec, parameter.value) if spec else ""
            if reason:
                text = f"{parameter.name}: {parameter.value}, {reason}"
                return SetParametersResult(successful=False, reason=text)
        for parameter in parameters:
            if parameter.name in specs:
                self._values[parameter.name] = parameter.value
        return SetParametersResult(successful=True)


def unfit(spec: Spec, value: object) -> str:
    """Why a value cannot be used, or nothing. NaN passes the ranges of rcl, so it ends here."""
    if isinstance(spec.default, float) and not (isinstance(value, float) and math.isfinite(value)):
        return "must be a finite number"
    if spec.low is not None and not spec.low <= value <= spec.high:
        return f"must be from {spec.low:g} to {spec.high:g}"
    return ""


def _descriptor(spec: Spec) -> ParameterDescriptor:
    descriptor = ParameterDescriptor(description=spec.about, read_only=spec.fixed)
    if isinstance(spec.default, float):
        # The ends of the range are all it holds: a step of 0 means any value between.
        ends = {"from_value": float(spec.low), "to_value": float(spec.high)}
        descriptor.floating_point_range = [FloatingPointRange(**ends, step=0.0)]
    elif isinstance(spec.default, int) and not isinstance(spec.default, bool):
        ends = {"from_value": int(spec.low), "to_value": int(spec.high)}
        descriptor.integer_range = [IntegerRange(**ends, step=1)]
    return descriptor
