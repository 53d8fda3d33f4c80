/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// How the gas drags a cluster: the law, the share of particles that is not shielded, the axes along which drag acts.

#ifndef LMP_CLUSTER_DRAG_H
#define LMP_CLUSTER_DRAG_H

#include "engine.h"

#include "model/drag_law.h"

#include <memory>
#include <string>

namespace LAMMPS_NS {
class StyleArguments;

class ClusterDrag : protected EnginePointers {
 public:
  ClusterDrag(class LAMMPS *lmp);

  void parse_law(StyleArguments &);
  void parse_plane(StyleArguments &);
  void parse_particle(StyleArguments &);
  void parse_unshielded(StyleArguments &);
  void tabulate();
  void init(const std::string &me);

  // drag on cluster i is this coefficient times its slip
  double coefficient(int i, const ClusterDEM::Gas &gas, double slip_speed) const
  {
    const double n = unshielded > 0.0 ? atom->rmass[i] / particle_mass : 0.0;
    return ClusterDEM::cluster_drag_coefficient(*law, gas, 2.0 * atom->radius[i], particle_d, n, unshielded,
                                                slip_speed);
  }
  // that of one primary particle of diameter d_p
  double particle_coefficient(const ClusterDEM::Gas &gas, double d_p, double slip_speed) const
  {
    return ClusterDEM::drag_coefficient(*law, gas, d_p, slip_speed);
  }
  ClusterDEM::Vec3 in_plane(const ClusterDEM::Vec3 &force) const
  {
    return {acts_along[0] ? force[0] : 0.0, acts_along[1] ? force[1] : 0.0, acts_along[2] ? force[2] : 0.0};
  }

 private:
  std::unique_ptr<ClusterDEM::DragLaw> law;
  bool acts_along[3];
  double unshielded;
  double particle_d, particle_mass;    // of a primary particle, where `unshielded` needs it
  bool particle_given;

  void find_primary_particle(const std::string &me);
};

}    // namespace LAMMPS_NS
#endif
