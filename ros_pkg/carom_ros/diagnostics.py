# SPDX-License-Identifier: Apache-2.0
"""How the node is doing, as diagnostic_msgs."""

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue

import carom
from carom_ros.schedule import Pace
from carom_ros.world import World


def array(world: World, pace: Pace, rejected: int, paused: bool, now: object) -> DiagnosticArray:
    """@param now  builtin_interfaces Time of the wall clock, as /diagnostics has it"""
    msg = DiagnosticArray()
    msg.header.stamp = now
    msg.status = [_simulation(world, pace, rejected, paused), _plan(world)]
    return msg


def _simulation(world: World, pace: Pace, rejected: int, paused: bool) -> DiagnosticStatus:
    report = world.simulation.report
    names = dict(zip(world.simulation.ids().tolist(), world.names, strict=True))
    frozen = [names.get(getattr(body, "value", body), str(body)) for body in report.frozen]
    level, text = DiagnosticStatus.OK, "paused" if paused else "running"
    if pace.overruns:
        level, text = DiagnosticStatus.WARN, f"{text}, slower than asked at times"
    if frozen:
        level, text = DiagnosticStatus.ERROR, f"{text}, {len(frozen)} bodies frozen"
    values = {
        "real_time_factor": f"{0.0 if paused else pace.factor:.4g}",
        "time_s": f"{world.time:.9g}",
        "dt_s": f"{world.dt:.9g}",
        "steps": report.steps,
        "bodies": len(world.names),
        "generation": world.generation,
        "contact_points": report.contact.points,
        "deepest_overlap_m": f"{report.contact.deepest_overlap:.4g}",
        "solver_residual_m_s": f"{report.contact.residual:.4g}",
        "solver_gave_up": report.contact.gave_up,
        "swept_impacts": report.sweep.impacts,
        "smallest_swept_gap_m": f"{report.sweep.smallest_gap:.4g}",
        "waited": report.sweep.waited,
        "time_lost_s": f"{report.sweep.time_lost:.4g}",
        "frozen": " ".join(frozen) or "none",
        "rejected": rejected,
        "overruns": pace.overruns,
        "dropped_s": f"{pace.dropped:.4g}",
    }
    return _status("carom: simulation", level, text, values)


def _plan(world: World) -> DiagnosticStatus:
    """Every stage a step runs with its reason and time; what is off, with why."""
    values: dict[str, object] = {}
    for stage in world.simulation.plan():
        values[stage.stage] = f"{stage.reason} ({stage.bodies} bodies, {stage.seconds:.4g} s)"
    on = set(values)
    for stage in carom.compile(world.simulation.scene).stages:
        if stage.stage not in on and not stage.on:
            values[f"{stage.stage} (off)"] = stage.reason
    return _status("carom: plan", DiagnosticStatus.OK, f"{len(on)} stages", values)


def _status(name: str, level: bytes, text: str, values: dict[str, object]) -> DiagnosticStatus:
    pairs = [KeyValue(key=key, value=str(value)) for key, value in values.items()]
    return DiagnosticStatus(level=level, name=name, message=text, values=pairs)
