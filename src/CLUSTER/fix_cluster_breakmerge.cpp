/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#include "fix_cluster_breakmerge.h"

#include "scene_checks.h"
#include "style_arguments.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "update.h"

#include <cstring>

using namespace LAMMPS_NS;
using namespace FixConst;
using namespace ClusterDEM;

/* ---------------------------------------------------------------------- */

static BreakMergeSettings read_settings(LAMMPS *lmp, int narg, char **arg)
{
  StyleArguments args(lmp, narg, arg, 3);
  return {args, lmp->atom->ntypes};
}

FixClusterBreakMerge::FixClusterBreakMerge(LAMMPS *lmp, int narg, char **arg) :
    ClusterFix(lmp, narg, arg), settings(read_settings(lmp, narg, arg)), columns{}, pairs(lmp),
    contacts(lmp, pairs, halo, groupbit), sizes(lmp, settings, columns, groupbit), walls(lmp, settings.event),
    tags(lmp), arrivals(lmp, settings.kinds, columns, tags, census, groupbit),
    apply(lmp, settings.kinds, columns, tags), output{}, output_step(-1), resumed_from_0_1(false)
{
  nevery = settings.event.every;
  force_reneighbor = 1;
  next_reneighbor = -1;
  restart_global = 1;
  vector_flag = 1;
  size_vector = sizeof(output) / sizeof(output[0]);
  global_freq = 1;
  extvector = 0;
  peratom_flag = 1;
  size_peratom_cols = ClusterColumns::NCOLUMNS;
  peratom_freq = 1;
  create_attribute = 1;
  dynamic_group_allow = 0;
  check_scene();

  use_hash_map(atom, domain);    // newborns find room and partners through it

  columns.count = &table.add<int>(ClusterTable::CARRIED);
  columns.shown = shown = &table.add_shown(ClusterColumns::NCOLUMNS);
  if (settings.event.test == EventSettings::CONTACT_ENDED)
    columns.partners = &table.add_lists<tagint>(ClusterTable::KEPT);
  start_table();
}

/* ---------------------------------------------------------------------- */

int FixClusterBreakMerge::setmask()
{
  return POST_INTEGRATE | PRE_EXCHANGE | PRE_NEIGHBOR;
}

void FixClusterBreakMerge::check_scene() const
{
  if (domain->dimension == 2)
    error->all(FLERR,
               "Fix {} requires a 3-d simulation (clusters are spheres): for motion in a plane "
               "use dimension 3 with 'plane xz'",
               style);
  if (!atom->tag_enable) error->all(FLERR, "Fix {} requires atom IDs", style);
  if (force->pair == nullptr) error->all(FLERR, "Fix {} must be defined after the pair_style command", style);
}

/* ---------------------------------------------------------------------- */

void FixClusterBreakMerge::init()
{
  const std::string me = fmt::format("Fix {} {}", style, id);
  const SceneChecks scene(lmp, this, me, settings);
  scene.check_engine();
  scene.check_order();
  sizes.init(me);
  walls.init(me);
  arrivals.init(me);
  apply.init();
  scene.check_foreign();
  pairs.find(me, groupbit, settings.kinds.largest_diameter());
  if (settings.looks_at_contacts()) pairs.expect_contacts(settings.next_check(update->ntimestep));
  scene.check_room();
  scene.check_lattice();
  const double reach = settings.event.claim / (settings.event.spacing * settings.kinds.smallest_diameter()) + 1.0;
  const bool planar = settings.event.planar;
  lattices = std::make_unique<Lattices>(planar ? 0 : -1, planar ? 2 : -1, reach);
}

/* ----------------------------------------------------------------------
   at the start of every run
------------------------------------------------------------------------- */

void FixClusterBreakMerge::setup_pre_exchange()
{
  arrivals.at_start_of_run();
  SceneChecks(lmp, this, fmt::format("Fix {} {}", style, id), settings).check_part_of_box();
}

// outputs of the first step; no event happens here

void FixClusterBreakMerge::setup(int)
{
  sizes.make_cells(this);
  measure();
  output_step = -1;
}

/* ---------------------------------------------------------------------- */

bool FixClusterBreakMerge::remembers(bigint step) const
{
  return settings.event.test == EventSettings::CONTACT_ENDED && step % settings.event.every == 0;
}

/* ---------------------------------------------------------------------- */

void FixClusterBreakMerge::post_integrate()
{
  events.clear();
  dying.clear();
  if (update->ntimestep % settings.event.every) return;

  // clusters have moved, their ghosts have not
  if (settings.looks_at_contacts()) comm->forward_comm();
  measure();
  note_forces();
  if (settings.looks_at_contacts()) pairs.expect_contacts(settings.next_check(update->ntimestep));
  plan_events();
}

/* ----------------------------------------------------------------------
   nothing in the engine looks at positions that are not a number until lists are rebuilt, which they prevent
------------------------------------------------------------------------- */

void FixClusterBreakMerge::measure()
{
  for (int i = 0; i < atom->nlocal; i++) {
    const Vec3 state = to_vec3(atom->x[i]) + to_vec3(atom->v[i]);
    if (!std::isfinite(state[0] + state[1] + state[2]))
      error->one(FLERR,
                 "Fix {} {}: position and velocity of cluster {} are not finite at step {}: clusters at one "
                 "point, or a time step that is too long",
                 style, id, atom->tag[i], update->ntimestep);
    if (atom->mask[i] & groupbit) arrivals.check_size(i);
  }
  if (settings.looks_at_contacts()) contacts.add_up(settings);
  sizes.measure(contacts);
}

/* ----------------------------------------------------------------------
   forces as they last acted: nothing is evaluated for this alone
------------------------------------------------------------------------- */

void FixClusterBreakMerge::note_forces()
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

/* ---------------------------------------------------------------------- */

bool FixClusterBreakMerge::tested(int i)
{
  switch (settings.event.test) {
    case EventSettings::IN_CONTACT:
      return contacts.in_contact(i);
    case EventSettings::CONTACT_ENDED:
      return contacts.ended_since((*columns.partners)[i], i);
    default:
      return true;
  }
}

std::vector<std::pair<int, BreakPlan>> FixClusterBreakMerge::breakups()
{
  std::vector<std::pair<int, BreakPlan>> wanted;
  for (int i = 0; settings.event.breaking && i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit) || !tested(i)) continue;
    census.add(Census::TESTS);
    const SizeRule &rule = sizes.rule(settings.kinds.of_type(atom->type[i]));
    const int n = (*columns.count)[i];
    const BreakPlan plan = rule.breakup(n, columns.diameter(i), sizes.stable(i));
    if (plan.is_event()) wanted.emplace_back(i, plan);
    else census.whole(rule, columns.power(i), n, columns.diameter(i));
  }
  return wanted;
}

/* ---------------------------------------------------------------------- */

Crowd FixClusterBreakMerge::crowd()
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
  c.count.assign(c.nall, 0);
  c.stable.assign(c.nall, 0);
  for (int i = 0; i < c.nlocal; i++)
    if (c.kind[i] >= 0) {
      c.count[i] = (*columns.count)[i];
      c.stable[i] = sizes.stable(i).n;
    }
  c.nearest_image = [this](int i, ClusterID other) {
    const int image = atom->map(static_cast<tagint>(other));
    return image < 0 ? -1 : domain->closest_image(i, image);
  };
  for (int axis = 0; axis < 3; axis++) {
    c.lo[axis] = domain->sublo[axis] - comm->cutghost[axis];
    c.hi[axis] = domain->subhi[axis] + comm->cutghost[axis];
  }
  c.walls_around = [this](const Vec3 &origin) { return walls.around(origin); };
  return c;
}

std::vector<Touch> FixClusterBreakMerge::touches() const
{
  std::vector<Touch> list;
  for (const auto &contact : pairs.contacts())
    list.push_back({contact.i, contact.j, !force->newton_pair && contact.j >= atom->nlocal});
  return list;
}

/* ---------------------------------------------------------------------- */

void FixClusterBreakMerge::plan_events()
{
  const auto wanted = breakups();
  if (!settings.event.merging && !halo.anywhere(!wanted.empty())) return;
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
  rules.check = update->ntimestep / settings.event.every;

  EventPlan plan(here, rules, halo);
  for (const auto &[i, into] : wanted) plan.propose_break(i, into);
  if (settings.event.merging)
    plan.propose_merges(touches(), [this](std::size_t k) { return pairs.stiffness(pairs.contacts()[k]); });
  if (!plan.any_proposed()) return;
  walls.prepare();
  plan.settle();
  census.add(Census::DEFERRED, plan.deferred());
  events = plan.events();
  dying = plan.dying();
  if (halo.anywhere(!events.empty())) {
    next_reneighbor = update->ntimestep;
    note_events();
  }
}

/* ----------------------------------------------------------------------
   what decided them; collective
------------------------------------------------------------------------- */

void FixClusterBreakMerge::note_events()
{
  std::vector<PowerParts> powers;
  if (settings.event.merging) {
    powers.assign(atom->nlocal + atom->nghost, PowerParts(0.0, 0.0, 0.0));
    for (int i = 0; i < atom->nlocal; i++) powers[i] = columns.power(i);
    halo.forward(powers);
  }
  for (const Event &e : events) {
    const SizeRule &rule = sizes.rule(settings.kinds.of_type(atom->type[e.i]));
    census.happened(e);
    if (!e.merges()) census.broke(rule, columns.power(e.i), (*columns.count)[e.i], columns.diameter(e.i));
    else census.merged(rule, powers[e.i], powers[e.j], e.particles);
  }
}

/* ---------------------------------------------------------------------- */

void FixClusterBreakMerge::pre_exchange()
{
  announce_exchange();    // migration carries the table
  if (next_reneighbor != update->ntimestep) return;
  output_step = -1;
  apply.carry_out(events, dying);
  events.clear();
  dying.clear();
}

/* ----------------------------------------------------------------------
   the box and its division among the ranks may change at any rebuild, and so may the clusters
------------------------------------------------------------------------- */

void FixClusterBreakMerge::pre_neighbor()
{
  const std::string me = fmt::format("Fix {} {}", style, id);
  SceneChecks(lmp, this, me, settings).check_part_of_box();
  const std::vector<int> mine = arrivals.newcomers();
  if (!halo.anywhere(!mine.empty())) return;
  pairs.check_cutoff(me, groupbit, settings.kinds.largest_diameter());
  arrivals.welcome(mine, halo);
  output_step = -1;
}

void FixClusterBreakMerge::leaving(int i)
{
  arrivals.note_leaving(i);
  output_step = -1;
}

void FixClusterBreakMerge::arrived(int i)
{
  arrivals.note_arrived(i);
}
