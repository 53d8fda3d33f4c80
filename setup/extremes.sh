# The campaign of tests/extremes: hundreds of scenes drawn at random, kills, cut restart files.
# shellcheck shell=bash

verb_extremes() { # hundreds of scenes at the far ends, or some: [FAMILY | FAMILY:NUMBER …] [--each N] [--seed N] [--keep FOLDER]
  set_up pinned
  CLUSTERDEM_LMP=$build/bin/lmp "$venv/bin/python" "$root/tests/extremes/campaign.py" "$@" </dev/null
}
