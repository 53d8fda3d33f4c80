/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// What a granular pair style remembers of a contact: that it was made, and its tangential displacement.

#ifndef LMP_CONTACT_MEMORY_H
#define LMP_CONTACT_MEMORY_H

namespace LAMMPS_NS {
class Atom;
class Pair;

// Do contacts of this style hold beyond touching, so that only its memory tells who is in contact?
bool holds_beyond_touching(const Pair *);

// Is neighbor number `slot` of cluster i bonded to it, by the style's memory and the present distance squared?
bool is_bonded(const Atom *, const Pair *, int i, int j, int slot, double rsq);

// neighbor number of j in the style's list of i; -1: j is not in it
int slot_of(const Atom *, const Pair *, int i, int j);

// Elastic energy of the tangential spring between i and its neighbor `slot` at the present overlap [force x length]; 0 of
// a style without one. Not of pair gran/cluster, which tells the whole energy itself.
double tangential_energy(const Atom *, const Pair *, int i, int j, int slot, double overlap);

}    // namespace LAMMPS_NS
#endif
