"""One module per command: its first line is the help, ``add_arguments`` its options, ``run`` the work."""

from __future__ import annotations

from . import compare, map, sizes

COMMANDS = (map, sizes, compare)
