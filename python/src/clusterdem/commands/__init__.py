"""One module per command: its first line is the help, ``add_arguments`` its options, ``run`` the work."""

from __future__ import annotations

from . import calibrate, compare, film, gas, map, profile, report, scatter, sizes, start, table, trade, vtk

COMMANDS = (map, sizes, compare, report, profile, scatter, film, vtk, table, start, gas, trade, calibrate)
