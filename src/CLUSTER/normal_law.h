/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// The normal force of a granular pair style between two clusters, damping left out: of clusters as they are, or as a
// merge would make them. The law is the style's own; contact history is neither asked nor touched.

#ifndef LMP_NORMAL_LAW_H
#define LMP_NORMAL_LAW_H

namespace LAMMPS_NS {
class Pair;
class PairGranCluster;
class PairGranHookeHistory;
namespace Granular_NS {
class GranularModel;
}

class NormalLaw {
 public:
  NormalLaw(const Pair *pair, int type_i, int type_j, double radius_i, double radius_j);

  // is the law of this pair style known here? Not one that remembers plastic deformation (pair granular, normal mdr).
  static bool knows(const Pair *);

  // how far beyond touching a contact still holds once it was made (JKR)
  double bond_length() const;

  // What the contact holds [force x length], from where it lets go: negative where it pulls more than it pushes, 0 where
  // it holds no more.
  double energy(double overlap) const;

  double contact_radius(double overlap) const;    // of pair granular's laws

 private:
  const PairGranCluster *cluster = nullptr;         // one of these three is the law
  const PairGranHookeHistory *classic = nullptr;    // gran/hooke, gran/hooke/history, gran/hertz/history
  Granular_NS::GranularModel *model = nullptr;
  double r_i, r_j;

  void set_geometry(double overlap) const;
  double model_force(double overlap) const;
};

}    // namespace LAMMPS_NS
#endif
