# What others install: a Debian package with engine, plugin and inputs, and a wheel of the post-processor.
# shellcheck shell=bash

verb_package() { # a .deb and a wheel in build/packages [--check: install them on a clean Debian, as root]
  [[ ${1:-} =~ ^(|--check)$ ]] || die "./run package: unknown argument $1: say --check, or nothing"
  local given=${LAMMPS_SOURCE_DIR:-}
  set_up pinned
  install_tools dpkg-dev:dpkg-shlibdeps file:file
  [[ $given ]] || {
    unset LAMMPS_SOURCE_DIR LAMMPS_EXE
    use_lammps portable
  }
  local home=$root/build/package packages=$root/build/packages log=$root/build/package.log
  make_folder "$home"
  rm -rf "$packages"
  say "the Debian package"
  { LAMMPS_SOURCE_DIR=$LAMMPS_SOURCE_DIR LAMMPS_EXE=$LAMMPS_EXE cmake --preset package -S "$root" &&
    cmake --build "$home" && cpack --config "$home/CPackConfig.cmake" -G DEB -B "$packages"; } >"$log" 2>&1 </dev/null ||
    die_with_log "$log" "the Debian package could not be built."
  rm -rf "$packages/_CPack_Packages"
  say "the wheel"
  # of a copy: setuptools leaves a folder beside what it builds, and takes files that were deleted since from it
  rm -rf "$home/python"
  cp -r "$root/python" "$home/python"
  rm -rf "$home/python/build"
  "$venv/bin/python" -m pip wheel -q --no-deps --disable-pip-version-check -w "$packages" "$home/python" >"$log" 2>&1 </dev/null ||
    die_with_log "$log" "the wheel could not be built."
  [[ ! ${1:-} ]] || check_packages "$packages"
  ls "$packages"/*
}

# A root of this Debian with nothing but its base, in which the packages are installed and case 1 is begun.
check_packages() {
  local packages=$1 clean=$root/build/clean-root log=$root/build/clean-root.log
  ((EUID == 0)) || die "--check makes a clean Debian with debootstrap and enters it: be root."
  install_tools debootstrap:debootstrap
  say "a clean Debian, to install them on"
  rm -rf "$clean"
  debootstrap --variant=minbase "$(. /etc/os-release && echo "$VERSION_CODENAME")" "$clean" \
    "$(debian_archives | head -n 1)" >"$log" 2>&1 </dev/null ||
    die_with_log "$log" "debootstrap could not make a clean Debian."
  cp "$packages"/* "$root/setup/check_packages.sh" "$clean/root/"
  # how this machine's pip reaches its registry
  local pip=()
  mapfile -t pip < <(env | grep ^PIP_)
  [[ ! ${PIP_CERT:-} ]] || { cp "$PIP_CERT" "$clean/root/ca.crt"; pip+=(PIP_CERT=/root/ca.crt); }
  mount --bind /proc "$clean/proc"
  mount --bind /dev "$clean/dev"
  local verdict=0
  chroot "$clean" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 "${pip[@]}" \
    bash /root/check_packages.sh 2>&1 </dev/null | tee -a "$log" >&2 || verdict=1
  umount "$clean/proc" "$clean/dev"
  ((verdict == 0)) || die "the packages do not work on a clean Debian: $log"
  rm -rf "$clean"
}
