/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#ifdef FIX_CLASS
// clang-format off
FixStyle(drag/cluster,FixDragCluster);
// clang-format on
#else

#ifndef LMP_FIX_DRAG_CLUSTER_H
#define LMP_FIX_DRAG_CLUSTER_H

#include "engine.h"

#include "model/drag_law.h"
#include "model/gas_field.h"

namespace LAMMPS_NS {
class GasFrames;
class StyleArguments;

class FixDragCluster : public EngineFix {
 public:
  FixDragCluster(class LAMMPS *, int, char **);
  ~FixDragCluster() override;
  int setmask() override;
  void init() override;
  void setup(int) override;
  void post_force(int) override;

  void grow_arrays(int) override;
  void copy_arrays(int, int, int) override;
  void set_arrays(int) override;
  int pack_exchange(int, double *) override;
  int unpack_exchange(int, double *) override;
  int pack_restart(int, double *) override;
  void unpack_restart(int, int) override;
  int size_restart(int) override;
  int maxsize_restart() override;

  double compute_vector(int) override;
  double memory_usage() override;

  // What the size law asks of the gas. prepare() once per step, before any gas_at().
  void prepare();
  ClusterDEM::LocalGas gas_at(int i);
  double cluster_coefficient(int i, const ClusterDEM::Gas &gas, double slip_speed) const;
  ClusterDEM::Vec3 in_plane(const ClusterDEM::Vec3 &force) const;
  ClusterDEM::Vec3 force_on(int i) const { return ClusterDEM::to_vec3(array_atom[i] + 3); }    // as last computed
  const ClusterDEM::DragLaw &drag_law() const { return *law; }
  const ClusterDEM::Gas &gas_properties() const { return gas; }    // where no field says otherwise
  bool uniform_properties() const;

  // Between two refreshes fix nve/cluster can take the drag into its own pass: true if it is held at this step, and is
  // then left to the caller.
  bool hand_over();
  const double *held_velocity() const { return held_u.data(); }       // 3 per cluster
  const double *held_coefficient() const { return held_b.data(); }    // 1 per cluster
  bool add_held_drag();
  bool any_variable() const;

  // a newborn or changed cluster sees a new fluctuation of its own
  void redraw(int i);

 private:
  ClusterDEM::Gas gas;
  std::unique_ptr<ClusterDEM::DragLaw> law;

  // mean velocity: numbers or variables per component, plus a profile along one axis
  struct Component {
    double value = 0.0;
    std::string variable;
    int index = -1;
    bool per_atom = false;
  };
  Component velocity[3];
  double **velocity_atom;    // of atom-style variables
  int nmax_velocity;
  ClusterDEM::GasProfile profile;
  int profile_axis;

  // gas from files: velocity, and what else they hold
  std::unique_ptr<GasFrames> field;

  enum { NO_FLUCTUATION, PER_CELL, OWN };
  int fluctuation;
  ClusterDEM::Vec3 amplitude;    // of a field with an amplitude: factors on that
  int cells[3];
  double period;
  uint64_t seed;
  int64_t period_now;
  ClusterDEM::Vec3 inverse_length;    // of the box

  // Fluctuation last computed for a slot of the atom arrays. It is a pure function of its key, so
  // it stays right whichever cluster comes to use the slot: nothing to migrate.
  struct CachedFluctuation {
    int64_t a = -1, b = -1, period = -1;
    ClusterDEM::Vec3 unit;
  };
  std::vector<CachedFluctuation> cache;
  int *draw;    // draw number per cluster (own fluctuation only)

  bool acts_along[3];
  double unshielded;
  double particle_d, particle_mass;    // of a primary particle, where `unshielded` needs it
  bool particle_given;
  bool exponential;

  // gas velocity and coefficient are held for so many steps
  int refresh;
  std::vector<double> held_u, held_b;
  double held_dt;                     // step that the coefficients are made for
  bool handed_over;                   // the drag of this step is somebody else's
  int peratom_rows;                   // rows that array_atom has room for
  double shortest_tau;                // relaxation time on this rank, this step
  double totals[4], totals_all[4];    // force and power on my clusters, on all
  bool totals_current;

  void parse_velocity(StyleArguments &);
  void parse_fluctuation(StyleArguments &);
  void parse_law(StyleArguments &);
  void parse_plane(StyleArguments &);
  void parse_profile(StyleArguments &);
  void parse_field(StyleArguments &);
  void find_primary_particle();
  const ClusterDEM::Vec3 &unit_fluctuation(int i);
  bool due() const;
  void hold(int i, const ClusterDEM::Vec3 &u, double b)
  {
    for (int k = 0; k < 3; k++) held_u[3 * i + k] = u[k];
    held_b[i] = b;
  }
  bool add_drag_anew();
  bool add_drag(int first, int last);
};

}    // namespace LAMMPS_NS

#endif
#endif
