# The tools that the build needs, from Debian packages where they are missing.
# shellcheck shell=bash

# Each line: a Debian package, and the command or header that shows it is there.
required_tools=(
  g++:c++
  cmake:cmake
  ninja-build:ninja
  openmpi-bin:mpirun
  libopenmpi-dev:mpicxx
  libgtest-dev:gtest/gtest.h
  librandom123-dev:Random123/philox.h
  pkg-config:pkg-config
  zlib1g-dev:zlib.h
  libzstd-dev:zstd.h
  python3-venv:python
  xz-utils:xz
)

tool_present() {
  case $1 in
    *.h) [[ -e /usr/include/$1 ]] || echo "#include <$1>" | c++ -x c++ -M - >/dev/null 2>&1 ;;
    python) [[ -x $venv/bin/python ]] || find_python >/dev/null ;;
    *) have "$1" ;;
  esac
}

# install_tools PACKAGE:TOOL…: the packages of the tools that are missing
install_tools() {
  local tool packages=() commands=()
  for tool in "$@"; do
    tool_present "${tool#*:}" && continue
    packages+=("${tool%%:*}") commands+=("${tool#*:}")
  done
  ((${#packages[@]})) || return 0

  local sudo=()
  have apt-get || die "missing: ${commands[*]}. There is no apt-get here:" \
    "install them (on Debian: ${packages[*]}) with this system's own package manager, and type ./run again."
  if ((EUID != 0)); then
    have sudo && sudo -n true 2>/dev/null && sudo=(sudo -n)
    ((${#sudo[@]})) || die "missing Debian packages. Type this, and ./run again:" \
      "sudo apt-get install --no-install-recommends ${packages[*]}"
  fi
  say "installing Debian packages: ${packages[*]}"
  make_folder "$cache"
  local log=$cache/debian-packages.log
  local apt=("${sudo[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q -y)
  local install=("${apt[@]}" install --no-install-recommends "${packages[@]}")
  # Lists that are absent or old make the first try fail: then they are fetched, once.
  "${install[@]}" >"$log" 2>&1 </dev/null ||
    { "${apt[@]}" update && "${install[@]}"; } >>"$log" 2>&1 </dev/null ||
    die_with_log "$log" "Debian packages could not be installed (no network?): ${packages[*]}"
}

# The compiler must know C++17 well; its predefined macros tell which it is.
check_compiler() {
  local macros family=GCC version
  macros=$("${CXX:-c++}" -std=c++17 -dM -E -x c++ /dev/null 2>/dev/null) || macros=
  macro() { awk -v name="$1" '$2 == name { print $3 }' <<<"$macros"; }
  version=$(macro __clang_major__)
  if [[ $version ]]; then family=Clang; else version=$(macro __GNUC__); fi
  [[ $family == GCC && ${version:-0} -ge 9 || $family == Clang && $version -ge 10 ]] || die \
    "the compiler ${CXX:-c++} is too old or does not work (found: ${version:+$family }${version:-none})." \
    "GCC 9 or Clang 10 is needed: install g++, or name another: CXX=g++-12 ./run setup"
}
