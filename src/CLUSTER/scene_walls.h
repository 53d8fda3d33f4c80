/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// The walls that other fixes put into the scene: what fragments and merged clusters must not enter, nor pass.

#ifndef LMP_SCENE_WALLS_H
#define LMP_SCENE_WALLS_H

#include "engine.h"

#include "model/vector3.h"

#include <functional>
#include <string>
#include <vector>

namespace LAMMPS_NS {

class SceneWalls {
 public:
  explicit SceneWalls(class LAMMPS *l) : lmp(l) {}

  void find();    // at the start of a run: fixes come and go between runs
  // fixes that are walls but do not tell where: in words, for a message
  const std::vector<std::string> &unseen() const { return unknown; }
  void prepare();    // where walls are at this step

  // does a sphere lie on that side of every wall on which its parent is, and in none? Walls in y are no matter to clusters
  // that stay in the xz plane.
  bool hold(const ClusterDEM::Vec3 &parent, const ClusterDEM::Vec3 &centre, double radius, bool planar) const;

 private:
  class LAMMPS *lmp;
  struct Plane {
    int axis;
    std::function<double()> position;    // may change from step to step
    double now;
  };
  struct Cylinder {
    int axis;
    double radius;
    ClusterDEM::Vec3 middle;    // of which the part along the axis is no matter
  };
  std::vector<Plane> planes;
  std::vector<Cylinder> cylinders;
  std::vector<class Region *> regions;
  std::vector<std::string> unknown;

  void add_plane(int axis, double position);
  void add_cylinder(int axis, double radius, double a,
                    double b);    // a, b: the other two coordinates, in their order
};

// does a sphere lie inside of a region, with its parent? Beyond an open face a region has neither inside nor wall.
bool region_holds(class Region *, const ClusterDEM::Vec3 &parent, const ClusterDEM::Vec3 &centre, double radius);

}    // namespace LAMMPS_NS
#endif
