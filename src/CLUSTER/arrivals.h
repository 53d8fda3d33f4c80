/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// Clusters that other commands let in or take out, such as fix deposit, fix pour, fix evaporate, delete_atoms or an open side
// of the box: how many particles they hold, and which IDs the new ones get.

#ifndef LMP_ARRIVALS_H
#define LMP_ARRIVALS_H

#include "engine.h"

#include "census.h"
#include "cluster_columns.h"
#include "halo.h"
#include "model/cluster_kinds.h"
#include "newborn_tags.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {

class Arrivals : protected EnginePointers {
 public:
  Arrivals(class LAMMPS *lmp, const ClusterDEM::ClusterKinds &, const ClusterColumns &, NewbornTags &, Census &,
           int groupbit);

  void init(const std::string &fix) { me = fix; }

  void check_all() const;    // all clusters of this rank, before anything is asked of them

  // whole number of particles of an owned cluster; stops if its mass or diameter is not that of a whole number
  int particle_count(int i);
  // mass and diameter are the size fix's to change
  void check_size(int i);

  void at_start_of_run();                // collective: counts all, and notes the highest ID
  void know_all();                       // owned atoms: whoever is there has not come in later
  std::vector<int> newcomers() const;    // owned atoms, of any group, that came in since the last rebuild
  void welcome(const std::vector<int> &mine, Halo &);    // collective: counts and numbers them

  void note_leaving(int i);
  void note_arrived(int i);

 private:
  const ClusterDEM::ClusterKinds &kinds;
  const ClusterColumns &columns;
  NewbornTags &tags;
  Census &census;
  int groupbit;
  std::string me;
  bool start_counted;    // what is found from now on has come in

  int whole_number(int i) const;
  std::string how_to_pour(int i) const;
  bool renumbered() const;
  void forget_contacts();
  void number_by_place(const std::vector<int> &mine, Halo &);
};

}    // namespace LAMMPS_NS
#endif
