/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#include "arrivals.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

using namespace LAMMPS_NS;
using namespace ClusterDEM;

static constexpr double TOLERANCE = 1.0e-6;    // of masses and diameters, relative

/* ---------------------------------------------------------------------- */

Arrivals::Arrivals(LAMMPS *lmp, const ClusterKinds &k, const ClusterColumns &c, NewbornTags &t, Census &all,
                   int group) :
    EnginePointers(lmp), kinds(k), columns(c), tags(t), census(all), groupbit(group), start_counted(false)
{
}

/* ----------------------------------------------------------------------
   from its mass when it is first asked for
------------------------------------------------------------------------- */

int Arrivals::particle_count(int i)
{
  int &count = (*columns.count)[i];
  if (count) return count;
  count = whole_number(i);
  (*columns.shown)[i][ClusterColumns::N] = count;
  (*columns.shown)[i][ClusterColumns::D] = kinds.geometry(atom->type[i]).diameter(count);
  return count;
}

void Arrivals::check_all() const
{
  for (int i = 0; i < atom->nlocal; i++)
    if (atom->mask[i] & groupbit) whole_number(i);
}

/* ----------------------------------------------------------------------
   fix pour draws diameters from a range unless it is given the few that there may be
------------------------------------------------------------------------- */

std::string Arrivals::how_to_pour(int i) const
{
  for (const Fix *other : find_fixes(lmp, "^pour"))
    return fmt::format(". Fix {} {} pours clusters of whole numbers of particles with 'diam one D' or 'diam poly "
                       "N D1 P1 ...', D = {:.10g} n^(1/3) for n particles, and 'dens RHO RHO', RHO = {:.10g}",
                       other->style, other->id, kinds.geometry(atom->type[i]).diameter(1),
                       kinds.geometry(atom->type[i]).density());
  return "";
}

/* ----------------------------------------------------------------------
   what a cluster of the nearest whole number would be, against what it is
------------------------------------------------------------------------- */

int Arrivals::whole_number(int i) const
{
  const ClusterGeometry &particles = kinds.geometry(atom->type[i]);
  const auto n = particles.count_from_mass(atom->rmass[i]);
  const double found_d = 2.0 * atom->radius[i];
  if (n.exact > 1.0e9 || n.exact < 0.5)
    error->one(FLERR,
               "{}: cluster {} of mass {:.6g} would be {:.3g} primary particles of d_p = {:.6g} and rho_p = "
               "{:.6g}: are d_p "
               "and rho_p given in this order, and in units {} (length, mass/volume)?",
               me, atom->tag[i], atom->rmass[i], n.exact, particles.d_p, particles.rho_p, update->unit_style);
  const double d = particles.diameter(n.whole ? n.n : n.exact);
  const bool right_size = std::fabs(found_d - d) <= TOLERANCE * d;
  if (!n.whole || !right_size) {
    const int nearest = std::max(1, static_cast<int>(std::lround(n.exact)));
    const std::string fault = n.whole
        ? fmt::format("has diameter {:.10g}, which does not fit its {} primary particles", found_d, n.n)
        : fmt::format("has mass {:.10g}, which is {:.2f} primary particles, not a whole number within 1e-6",
                      atom->rmass[i], n.exact);
    error->one(
        FLERR,
        "{}: cluster {} {}: {} particles at voidage {} need diameter {:.10g} and density {:.10g}, but it has "
        "diameter {:.10g} and density {:.10g}, a voidage of {:.4g} for particles of density {:.6g}{}",
        me, atom->tag[i], fault, nearest, particles.voidage, particles.diameter(nearest), particles.density(),
        found_d, sphere_density(atom->rmass[i], found_d),
        1.0 - sphere_density(atom->rmass[i], found_d) / particles.rho_p, particles.rho_p, how_to_pour(i));
  }
  if (n.n > kinds.limits.hi)
    error->one(FLERR,
               "{}: cluster {} holds {} primary particles, above the upper limit {}: the pair "
               "cutoff is made for the largest diameter of the limits",
               me, atom->tag[i], n.n, kinds.limits.hi);
  return n.n;
}

/* ---------------------------------------------------------------------- */

void Arrivals::check_size(int i)
{
  const int n = particle_count(i);
  const double d = columns.diameter(i), mass = kinds.geometry(atom->type[i]).mass(n);
  if (std::fabs(2.0 * atom->radius[i] - d) > TOLERANCE * d ||
      std::fabs(atom->rmass[i] - mass) > TOLERANCE * atom->rmass[i])
    error->one(FLERR,
               "{}: cluster {} of {} particles has diameter {:.10g} and mass {:.10g} at step {}: another command "
               "changes diameters or masses",
               me, atom->tag[i], n, 2.0 * atom->radius[i], atom->rmass[i], update->ntimestep);
}

/* ----------------------------------------------------------------------
   a set command or the like may have changed any of them
------------------------------------------------------------------------- */

void Arrivals::at_start_of_run()
{
  const bool new_ids = renumbered();
  if (new_ids) forget_contacts();
  tagint mine = 0, all = 0;
  for (int i = 0; i < atom->nlocal; i++) {
    mine = std::max(mine, atom->tag[i]);
    if (!(atom->mask[i] & groupbit)) continue;
    int &count = (*columns.count)[i];
    const int before = count;
    count = 0;
    const int change = particle_count(i) - before;
    if (!start_counted) continue;
    if (before == 0) census.add(Census::CLUSTERS_FED);
    census.add(change > 0 ? Census::FED : Census::LEFT, std::abs(change));
  }
  know_all();
  start_counted = true;
  MPI_Allreduce(&mine, &all, 1, MPI_LMP_TAGINT, MPI_MAX, world);
  if (new_ids) tags.start_over(all);
  else tags.raise(all);
}

/* ----------------------------------------------------------------------
   Contacts are remembered by IDs. A command that gives IDs anew between two runs, such as reset_atoms id or delete_atoms with
   compress yes, would leave the memory of one pair to another.
------------------------------------------------------------------------- */

void Arrivals::know_all()
{
  for (int i = 0; i < atom->nlocal; i++) (*columns.seen)[i] = atom->tag[i];
}

bool Arrivals::renumbered() const
{
  int mine = 0, any;
  for (int i = 0; i < atom->nlocal; i++) {
    const tagint seen = (*columns.seen)[i];
    if (seen && seen != atom->tag[i]) mine = 1;
  }
  MPI_Allreduce(&mine, &any, 1, MPI_INT, MPI_MAX, world);
  return any;
}

void Arrivals::forget_contacts()
{
  for (int i = 0; i < atom->nlocal; i++) {
    if (columns.partners) (*columns.partners)[i].clear();
    for (Fix *memory : fixes_that_remember_contacts(lmp)) memory->set_arrays(i);
  }
  if (comm->me == 0)
    error->warning(
        FLERR,
        fmt::format("{}: atoms have other IDs than in the last run, by which contacts are remembered: what was "
                    "remembered of contacts is forgotten (springs of friction start anew)",
                    me));
}

/* ---------------------------------------------------------------------- */

std::vector<int> Arrivals::newcomers() const
{
  std::vector<int> mine;
  for (int i = 0; i < atom->nlocal; i++)
    if ((*columns.seen)[i] == 0) mine.push_back(i);
  return mine;
}

/* ----------------------------------------------------------------------
   They are numbered above every ID ever used, in an order that hangs on their places alone, whatever IDs they brought:
   those may have belonged to others, or depend on the ranks.
------------------------------------------------------------------------- */

void Arrivals::welcome(const std::vector<int> &mine, Halo &halo)
{
  for (const int i : mine)
    if (atom->mask[i] & groupbit) census.came(particle_count(i));
  number_by_place(mine, halo);
}

/* ----------------------------------------------------------------------
   Places mixed to numbers that are spread evenly wherever the clusters came in, so that the ranks share the work. Of a
   place only what rounding does not touch counts.
------------------------------------------------------------------------- */

static std::uint64_t mixed(std::uint64_t z)
{
  z += 0x9e3779b97f4a7c15u;    // splitmix64
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

void Arrivals::number_by_place(const std::vector<int> &mine, Halo &halo)
{
  static constexpr double FINEST = 4294967296.0;    // parts of the box along an axis
  std::vector<NewbornTags::Birth> births;
  for (const int i : mine) {
    std::uint64_t key = 0;
    for (int axis = 0; axis < 3; axis++) {
      const double share = (atom->x[i][axis] - domain->boxlo[axis]) / domain->prd[axis];
      key = mixed(key ^ static_cast<std::uint64_t>(static_cast<std::int64_t>(share * FINEST)));
    }
    births.push_back({key, 1});
  }
  tags.assign(births, FINEST * FINEST);

  const int nall = atom->nlocal + atom->nghost;
  std::vector<tagint> ids(atom->tag, atom->tag + nall);
  for (std::size_t k = 0; k < mine.size(); k++) ids[mine[k]] = births[k].first;
  halo.forward(ids);
  atom->map_clear();
  std::copy(ids.begin(), ids.end(), atom->tag);
  for (const int i : mine) (*columns.seen)[i] = atom->tag[i];
  atom->map_init();
  atom->map_set();
}

/* ----------------------------------------------------------------------
   The engine deletes clusters by copying another one over them, and so it does with those that it has packed for
   another rank: what is deleted and unpacked nowhere has left.
------------------------------------------------------------------------- */

void Arrivals::note_leaving(int i)
{
  const int n = (*columns.count)[i];
  if (n) census.left(n);
}

void Arrivals::note_arrived(int i)
{
  const int n = (*columns.count)[i];
  if (n) census.left_elsewhere(n);
}
