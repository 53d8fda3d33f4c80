/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// What a cluster carries beside place, motion and size, and becomes other when it breaks or merges: temperature, charge, columns
// of a user's own. Fragments are copies of their parent, and a merged cluster is the one that leads; here is what that would get
// wrong. What is extensive is divided in proportion to mass and summed up, of what is intensive the mass mean is taken.

#ifndef LMP_CARRIED_VALUES_H
#define LMP_CARRIED_VALUES_H

#include "engine.h"

#include "breakmerge_settings.h"
#include "event.h"
#include "halo.h"
#include "requirements.h"

#include <functional>
#include <string>
#include <vector>

namespace LAMMPS_NS {

using ClusterDEM::CarryRule;

class CarriedValues : protected EnginePointers {
 public:
  CarriedValues(class LAMMPS *lmp, const EventSettings &s) : EnginePointers(lmp), settings(s) {}

  void init(const std::string &me, Requirements &);    // what there is in this scene

  // collective, while partners still are there: what those that merge will carry
  void prepare(std::vector<Event> &, Halo &) const;

  void merge(const Event &) const;                // owned cluster e.i carries what both did
  void divide(const Event &, int first) const;    // among e.i and its copies, the owned clusters from `first` on

 private:
  const EventSettings &settings;
  using Place = std::function<double *(int)>;    // where the value of a cluster is
  struct Column {
    CarryRule rule;
    Place of;
  };
  std::vector<Column> columns;

  void add(const std::string &name, CarryRule by_default, const Place &);
  void add_named(const CarrySetting &, const std::string &me, Requirements &);
};

}    // namespace LAMMPS_NS
#endif
