/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#ifdef FIX_CLASS
// clang-format off
FixStyle(nve/cluster,FixNVECluster);
// clang-format on
#else

#ifndef LMP_FIX_NVE_CLUSTER_H
#define LMP_FIX_NVE_CLUSTER_H

#include "fix_nve.h"

#include "model/vector3.h"

namespace LAMMPS_NS {
class HeldDrag;

class FixNVECluster : public FixNVE {
 public:
  FixNVECluster(class LAMMPS *, int, char **);
  int setmask() override;
  void init() override;
  void setup(int) override;
  void initial_integrate(int) override;
  void post_force(int) override;
  void final_integrate() override;
  void post_run() override;
  void reset_dt() override;

 private:
  ClusterDEM::Vec3 g;     // acceleration by gravity
  bool falling;           // gravity is not 0
  std::string drag_id;    // empty: no drag
  HeldDrag *drag;

  // The end of a step that nobody looks at is done together with the start of the next one, in one pass over memory.
  bool alone;                      // no other fix adds forces after these, or integrates
  std::vector<Fix *> observers;    // fixes that may look at the end of a step
  bool postponed;                  // the end of the last step is not done yet
  bool forces_postponed;           // … and its gravity and drag are not added yet

  bool looked_at(bigint step) const;
  void add_gravity();
  void kick();
  void catch_up();
  template <bool END, bool FORCES> void advance();
};

}    // namespace LAMMPS_NS

#endif
#endif
