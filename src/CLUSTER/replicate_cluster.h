/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#ifdef COMMAND_CLASS
// clang-format off
CommandStyle(replicate/cluster,ReplicateCluster);
// clang-format on
#else

#ifndef LMP_REPLICATE_CLUSTER_H
#define LMP_REPLICATE_CLUSTER_H

#include "command.h"

namespace LAMMPS_NS {

// The box and what is in it, nx * ny * nz times, as LAMMPS' replicate does; that one makes a new Atom class, which knows
// no atom style of a plugin, and lets every rank look at the clusters of all.
class ReplicateCluster : public Command {
 public:
  ReplicateCluster(class LAMMPS *lmp) : Command(lmp) {}
  void command(int, char **) override;

 private:
  void refuse_what_has_more_than_clusters();
  tagint highest_tag();
  void copy_mine(const int *copies, tagint highest);
  void enlarge_box(const int *copies);
};

}    // namespace LAMMPS_NS

#endif
#endif
