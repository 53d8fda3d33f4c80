/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// A fix that keeps values per cluster and talks about them: the engine's callbacks end in its table and its halo.

#ifndef LMP_CLUSTER_FIX_H
#define LMP_CLUSTER_FIX_H

#include "engine.h"

#include "cluster_table.h"
#include "fix_halo.h"

namespace LAMMPS_NS {

class ClusterFix : public EngineFix {
 public:
  ClusterFix(class LAMMPS *, int, char **);
  ~ClusterFix() override;

  void grow_arrays(int) override;
  void copy_arrays(int, int, int) override;
  void set_arrays(int) override;
  int pack_exchange(int, double *) override;
  int unpack_exchange(int, double *) override;
  int pack_restart(int, double *) override;
  void unpack_restart(int, int) override;
  int size_restart(int) override;
  int maxsize_restart() override;

  int pack_forward_comm(int, int *, double *, int, int *) override;
  void unpack_forward_comm(int, int, double *) override;
  int pack_reverse_comm_size(int, int) override;
  int pack_reverse_comm(int, int, double *) override;
  void unpack_reverse_comm(int, int *, double *) override;

 protected:
  ClusterTable table;
  FixHalo halo;
  ClusterTable::Shown *shown;    // what array_atom is, if the fix has one

  void require_clusters() const;    // atoms with a diameter and a mass
  void start_table();               // once all columns are there
  void announce_exchange();         // before atoms migrate: how large a message may get

  // the engine is about to copy another cluster over this one and to forget it, here; it may arrive elsewhere
  virtual void leaving(int) {}
  virtual void arrived(int) {}
  // n numbers about a cluster in a restart file: true if they are of an earlier version's layout, and taken as such
  virtual bool unpack_earlier(int /*i*/, const double * /*from*/, int /*n*/) { return false; }

 private:
  bool in_callbacks;
};

}    // namespace LAMMPS_NS
#endif
