# SPDX-License-Identifier: Apache-2.0
"""Named hard cases, each with its limit: what `carom stress` runs and tests/hard_cases holds.

A case is a function that builds something hard, runs it and returns one number in a physical unit,
which must not exceed its limit. References are closed forms, rational arithmetic, stored
high-precision constants or conservation laws, never the library itself. A limit that physics or
rounding forbids is replaced by the one they allow, with the reason in the case's `note`.
"""

from carom.stress.case import Case, Outcome, run_case
from carom.stress.groups import GROUPS, cases_of

__all__ = ["GROUPS", "Case", "Outcome", "cases_of", "run_case"]
