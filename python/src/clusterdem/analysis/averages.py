"""Averages over time with their standard error, by blocks."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from itertools import repeat

import numpy as np

from ..errors import ArgumentError
from ..frame import Floats


@dataclass(frozen=True)
class TimeAverage:
    """A quantity's average over frames.

    Parameters
    ----------
    mean : ndarray
        The average, in the quantity's unit and shape; NaN where no frame has a value.
    error : ndarray
        Its standard error; NaN where fewer than two blocks have a value.
    """

    mean: Floats
    error: Floats


def time_average(
    values: Iterable[Floats], frames: int, blocks: int, weights: Iterable[Floats] | None = None
) -> TimeAverage:
    """Average a quantity over frames; the frames are gone through once.

    Parameters
    ----------
    values : iterable of ndarray
        The quantity in each frame, all of one shape; NaN where it has no value.
    frames : int
        How many there are.
    blocks : int
        Blocks of frames in a row that the error is taken from, as equal in length as the number of frames allows.
    weights : iterable of ndarray, optional
        What each value counts, such as the mass (kg) behind a mean velocity, of the same shape; by default all alike.

    Returns
    -------
    TimeAverage

    Raises
    ------
    ArgumentError
        If there are fewer than two blocks, or fewer frames than blocks.

    Notes
    -----
    Plain blocks: frames near in time resemble each other, blocks longer than that resemblance do not, and the spread of
    their means tells the error of the whole (Flyvbjerg & Petersen, J. Chem. Phys. 91 (1989) 461, who double the blocks
    until the error stays; here their number is given: where fewer blocks give a larger error they were too short). With
    the weight W_b and the mean m_b of block b of B, W their sum and m the mean of all,

        error² = B / (B − 1) Σ_b (W_b / W)² (m_b − m)²

    which is Cochran's for a ratio of two sums (Sampling Techniques, 1977, § 6.3); of equal weights it is the
    standard deviation of the block means over √B. Blocks without a value do not count.

    Examples
    --------
    >>> found = time_average([np.array(v) for v in (1.0, 3.0, 4.0, 8.0)], 4, 2)
    >>> float(found.mean), float(found.error)  # blocks of 2 and 6
    (4.0, 2.0)
    """
    sums = _Blocks(frames, blocks)
    each: Iterable[Floats | float] = repeat(1.0) if weights is None else weights
    for value, weight in zip(values, each):
        sums.add(value, weight)
    return sums.average()


def average_of(
    frames: Iterable[Mapping[str, Floats]], count: int, blocks: int, weights: Mapping[str, str]
) -> dict[str, TimeAverage]:
    """Average all maps, or all numbers of a profile, over frames; the frames are gone through once.

    Parameters
    ----------
    frames : iterable of mapping of str to ndarray
        The maps of each frame by name, all frames with the same names and shapes.
    count : int
        How many frames there are.
    blocks : int
        As in :func:`time_average`.
    weights : mapping of str to str
        Names of the maps that are means, with the name of the map that each is weighted by.

    Raises
    ------
    ArgumentError
        As :func:`time_average`.
    """
    sums: dict[str, _Blocks] = {}
    for maps in frames:
        for name, values in maps.items():
            weight = maps[weights[name]] if name in weights else 1.0
            sums.setdefault(name, _Blocks(count, blocks)).add(values, weight)
    return {name: blocked.average() for name, blocked in sums.items()}


def check_blocks(blocks: int, frames: int | None = None) -> None:
    """Refuse fewer than two blocks, or fewer frames than blocks."""
    if blocks < 2:
        raise ArgumentError("average", f"needs 2 blocks or more, not {blocks}")
    if frames is not None and frames < blocks:
        raise ArgumentError("average", f"{blocks} blocks need {blocks} frames or more, not {frames}")


class _Blocks:
    """Weights and weighted sums of each block, shape (blocks, …)."""

    def __init__(self, frames: int, blocks: int) -> None:
        check_blocks(blocks, frames)
        self.frames, self.blocks, self.seen = frames, blocks, 0
        self.weight: Floats = np.zeros(0)
        self.total: Floats = np.zeros(0)

    def add(self, value: Floats, weight: Floats | float) -> None:
        if not self.seen:
            self.weight, self.total = np.zeros((2, self.blocks, *np.shape(value)))
        block = self.seen * self.blocks // self.frames
        known = np.isfinite(value)
        share = np.where(known, weight, 0.0)
        self.weight[block] += share
        self.total[block] += share * np.where(known, value, 0.0)
        self.seen += 1

    def average(self) -> TimeAverage:
        return _of_blocks(self.weight, self.total)


def _of_blocks(weight: Floats, total: Floats) -> TimeAverage:
    """Mean and error from each block's weight and weighted sum, shape (blocks, …)."""
    with np.errstate(invalid="ignore", divide="ignore"):
        all_weight = weight.sum(axis=0)
        mean = total.sum(axis=0) / all_weight
        counts = (weight > 0).sum(axis=0)
        apart = np.where(weight > 0, weight / all_weight * (total / weight - mean), 0.0)
        error = np.sqrt(counts / (counts - 1.0) * (apart**2).sum(axis=0))
    return TimeAverage(mean, np.where(counts > 1, error, np.nan))
