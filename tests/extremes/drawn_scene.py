"""One scene: the parameters that were drawn, and the LAMMPS input that they make."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

RHO_P = 2000.0  # density of a primary particle [kg/m^3]
VOIDAGE = 0.5  # inside a cluster
RHO_G, NU_G = 1.2, 1.53e-5  # gas [kg/m^3, m^2/s]

HELD, REFUSED, EITHER = "held", "refused", "either"


@dataclass
class Clusters:
    """Start state: particle counts, positions [m], velocities [m/s], spins [rad/s], atom IDs."""

    n: np.ndarray
    x: np.ndarray
    v: np.ndarray
    omega: np.ndarray | None = None
    ids: np.ndarray | None = None

    def __len__(self) -> int:
        return len(self.n)


@dataclass
class Contact:
    """Linear contact: stiffness [N/m], restitution, friction; `style` names the pair style."""

    k_n: float = 10.0
    e: float = 0.3
    mu: float = 0.33
    style: str = "granular"
    words: str = ""  # more words of pair gran/cluster

    def frequency(self, m_eff: float) -> float:
        """Undamped angular frequency of a contact [rad/s]."""
        return float(np.sqrt(self.k_n / m_eff))

    def damping_ratio(self) -> float:
        if self.e <= 0.0:
            return 1.0
        log_e = np.log(self.e)
        return float(-log_e / np.sqrt(np.pi**2 + log_e**2))


@dataclass
class Scene:
    """What a family draws. All lengths in m, times in s."""

    clusters: Clusters
    box: tuple[float, float, float]
    dt: float
    steps: int
    d_p: float = 1e-4
    contact: Contact = field(default_factory=Contact)
    boundary: str = "p p p"
    gas: str = ""  # words of fix drag/cluster after nu_g; "": no such fix
    before_gas: str = ""  # commands before it (variables)
    size: str = ""  # words of fix cluster/breakmerge after rho_p; "": no such fix
    every: int = 1
    limits: tuple[int, int] = (3, 2000)
    claim: float = 0.0  # 0: the default of the fix
    control: str = ""  # words of fix cluster/timestep; "": no such fix
    atom_style: str = "sphere"
    np_: int = 1
    frames: int = 10
    time_limit: float = 120.0
    files: dict[str, str] = field(default_factory=dict)  # that the commands read, by name
    before: str = ""  # commands after the data file is read: other atoms, groups
    group: str = "all"  # of the clusters: what our fixes, the motion and the dumps are for
    types: int = 1  # of atoms
    widest: float = 0.0  # diameter of the largest atom that is no cluster
    extra: str = ""  # more commands before run
    resumed_np: int = 0  # ranks that take up the second half from a restart file; 0: one run of all steps
    extra_again: str = ""  # in place of `extra` after the restart
    # ---- what must hold
    expect: str = HELD
    refusals: tuple[str, ...] = ()  # names in outcomes.REFUSALS that are right for this scene
    momentum: bool = True  # nothing outside acts
    energy: float | None = None  # most that energy may rise, as a share; None: not bounded
    frame: tuple[float, float, float] = (0.0, 0.0, 0.0)  # velocity of the frame in which energy is bounded
    open: bool = False  # other commands let clusters in or out, which the fix counts
    more: tuple = ()  # further checks: functions of (scene, frames, run) that return a fault or ""
    # ---- its place in the campaign
    family: str = ""
    index: int = 0

    @property
    def name(self) -> str:
        return f"{self.family}:{self.index}"

    def particle_mass(self) -> float:
        return float(np.pi) / 6 * self.d_p**3 * RHO_P

    def diameter(self, n) -> np.ndarray:
        return self.d_p * np.cbrt(np.asarray(n, dtype=float) / (1.0 - VOIDAGE))

    def mass(self, n) -> np.ndarray:
        return np.asarray(n, dtype=float) * self.particle_mass()

    # ---- the input

    def data_file(self) -> str:
        c = self.clusters
        ids = np.arange(1, len(c) + 1) if c.ids is None else c.ids
        lines = ["start", "", f"{len(c)} atoms", f"{self.types} atom types"]
        for axis, length in zip("xyz", self.box):
            lines.append(f"0 {length!r} {axis}lo {axis}hi")
        if not len(c):
            return "\n".join(lines) + "\n"
        d = self.diameter(c.n)
        density = RHO_P * (1.0 - VOIDAGE)
        lines += ["", "Atoms", ""]
        for k in range(len(c)):
            x, y, z = (repr(float(s)) for s in c.x[k])
            lines.append(f"{ids[k]} 1 {float(d[k])!r} {density!r} {x} {y} {z}")
        lines += ["", "Velocities", ""]
        omega = np.zeros((len(c), 3)) if c.omega is None else c.omega
        for k in range(len(c)):
            values = [*c.v[k]] + ([*omega[k]] if self.rotates else [])
            lines.append(f"{ids[k]} " + " ".join(repr(float(s)) for s in values))
        return "\n".join(lines) + "\n"

    @property
    def rotates(self) -> bool:
        return self.atom_style == "sphere"

    def skin(self) -> float:
        return 0.3 * float(self.diameter(self.limits[1]))

    def ghost(self) -> float:
        largest = float(self.diameter(self.limits[1]))
        claim = self.claim or 1.6 * largest
        return 1.001 * (max(2.0 * claim, claim + 0.5 * self.widest) + self.skin()) if self.size else 0.0

    def limit_words(self) -> str:
        """A scene may give the keyword itself."""
        return "" if "limits" in self.size else f"limits {self.limits[0]} {self.limits[1]}"

    def script(self, again: bool = False) -> str:
        """All steps; if the scene is resumed the first half, or (again) the second."""
        largest = max(float(self.diameter(max([self.limits[1], *self.clusters.n]))), self.widest)
        c = self.contact
        ghost = f" cutoff {self.ghost()!r}" if self.ghost() else ""
        if c.style == "granular":
            pair = (
                f"pair_style granular\npair_coeff * * hooke {c.k_n!r} {c.e!r} tangential linear_history "
                f"{6 / 7 * c.k_n!r} 1.0 {c.mu!r} damping coeff_restitution cutoff {1.0001 * largest!r}"
            )
        else:
            pair = (
                f"pair_style gran/cluster {c.k_n!r} {c.e!r} {c.mu!r} {c.words} cutoff {1.0001 * largest!r}\n"
                "pair_coeff * *"
            )
        every = max(1, -(-self.steps // self.frames))
        columns = "id x y z vx vy vz diameter mass"
        columns += " omegax omegay omegaz" if self.rotates else ""
        columns += " f_size[1] f_size[3]" if self.size else ""
        columns += " f_drag[8]" if self.gas else ""
        begin = ["units si", f"atom_style {self.atom_style}", f"boundary {self.boundary}"]
        lines = [
            *([] if again else begin),
            "atom_modify map hash sort 0 0",
            f"comm_modify vel yes{ghost}",
            "read_restart half.restart" if again else "read_data start.data",
            f"neighbor {self.skin()!r} bin",
            "neigh_modify every 1 delay 0 check yes",
            pair,
        ]
        if self.before and not again:
            lines.append(self.before)
        if self.control:
            lines.append(f"fix step all cluster/timestep {self.control}")
        lines.append(f"fix move {self.group} nve{'/sphere' if self.rotates else ''}")
        if self.before_gas:
            lines.append(self.before_gas)
        if self.gas:
            lines.append(f"fix drag {self.group} drag/cluster {RHO_G} {NU_G} {self.gas}")
        if self.size:
            claim = f" claim {self.claim!r}" if self.claim else ""
            lines += [
                f"fix size {self.group} cluster/breakmerge {self.every} {self.d_p!r} {RHO_P} {self.size} "
                f"{self.limit_words()}{claim}",
                f'fix table all ave/time 1 1 {every} f_size[*] mode scalar file out.txt format " %.17g"',
            ]
        lines.append(f"timestep {self.dt!r}")
        if extra := self.extra_again if again else self.extra:
            lines.append(extra)
        lines += [
            f"dump frames {self.group} custom {every} frames.dump {columns}",
            f"dump_modify frames sort id format float %.17g{' append yes' if again else ''}",
            f"thermo {every}",
        ]
        if self.resumed_np and not again:
            return "\n".join([*lines, f"run {self.steps // 2}", "write_restart half.restart"]) + "\n"
        lines += [
            f"run {self.steps - self.steps // 2 if again else self.steps}",
            f"write_dump {self.group} custom end.dump {columns} modify sort id format float %.17g",
        ]
        return "\n".join(lines) + "\n"
