/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// The clusters that a rank sees at a check, in plain arrays: owned ones first, then ghosts. Events are planned on it without
// an engine.

#ifndef LMP_CROWD_H
#define LMP_CROWD_H

#include "model/cluster.h"
#include "model/merging.h"
#include "model/placement.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace LAMMPS_NS {

using ClusterID = std::int64_t;

struct Crowd {
  int nlocal = 0, nall = 0;
  const double *const *x = nullptr;
  const double *const *v = nullptr;
  const double *const *omega = nullptr;    // none: clusters do not turn
  const double *radius = nullptr;
  const double *mass = nullptr;
  std::vector<ClusterID> id;
  std::vector<int> kind;    // of primary particles; negative: not of the group, in the way but in no event
  struct Size {
    int count = 0;     // primary particles
    int stable = 0;    // the same of the stable size
    int taken = 0;     // by an event
  };
  std::vector<Size> size;    // of ghosts, too, once the plan has asked their owners
  std::function<int(int, ClusterID)>
      nearest_image;          // of the cluster with this ID, to cluster i; -1: not seen here
  ClusterDEM::Vec3 lo, hi;    // all lie between
  std::function<ClusterDEM::Walls(const ClusterDEM::Vec3 &)> walls_around;    // as seen from a point
  // of a contact of i, if it had that radius, with j at that distance
  std::function<double(int i, int j, double radius_i, double distance)> contact_energy;

  ClusterDEM::Body body(int i) const { return {mass[i], ClusterDEM::to_vec3(x[i]), ClusterDEM::to_vec3(v[i])}; }
  ClusterDEM::Spinning spinning(int i) const { return {mass[i], radius[i], ClusterDEM::to_vec3(omega[i])}; }
};

// Two clusters in contact, at least one of them owned.
struct Touch {
  int i, j;
};

}    // namespace LAMMPS_NS
#endif
