/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#include "event_check.h"

#include "event_plan.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "force.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace ClusterDEM;

/* ---------------------------------------------------------------------- */

EventCheck::EventCheck(LAMMPS *lmp, const BreakMergeSettings &s, const ClusterColumns &c, ContactSource &p,
                       Census &all, Halo &h, int group) :
    EnginePointers(lmp), settings(s), columns(c), pairs(p), census(all), halo(h), groupbit(group),
    contacts(lmp, p, h, group), sizes(lmp, s, c, group), walls(lmp, s.event), carried_by_clusters(lmp, s.event)
{
}

/* ---------------------------------------------------------------------- */

void EventCheck::init(const std::string &me, Requirements &all)
{
  sizes.init(me);
  walls.init(me, all);
  carried_by_clusters.init(me, all);
  others.find(lmp);
}

void EventCheck::make_lattices()
{
  const double reach = settings.event.claim / (settings.event.spacing * settings.kinds.smallest_diameter()) + 1.0;
  const bool planar = settings.event.planar;
  lattices = std::make_unique<Lattices>(planar ? 0 : -1, planar ? 2 : -1, reach);
}

void EventCheck::measure()
{
  if (settings.looks_at_contacts()) contacts.add_up(settings);
  sizes.measure(contacts);
}

void EventCheck::forget()
{
  to_do.clear();
  vanishing.clear();
}

/* ---------------------------------------------------------------------- */

bool EventCheck::plan(bigint step)
{
  note_forces();
  const Breakups wanted = breakups();
  if (!settings.event.merging && !halo.anywhere(!wanted.empty())) return false;
  if (!settings.looks_at_contacts()) comm->forward_comm();

  Crowd here = crowd();
  PlanRules rules;
  rules.kinds = &settings.kinds;
  rules.lattices = lattices.get();
  rules.merge_tolerance = settings.event.merge_tolerance;
  rules.break_refused = settings.event.break_refused;
  rules.claim = settings.event.claim;
  rules.spacing = settings.event.spacing;
  rules.planar = settings.event.planar;
  rules.check = step / settings.event.every;

  EventPlan plan(here, rules, halo);
  for (const auto &[i, into] : wanted) plan.propose_break(i, into);
  if (settings.event.merging) plan.propose_merges(touches());
  if (!plan.any_proposed()) return false;
  walls.prepare();
  plan.settle();
  census.add(Census::DEFERRED, plan.deferred());
  to_do = plan.events();
  vanishing = plan.dying();
  remember_postponed(wanted);
  if (!halo.anywhere(!to_do.empty())) return false;
  note_events();
  note_contacts();
  if (settings.event.merging) carried_by_clusters.prepare(to_do, halo);
  return true;
}

/* ----------------------------------------------------------------------
   forces as they last acted: nothing is evaluated for this alone
------------------------------------------------------------------------- */

void EventCheck::note_forces()
{
  double drag_force = 0.0, mass = 0.0;
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    if (sizes.knows_drag()) drag_force += sizes.drag_force(i);
    mass += atom->rmass[i];
  }
  census.add(Census::DRAG_FORCE, drag_force);
  census.add(Census::CONTACT_FORCE, contacts.magnitude());
  census.add(Census::WEIGHT, mass * settings.size.gravity);
}

/* ----------------------------------------------------------------------
   a cluster whose breakup was postponed is tested until it breaks, or wants to no more
------------------------------------------------------------------------- */

bool EventCheck::tested(int i)
{
  const bool postponed = columns.postponed && (*columns.postponed)[i];
  switch (settings.event.test) {
    case EventSettings::IN_CONTACT:
      return contacts.in_contact(i) || postponed;
    case EventSettings::CONTACT_ENDED:
      return contacts.ended_since((*columns.partners)[i], i) || postponed;
    default:
      return true;
  }
}

EventCheck::Breakups EventCheck::breakups()
{
  Breakups wanted;
  for (int i = 0; settings.event.breaking && i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit) || !tested(i) || others.holds(i, update->ntimestep)) continue;
    census.add(Census::TESTS);
    const SizeRule &rule = sizes.rule(settings.kinds.of_type(atom->type[i]));
    const int n = (*columns.count)[i];
    const BreakPlan plan = rule.breakup(n, columns.diameter(i), sizes.stable(i));
    if (plan.is_event()) wanted.emplace_back(i, plan);
    else census.whole(rule, columns.power(i), n, columns.diameter(i));
    if (columns.postponed) (*columns.postponed)[i] = 0;
  }
  return wanted;
}

// those that break forget it as they change
void EventCheck::remember_postponed(const Breakups &wanted)
{
  if (!columns.postponed) return;
  for (const auto &[i, into] : wanted) (*columns.postponed)[i] = 1;
}

/* ---------------------------------------------------------------------- */

Crowd EventCheck::crowd() const
{
  Crowd c;
  c.nlocal = atom->nlocal;
  c.nall = atom->nlocal + atom->nghost;
  c.x = atom->x;
  c.v = atom->v;
  c.omega = atom->omega_flag ? atom->omega : nullptr;
  c.radius = atom->radius;
  c.mass = atom->rmass;
  c.id.assign(atom->tag, atom->tag + c.nall);
  c.kind.resize(c.nall);
  for (int i = 0; i < c.nall; i++)
    c.kind[i] = atom->mask[i] & groupbit ? settings.kinds.of_type(atom->type[i]) : -1;
  c.size.assign(c.nall, Crowd::Size());
  for (int i = 0; i < c.nlocal; i++)
    if (c.kind[i] >= 0)
      c.size[i] = {(*columns.count)[i], sizes.stable(i).n, others.holds(i, update->ntimestep) ? 1 : 0};
  c.nearest_image = [this](int i, ClusterID other) {
    const int image = atom->map(static_cast<tagint>(other));
    return image < 0 ? -1 : domain->closest_image(i, image);
  };
  for (int axis = 0; axis < 3; axis++) {
    c.lo[axis] = domain->sublo[axis] - comm->cutghost[axis];
    c.hi[axis] = domain->subhi[axis] + comm->cutghost[axis];
  }
  c.walls_around = [this](const Vec3 &origin) { return walls.around(origin); };
  c.contact_energy = [this](int i, int j, double radius_i, double distance) {
    return pairs.energy(i, j, radius_i, distance);
  };
  return c;
}

std::vector<Touch> EventCheck::touches() const
{
  std::vector<Touch> list;
  for (const auto &contact : pairs.contacts()) list.push_back({contact.i, contact.j});
  return list;
}

/* ----------------------------------------------------------------------
   what decided the events; collective
------------------------------------------------------------------------- */

void EventCheck::note_events()
{
  std::vector<PowerParts> powers;
  if (settings.event.merging) {
    powers.assign(atom->nlocal + atom->nghost, PowerParts(0.0, 0.0, 0.0));
    for (int i = 0; i < atom->nlocal; i++) powers[i] = columns.power(i);
    halo.forward(powers);
  }
  for (const Event &e : to_do) {
    const SizeRule &rule = sizes.rule(settings.kinds.of_type(atom->type[e.i]));
    census.happened(e);
    if (atom->omega_flag) note_spin(e);
    if (!e.merges()) census.broke(rule, columns.power(e.i), (*columns.count)[e.i], columns.diameter(e.i));
    else census.merged(rule, powers[e.i], powers[e.j], e.particles);
  }
}

/* ----------------------------------------------------------------------
   energy of rotation that smaller or merged spheres hold no more; e.j may be a ghost
------------------------------------------------------------------------- */

void EventCheck::note_spin(const Event &e)
{
  const ClusterGeometry &particles = settings.kinds.geometry(atom->type[e.i]);
  auto energy = [&](int i) { return Spinning{atom->rmass[i], atom->radius[i], to_vec3(atom->omega[i])}.energy(); };
  double given_up = energy(e.i) + (e.merges() ? energy(e.j) : 0.0);
  const Vec3 omega = e.merges() ? e.omega : to_vec3(atom->omega[e.i]);
  for (int piece = 0; piece < e.plan.pieces(); piece++) {
    const int n = e.plan.particles(piece);
    given_up -= Spinning{particles.mass(n), 0.5 * particles.diameter(n), omega}.energy();
  }
  census.add(Census::E_SPIN, given_up);
}

/* ----------------------------------------------------------------------
   elastic energy of the contacts that vanish, less that of the contacts which merged clusters have; collective
------------------------------------------------------------------------- */

void EventCheck::note_contacts()
{
  if (!settings.looks_at_contacts()) pairs.find_contacts();
  std::vector<char> changes(atom->nlocal + atom->nghost, 0);
  for (const Event &e : to_do) {
    changes[e.i] = 1;
    census.add(Census::E_CONTACTS, -e.energy_after);
  }
  for (const int j : vanishing) changes[j] = 1;
  halo.forward(changes);
  for (const auto &c : pairs.contacts()) {
    if (!changes[c.i] && !changes[c.j]) continue;
    const bool twice = !force->newton_pair && c.j >= atom->nlocal;    // in the lists of both ranks
    census.add(Census::E_CONTACTS, (twice ? 0.5 : 1.0) * pairs.energy_now(c));
  }
}
