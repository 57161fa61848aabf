# SPDX-License-Identifier: Apache-2.0
"""Commands of `carom`, one file each.

A command is a function that takes argparse's subparsers, adds its parser and sets `run`, a function
from the arguments to an exit code. Other packages add theirs by the entry-point group
`carom.commands`.
"""

from carom.commands import cost, explain, run, stress

COMMANDS = (run.add, explain.add, cost.add, stress.add)
