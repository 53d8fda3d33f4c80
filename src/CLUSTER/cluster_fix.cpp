/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#include "cluster_fix.h"

#include "atom.h"
#include "error.h"

#include <algorithm>

using namespace LAMMPS_NS;

/* ---------------------------------------------------------------------- */

ClusterFix::ClusterFix(LAMMPS *lmp, int narg, char **arg) :
    EngineFix(lmp, narg, arg), halo(lmp, this), shown(nullptr), in_callbacks(false)
{
  comm_forward = comm_reverse = Halo::MOST_DOUBLES;
  require_clusters();
}

ClusterFix::~ClusterFix()
{
  if (!in_callbacks) return;
  atom->delete_callback(id, Atom::GROW);
  if (restart_peratom) atom->delete_callback(id, Atom::RESTART);
  array_atom = nullptr;    // is the table's
}

void ClusterFix::require_clusters() const
{
  if (!atom->radius_flag || !atom->rmass_flag)
    error->all(FLERR, "Fix {} requires atom style sphere or cluster: clusters have a diameter and a mass", style);
}

/* ---------------------------------------------------------------------- */

void ClusterFix::start_table()
{
  restart_peratom = table.keeps_any();
  maxexchange_dynamic = table.has_lists();
  ClusterFix::grow_arrays(atom->nmax);
  for (int i = 0; i < atom->nlocal; i++) ClusterFix::set_arrays(i);
  atom->add_callback(Atom::GROW);
  if (restart_peratom) atom->add_callback(Atom::RESTART);
  in_callbacks = true;
  if (!maxexchange_dynamic) maxexchange = table.size(0, ClusterTable::CARRIED);
}

void ClusterFix::announce_exchange()
{
  if (!maxexchange_dynamic) return;
  int mine = 0, most;
  for (int i = 0; i < atom->nlocal; i++) mine = std::max(mine, table.size(i, ClusterTable::CARRIED));
  MPI_Allreduce(&mine, &most, 1, MPI_INT, MPI_MAX, world);
  maxexchange = most;
}

/* ---------------------------------------------------------------------- */

void ClusterFix::grow_arrays(int nmax)
{
  table.grow(std::max(nmax, 1));
  if (shown) array_atom = shown->array();
}

void ClusterFix::copy_arrays(int i, int j, int delflag)
{
  if (delflag) leaving(j);
  table.copy(i, j);
}

void ClusterFix::set_arrays(int i)
{
  table.clear(i);
}

int ClusterFix::pack_exchange(int i, double *to)
{
  return table.pack(i, to, ClusterTable::CARRIED);
}

int ClusterFix::unpack_exchange(int i, double *from)
{
  const int n = table.unpack(i, from, ClusterTable::CARRIED);
  arrived(i);
  return n;
}

/* ----------------------------------------------------------------------
   in restart files the number of values stands first
------------------------------------------------------------------------- */

int ClusterFix::pack_restart(int i, double *to)
{
  to[0] = size_restart(i);
  return 1 + table.pack(i, to + 1, ClusterTable::KEPT);
}

void ClusterFix::unpack_restart(int i, int nth)
{
  const double *from = atom->extra[i];
  for (int k = 0; k < nth; k++) from += static_cast<int>(*from);
  const int n = static_cast<int>(*from) - 1;
  table.clear(i);
  if (!unpack_earlier(i, from + 1, n)) table.unpack(i, from + 1, ClusterTable::KEPT);
}

int ClusterFix::size_restart(int i)
{
  return 1 + table.size(i, ClusterTable::KEPT);
}

// called on all ranks, but the file keeps the answer of the first: room for the clusters of all

int ClusterFix::maxsize_restart()
{
  int mine = 1, most = 0;
  for (int i = 0; i < atom->nlocal; i++) mine = std::max(mine, size_restart(i));
  MPI_Allreduce(&mine, &most, 1, MPI_INT, MPI_MAX, world);
  return most;
}

/* ---------------------------------------------------------------------- */

int ClusterFix::pack_forward_comm(int n, int *list, double *buf, int, int *)
{
  return halo.pack_forward(n, list, buf);
}

void ClusterFix::unpack_forward_comm(int n, int first, double *buf)
{
  halo.unpack_forward(n, first, buf);
}

int ClusterFix::pack_reverse_comm_size(int n, int first)
{
  return halo.reverse_size(n, first);
}

int ClusterFix::pack_reverse_comm(int n, int first, double *buf)
{
  return halo.pack_reverse(n, first, buf);
}

void ClusterFix::unpack_reverse_comm(int n, int *list, double *buf)
{
  halo.unpack_reverse(n, list, buf);
}
