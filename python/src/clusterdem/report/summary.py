"""What a report keeps of the frames: a few numbers of every one, maps and profiles of those that are shown."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field

import numpy as np

from .. import observables
from ..analysis.correlation import pair_correlation, reach_of
from ..analysis.grid import Grid, Maps, maps_of, solids_fraction
from ..analysis.ledger import Flow, Totals, totals_of
from ..analysis.nonuniformity import Uniformity, measure
from ..analysis.profiles import Profile, lateral
from ..analysis.sizes import borders_of, edges_of, histogram
from ..errors import ArgumentError, InputError
from ..frame import Floats, Frame
from ..io.parallel import size_range
from ..plot.maps import panels_of
from ..published.cases import CLASS_BORDERS, SCALE
from ..published.compare import Moment, moment_of
from ..run import Run

COLUMNS = ("id", "x", "y", "z", "vx", "vy", "vz", "n", "type")
SINGLE = ("count", "mean_diameter", "sauter_diameter", "mass_mean_diameter", "smallest_diameter", "largest_diameter")


@dataclass(frozen=True)
class Summary:
    """What every frame leaves behind; ``particles`` are its primary particles in words."""

    sizes: dict[str, float]
    classes: Floats
    moment: Moment | None
    totals: Totals
    uniformity: Uniformity
    particles: str | None


@dataclass(frozen=True)
class Shown:
    """What the frames that are drawn leave behind besides."""

    frame: Frame
    maps: Maps
    profile: Profile
    histogram: tuple[Floats, Floats]
    correlation: tuple[Floats, Floats] | None

    @property
    def label(self) -> str:
        """Its time, or its step."""
        return self.frame.label


@dataclass
class Story:
    """All that a page tells of.

    Parameters
    ----------
    run : Run
        The run.
    case : str or None
        The published case that it is compared with.
    plane, shape
        Of the maps.
    how : How
        How observables are measured: size classes.
    heads, values, error
        The frames without clusters, their summaries, and what ended the reading early.
    shown : list of Shown
        The frames that are drawn.
    made : list of (Frame, Grid, Maps)
        Maps that the run made itself, where it wrote no clusters.
    """

    run: Run
    case: str | None
    plane: str
    shape: tuple[int, int]
    how: observables.How = observables.How()
    heads: list[Frame] = field(default_factory=list)
    values: list[Summary] = field(default_factory=list)
    error: InputError | ArgumentError | None = None
    shown: list[Shown] = field(default_factory=list)
    made: list[tuple[Frame, Grid, Maps]] = field(default_factory=list)

    @property
    def scale(self) -> float | None:
        """The paper's scale of fractions, for its cases."""
        return SCALE if self.case else None

    @property
    def times(self) -> Floats:
        """Times of the frames (s)."""
        return np.array([head.time for head in self.heads])

    @property
    def steps(self) -> np.ndarray:
        """Steps of the frames."""
        return np.array([head.step for head in self.heads])

    @property
    def one_box(self) -> bool:
        """Whether all frames have the same box."""
        return all(head.box.same_as(self.heads[0].box) for head in self.heads)

    @property
    def grid(self) -> Grid:
        """The grid of the maps."""
        return self.made[0][1] if self.made else Grid(self.heads[0].box, *self.shape, self.plane)

    @property
    def range(self) -> tuple[float, float]:
        """Smallest and largest diameter of all frames (m)."""
        lows = [v.sizes["smallest_diameter"] for v in self.values if v.sizes["count"]]
        highs = [v.sizes["largest_diameter"] for v in self.values if v.sizes["count"]]
        return min(lows, default=np.inf), max(highs, default=0.0)

    @property
    def edges(self) -> Floats:
        """Bins of the histograms (m)."""
        return edges_of(*self.range)

    @property
    def particles(self) -> str:
        """What solids fractions rest on."""
        words = [value.particles for value in self.values]
        words += [frame.primary.words for frame, _, _ in self.made if frame.primary]
        return "; ".join(dict.fromkeys(word for word in words if word))

    @property
    def flows(self) -> list[Flow | None]:
        """What had been fed and had left by each frame."""
        return [self.run.flow(head.step) for head in self.heads]


def how_of(run: Run, case: str | None, plane: str) -> observables.How:
    """Size classes of the paper for its cases, else such as follow from the data."""
    borders = CLASS_BORDERS if case else borders_of(*size_range(run.dumps, run.density))
    return observables.How(borders=borders, plane=plane)


def summary_of(frame: Frame, shape: tuple[int, int], how: observables.How, compared: bool) -> Summary:
    """Reduce a frame to its summary; ``compared`` if it is held against published numbers."""
    grid = Grid(frame.box, *shape, how.plane)
    classes = observables.find("size_classes")(frame, how)
    sizes = {name: float(observables.find(name)(frame, how)[0]) for name in SINGLE}
    uniformity = measure(solids_fraction(frame, grid), frame, grid)
    particles = frame.particles.words if len(frame) else None
    moment = moment_of(frame) if compared else None
    return Summary(sizes, classes, moment, totals_of(frame), uniformity, particles)


def shown_of(story: Story) -> list[Shown]:
    """Read the frames again that are drawn."""
    shown = []
    chosen = panels_of(len(story.heads))
    curves = {chosen[0], chosen[len(chosen) // 2], chosen[-1]}
    for i in chosen:
        frame = story.run.frame(story.heads[i], COLUMNS)
        grid = Grid(frame.box, *story.shape, story.plane)
        curve = None
        if i in curves and len(frame) > 1:
            curve = pair_correlation(frame, reach_of(frame, story.plane), plane=story.plane)
        bins = histogram(frame.diameter, frame.mass, story.edges)
        profile = lateral(frame, story.shape[0], story.plane)
        shown.append(Shown(frame, maps_of(frame, grid), profile, bins, curve))
    return shown


def made_by_run(
    files: Iterable[Iterator[tuple[Frame, Grid, Maps]]],
) -> list[tuple[Frame, Grid, Maps]]:
    """The maps that a run made itself, as many as are drawn."""
    every = [found for file in files for found in file]
    return [every[i] for i in panels_of(len(every))]
