/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// What fragments must not enter, beside other atoms: fixed sides of the box, and what lies outside of a region.

#ifndef LMP_CLUSTER_WALLS_H
#define LMP_CLUSTER_WALLS_H

#include "engine.h"

#include "breakmerge_settings.h"
#include "model/placement.h"

#include <string>

namespace LAMMPS_NS {

class ClusterWalls : protected EnginePointers {
 public:
  ClusterWalls(class LAMMPS *lmp, const EventSettings &s) : EnginePointers(lmp), settings(s), region(nullptr) {}

  void init(const std::string &me);    // stops with an error where a wall is not seen
  void prepare();                      // before any around() of a check
  ClusterDEM::Walls around(const ClusterDEM::Vec3 &origin) const;

 private:
  const EventSettings &settings;
  class Region *region;
};

}    // namespace LAMMPS_NS
#endif
