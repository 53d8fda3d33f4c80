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

#include "contact_source.h"
#include "contact_survey.h"
#include "energy_balance.h"
#include "model/step_control.h"
#include "step_clock.h"
#include "step_motion.h"
#include "step_settings.h"
#include "step_state.h"

#include <array>
#include <string>

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
  StepSettings settings;
  ClusterDEM::StepSize step;
  ContactSource contacts;
  ContactSurvey survey;
  StepClock clock;
  StepState state;    // at the start of the step being taken
  StepMotion motion;
  EnergyBalance energy;
  PairGranCluster *pair;    // null: not of all contacts
  FixClusterBreakMerge *breakmerge;

  // of the step being taken
  double depth_bound;    // no overlap is larger than this times d_i
  double moved;          // bound on the way of any cluster since the lists were built
  bool test_due;         // overlaps are looked at after the drift
  bool repeating;        // the drift of the other fixes is done again

  // since the fix was defined, the same on all ranks
  enum { BY_OVERLAP, BY_ENERGY, UNTESTED, LET_PASS, NCOUNTS };
  std::array<bigint, NCOUNTS> count;
  double worst_depth;    // largest that was looked at and accepted

  void check_order() const;
  void check_fixes() const;
  void find_pair();
  double stiffness() const;    // k_n
  double stored_energy();

  void look();
  double choose_step();
  double predict(double wanted, const ContactSurvey::Found &now);
  bool cannot_be_taken_back() const;
  bool changed_clusters() const;
  void drift_again();
  void take_back();

  using Meeting = ContactSurvey::Meeting;
  [[noreturn]] void stop(const std::string &message, bool drifted);
  [[noreturn]] void stop_too_soft(const Meeting &, bool drifted);
  [[noreturn]] void stop_energy(double error);
  bool too_soft(const Meeting &) const;
};

}    // namespace LAMMPS_NS

#endif
#endif
