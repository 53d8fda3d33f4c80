/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#ifdef FIX_CLASS
// clang-format off
FixStyle(cluster/timestep,FixClusterTimestep);
// clang-format on
#else

#ifndef LMP_FIX_CLUSTER_TIMESTEP_H
#define LMP_FIX_CLUSTER_TIMESTEP_H

#include "fix.h"

#include "granular_pairs.h"
#include "model/step_control.h"

namespace LAMMPS_NS {
class FixClusterBreakMerge;
class PairGranCluster;

class FixClusterTimestep : public Fix {
 public:
  FixClusterTimestep(class LAMMPS *, int, char **);
  int setmask() override;
  void init() override;
  void setup(int) override;
  void initial_integrate(int) override;
  void post_integrate() override;
  void post_force(int) override;
  void end_of_step() override;
  void write_restart(FILE *) override;
  void restart(char *) override;
  double compute_scalar() override;
  double compute_vector(int) override;
  double memory_usage() override;

 private:
  // ---- settings
  double contact_factor;    // C, 0: no such bound
  double stiffness;         // k_n; of pair gran/cluster unless given
  bool stiffness_given;
  double overlap_limit;    // F: an overlap stays below F d_i
  bool energy_test;
  double tolerance;
  bool kinetic;    // the printed test: kinetic energy must not rise
  bool predict;
  double floor_given;    // smallest step, 0: as the retries have it
  ClusterDEM::StepSize step;

  // ---- what init() finds
  GranularPairs pairs;
  PairGranCluster *pair;    // null: a stock pair style
  FixClusterBreakMerge *breakmerge;

  // ---- of the step being taken
  struct Motion {                 // of all clusters on all ranks, at the start of the step
    double closing;               // no two approach each other faster, whatever the step
    double speed;                 // none is faster
    double acceleration;          // none is larger
    double lightest, heaviest;    // mass
    double smallest;              // diameter
  } motion;
  double range, fastest;    // of velocities, when last looked at; how much that may have grown since:
  double gain, acceleration_at_look;
  int looks_ago;
  bool look_due;           // clusters changed, or moved by other than forces
  double overlap_bound;    // no overlap is larger than this times d_i
  bool test_due;           // overlaps are looked at after the drift
  bool repeating;          // the drift of the other fixes is done again
  double moved;            // bound on the way of any cluster since the lists were built
  double kinetic_mine;     // energy of my clusters, when last looked at
  double energy_all;       // at the end of the last step tested
  double most_energy;      // in this run
  ClusterDEM::Restlessness restless_all;
  double recent_error;    // largest of the last steps, as a share of what would be too much

  // ---- state at the start of the step, of my clusters
  std::vector<double> x_before, v_before, f_before, omega_before, torque_before;
  int saved;    // clusters, -1: not saved
  bool saved_forces;

  // clusters that contacts push, in the order of their indices: at the start of the step and at its end. v and omega
  // as they were at the start of the step, of newcomers before its end.
  struct Pushed {
    int i;
    ClusterDEM::Vec3 force, torque, v, omega;
  };
  std::vector<Pushed> pushed_before, pushed;
  double elastic_before;

  // ---- totals since the fix was defined, the same on all ranks
  enum { BY_OVERLAP, BY_ENERGY, UNTESTED, LET_PASS, NCOUNTS };
  bigint count[NCOUNTS];
  double worst_overlap;    // largest that was looked at and accepted
  double last_error, worst_error;

  void check_order() const;
  void find_pair();
  void observe();
  void look();
  double strongest_contact() const;
  double largest_force();
  [[noreturn]] void stop_not_finite();
  void find_smallest();
  bool may_be_rejected() const;
  void save(bool forces);
  void restore_positions();
  double choose_step();
  bool cannot_be_taken_back() const;
  bool changed_clusters() const;
  void set_step(double dt);
  void drift_again();
  void collect_pushed();
  double kinetic_energy() const;
  void note_start();
  double contact_work() const;
  void take_back();

  [[noreturn]] void stop(const std::string &message, bool drifted);
  [[noreturn]] void stop_too_soft(const GranularPairs::Meeting &, bool drifted);
  [[noreturn]] void stop_energy(double error);
  bool too_soft(const GranularPairs::Meeting &) const;
};

}    // namespace LAMMPS_NS

#endif
#endif
