"""Checks, divergence, pictures and the jet: each finding by a field that has just that fault."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from clusterdem.gas.divergence import divergence
from clusterdem.gas.field import GasField
from clusterdem.gas.jet import plane_jet
from clusterdem.gas.legacy import read_field, write_field
from PIL import Image
from synthetic import BOX, random_frame, write_dump

X, Z = np.linspace(0, 0.3, 7), np.linspace(0, 0.6, 13)


def field(x=X, z=Z, y=(0.0,), time=float("nan"), **arrays):
    """Air going up at 2 m/s, unless said otherwise."""
    axes = (np.asarray(x, float), np.asarray(y, float), np.asarray(z, float))
    shape = tuple(axis.size for axis in axes)
    values = {"velocity": np.broadcast_to([0.0, 0.0, 2.0], (*shape, 3)).copy()}
    for name, value in arrays.items():
        part = (3,) if name in ("velocity", "fluctuation") else ()
        values[name] = np.broadcast_to(value, (*shape, *part)).astype(float)
    return GasField(axes, values, time)


def at(gas, name, place, value):
    gas.arrays[name][place] = value
    return gas


def check(command, tmp_path, gas, *words):
    return command("gas", "check", write_field(tmp_path / "gas.vtk", gas), *words)


@pytest.mark.parametrize(
    "gas, words, rule",
    [
        (
            at(field(), "velocity", (2, 0, 3, 1), np.nan),
            (),
            "velocity must be finite: 1 points are not, the first at x = 0.1",
        ),
        (
            at(field(density=1.2), "density", (0, 0, 1), 0),
            (),
            "array density must be above zero: 0 kg/m^3 at x = 0, y = 0, z = 0.05",
        ),
        (field(viscosity=-1e-5), (), "array viscosity must be above zero"),
        (field(fluctuation=(0.5, 0, -0.1)), (), "array fluctuation must not be negative: -0.1 m/s"),
        (field(x=[0, 0.1, 0.1, 0.3]), (), "x coordinates must increase: 0.1, then 0.1"),
        (field(x=[0, 0.1, np.inf]), (), "x coordinates must be finite"),
        (
            field(),
            ("--box", 0, 0.36, 0, 0.6),
            "along x it reaches from 0 to 0.3 m, the box from 0 to 0.36 m: more than",
        ),
        (field(), ("--box", 0, 300, 0, 600), "is it in mm? (the field is 0.001 times as long as the box"),
        (
            field(y=[0, 0.1]),
            ("--box", 0, 0.3, 0, 0.3, 0, 0.6),
            "along y it reaches from 0 to 0.1 m, the box from 0 to 0.3",
        ),
        (
            field(x=np.linspace(0, 0.36, 7)),
            ("--box", 0, 0.3, 0, 0.6, "--periodic", "x"),
            "longer than the period of the box",
        ),
        (
            at(field(), "velocity", (0, 0, 3, 2), 2.5),
            ("--box", 0, 0.3, 0, 0.6, "--periodic", "x"),
            "the last plane is the first of the next period, but differs by up to 0.5 m/s",
        ),
        (field(), ("--box", 0, 0.4, 0, 0.6, "--periodic", "x"), "more than a spacing is missing"),
        (field(), ("--box", 0, 0.4, 0, 0.6, "--edge", "x", "open"), "needs an axis x, y or z, and periodic or clamp"),
        (field(), ("--box", 0.3, 0, 0, 0.6), "lower bound below"),
        (field(), ("--box", 0, 0.3), "4 or 6 lengths"),
        (field(), ("--dump", "none.dump"), "cannot be opened"),
    ],
)
def test_errors(tmp_path, command, gas, words, rule):
    code, _, err = check(command, tmp_path, gas, *words)
    assert code == 2 and rule in err and len(err.splitlines()) == 1, err


@pytest.mark.parametrize(
    "gas, words, rule",
    [
        (field(velocity=(0, 0, 2000)), (), "reaches 2000 m/s at x = 0, y = 0, z = 0 m, faster than sound"),
        (field(velocity=(0, 0, 0)), (), "at rest everywhere"),
        (field(density=1000), (), "density is 1000 to 1000 kg/m^3, that of a gas is 0.05 to 200"),
        (field(viscosity=15), (), "viscosity is 15 to 15 m^2/s, that of a gas is 1e-07 to 0.01: is it the"),
        (field(density=20, viscosity=1.8e-5), (), "density times viscosity is 0.00036 to 0.00036 Pa s"),
        (
            field(x=np.linspace(0, 300, 7)),
            ("--box", 0, 0.3, 0, 0.6),
            "along x it reaches from 0 to 300 m: is it in mm?",
        ),
        (
            field(velocity=np.stack(np.broadcast_arrays(10 * X[:, None, None], 0, 2 * Z**0), axis=-1)),
            (),
            "the flux through sections across x changes by 100 % of the largest, most at x = 0.3 m",
        ),
    ],
)
def test_warnings(tmp_path, command, gas, words, rule):
    code, out, err = check(command, tmp_path, gas, *words)
    assert (code, err) == (0, "") and "warning" in out and rule in out and out.endswith("no errors\n"), out


@pytest.mark.parametrize(
    "gas, words",
    [
        (field(density=1.2, viscosity=1.53e-5, fluctuation=0.75), ()),
        (field(), ("--box", 0, 0.3, 0, 0.6, "--periodic", "xz")),  # the last planes equal the first
        (field(x=X + 0.025, z=Z[:-1] + 0.025), ("--box", 0, 0.35, 0, 0.6)),  # cell centres: half a cell short
        (field(x=X[:-1], z=Z[:-1]), ("--box", 0, 0.3, 0, 0.6, "--periodic", "xz")),
        (field(), ("--box", 0, 0.4, 0, 0.9, "--periodic", "x", "--edge", "x", "periodic", "--edge", "z", "clamp")),
        (field(y=[0, 0.1]), ("--box", 0, 0.3, 0, 0.6)),
        (field(x=[0.1]), ("--box", 0, 5, 0, 0.6)),  # one point: uniform along x
    ],
)
def test_nothing_found(tmp_path, command, gas, words):
    code, out, err = check(command, tmp_path, gas, *words)
    assert (code, err) == (0, "") and out.endswith("nothing found\n")


def test_box_of_a_dump(tmp_path, command):
    dump = write_dump(tmp_path / "a.dump", random_frame(10))
    assert BOX.lengths == (0.3, 0.003, 0.6)
    assert check(command, tmp_path, field(), "--dump", dump)[0] == 0
    code, _, err = check(command, tmp_path, field(z=Z / 2), "--dump", dump)
    assert code == 2 and "the box from 0 to 0.6 m: more than a spacing" in err
    code, _, err = check(command, tmp_path, field(z=2 * Z), "--dump", dump)
    assert code == 2 and "longer than the period" in err


def test_series(tmp_path, command):
    def written(*fields):
        return [write_field(tmp_path / f"g.{k}.vtk", gas) for k, gas in enumerate(fields)]

    def series(*fields):
        return command("gas", "check", *written(*fields))

    frames = [field(time=t) for t in (0, 0.1, 0.2, 0.3)]
    assert series(*frames)[:2][1].endswith("nothing found\n")
    code, out, _ = series(*frames[:3], field(time=0.5))
    assert code == 0 and "comes 0.3 s after" in out and "is a frame missing?" in out
    for odd, rule in (
        (field(), "must have its TIME"),
        (field(time=0.1), "has the same time as"),
        (field(time=1, density=1.2), "has the arrays velocity, density"),
        (field(time=1, x=X[:-1]), "has another grid along x"),
        (field(time=1, z=Z * 1.001), "has another grid along z"),
    ):
        code, _, err = series(*frames[:2], odd)
        assert code == 2 and rule in err, err


def test_divergence_is_second_order():
    """Of u = (sin x cos z, 0, 0.5 sin(x + z)), whose divergence is known, on uneven grids, ends included."""
    errors = []
    for n in (20, 40, 80):
        s = np.linspace(0, 1, n + 1)
        x, z = 2 * (s + 0.3 * s**2), 3 * (s + 0.2 * s**2)
        mx, _, mz = np.meshgrid(x, [0.0], z, indexing="ij")
        velocity = np.stack([np.sin(mx) * np.cos(mz), 0 * mx, 0.5 * np.sin(mx + mz)], axis=-1)
        found = divergence(field(x=x, z=z, velocity=velocity)).map
        errors.append(np.abs(found - (np.cos(mx) * np.cos(mz) + 0.5 * np.cos(mx + mz))).max())
    order = np.log2(np.array(errors[:-1]) / errors[1:])
    assert np.all(order > 1.8)


def test_divergence_of_a_gas_that_expands():
    """With rho u = const: no gas is made, though div u is not zero."""
    w = 2.0 + Z[None, None, :]
    velocity = np.stack(np.broadcast_arrays(0.0 * X[:, None, None], 0.0, w), axis=-1)
    gas = field(velocity=velocity)
    assert divergence(gas).rms == pytest.approx(1, rel=1e-9)
    assert (
        divergence(dataclasses.replace(gas, arrays={**gas.arrays, "density": np.broadcast_to(2.4 / w, gas.shape)})).rms
        < 1e-12
    )


def test_jet(tmp_path, command):
    """Görtler's jet: momentum is kept along the height, mass is conserved, the centre slows down as 1/sqrt(s)."""
    out = tmp_path / "jet.vtk"
    words = ("--speed", 12, "--slot", 0.01, "--grid", 601, 241, "--box", -0.3, 0.3, 0, 0.3, "--intensity", 0.2)
    assert command("gas", "jet", "-o", out, *words)[0] == 0
    gas = read_field(out)
    x, _, z = gas.axes
    u, _, w = np.moveaxis(gas["velocity"][:, 0], -1, 0)
    momentum = np.trapezoid(w**2, x, axis=0)
    # U²b; the trapezoidal rule on a bell that falls to 1e-6 at the sides
    np.testing.assert_allclose(momentum, 12**2 * 0.01, rtol=2e-4)
    assert w[300, 0] == pytest.approx(12, rel=1e-12)
    s = z + 0.75 * 7.67 * 0.01
    np.testing.assert_allclose(w[300], 12 * np.sqrt(s[0] / s), rtol=1e-12)
    half = np.array([np.interp(-0.5, -w[300:, k] / w[300, k], x[300:]) for k in range(z.size)])
    np.testing.assert_allclose(half, 0.8814 / 7.67 * s, rtol=2e-3)  # sech² eta = 1/2 at eta = 0.8814
    np.testing.assert_allclose(gas["fluctuation"][:, 0, :, 0], np.sqrt(3) * 0.2 * w, rtol=1e-12)
    np.testing.assert_allclose(u, -u[::-1], atol=1e-12)
    errors = []
    for n in (100, 200, 400):
        axes = (np.linspace(-0.1, 0.1, n + 1), np.zeros(1), np.linspace(0, 0.2, n + 1))
        errors.append(divergence(plane_jet(axes, 0.02, 10, 0, 0)).most)
    assert errors[1] < errors[0] / 3 and errors[2] < errors[1] / 3.5  # zero but for the discretization


@pytest.mark.parametrize(
    "words, rule",
    [(("--box", 1, 0, 0, 1), "X0 < X1"), (("--grid", 1, 5), "two points"), (("--intensity", -1), "not be negative")],
)
def test_bad_jets(tmp_path, command, words, rule):
    code, _, err = command("gas", "jet", "-o", tmp_path / "j.vtk", *words)
    assert code == 2 and rule in err


def test_pictures(tmp_path, command):
    """Every array has its panel: the wider, the more arrays; a plane of a 3-D field can be chosen."""
    jet = plane_jet((X, np.zeros(1), Z), 0.05, 10, 0.15, 0)
    full = field(density=1.2, viscosity=1.5e-5, fluctuation=0.75, time=0.1)
    solid = field(y=[0, 0.1, 0.2])
    solid["velocity"][:, 2, :, 2] = 9.0
    files = [write_field(tmp_path / f"{k}.vtk", gas) for k, gas in enumerate((jet, full, solid))]
    code, out, _ = command("gas", "draw", *files, "-o", tmp_path / "g.png")
    assert code == 0 and out.split() == [str(tmp_path / f"g.000{k}.png") for k in range(3)]
    widths = []
    for path in out.split():
        with Image.open(path) as picture:
            widths.append(picture.width)
            assert len(set(picture.convert("L").tobytes())) > 50
    assert widths[1] > 1.5 * widths[0]
    assert command("gas", "draw", files[2], "-o", tmp_path / "top.png", "--slice", 0.2)[0] == 0
    assert (tmp_path / "top.png").read_bytes() != (tmp_path / "g.0002.png").read_bytes()
    write_field(tmp_path / "thin.vtk", field(x=[0.0]))
    code, _, err = command("gas", "draw", tmp_path / "thin.vtk", "-o", tmp_path / "t.png")
    assert code == 2 and "two points or more along x" in err
