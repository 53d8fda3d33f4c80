/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// What fragments and merged clusters must not enter, beside other atoms: fixed sides of the box, walls of other fixes, and what
// lies outside of a region.

#ifndef LMP_CLUSTER_WALLS_H
#define LMP_CLUSTER_WALLS_H

#include "engine.h"

#include "breakmerge_settings.h"
#include "model/placement.h"
#include "requirements.h"
#include "scene_walls.h"

#include <string>

namespace LAMMPS_NS {

class ClusterWalls : protected EnginePointers {
 public:
  ClusterWalls(class LAMMPS *lmp, const EventSettings &s) :
      EnginePointers(lmp), settings(s), walls(lmp), region(nullptr)
  {
  }

  void init(const std::string &me, Requirements &);    // what is a wall, but not seen, is not met
  void prepare();                                      // before any around() of a check
  ClusterDEM::Walls around(const ClusterDEM::Vec3 &parent) const;

 private:
  const EventSettings &settings;
  SceneWalls walls;
  class Region *region;    // of the keyword
};

}    // namespace LAMMPS_NS
#endif
