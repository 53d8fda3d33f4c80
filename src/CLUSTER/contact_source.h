/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// Which clusters touch, and what their contacts do: of the granular pair style, or of the granular sub-styles of a
// hybrid one. contact_source.cpp holds what all engines share; what differs is in contact_source_lammps.cpp and
// src/LIGGGHTS/contact_source_liggghts.cpp.

#ifndef LMP_CONTACT_SOURCE_H
#define LMP_CONTACT_SOURCE_H

#include "pointers.h"

#include "model/vector3.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {
class Pair;

class ContactSource : protected Pointers {
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

  ContactSource(class LAMMPS *lmp) : Pointers(lmp) {}

  // find the pair styles; stops with an error that names the fix if there is none, or if a pair of
  // clusters of the largest diameter could be missed
  void find(const std::string &fix, int groupbit, double largest_diameter);

  // the same for the pairs of types that there are now
  void check_cutoff(const std::string &fix, int groupbit, double largest_diameter) const;

  const std::vector<Pair *> &pair_styles() const { return pairs; }

  // contacts() will be asked for at that step, before its forces: pair gran/cluster then notes those of the
  // step before while it computes
  void expect_contacts(bigint step);

  // collect all pairs of the half neighbor lists in contact: as noted at the last evaluation of forces, else those
  // that overlap now
  void find_contacts();
  const std::vector<Contact> &contacts() const { return touching; }

  // at the instant of find_contacts()
  Load load(const Contact &) const;

  // elastic normal force over overlap at this instant, damping left out
  double stiffness(const Contact &) const;

 private:
  std::vector<Pair *> pairs;
  std::vector<Contact> touching;

  bool take_noted(Pair *);    // false if this pair style has not noted its contacts
  ClusterDEM::Vec3 contact_force(const Contact &) const;
};

}    // namespace LAMMPS_NS
#endif
