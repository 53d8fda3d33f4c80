/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// Energy that contacts create in a step: their work on clusters, plus the change of what their springs hold.

#ifndef LMP_ENERGY_BALANCE_H
#define LMP_ENERGY_BALANCE_H

#include "pointers.h"

#include "model/step_energy.h"

#include <vector>

namespace LAMMPS_NS {
class PairGranCluster;
class StepMotion;

class EnergyBalance : protected Pointers {
 public:
  // kinetic: the kinetic energy alone is looked at, as the paper has it
  EnergyBalance(class LAMMPS *lmp, double tolerance, bool kinetic);

  void start_run(const PairGranCluster *pair);

  // at the start of a step; when all velocities are looked at; when pair forces are in and others are not yet
  void note_start();
  void note_kinetic() { kinetic_mine = kinetic_energy(); }
  void note_contacts();

  // could a step of dt create more than the tolerance allows?
  bool may_fail(double dt, double stiffness, const StepMotion &) const;

  // at the end of a step: what it created, relative to the energy there was, over all ranks
  struct Verdict {
    double created;
    bool too_much;
    double all_energy;
    ClusterDEM::Restlessness restless;
  };
  Verdict judge();
  void accept(const Verdict &);    // the step stays
  void go_on_untested();           // the step stays, nobody looked at it

  double tolerance() const { return limit; }
  double error_of_last() const { return last_error; }
  double worst_error() const { return worst; }
  double recent() const { return recent_error; }    // as a share of what would be too much
  void restore(double last, double worst_of_all)
  {
    last_error = last;
    worst = worst_of_all;
  }
  double bytes() const { return (double) (pushed.capacity() + pushed_before.capacity()) * sizeof(Pushed); }

 private:
  // Clusters that contacts push, in the order of their indices: at the start of the step and at its end. v and omega
  // as they were at the start of the step, of newcomers before its end.
  struct Pushed {
    int i;
    ClusterDEM::Vec3 force, torque, v, omega;
  };
  double limit;
  bool kinetic;
  const PairGranCluster *pair;
  std::vector<Pushed> pushed_before, pushed;
  double elastic_before;
  double kinetic_mine;    // of my clusters, when last looked at
  double energy_all;      // at the end of the last step tested
  double most_energy;     // in this run
  ClusterDEM::Restlessness restless_all;
  double recent_error, last_error, worst;

  double kinetic_energy() const;
  double contact_work() const;
  void step_ends();
};

}    // namespace LAMMPS_NS
#endif
