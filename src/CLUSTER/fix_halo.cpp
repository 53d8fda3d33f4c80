/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#include "fix_halo.h"

#include "comm.h"
#include "lammps.h"

using namespace LAMMPS_NS;

/* ---------------------------------------------------------------------- */

bool FixHalo::anywhere(bool here)
{
  const int mine = here;
  int any;
  MPI_Allreduce(&mine, &any, 1, MPI_INT, MPI_MAX, lmp->world);
  return any;
}

/* ----------------------------------------------------------------------
   with newton off a rank knows all contacts of its clusters, and ghosts have nothing to say
------------------------------------------------------------------------- */

void FixHalo::send_forward(Parcel &p)
{
  parcel = &p;
  forward_values(lmp->comm, fix, p.size(0));
}

void FixHalo::send_reverse(Parcel &p)
{
  parcel = &p;
  reverse_values(lmp->comm, fix, p.size(0));
}

void FixHalo::send_reverse_lists(Parcel &p)
{
  parcel = &p;
  reverse_lists_of_values(lmp->comm, fix);
}

/* ---------------------------------------------------------------------- */

int FixHalo::pack_forward(int n, const int *list, double *to) const
{
  int m = 0;
  for (int k = 0; k < n; k++) m += parcel->pack(list[k], to + m);
  return m;
}

void FixHalo::unpack_forward(int n, int first, const double *from)
{
  int m = 0;
  for (int i = first; i < first + n; i++) m += parcel->unpack(i, from + m);
}

int FixHalo::reverse_size(int n, int first) const
{
  int m = 0;
  for (int i = first; i < first + n; i++) m += parcel->size(i);
  return m;
}

int FixHalo::pack_reverse(int n, int first, double *to) const
{
  int m = 0;
  for (int i = first; i < first + n; i++) m += parcel->pack(i, to + m);
  return m;
}

void FixHalo::unpack_reverse(int n, const int *list, const double *from)
{
  int m = 0;
  for (int k = 0; k < n; k++) m += parcel->unpack(list[k], from + m);
}
