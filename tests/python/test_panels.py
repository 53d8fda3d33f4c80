"""Pictures of boxes of any shape: no text meets another or leaves the figure, colour bars have ticks, scales are as they should be."""

import itertools

import numpy as np
import pytest
from clusterdem.analysis.grid import Grid
from clusterdem.frame import Box, Frame
from clusterdem.plot.maps import draw_maps, fields_of
from clusterdem.plot.panels import bar_ticks
from clusterdem.plot.scatter import draw_scatter, fullest_window
from matplotlib.text import Text

SHAPES = {
    "tall": (0.15, 6.0),
    "flat": (3.0, 0.15),
    "square": (0.3, 0.3),
    "the paper's": (0.3, 0.6),
    "40 wide": (4.0, 0.1),
    "40 tall": (0.1, 4.0),
}
FIELDS = {field.name: field for field in fields_of("xz")}


def box_of(shape):
    lx, lz = SHAPES[shape]
    return Box((0.0, 0.0, 0.0), (lx, 0.003, lz), (True, False, True))


def frame_of(shape, x, z, d=5e-4, time=0.0125):
    count = len(x)
    values = {"x": np.asarray(x, float), "z": np.asarray(z, float), "y": np.full(count, 0.0015)}
    values |= {"diameter": np.broadcast_to(d, count).astype(float), "mass": np.full(count, 1e-8)}
    return Frame(1250, time, box_of(shape), values, "a.dump", 1, 10, {})


def texts_that_meet(figure):
    """Pairs of drawn texts whose boxes overlap by more than a pixel, and texts that leave the figure."""
    figure.canvas.draw()
    renderer = figure.canvas.get_renderer()
    whole = figure.bbox
    found = [t for t in figure.findobj(Text) if t.get_visible() and t.get_text().strip()]
    # tick labels beyond the ends of their axis exist but are not drawn
    boxes = [(t.get_text(), t.get_window_extent(renderer).padded(-1)) for t in found if _drawn(t)]
    meet = [(a, b) for (a, p), (b, q) in itertools.combinations(boxes, 2) if a != b and p.overlaps(q)]
    out = [
        a for a, p in boxes if p.x0 < whole.x0 - 1 or p.y0 < whole.y0 - 1 or p.x1 > whole.x1 + 1 or p.y1 > whole.y1 + 1
    ]
    return meet, out


def _drawn(text):
    axes = text.axes
    if axes is None or text not in [*axes.get_xticklabels(which="both"), *axes.get_yticklabels(which="both")]:
        return True
    (x0, x1), (y0, y1) = sorted(axes.get_xlim()), sorted(axes.get_ylim())
    x, y = text.get_position()
    return (x0 <= x <= x1) if text in axes.get_xticklabels(which="both") else (y0 <= y <= y1)


@pytest.mark.parametrize("count", [1, 2, 6])
@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize(
    "name, scale", [("fraction", None), ("fraction", 10.0), ("velocity_z", None), ("mean_diameter", None)]
)
def test_maps_of_any_shape(shape, name, scale, count):
    grid = Grid(box_of(shape), 12, 12, "xz")
    rng = np.random.default_rng(1)
    maps = [rng.uniform(0.001, 0.02, (12, 12)) - (0.004 if name == "velocity_z" else 0) for _ in range(count)]
    figure = draw_maps(
        maps, [f"t = {0.0125 * k:g} s" for k in range(count)], grid, FIELDS[name], scale, "primary particles of 100 µm"
    )
    assert texts_that_meet(figure) == ([], [])
    panels, bar = figure.axes[:count], figure.axes[count]
    lx, lz = SHAPES[shape]
    for axis in panels:
        size = axis.get_position()
        width, height = size.width * figure.get_size_inches()[0], size.height * figure.get_size_inches()[1]
        assert width / height == pytest.approx(lx / lz, rel=1e-6)  # true to scale
        assert axis.get_xlim() == pytest.approx((0, 1e3 * lx)) and axis.get_ylim() == pytest.approx((0, 1e3 * lz))
    ends = bar.get_xlim() if lx > 2.5 * lz else bar.get_ylim()
    ticks = bar.get_xticks() if lx > 2.5 * lz else bar.get_yticks()
    assert sum(min(ends) <= tick <= max(ends) for tick in ticks) >= 2
    assert figure.get_size_inches()[0] <= 8.5 and figure.get_size_inches()[1] <= 9.5


def test_velocities_of_both_signs_have_a_symmetric_scale():
    grid = Grid(box_of("square"), 4, 4, "xz")
    values = np.linspace(-0.3, 4.0, 16).reshape(4, 4)
    figure = draw_maps([values], ["t = 0 s"], grid, FIELDS["velocity_z"])
    (mesh,) = figure.axes[0].collections
    low, high = np.percentile(values, (0.25, 99.75))
    assert mesh.norm.vmax == pytest.approx(max(-low, high)) and mesh.norm.vmin == -mesh.norm.vmax
    assert np.allclose(np.asarray(mesh.get_array()).reshape(4, 4), values.T, rtol=1e-12)


def test_a_bar_has_two_ticks_at_least():
    assert bar_ticks(0.0, 1.0) == pytest.approx([0, 0.2, 0.4, 0.6, 0.8, 1.0])
    assert bar_ticks(0.123, 0.1231) != [] and len(bar_ticks(0.123, 0.1231)) >= 2
    assert len(bar_ticks(2.0, 2.0 + 1e-12)) >= 2


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("count", [0, 1, 500])
def test_scatter_of_any_shape(shape, count):
    lx, lz = SHAPES[shape]
    rng = np.random.default_rng(2)
    frame = frame_of(shape, rng.uniform(0, lx, count), rng.uniform(0, lz, count), rng.uniform(2e-4, 1e-3, count))
    figure = draw_scatter(frame)
    assert texts_that_meet(figure) == ([], [])
    words = {0: "0 clusters", 1: "1 cluster", 500: "500 clusters"}[count]
    assert figure.axes[0].get_title().replace("\n", ", ") == f"t = 0.0125 s, {words}"
    (discs,) = figure.axes[0].collections
    assert len(discs.get_offsets()) == count


def test_the_window_is_where_clusters_are():
    """A bed in the lowest tenth, densest at the right: 10 x 10 parts of the box, of which one holds most."""
    rng = np.random.default_rng(3)
    x = np.concatenate([rng.uniform(0, 0.3, 200), rng.uniform(0.21, 0.24, 100)])
    z = np.concatenate([rng.uniform(0, 0.059, 200), rng.uniform(0.001, 0.059, 100)])
    assert fullest_window(frame_of("the paper's", x, z)) == pytest.approx((0.21, 0.24, 0.0, 0.06))
    even = frame_of("the paper's", rng.uniform(0, 0.3, 5000), rng.uniform(0, 0.6, 5000))
    assert fullest_window(even) == pytest.approx((0.135, 0.165, 0.27, 0.33))
    assert fullest_window(frame_of("the paper's", [], [])) == pytest.approx((0.135, 0.165, 0.27, 0.33))
