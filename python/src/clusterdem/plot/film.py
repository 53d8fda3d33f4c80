"""A film of a run: clusters at true size beside the map of solids fraction."""

from __future__ import annotations

import shutil
import subprocess
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import Normalize
from numpy.typing import NDArray
from PIL import Image

from ..analysis.grid import Grid, solids_fraction
from ..errors import InputError
from ..frame import Frame
from ..io.output import atomic
from .scatter import Colouring, colour_bar, draw_discs, whole
from .style import counted, new_figure, styled

Picture = NDArray[np.uint8]


@dataclass(frozen=True)
class Scales:
    """What stays the same through a film: the colour scales.

    Parameters
    ----------
    discs : Colouring
        Of the clusters.
    by : str
        What colours them.
    fraction : float
        Top of the map's scale (true solids fraction).
    published : float or None
        A published scale that is said beside it.
    """

    discs: Colouring
    by: str
    fraction: float
    published: float | None = None


def picture(frame: Frame, grid: Grid, scales: Scales, method: str, dpi: int) -> Picture:
    """One picture of the film, shape (height, width, 3), both even."""
    fraction = 100 * solids_fraction(frame, grid, method)
    (lx, lz), (first, second) = grid.sides, grid.edges
    with styled():
        figure = new_figure(6.4, min(max(2.15 * lz / lx + 0.9, 2.4), 8.0), layout="compressed")
        left, right = figure.subplots(1, 2, sharey=True)
        discs = draw_discs(left, frame, scales.discs, scales.by, whole(frame, grid.plane), grid.plane)
        left.set_ylabel(f"{grid.plane[1]} (mm)")
        colour_bar(figure, discs, left, scales.discs)
        image = right.pcolormesh(
            1e3 * first, 1e3 * second, fraction.T, norm=Normalize(0, 100 * scales.fraction or 1.0), cmap="viridis"
        )
        right.set_aspect("equal")
        right.set_xlabel(f"{grid.plane[0]} (mm)")
        bar = figure.colorbar(image, ax=right, aspect=30, pad=0.02)
        beside = "" if scales.published is None else f"; paper's scale: ×{scales.published:g}"
        words = f"\nwith {frame.particles.words}" if len(frame) else ""
        bar.set_label(f"true solids fraction (%){beside}{words}", fontsize=6)
        figure.suptitle(f"{frame.label}    {counted(len(frame), 'cluster')}")
        figure.set_dpi(dpi)
        canvas = figure.canvas
        assert isinstance(canvas, FigureCanvasAgg)
        canvas.draw()  # type: ignore[no-untyped-call]
        pixels = np.asarray(canvas.buffer_rgba())[..., :3]  # type: ignore[no-untyped-call]
    height, width = (side - side % 2 for side in pixels.shape[:2])
    return np.ascontiguousarray(pixels[:height, :width])


def write_film(path: str | Path, pictures: Iterable[Picture], rate: float) -> Path:
    """Write pictures as .mp4 (by ffmpeg) or .gif.

    Parameters
    ----------
    path : str or Path
        The file; its ending decides.
    pictures : iterable of ndarray, shape (height, width, 3)
        The pictures, one in memory at a time for .mp4.
    rate : float
        Pictures per second.
    """
    path = Path(path)
    if path.suffix not in (".mp4", ".gif"):
        raise InputError(path, "a film's name must end in .mp4 or .gif")
    if path.suffix == ".mp4" and shutil.which("ffmpeg") is None:
        raise InputError(path, "an .mp4 film needs ffmpeg (Debian package ffmpeg); a .gif needs nothing more")
    with atomic(path) as name:
        if path.suffix == ".mp4":
            _mp4(name, iter(pictures), rate)
        else:
            _gif(name, iter(pictures), rate)
    return path


def _gif(name: Path, pictures: Iterator[Picture], rate: float) -> None:
    images = (Image.fromarray(p).quantize(128, dither=Image.Dither.NONE) for p in pictures)
    first = next(images)
    first.save(name, save_all=True, append_images=images, duration=round(1000 / rate), loop=0, optimize=False)


def _mp4(name: Path, pictures: Iterator[Picture], rate: float) -> None:
    first = next(pictures)
    size = f"{first.shape[1]}x{first.shape[0]}"
    command = ["ffmpeg", "-y", "-loglevel", "error", "-f", "rawvideo", "-pix_fmt", "rgb24", "-s", size]
    command += ["-r", f"{rate:g}", "-i", "-", "-c:v", "libx264", "-pix_fmt", "yuv420p", "-crf", "18", "-threads", "1"]
    command += ["-movflags", "+faststart", str(name)]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stderr=subprocess.PIPE) as encoder:
        assert encoder.stdin is not None and encoder.stderr is not None
        try:
            encoder.stdin.write(first.tobytes())
            for pixels in pictures:
                encoder.stdin.write(pixels.tobytes())
            encoder.stdin.close()
        except BrokenPipeError:
            pass
        except BaseException:
            encoder.kill()
            raise
        message = encoder.stderr.read().decode(errors="replace").strip()
        if encoder.wait() != 0:
            raise InputError(name, f"ffmpeg failed: {message.splitlines()[-1] if message else encoder.returncode}")
