/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// How the gas drags a cluster: the law, the share of particles that is not shielded, the axes along which drag acts.

#ifndef LMP_CLUSTER_DRAG_H
#define LMP_CLUSTER_DRAG_H

#include "engine.h"

#include "local_voidage.h"
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
  void parse_pressure(StyleArguments &);
  void settle(bool table_of_law, ClusterTable &, const std::string &me);    // once all words are read
  void init(const std::string &me, class Fix *owner);
  LocalVoidage &voidage() { return local; }

  // drag on cluster i is this coefficient times its slip
  double coefficient(int i, const ClusterDEM::Gas &gas, double slip_speed) const
  {
    const double n = unshielded > 0.0 ? atom->rmass[i] / particle_mass : 0.0;
    const double eps = voidage_at(i);
    return pressure_factor(eps) *
        ClusterDEM::cluster_drag_coefficient(*law, gas, 2.0 * atom->radius[i], particle_d, n, unshielded,
                                             slip_speed, eps);
  }
  // that of one primary particle of diameter d_p in cluster i
  double particle_coefficient(int i, const ClusterDEM::Gas &gas, double d_p, double slip_speed) const
  {
    const double eps = voidage_at(i);
    return pressure_factor(eps) * ClusterDEM::drag_coefficient(*law, gas, d_p, slip_speed, eps);
  }
  ClusterDEM::Vec3 in_plane(const ClusterDEM::Vec3 &force) const
  {
    return {acts_along[0] ? force[0] : 0.0, acts_along[1] ? force[1] : 0.0, acts_along[2] ? force[2] : 0.0};
  }

 private:
  std::unique_ptr<ClusterDEM::DragLaw> law;
  std::string name;
  LocalVoidage local;
  double constant_voidage;    // 1 if the law has none
  bool pressure;
  bool acts_along[3];
  double unshielded;
  double particle_d, particle_mass;    // of a primary particle, where `unshielded` needs it
  bool particle_given;

  double voidage_at(int i) const { return local.any() ? local.at(i) : constant_voidage; }
  double pressure_factor(double eps) const { return pressure ? ClusterDEM::with_pressure_gradient(eps) : 1.0; }
  void find_primary_particle(const std::string &me);
};

}    // namespace LAMMPS_NS
#endif
