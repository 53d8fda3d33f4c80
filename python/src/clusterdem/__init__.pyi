from .analysis.grid import Deposit as Deposit
from .analysis.grid import Grid as Grid
from .analysis.grid import deposit as deposit
from .analysis.grid import maps_of as maps_of
from .analysis.grid import solids_fraction as solids_fraction
from .analysis.nonuniformity import Uniformity as Uniformity
from .analysis.nonuniformity import measure as measure
from .analysis.nonuniformity import strips as strips
from .analysis.sizes import Sizes as Sizes
from .analysis.sizes import class_shares as class_shares
from .analysis.sizes import size_summary as size_summary
from .errors import ArgumentError as ArgumentError
from .errors import InputError as InputError
from .frame import Box as Box
from .frame import Frame as Frame
from .io.reader import read_dumps as read_dumps
from .io.reader import read_file as read_file

__version__: str
