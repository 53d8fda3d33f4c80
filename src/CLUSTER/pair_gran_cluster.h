/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#ifdef PAIR_CLASS
// clang-format off
PairStyle(gran/cluster,PairGranCluster);
// clang-format on
#else

#ifndef LMP_PAIR_GRAN_CLUSTER_H
#define LMP_PAIR_GRAN_CLUSTER_H

#include "pair_gran_hooke_history.h"

#include "model/contact_law.h"
#include "model/step_energy.h"

#include <vector>

namespace LAMMPS_NS {

class PairGranCluster : public PairGranHookeHistory {
 public:
  PairGranCluster(class LAMMPS *);
  void compute(int, int) override;
  void settings(int, char **) override;
  void init_style() override;
  double init_one(int, int) override;
  void write_restart_settings(FILE *) override;
  void read_restart_settings(FILE *) override;
  double single(int, int, int, int, double, double, double, double &) override;
  double memory_usage() override;

  const ClusterDEM::ContactLaw &contact_law() const { return law; }
  double reduced_mass(int i, int j) const;

  // Contacts that compute() of a step met, for whoever needs them right after: asked for in advance, known
  // until the next compute().
  struct Contact {
    int i, j;        // as they stand in the neighbor list: i is owned
    double power;    // F_ij . (V_i - V_j)
    double force;    // |F_ij|
  };
  void record_contacts(bigint step) { record_step = step; }
  bool contacts_recorded(bigint step) const { return step >= 0 && recorded_step == step; }
  const std::vector<Contact> &contacts() const { return recorded; }

  // this rank's share of the energy stored in the springs, as of the last compute()
  double elastic_energy() const { return elastic; }

  // What the energy that a step may create scales with, see possible_creation(): sums over contacts
  const ClusterDEM::Restlessness &restlessness() const { return restless; }

  // A step can be taken back: what compute() changed in the contact history is kept, and put back.
  void keep_undo(bool yes) { undoable = yes; }
  void undo();

 private:
  ClusterDEM::ContactLaw law;
  double cutoff_given;    // largest distance of contact that the user promises, 0: none
  bool rotating;          // the atom style has angular velocities and torques

  bigint record_step, recorded_step;
  std::vector<Contact> recorded;
  double elastic, elastic_before;
  ClusterDEM::Restlessness restless;

  struct Change {
    int *touch;
    double *displacement;
    int touch_was;
    ClusterDEM::Vec3 displacement_was;
  };
  bool undoable;
  std::vector<Change> changes;

  struct NearPair {
    int i, j, slot;    // j is that entry of i's neighbors
  };
  std::vector<NearPair> near;    // the neighbor list in one row

  struct Touching;    // one pair in contact, its force
  void flatten_list();
  template <bool ROTATE> Touching look_at(int i, int j, const ClusterDEM::Vec3 &d) const;
  template <bool ROTATE, bool FRICTION> void compute_contacts();
  template <bool ROTATE> void add_force(int i, int j, const Touching &);
  double *displacement_of(int i, int j);
};

}    // namespace LAMMPS_NS

#endif
#endif
