# SPDX-License-Identifier: Apache-2.0
"""When things are due, in wall time as the ticks count it."""


class Every:
    """Due `hz` times a second, by a grid that one late tick does not shift."""

    def __init__(self) -> None:
        self._next = 0.0

    def due(self, now: float, hz: float, slack: float) -> bool:
        """slack: s, how much too early counts as on time; half a tick."""
        period = 1.0 / hz
        if now + slack < self._next:
            if self._next - now > period + slack:  # the rate has just been raised
                self._next = now + period
            return False
        self._next += period
        if self._next <= now:
            self._next = now + period
        return True


class Pace:
    """How many steps a tick takes, and how fast simulated time runs against the wall's."""

    def __init__(self) -> None:
        self.overruns = 0  # ticks that could not do all the steps they owed
        self.dropped = 0.0  # s of simulated time given up
        self._owed = 0.0
        self._wall = self._simulated = 0.0
        self.factor = 0.0  # simulated per wall second, smoothed over about a second

    def steps(self, elapsed: float, factor: float, dt: float, max_lag: float) -> int:
        """Steps owed after `elapsed` s of wall time, the catch-up capped at `max_lag` s of it."""
        self._owed += elapsed * factor
        most = max(max_lag * factor, dt)
        if self._owed > most + dt:
            self.overruns += 1
            self.dropped += self._owed - most
            self._owed = most
        # A hair over the quotient: 2.4 - 0.4 - 2 must not leave a step behind for its rounding.
        return int(self._owed / dt + 1e-9)

    def took(self, steps: int, dt: float) -> None:
        self._owed -= steps * dt

    def measure(self, elapsed: float, simulated: float) -> None:
        keep = max(0.0, 1.0 - elapsed)
        self._wall = self._wall * keep + elapsed
        self._simulated = self._simulated * keep + simulated
        if self._wall > 0:
            self.factor = self._simulated / self._wall
