# src/CLUSTER as a package of LAMMPS itself, built into the executable: no plugin, no wrapper.
# shellcheck shell=bash

verb_test_static() { # build src/CLUSTER into LAMMPS as a package (slow), run it: [pytest arguments]
  set_up pinned
  local static=$root/build/static log=$root/build/static.log
  with_lock "$root/build/static.lock" build_static "$static" "$log"
  local style help
  help=$("$static/lmp" -h)
  for style in "$root"/src/CLUSTER/{fix,pair,atom_vec}_*.h; do
    style=$(sed -nE 's/^ *(Fix|Pair|Atom)Style\(([^,]*),.*/\2/p' "$style")
    [[ -z $style ]] || grep -qw -- "$style" <<<"$help" || die "the static build has no style $style"
  done
  say "the static build has every style; now the engine tests with it"
  cd "$root"
  export CLUSTERDEM_LMP=$static/lmp CLUSTERDEM_BUILD=$static
  (($#)) || set -- tests/engine
  rm -f "$static/pytest.xml"
  run_pytest "$static/pytest.xml" "$@"
  count_results "$static/pytest.xml" || exit 1
}

# The steps of src/CLUSTER/README.md. An unchanged tree of LAMMPS is compiled once.
build_static() {
  local static=$1 log=$2 tree=$1/lammps
  if [[ ! -e $static/unpacked ]]; then
    need_space "$root" 1500 "the static build of LAMMPS"
    fetch_lammps trixie "$lammps_tarball"
    unpack_lammps "$downloads/trixie/$lammps_tarball" "$tree"
    sed -i 's/^  CLASS2$/  CLASS2\n  CLUSTER/' "$tree/cmake/CMakeLists.txt"
    touch "$static/unpacked"
  fi
  cp -ru "$root/src/CLUSTER" "$tree/src/"
  compile_lammps "$tree" "$static" "$log" "${lammps_options[@]}" -DPKG_CLUSTER=on -DCMAKE_CXX_FLAGS=-ffp-contract=off
}
