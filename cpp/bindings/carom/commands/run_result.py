# SPDX-License-Identifier: Apache-2.0
"""What `carom run` prints."""

from __future__ import annotations

from carom._core import Energy, Simulation
from carom.commands.output import number, print_json, table


def as_text(scene: str, simulation: Simulation, start: Energy) -> None:
    report, energy = simulation.report, simulation.energy()
    speed = report.simulated / report.wall_seconds if report.wall_seconds else float("inf")
    print(
        f"{scene}: {len(simulation)} bodies, {number(report.simulated)} s in {report.steps} steps, "
        f"{number(report.wall_seconds)} s wall ({number(speed)} x real time)\n"
    )
    print(
        table(
            ["body", "x m", "y m", "z m", "qx", "qy", "qz", "qw", "m/s", "rad/s"], _rows(simulation)
        )
    )
    print(
        f"\nenergy J: kinetic {number(energy.kinetic)}, potential {number(energy.potential)}, "
        f"dissipated {number(energy.dissipated)}, work {number(energy.work)}{_pushed(simulation)}; "
        f"unaccounted {number(energy.balance - start.balance)}"
    )
    contact = report.contact
    print(
        f"contacts: {contact.points} points at the end, deepest overlap "
        f"{number(contact.deepest_overlap)} m, residual {number(contact.residual)} m/s, "
        f"{contact.gave_up} solves gave up; {contact.islands} islands, "
        f"{contact.direct_islands} solved directly, {contact.asleep} bodies asleep"
    )
    sweep = report.sweep
    if sweep.sweeps:
        print(
            f"sweeps: {sweep.sweeps}, {sweep.impacts} hits at their time, smallest gap "
            f"{number(sweep.smallest_gap)} m, {sweep.waited} bodies waited "
            f"({number(sweep.time_lost)} s lost)"
        )
    print()
    total = sum(stage.seconds for stage in simulation.plan()) or 1.0
    rows = [
        [s.stage, number(s.seconds), f"{100 * s.seconds / total:.0f} %", str(s.bodies), s.reason]
        for s in simulation.plan()
    ]
    print(table(["stage", "wall s", "share", "bodies", "because"], rows))


def as_json(scene: str, simulation: Simulation, start: Energy) -> None:
    report, energy, contact = simulation.report, simulation.energy(), simulation.report.contact
    poses, twists = simulation.poses(), simulation.twists()
    bodies = [
        {
            "id": body.id,
            "name": body.name,
            "static": body.static,
            "position_m": poses[i, :3],
            "orientation_xyzw": poses[i, 3:],
            "velocity_m_per_s": twists[i, :3],
            "angular_velocity_rad_per_s": twists[i, 3:],
        }
        for i, body in enumerate(simulation.scene.bodies)
    ]
    print_json(
        "carom.run/1",
        {
            "scene": scene,
            "ok": report.ok,
            "simulated_s": report.simulated,
            "steps": report.steps,
            "wall_s": report.wall_seconds,
            "bodies": bodies,
            "energy": {
                "kinetic_j": energy.kinetic,
                "potential_j": energy.potential,
                "dissipated_j": energy.dissipated,
                "work_j": energy.work,
                "repulsion_j": energy.repulsion,
                "unaccounted_j": energy.balance - start.balance,
            },
            "contact": {
                "points": contact.points,
                "deepest_overlap_m": contact.deepest_overlap,
                "residual_m_per_s": contact.residual,
                "iterations": contact.iterations,
                "gave_up": contact.gave_up,
                "islands": contact.islands,
                "direct_islands": contact.direct_islands,
                "asleep": contact.asleep,
            },
            "sweep": {
                "sweeps": report.sweep.sweeps,
                "queries": report.sweep.queries,
                "impacts": report.sweep.impacts,
                "waited": report.sweep.waited,
                "gave_up": report.sweep.gave_up,
                "time_lost_s": report.sweep.time_lost,
                "smallest_gap_m": report.sweep.smallest_gap if report.sweep.sweeps else None,
            },
            "frozen": [b["name"] for b in bodies if b["id"] in report.frozen],
            "stages": [
                {"stage": s.stage, "reason": s.reason, "bodies": s.bodies, "wall_s": s.seconds}
                for s in simulation.plan()
            ],
        },
    )


def _pushed(simulation: Simulation) -> str:
    """The repulsion's entry of the ledger, where a scene has one."""
    if all(stage.stage != "repulsion" for stage in simulation.plan()):
        return ""
    return f", repulsion {number(simulation.energy().repulsion)}"


def _rows(simulation: Simulation) -> list[list[str]]:
    poses, twists = simulation.poses(), simulation.twists()
    speeds = (twists[:, :3] ** 2).sum(1) ** 0.5
    spins = (twists[:, 3:] ** 2).sum(1) ** 0.5
    return [
        [name, *map(number, [*pose, speed, spin])]
        for name, pose, speed, spin in zip(simulation.names(), poses, speeds, spins, strict=True)
    ]
