/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// The halo over the engine's communication, which asks a fix to fill and to read the messages.

#ifndef LMP_FIX_HALO_H
#define LMP_FIX_HALO_H

#include "engine.h"

#include "halo.h"

namespace LAMMPS_NS {

class FixHalo : public Halo {
 public:
  FixHalo(class LAMMPS *l, Fix *owner) : lmp(l), fix(owner), parcel(nullptr) {}

  bool anywhere(bool here) override;

  // the owner's callbacks end here
  int pack_forward(int n, const int *list, double *to) const;
  void unpack_forward(int n, int first, const double *from);
  int reverse_size(int n, int first) const;
  int pack_reverse(int n, int first, double *to) const;
  void unpack_reverse(int n, const int *list, const double *from);

 private:
  class LAMMPS *lmp;
  Fix *fix;
  Parcel *parcel;    // of the exchange that is going on

  void send_forward(Parcel &) override;
  void send_reverse(Parcel &) override;
  void send_reverse_lists(Parcel &) override;
};

}    // namespace LAMMPS_NS
#endif
