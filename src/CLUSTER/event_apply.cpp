/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#include "event_apply.h"

#include "atom.h"
#include "atom_vec.h"
#include "error.h"
#include "modify.h"

#include <algorithm>

using namespace LAMMPS_NS;
using namespace ClusterDEM;

/* ---------------------------------------------------------------------- */

void EventApply::init()
{
  contact_memories = fixes_that_remember_contacts(lmp);
}

/* ---------------------------------------------------------------------- */

void EventApply::carry_out(const std::vector<Event> &events, std::vector<int> dying)
{
  std::vector<NewbornTags::Birth> births;
  for (const Event &e : events)
    if (e.breaks()) births.push_back({static_cast<std::uint64_t>(atom->tag[e.i]), e.plan.pieces() - 1});
  tags.assign(births, tags.highest_used() + 1.0);

  // newborns overwrite ghosts, so forget those first
  atom->map_clear();
  atom->nghost = 0;
  atom->avec->clear_bonus();

  const int nlocal_before = atom->nlocal;
  std::size_t birth = 0;
  for (const Event &e : events) {
    if (e.merges()) {
      carried.merge(e);
      for (int axis = 0; atom->omega_flag && axis < 3; axis++) atom->omega[e.i][axis] = e.omega[axis];
    }
    if (e.breaks()) create_fragments(e, births[birth++].first);
    else become(e.i, e.plan.n, e.body.x, e.body.v);
  }
  remove(dying);

  // what the events made, not a recount: clusters that left the box must stay missing in the engine's own test
  bigint made = atom->nlocal - nlocal_before, made_all = 0;
  MPI_Allreduce(&made, &made_all, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  atom->natoms += made_all;
  if (atom->natoms < 0 || atom->natoms >= MAXBIGINT) error->all(FLERR, "Too many clusters: {}", atom->natoms);
  atom->map_init();
  atom->map_set();
}

/* ----------------------------------------------------------------------
   owned cluster i, changed or newborn, holds n particles from now on
------------------------------------------------------------------------- */

void EventApply::become(int i, int n, const Vec3 &x, const Vec3 &v)
{
  const ClusterGeometry &particles = kinds.geometry(atom->type[i]);
  for (int axis = 0; axis < 3; axis++) {
    atom->x[i][axis] = x[axis];
    atom->v[i][axis] = v[axis];
  }
  atom->radius[i] = 0.5 * particles.diameter(n);
  atom->rmass[i] = particles.mass(n);
  set_density(atom, i, particles.density());
  columns.set_count(i, n, particles.diameter(n));
}

/* ----------------------------------------------------------------------
   the parent becomes the first piece; the others are copies of it in all else
------------------------------------------------------------------------- */

void EventApply::create_fragments(const Event &e, tagint first)
{
  const int newborns = atom->nlocal;
  for (int piece = 1; piece < e.plan.pieces(); piece++) {
    const int m = copy_of(e.i);
    (*columns.seen)[m] = atom->tag[m] = first + piece - 1;
    become(m, e.plan.particles(piece), e.body.x + e.placement.centres[piece], e.body.v);
  }
  become(e.i, e.plan.particles(0), e.body.x + e.placement.centres[0], e.body.v);
  carried.divide(e, newborns);
}

/* ----------------------------------------------------------------------
   all that the engine, its fixes and computes keep for an atom goes on to the copy, but for the memory of contacts:
   a newborn touches nobody
------------------------------------------------------------------------- */

int EventApply::copy_of(int parent)
{
  Vec3 x = to_vec3(atom->x[parent]);    // the engine's own may move as it makes room
  atom->avec->create_atom(atom->type[parent], x.data());
  const int m = atom->nlocal - 1;
  atom->avec->copy(parent, m, 0);
  for (Fix *memory : contact_memories) memory->set_arrays(m);
  return m;
}

/* ---------------------------------------------------------------------- */

void EventApply::remove(std::vector<int> &dying)
{
  std::sort(dying.begin(), dying.end());
  for (auto j = dying.rbegin(); j != dying.rend(); ++j) {
    (*columns.count)[*j] = 0;    // its particles are in another cluster: it does not leave
    atom->avec->copy(atom->nlocal - 1, *j, 1);
    atom->nlocal--;
  }
}
