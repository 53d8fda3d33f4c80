# The same fixes for LIGGGHTS 3.8 of Debian: a library, and the wrapper build/bin/liggghts-cluster.
# shellcheck shell=bash

liggghts_tools=(liggghts:liggghts libliggghts-dev:liggghts/contact_models.h)

# set_up_liggghts: build/ is configured already (set_up)
set_up_liggghts() {
  install_tools "${liggghts_tools[@]}"
  with_lock "$root/build/.lock" build_liggghts
}

build_liggghts() {
  local log=$build/liggghts.log said
  cmake -S "$root" -B "$build" -DCLUSTER_LIGGGHTS=ON >"$log" 2>&1 </dev/null ||
    die_with_log "$log" "the library for LIGGGHTS could not be configured."
  cmake --build "$build" --target liggghtscluster >"$log" 2>&1 </dev/null ||
    die_with_log "$log" "the library for LIGGGHTS could not be built."
  # a library that does not fit this LIGGGHTS shows it here, not in the middle of a run
  said=$(cd "$build" && printf '%s\n' 'region all block 0 1 0 1 0 1' 'create_box 1 all' 'fix drag all drag/cluster' |
    bin/liggghts-cluster -log none 2>&1) || true
  grep -q 'drag/cluster (id drag): requires atom style' <<<"$said" ||
    die "LIGGGHTS does not run with the library: $(grep -i error <<<"$said" | head -n 1)"
}
