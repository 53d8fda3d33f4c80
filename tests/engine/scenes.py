"""Scenes that several test files share."""

from lammps_run import clusters, head, pair, random_clusters, write

GAS = "fix drag all drag/cluster 1.2 1.53e-5 velocity 0 0 2 fluctuation 3 0 3 cell 8 1 8 4e-4 5 plane xz\n"


def busy(
    steps: int = 2000,
    every: int = 5,
    newton: str = "on",
    options: str = "",
    count: int = 300,
    seed: int = 1,
    model: str | None = None,
    gas: str = GAS,
) -> str:
    """A crowded box in gusty gas: hundreds of breaks and merges in 2000 steps."""
    return start(newton, count, seed, model) + fixes(every, options, gas) + outputs() + f"run {steps}\n" + final()


def start(newton: str = "on", count: int = 300, seed: int = 1, model: str | None = None) -> str:
    contact = pair() if model is None else pair(model)
    # velocities by position: a random() variable would depend on the ranks
    stir = "variable u atom 0.4*sin(79190*x+104729*z)\nvariable w atom 2+0.4*sin(61379*x-94321*z)\nvelocity all set v_u 0 v_w\n"
    return head(newton=newton) + random_clusters(count, seed=seed) + contact + stir


def fixes(every: int = 5, options: str = "", gas: str = GAS) -> str:
    return (
        "fix move all nve\nfix fall all gravity 9.81 vector 0 0 -1\n"
        + gas
        + f"fix size all cluster/breakmerge {every} 1e-4 2000 drag drag K 0.5 merge 0.2 {options}\n"
        "timestep 2e-6\n"
    )


def outputs() -> str:
    return (
        'fix table all ave/time 50 1 50 f_size[*] mode scalar file out.txt format " %.17g"\n'
        "thermo 500\nthermo_modify lost error\n"
    )


def final() -> str:
    return write("f_size[1]", "f_size[2]", "f_size[3]", "f_size[4]", "f_size[5]", "f_size[6]")


def again(restart: str, every: int = 5, options: str = "", gas: str = GAS) -> str:
    """Continue from a restart file."""
    return (
        "atom_modify map hash sort 0 0\ncomm_modify vel yes cutoff 5.7e-3\n"
        f"read_restart {restart}\nneighbor 0.5e-3 bin\n" + fixes(every, options, gas) + outputs()
    )


# 1-based entries of the global vector of fix cluster/breakmerge; column 0 of its table is the step
CLUSTERS, PARTICLES, BREAKUPS, MERGES, BORN, DEFERRED, E_LOST, E_BORN, D_MIN, D_MEAN, D_MAX = range(1, 12)

__all__ = [name for name in dir() if not name.startswith("_")] + ["clusters"]
