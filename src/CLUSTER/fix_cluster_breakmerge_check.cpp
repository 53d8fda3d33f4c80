/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// What holds at a check: particle counts, contacts and their power, E_in* and the stable size.

#include "fix_cluster_breakmerge.h"

#include "cell_averages.h"
#include "fix_drag_cluster.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "memory.h"
#include "update.h"

#include <algorithm>

using namespace LAMMPS_NS;
using namespace ClusterDEM;

/* ----------------------------------------------------------------------
   whole number of particles of an owned cluster, from its mass when it is first asked for
------------------------------------------------------------------------- */

int FixClusterBreakMerge::particle_count(int i)
{
  if (count[i]) return count[i];
  const ClusterGeometry &particles = geometry(i);
  const auto n = particles.count_from_mass(atom->rmass[i]);
  const double d = particles.diameter(n.whole ? n.n : n.exact);
  const bool right_size = std::fabs(2.0 * atom->radius[i] - d) <= 1.0e-6 * d;
  if (!n.whole || !right_size) {
    const int nearest = MAX(1, static_cast<int>(std::lround(n.exact)));
    const std::string fault = n.whole
        ? fmt::format("has diameter {:.10g}, which does not fit its {} primary particles", 2.0 * atom->radius[i],
                      n.n)
        : fmt::format("has mass {:.10g}, which is {:.2f} primary particles, not a whole number within 1e-6",
                      atom->rmass[i], n.exact);
    error->one(FLERR,
               "Fix {} {}: cluster {} {}: {} particles at voidage {} need diameter {:.10g} and density {:.10g}",
               style, id, atom->tag[i], fault, nearest, particles.voidage, particles.diameter(nearest),
               particles.density());
  }
  if (n.n > limits.hi)
    error->one(FLERR,
               "Fix {} {}: cluster {} holds {} primary particles, above the upper limit {}: the pair "
               "cutoff is made for the largest diameter of the limits",
               style, id, atom->tag[i], n.n, limits.hi);
  count[i] = n.n;
  array_atom[i][0] = n.n;
  array_atom[i][1] = d;
  return n.n;
}

/* ----------------------------------------------------------------------
   mass and diameter are this fix's to change
------------------------------------------------------------------------- */

void FixClusterBreakMerge::check_size(int i)
{
  const int n = particle_count(i);
  const double d = array_atom[i][1];
  if (std::fabs(2.0 * atom->radius[i] - d) > 1.0e-6 * d ||
      std::fabs(atom->rmass[i] - geometry(i).mass(n)) > 1.0e-6 * atom->rmass[i])
    error->one(
        FLERR,
        "Fix {} {}: cluster {} of {} particles has diameter {:.10g} and mass {:.10g} at step {}: another command "
        "changes diameters or masses",
        style, id, atom->tag[i], n, 2.0 * atom->radius[i], atom->rmass[i], update->ntimestep);
}

/* ---------------------------------------------------------------------- */

void FixClusterBreakMerge::free_scratch()
{
  memory->destroy(stable);
  memory->destroy(power);
  memory->destroy(ncontacts);
  memory->sfree(suitor);
  memory->destroy(needs);
  memory->destroy(room);
  memory->destroy(proceeds);
}

void FixClusterBreakMerge::size_scratch()
{
  if (nmax_check >= atom->nmax) return;
  nmax_check = atom->nmax;
  free_scratch();
  memory->create(stable, nmax_check, "cluster/breakmerge:stable");
  memory->create(power, nmax_check, "cluster/breakmerge:power");
  memory->create(ncontacts, nmax_check, "cluster/breakmerge:ncontacts");
  suitor = (Suitor *) memory->smalloc(nmax_check * sizeof(Suitor), "cluster/breakmerge:suitor");
  memory->create(needs, nmax_check, "cluster/breakmerge:needs");
  memory->create(room, nmax_check, 4, "cluster/breakmerge:room");
  memory->create(proceeds, nmax_check, "cluster/breakmerge:proceeds");
}

/* ----------------------------------------------------------------------
   nothing in the engine looks at positions that are not a number until lists are rebuilt, which they prevent
------------------------------------------------------------------------- */

void FixClusterBreakMerge::check_finite()
{
  for (int i = 0; i < atom->nlocal; i++) {
    const Vec3 state = to_vec3(atom->x[i]) + to_vec3(atom->v[i]);
    if (!std::isfinite(state[0] + state[1] + state[2]))
      error->one(FLERR,
                 "Fix {} {}: position and velocity of cluster {} are not finite at step {}: clusters at one "
                 "point, or a time step that is too long",
                 style, id, atom->tag[i], update->ntimestep);
  }
}

/* ----------------------------------------------------------------------
   l of every owned cluster, and what it is made of
------------------------------------------------------------------------- */

void FixClusterBreakMerge::measure()
{
  size_scratch();
  check_finite();
  for (int i = 0; i < atom->nlocal; i++)
    if (atom->mask[i] & groupbit) check_size(i);
  contact_force = 0.0;
  if (looks_at_contacts()) add_up_contacts();
  if (term_st || local_umf()) drag->prepare();
  if (averages) average_cells();
  find_stable_sizes();
}

/* ----------------------------------------------------------------------
   power of the contact forces and number of contacts; with newton on, half of the pairs across ranks
   are known to the other side alone. Nothing is summed or sent that nobody asks for.
------------------------------------------------------------------------- */

void FixClusterBreakMerge::add_up_contacts()
{
  const int nlocal = atom->nlocal;
  const int nall = nlocal + atom->nghost;
  const bool want_power = looks_at_power();
  const bool want_sums = want_power || test == IN_CONTACT;
  const bool want_tags = test == CONTACT_ENDED;

  if (want_sums) {
    std::fill(power, power + nall, 0.0);
    std::fill(ncontacts, ncontacts + nall, 0);
  }
  if (want_tags) {
    touching_tags.resize(MAX(static_cast<std::size_t>(nall), touching_tags.size()));
    for (int i = 0; i < nall; i++) touching_tags[i].clear();
  }

  pairs.find_contacts();
  for (const auto &contact : pairs.contacts()) {
    const int i = contact.i, j = contact.j;
    const bool both = force->newton_pair || j < nlocal;
    ContactSource::Load load = {0.0, 0.0};
    if (want_power || contact.noted) load = pairs.load(contact);
    contact_force +=
        load.force * ((atom->mask[i] & groupbit ? 1 : 0) + (both && atom->mask[j] & groupbit ? 1 : 0));
    if (want_sums) {
      power[i] += load.power;
      ncontacts[i]++;
      if (both) {
        power[j] += load.power;
        ncontacts[j]++;
      }
    }
    if (want_tags) {
      touching_tags[i].push_back(atom->tag[j]);
      if (both) touching_tags[j].push_back(atom->tag[i]);
    }
  }
  if (!force->newton_pair) return;
  if (want_sums) exchange(CONTACTS, 2);
  if (want_tags) {
    comm_stage = TAGS;
    comm->reverse_comm_variable(this);
  }
}

/* ----------------------------------------------------------------------
   minimum fluidization velocity after Wen & Yu: of each cluster's own gas where density or viscosity vary
------------------------------------------------------------------------- */

double FixClusterBreakMerge::umf_in(const Gas &gas, const ClusterGeometry &particles) const
{
  return umf_wen_yu(particles.d_p, particles.rho_p, gas, gravity);
}

bool FixClusterBreakMerge::local_umf() const
{
  return term_mf && umf_from_wen_yu && drag && !drag->uniform_properties();
}

/* ---------------------------------------------------------------------- */

void FixClusterBreakMerge::average_cells()
{
  averages->clear();
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    const double *x = atom->x[i];
    const Vec3 v = to_vec3(atom->v[i]);
    averages->add(x, CellAverages::MASS, atom->rmass[i]);
    averages->add(x, CellAverages::MASS_SPEED, atom->rmass[i] * std::fabs(v[gravity_axis]));
    if (term_st && nst == NstReading::CELL) {
      const LocalGas here = drag->gas_at(i);
      const Vec3 slip = drag->in_plane(here.u - v);
      const double b = drag->cluster_coefficient(i, here.gas, norm(slip));
      averages->add(x, CellAverages::DRAG_POWER, dot(b * slip, here.u));
    }
  }
  averages->sum();
}

/* ---------------------------------------------------------------------- */

void FixClusterBreakMerge::find_stable_sizes()
{
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) {
      stable[i] = needs[i] = 0;
      continue;
    }
    const Kind &mine = kind(i);
    const ClusterGeometry &particles = mine.rule.geometry;
    const double *x = atom->x[i];
    const Vec3 v = to_vec3(atom->v[i]);
    double gas = 0.0, contacts = 0.0, fluidization = 0.0;

    if (term_st && nst == NstReading::CELL)
      gas = averages->total(x, CellAverages::DRAG_POWER) / averages->total(x, CellAverages::MASS);
    else if (term_st) {
      const LocalGas here = drag->gas_at(i);
      const Vec3 slip = drag->in_plane(here.u - v);
      const double speed = norm(slip);
      const bool single = nst == NstReading::PARTICLE;
      const double b = single ? drag_coefficient(drag->drag_law(), here.gas, particles.d_p, speed)
                              : drag->cluster_coefficient(i, here.gas, speed);
      gas = n_st(b * slip, here.u, single ? particles.particle_mass() : atom->rmass[i]);
    }
    if (looks_at_power()) contacts = n_cc(power[i], atom->rmass[i], ncc_factor);
    if (term_mf) {
      double speed = std::fabs(v[gravity_axis]);
      if (up != UpReading::OWN) {
        const double mass = averages->total(x, CellAverages::MASS);
        speed = averages->total(x, CellAverages::MASS_SPEED) / mass;
        if (up == UpReading::SUPERFICIAL) speed *= mass / (particles.rho_p * averages->cell_volume());
      }
      const double u_mf = local_umf() ? umf_in(drag->gas_at(i).gas, particles) : mine.u_mf;
      fluidization = n_smf(nsmf, u_mf, speed, eps_mf, gravity);
    }

    const StableSize size = mine.rule.stable(gas + contacts - fluidization);
    stable[i] = size.n;
    needs[i] = 0;
    double *row = array_atom[i];
    row[2] = size.l;
    row[3] = gas;
    row[4] = contacts;
    row[5] = fluidization;
  }
}

/* ----------------------------------------------------------------------
   has any contact of the last test ended? The contacts of now are kept for the next one.
------------------------------------------------------------------------- */

bool FixClusterBreakMerge::contact_ended(int i)
{
  std::vector<tagint> &now = touching_tags[i];
  std::sort(now.begin(), now.end());
  now.erase(std::unique(now.begin(), now.end()), now.end());
  const bool ended = !std::includes(now.begin(), now.end(), partners[i].begin(), partners[i].end());
  partners[i] = now;
  return ended;
}
