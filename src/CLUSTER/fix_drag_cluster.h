/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#ifdef FIX_CLASS
// clang-format off
FixStyle(drag/cluster,FixDragCluster);
// clang-format on
#else

#ifndef LMP_FIX_DRAG_CLUSTER_H
#define LMP_FIX_DRAG_CLUSTER_H

#include "cluster_fix.h"

#include "cluster_drag.h"
#include "held_drag.h"
#include "prescribed_gas.h"

namespace LAMMPS_NS {

class FixDragCluster : public ClusterFix, public HoldsDrag {
 public:
  FixDragCluster(class LAMMPS *, int, char **);
  int setmask() override;
  void init() override;
  void setup(int) override;
  void post_force(int) override;
  double compute_vector(int) override;
  double memory_usage() override;
  void reset_grid() override;
  void pack_forward_grid(int, void *, int, int *) override;
  void unpack_forward_grid(int, void *, int, int *) override;
  void pack_reverse_grid(int, void *, int, int *) override;
  void unpack_reverse_grid(int, void *, int, int *) override;

  // the rooms that others look into
  PrescribedGas &prescribed_gas() { return gas; }
  const ClusterDrag &drag_on_clusters() const { return drag; }
  HeldDrag &held_drag() override { return held; }
  bool asks_variables() const override { return gas.any_variable(); }
  ClusterDEM::Vec3 force_on(int i) const;    // as last computed

 private:
  PrescribedGas gas;
  ClusterDrag drag;
  HeldDrag held;
  bool exponential;
  double shortest_tau;    // relaxation time on this rank, this step
  DragTotals totals;
  double totals_all[4];    // force and power on all ranks
  bool totals_current;

  void parse(class StyleArguments &);
  DragTotals add_drag_anew();
  DragTotals add_drag(int first, int last);
  bool unpack_earlier(int, const double *, int) override;
};

}    // namespace LAMMPS_NS

#endif
#endif
