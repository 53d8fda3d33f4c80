"""Read cluster DEM dumps, map solids, measure sizes and non-uniformity, draw and report."""

from .errors import InputError
from .frame import Box, Frame
from .grid import Deposit, Grid, deposit, maps_of, solids_fraction
from .nonuniformity import Uniformity, measure, strips
from .reader import read_dumps, read_file
from .sizes import Sizes, class_shares, size_summary

__version__ = "0.1.0"  # of the whole project: CMake reads it here

__all__ = [
    "Box",
    "Deposit",
    "Frame",
    "Grid",
    "InputError",
    "Sizes",
    "Uniformity",
    "class_shares",
    "deposit",
    "maps_of",
    "measure",
    "read_dumps",
    "read_file",
    "size_summary",
    "solids_fraction",
    "strips",
]
