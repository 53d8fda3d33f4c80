# The plugin and the wrapper build/bin/lmp, by CMake. (Unit tests are built by ./run test.)
# shellcheck shell=bash

# A build/ that is a link into another checkout would be turned over to this one, and the other would run this one's code.
check_build_is_ours() {
  local other
  other=$(sed -nE 's/^CMAKE_HOME_DIRECTORY:INTERNAL=(.*)/\1/p' "$build/CMakeCache.txt" 2>/dev/null) || return 0
  [[ $other && $other != "$root" && -e $other/run && $other/build -ef $root/build ]] || return 0
  die "$root/build is the build folder of $other, too: give this checkout one of its own (remove the link build)."
}

build_plugin() {
  make_folder "$build"
  local log=$build/build.log arguments
  arguments=(-S "$root" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release
    "-DLAMMPS_SOURCE_DIR=$LAMMPS_SOURCE_DIR" "-DLAMMPS_EXE=$LAMMPS_EXE" "-DLAMMPS_SIZES=$lammps_sizes")
  # Another engine, compiler or place of this checkout: configure anew.
  local stamp=$build/.configured now="${arguments[*]} ${CXX:-}"
  if [[ ! -e $build/build.ninja || $(cat "$stamp" 2>/dev/null) != "$now" ]]; then
    need_space "$root" 500 "the build of the plugin"
    rm -rf "$build/CMakeCache.txt" "$build/CMakeFiles" "$stamp"
    cmake "${arguments[@]}" >"$log" 2>&1 </dev/null || die_with_log "$log" "the plugin could not be configured."
    echo "$now" >"$stamp"
  fi
  cmake --build "$build" --target clusterplugin >"$log" 2>&1 </dev/null || die_with_log "$log" "the plugin could not be built."
  check_plugin_loads
}

# A plugin of another MPI or other integer sizes than the engine's shows it here, not in the middle of a run.
check_plugin_loads() {
  local plugin=$build/plugin/clusterplugin.so stamp=$build/.loads said
  [[ $plugin -nt $stamp || $build/bin/lmp -nt $stamp ]] || return 0
  said=$(cd "$build" && bin/lmp -in /dev/null -log none 2>&1 </dev/null) || true
  grep -q 'Loaded 1 plugins' <<<"$said" || die \
    "the plugin does not load into $LAMMPS_EXE: $(grep -iE 'fail|error' <<<"$said" | head -n 1)" \
    "Was that LAMMPS built with another MPI or compiler? Set CXX and PATH so that mpicxx is the one it was built with."
  touch "$stamp"
}
