/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#ifdef FIX_CLASS
// clang-format off
FixStyle(cluster/breakmerge,FixClusterBreakMerge);
// clang-format on
#else

#ifndef LMP_FIX_CLUSTER_BREAKMERGE_H
#define LMP_FIX_CLUSTER_BREAKMERGE_H

#include "cluster_fix.h"

#include "arrivals.h"
#include "breakmerge_settings.h"
#include "census.h"
#include "cluster_columns.h"
#include "contact_source.h"
#include "event_apply.h"
#include "event_check.h"
#include "largest_diameters.h"
#include "newborn_tags.h"

namespace LAMMPS_NS {

class FixClusterBreakMerge : public ClusterFix, public ClusterDEM::KnowsClusterKinds {
 public:
  FixClusterBreakMerge(class LAMMPS *, int, char **);
  int setmask() override;
  void init() override;
  void setup_pre_exchange() override;
  void setup(int) override;
  void post_integrate() override;
  void pre_exchange() override;
  void pre_neighbor() override;

  void write_restart(FILE *) override;
  void restart(char *) override;
  double compute_vector(int) override;
  double memory_usage() override;

  void reset_grid() override;
  void pack_forward_grid(int, void *, int, int *) override;
  void unpack_forward_grid(int, void *, int, int *) override;
  void pack_reverse_grid(int, void *, int, int *) override;
  void unpack_reverse_grid(int, void *, int, int *) override;

  const ClusterDEM::ClusterKinds &cluster_kinds() const override { return settings.kinds; }
  // does a check at this step change what later checks decide, even without events?
  bool remembers(bigint step) const;

 protected:
  const BreakMergeSettings settings;

 private:
  ClusterColumns columns;
  ContactSource pairs;
  LargestDiameters largest;
  Census census;
  NewbornTags tags;
  Arrivals arrivals;
  EventCheck check;
  EventApply apply;
  double output[5 + Census::NTOTALS];
  bigint output_step;

  void check_scene() const;
  void check_cutoffs(class Requirements &);
  void measure();

  void leaving(int i) override;
  void arrived(int i) override;
  bool unpack_earlier(int, const double *, int) override;
  bool resumed_from_0_1, resumed_from_other_test;
};

}    // namespace LAMMPS_NS

#endif
#endif
