# The plugin and the wrapper build/bin/lmp, by CMake. (Unit tests are built by ./run test.)
# shellcheck shell=bash

build_plugin() {
  make_folder "$build"
  local log=$build/build.log arguments
  arguments=(-S "$root" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release
    "-DLAMMPS_SOURCE_DIR=$LAMMPS_SOURCE_DIR" "-DLAMMPS_EXE=$LAMMPS_EXE")
  # Another engine, compiler or place of this checkout: configure anew.
  local stamp=$build/.configured now="${arguments[*]} ${CXX:-}"
  if [[ ! -e $build/build.ninja || $(cat "$stamp" 2>/dev/null) != "$now" ]]; then
    need_space "$root" 500 "the build of the plugin"
    rm -rf "$build/CMakeCache.txt" "$build/CMakeFiles" "$stamp"
    cmake "${arguments[@]}" >"$log" 2>&1 </dev/null || die_with_log "$log" "the plugin could not be configured."
    echo "$now" >"$stamp"
  fi
  cmake --build "$build" --target clusterplugin >"$log" 2>&1 </dev/null || die_with_log "$log" "the plugin could not be built."
}
