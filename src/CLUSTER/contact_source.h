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
class LargestDiameters;
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

  // find the pair styles; stops with an error that names the fix if there is none
  void find(const std::string &fix, bool looked_at = true);

  // in words: the pair of types whose cutoff is shortest of where its largest atoms touch, if any is, so that contacts
  // would be missed; else empty
  std::string short_cutoff(const std::string &fix, const LargestDiameters &) const;

  const std::vector<Pair *> &pair_styles() const { return pairs; }

  // contacts() will be asked for at that step, before its forces: pair gran/cluster then notes those of the
  // step before while it computes
  void expect_contacts(bigint step);

  // collect all pairs of the half neighbor lists in contact: as noted at the last evaluation of forces, else those
  // that overlap now or are held together by a cohesive law beyond touching
  void find_contacts();
  const std::vector<Contact> &contacts() const { return touching; }

  // at the instant of find_contacts()
  Load load(const Contact &) const;

  // Energy [force x length] that the normal force of clusters i and j would hold at this distance of their centres if i had
  // that radius, damping left out: 0 where they do not touch, unless a cohesive law holds them together now. The work
  // against the force on the way from where it lets go; the law is that of the pair style, all sub-styles together. Changes
  // nothing.
  double energy(int i, int j, double radius_i, double distance) const;

  // The largest stiffness [force/length] of a contact between two clusters of this diameter, of any two types that are in
  // the group: 2 E/overlap^2 at an overlap of 1 % of the diameter; k_n of linear springs. 0: not known. Collective.
  double stiffest(int groupbit, double diameter) const;

  // Energy [force x length] that a contact holds at this instant: normal, and of the tangential spring if the style has one.
  double energy_now(const Contact &) const;

 private:
  std::vector<Pair *> pairs;
  std::vector<Contact> touching;

  bool take_noted(Pair *);    // false if this pair style has not noted its contacts
  bool can_bond(const Pair *) const;
  bool bonded(const Pair *, int i, int j, int slot, double rsq) const;
  ClusterDEM::Vec3 contact_force(const Contact &) const;
};

}    // namespace LAMMPS_NS
#endif
