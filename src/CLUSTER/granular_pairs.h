/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// The granular pair style, or the granular sub-styles of a hybrid one: which clusters touch, and the
// contact force between two of them. Pair gran/cluster notes its contacts while it computes; of any other
// style the neighbor list is walked again and single() is asked.

#ifndef LMP_GRANULAR_PAIRS_H
#define LMP_GRANULAR_PAIRS_H

#include "pointers.h"

#include "model/vector3.h"

#include <cmath>
#include <string>
#include <vector>

namespace LAMMPS_NS {
class Pair;

class GranularPairs : protected Pointers {
 public:
  struct Load {
    double power;    // F_ij . (V_i - V_j), the same for both
    double force;    // |F_ij|
  };
  struct Contact {
    int i, j;    // as they stand in the neighbor list: i is owned
    Pair *pair;
    bool noted;    // its load is known already
    Load noted_load;
  };

  GranularPairs(class LAMMPS *lmp) : Pointers(lmp) {}

  // find the pair styles; stops with an error that names the fix if there is none, or if a pair of
  // clusters of the largest diameter could be missed
  void find(const std::string &fix, int groupbit, double largest_diameter);

  // the same for the pairs of types that there are now
  void check_cutoff(const std::string &fix, int groupbit, double largest_diameter) const;

  // contacts() will be asked for at that step, before its forces: pair gran/cluster then notes those of the
  // step before while it computes
  void expect_contacts(bigint step);

  // collect all pairs of the half neighbor lists in contact: as noted at the last evaluation of forces, else those
  // that overlap now
  void find_contacts();
  const std::vector<Contact> &contacts() const { return touching; }

  // at the instant of find_contacts()
  Load load(const Contact &) const;

  // Two clusters that meet.
  struct Meeting {
    double tags[2];
    double overlap, smaller;    // smaller: diameter
    double closing, mass;       // speed of approach, reduced mass
  };

  // How deep pairs overlap, as a share of the smaller diameter, and when the first would reach `limit` at its present
  // speed of approach; over all ranks. With drift > 0, over the straight way of that time that led here: two equal
  // clusters that went through each other overlap no more than before. Pairs further apart than `near` are left out.
  struct Survey {
    double deepest = -INFINITY, soonest = INFINITY;
    struct Mine {
      double value;
      int i = -1, j = -1;
      double overlap = 0.0, closing = 0.0;
    } my_deepest{-INFINITY}, my_soonest{INFINITY};
  };
  Survey survey(double limit, double near, double drift = 0.0) const;

  // the pair behind an extreme of a survey, told to all ranks
  Meeting meeting(const Survey::Mine &, double extreme) const;

  // elastic normal force over overlap at this instant, damping left out
  double stiffness(const Contact &) const;

 private:
  std::vector<Pair *> pairs;
  std::vector<Contact> touching;

  void walk(Pair *);
  ClusterDEM::Vec3 contact_force(const Contact &) const;
};

}    // namespace LAMMPS_NS
#endif
