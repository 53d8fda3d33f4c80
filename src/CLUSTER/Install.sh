# shellcheck shell=sh disable=SC2233  # in the form of LAMMPS' own Install.sh files
# Called by LAMMPS' `make yes-cluster`, `no-cluster` and `package-update` in this folder, copied to LAMMPS' src.
# mode = 0/1/2 for uninstall/install/update

mode=$1
LC_ALL=C
export LC_ALL

for file in *.cpp *.h; do
  if (test "$file" = clusterplugin.cpp) then
    continue
  elif (test "$mode" = 0) then
    rm -f "../$file"
  elif (! cmp -s "$file" "../$file") then
    cp "$file" ..
    if (test "$mode" = 2) then
      echo "  updating src/$file"
    fi
  fi
done

# the headers of model/ stay here: this folder goes on the include path

if (test -e ../Makefile.package) then
  sed -i -e 's|-I../CLUSTER ||' ../Makefile.package
  if (test "$mode" = 1) then
    sed -i -e 's|^PKG_INC =[ \t]*|&-I../CLUSTER |' ../Makefile.package
  fi
fi
