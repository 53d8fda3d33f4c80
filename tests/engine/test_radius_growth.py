"""Clusters that merge to a larger one than any at set-up must still feel each other."""

import numpy as np
from lammps_run import CUTOFF, clusters, diameter, head, pair, run, write

GROW = "fix move all nve\nfix size all cluster/breakmerge 1 1e-4 2000 K 1 terms cc ncc 0 break no\n"


def row_of_pairs() -> tuple[str, float]:
    """Two touching pairs side by side; each merges at once, and then the merged ones overlap nobody yet."""
    d, merged = diameter(900), diameter(1800)
    shift = 0.999 * d / 2
    apart = 1.01 * merged
    text = clusters(
        (900, (0.015, 0.02 - shift), (0.5, 0.0)),
        (900, (0.015, 0.02 + shift), (0.5, 0.0)),
        (900, (0.015 + apart, 0.02 - shift), (0.2, 0.0)),
        (900, (0.015 + apart, 0.02 + shift), (0.2, 0.0)),
    )
    return text, merged


def check(folder, contact):
    text, merged = row_of_pairs()
    script = (
        head()
        + text
        + contact
        + GROW
        + "timestep 1e-6\nneigh_modify every 1 delay 0 check yes\nrun 200\n"
        + write("f_size[1]")
    )
    row = run(folder, script).dump()
    assert row["f_size[1]"].tolist() == [1800, 1800]
    gap = np.hypot(row["x"][1] - row["x"][0], row["z"][1] - row["z"][0]) - merged
    assert gap < 0.0 and gap > -0.1 * merged
    # the linear spring: k overlap, less damping that is still small next to it early in the contact
    assert row["fx"][0] < -0.5 * 10.0 * -gap and row["fx"][1] == -row["fx"][0]


def test_merged_clusters_repel_at_their_new_size(tmp_path):
    check(tmp_path, pair())


def test_overlay_widens_the_reach_of_gran_styles(tmp_path):
    contact = (
        f"pair_style hybrid/overlay gran/hooke 10.0 8.57 1000.0 500.0 0.33 1 zero {CUTOFF}\n"
        "pair_coeff * * gran/hooke\npair_coeff * * zero\n"
    )
    check(tmp_path, contact)


def test_small_cutoff_is_refused_with_the_remedy(tmp_path):
    text, _ = row_of_pairs()
    contact = "pair_style granular\npair_coeff * * hooke 10.0 100.0 tangential linear_nohistory 1.0 0.33\n"
    r = run(tmp_path / "granular", head() + text + contact + GROW + "run 1\n", check=False)
    assert r.code != 0 and "below the largest cluster diameter" in r.output and "'cutoff 0.001588'" in r.output
    contact = "pair_style gran/hooke 10.0 8.57 1000.0 500.0 0.33 1\npair_coeff * *\n"
    r = run(tmp_path / "hooke", head() + text + contact + GROW + "run 1\n", check=False)
    assert r.code != 0 and "hybrid/overlay with 'zero 0.001588'" in r.output
