"""Read cluster DEM dumps, map solids, measure sizes and uniformity, draw and report.

Names are imported when they are first used; ``__init__.pyi`` says from where.
"""

import lazy_loader

__version__ = "0.2.0"  # of the whole project: CMake reads it here

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
