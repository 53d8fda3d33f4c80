"""Limits of the size law in the EMMS literature: l = d_p at N = U_p g/(1 - eps_max), l -> infinity at N = N_smf."""

import numpy as np

D_P, RHO_P, RHO_G, NU, G, U_P = 1e-4, 2000.0, 1.2, 1.53e-5, 9.81, 0.01
EPS_MAX, EPS_MF, MOST = 0.9997, 0.5, 200_000_000

ARCHIMEDES = G * D_P**3 * (RHO_P - RHO_G) / (RHO_G * NU**2)
U_MF = NU / D_P * (np.sqrt(33.7**2 + 0.0408 * ARCHIMEDES) - 33.7)  # Wen & Yu (1966)
N_SMF = (U_MF + EPS_MF * U_P / (1 - EPS_MF)) * G
N_DISPERSED = U_P * G / (1 - EPS_MAX)  # at which nothing is clustered
PER_SLIP = 18 * NU * RHO_G / (RHO_P * D_P**2)  # Stokes: N_st = PER_SLIP (u - V) u


def gas_speed(n):
    """Gas speed at which N_st is n, of a particle that moves at U_p."""
    return 0.5 * (U_P + np.sqrt(U_P**2 + 4 * n / PER_SLIP))


def sizes(case, **variables):
    """Gas speed, l, N_st, N_smf of the clusters of one run."""
    row = case.run(**variables).dump("sizes.dump")
    return row["f_drag[3]"], row["f_size[3]"], row["f_size[4]"], row["f_size[6]"]


def test_dispersed_limit(case):
    u, size, n_st, n_smf = sizes(case, lowest=1.0, highest=repr(float(gas_speed(N_DISPERSED))), count=2)
    case.check("N_smf [W/kg]", N_SMF, n_smf[-1], rel=1e-12)
    case.check("N_st at the dispersed limit, U_p g/(1 - eps_max) [W/kg]", N_DISPERSED, n_st[-1], rel=1e-10)
    case.check("l at the dispersed limit [m]", D_P, size[-1], rel=1e-10)


def test_dense_limit(case):
    """L grows without bound as N falls to N_smf: 1/(N - N_smf), up to the largest size allowed."""
    close = [repr(float(gas_speed(N_SMF * factor))) for factor in (1 - 1e-6, 30.0)]
    _, size, n_st, n_smf = sizes(case, lowest=close[0], highest=close[1], count=100)
    largest = D_P * np.cbrt(MOST)
    case.check("l just below N_smf / largest size allowed", 1.0, size[0] / largest, rel=1e-12)
    free = (size < largest * (1 - 1e-9)) & (n_st > n_smf)
    assert free.sum() > 10
    slope = np.polyfit(np.log((n_st - n_smf)[free]), np.log(size[free]), 1)[0]
    case.check("exponent of l in N - N_smf", -1.0, slope, abs=1e-9)


def test_between(case):
    u, size, n_st, n_smf = sizes(case)
    assert np.allclose(n_st, PER_SLIP * (u - U_P) * u, rtol=1e-9)
    free = (size > D_P * (1 + 1e-9)) & (size < D_P * np.cbrt(MOST) * (1 - 1e-9))
    assert free.sum() > 100
    # the straight line through both limits: 1/l is 0 at N_smf and 1/d_p at the dispersed limit
    expected = D_P * (N_DISPERSED - N_SMF) / (n_st[free] - N_SMF)
    case.check("largest relative error of l between the limits", 0.0, np.abs(size[free] / expected - 1).max(), abs=1e-9)
    below = n_st < N_SMF
    assert below.any() and np.all(size[below] == size.max())


def test_figure(case):
    _, size, n_st, _ = sizes(case)
    with case.figure() as axes:
        fine = np.geomspace(N_SMF * 1.001, N_DISPERSED, 400)
        axes.loglog(fine, (N_DISPERSED - N_SMF) / (fine - N_SMF), "k-", label="K / (N − N_smf)")
        axes.loglog(n_st[::5], size[::5] / D_P, "o", label="engine")
        axes.axvline(N_SMF, color="C1", ls="--", lw=0.8, label="N_smf")
        axes.axvline(N_DISPERSED, color="C2", ls="--", lw=0.8, label="U_p g/(1 − ε_max)")
        axes.set(xlabel="N_st [W/kg]", ylabel="l / d_p", ylim=(0.5, 3000))
        axes.legend()
