/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// The vectors of four neighbouring clusters, x y z x y z x y z x y z in memory, as three packs of four numbers: the
// compilers' loops over three components do one number at a time, which is 2.5 times slower (bench/README.md).
// Every sum is made as in a plain loop, so results are the same to the bit.

#ifndef LMP_FOUR_CLUSTERS_H
#define LMP_FOUR_CLUSTERS_H

#include "model/vector3.h"

#include <cstring>

// GNU vectors and shuffles: GCC since 12, Clang. Others take the plain loop.
#if defined(__has_builtin)
#if __has_builtin(__builtin_shufflevector)
#define CLUSTER_PACKS
#endif
#endif

#ifdef CLUSTER_PACKS

namespace LAMMPS_NS {

using Pack __attribute__((vector_size(4 * sizeof(double)))) = double;

inline Pack load(const double *from)
{
  Pack pack;
  memcpy(&pack, from, sizeof(Pack));
  return pack;
}

inline void store(double *to, const Pack &pack)
{
  memcpy(to, &pack, sizeof(Pack));
}

// one number per cluster, laid beside the components of their vectors
struct Threefold {
  Pack part[3];
  explicit Threefold(const Pack &a) :
      part{__builtin_shufflevector(a, a, 0, 0, 0, 1), __builtin_shufflevector(a, a, 1, 1, 2, 2),
           __builtin_shufflevector(a, a, 2, 3, 3, 3)}
  {
  }
};

// the same vector for all four
struct Fourfold {
  Pack part[3];
  explicit Fourfold(const ClusterDEM::Vec3 &a) :
      part{{a[0], a[1], a[2], a[0]}, {a[1], a[2], a[0], a[1]}, {a[2], a[0], a[1], a[2]}}
  {
  }
};

}    // namespace LAMMPS_NS
#endif
#endif
