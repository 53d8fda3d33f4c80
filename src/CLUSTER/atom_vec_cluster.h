/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// Spheres with a diameter and a mass that do not rotate: atom style sphere without angular velocity and
// torque, which are then neither stored, nor computed, nor sent.

#ifdef ATOM_CLASS
// clang-format off
AtomStyle(cluster,AtomVecCluster);
// clang-format on
#else

#ifndef LMP_ATOM_VEC_CLUSTER_H
#define LMP_ATOM_VEC_CLUSTER_H

#include "atom_vec.h"

namespace LAMMPS_NS {

class AtomVecCluster : virtual public AtomVec {
 public:
  AtomVecCluster(class LAMMPS *);

  void process_args(int, char **) override;
  void init() override;
  void grow_pointers() override;
  void create_atom_post(int) override;
  void data_atom_post(int) override;
  void pack_data_pre(int) override;
  void pack_data_post(int) override;

 private:
  double *radius, *rmass;
  double radius_kept, mass_kept;    // while a line of a data file is written
};

}    // namespace LAMMPS_NS

#endif
#endif
