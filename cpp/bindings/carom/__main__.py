# SPDX-License-Identifier: Apache-2.0
import sys

from carom.cli import main

sys.exit(main())
