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
    largest(lmp, settings.kinds, groupbit), tags(lmp),
    arrivals(lmp, settings.kinds, columns, tags, census, groupbit),
    check(lmp, settings, columns, pairs, census, halo, groupbit),
    apply(lmp, settings.kinds, columns, tags, check.carried()), output{}, output_step(-1), resumed_from_0_1(false),
    resumed_from_other_test(false)
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
  pergrid_flag = settings.size.cells_given;    // fix balance tells whoever has a grid
  dynamic_group_allow = 0;
  check_scene();

  use_hash_map(atom, domain);    // newborns find room and partners through it

  columns.count = &table.add<int>(ClusterTable::CARRIED);
  columns.seen = &table.add<tagint>(ClusterTable::KEPT);    // IDs may be given anew after a restart, too
  columns.shown = shown = &table.add_shown(ClusterColumns::NCOLUMNS);
  if (settings.event.test == EventSettings::CONTACT_ENDED)
    columns.partners = &table.add_lists<tagint>(ClusterTable::KEPT);
  if (settings.event.test != EventSettings::ALWAYS) columns.postponed = &table.add<int>(ClusterTable::KEPT);
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
  Requirements all(lmp, me);
  if (force->pair == nullptr) error->all(FLERR, "{} must be defined after the pair_style command", me);
  arrivals.init(me);
  arrivals.check_all();
  scene.check_engine(all);
  scene.check_order(all);
  scene.check_foreign(all);
  scene.check_gravity(all);
  scene.check_groups(all);
  scene.check_plane(all);
  scene.check_room(all);
  scene.check_lattice(all);
  pairs.find(me, settings.looks_at_contacts());
  largest.find();
  check_cutoffs(all);
  check.init(me, all);
  all.refuse();
  check.make_lattices();
  apply.init();
  if (settings.looks_at_contacts()) pairs.expect_contacts(settings.next_check(update->ntimestep));
  scene.check_step(all, pairs.stiffest(groupbit, settings.kinds.kind(0).diameter(settings.kinds.limits.lo)));
}

// of contacts and of ghosts, for the atoms that there are now

void FixClusterBreakMerge::check_cutoffs(Requirements &all)
{
  const std::string me = fmt::format("Fix {} {}", style, id);
  const std::string fault = pairs.short_cutoff(me, largest);
  all.unmet_if(!fault.empty(), fault);
  SceneChecks(lmp, this, me, settings).check_ghosts(all, largest);
}

/* ----------------------------------------------------------------------
   at the start of every run
------------------------------------------------------------------------- */

void FixClusterBreakMerge::setup_pre_exchange()
{
  arrivals.at_start_of_run();
  sort_dumps_in_earnest(lmp);
  SceneChecks(lmp, this, fmt::format("Fix {} {}", style, id), settings).check_part_of_box();
}

// outputs of the first step; no event happens here

void FixClusterBreakMerge::setup(int)
{
  check.make_cells(this);
  measure();
  arrivals.know_all();    // LIGGGHTS clears what fixes keep per atom after setup_pre_exchange()
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
  check.forget();
  if (update->ntimestep % settings.event.every) return;

  // clusters have moved, their ghosts have not
  if (settings.looks_at_contacts()) comm->forward_comm();
  measure();
  if (settings.looks_at_contacts()) pairs.expect_contacts(settings.next_check(update->ntimestep));
  if (check.plan(update->ntimestep)) next_reneighbor = update->ntimestep;
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
  check.measure();
}

/* ---------------------------------------------------------------------- */

void FixClusterBreakMerge::pre_exchange()
{
  announce_exchange();    // migration carries the table
  if (next_reneighbor != update->ntimestep) return;
  output_step = -1;
  apply.carry_out(check.events(), check.dying());
  sort_dumps_in_earnest(lmp);
  check.forget();
}

/* ----------------------------------------------------------------------
   the box and its division among the ranks may change at any rebuild, and so may the clusters
------------------------------------------------------------------------- */

void FixClusterBreakMerge::pre_neighbor()
{
  const std::string me = fmt::format("Fix {} {}", style, id);
  SceneChecks(lmp, this, me, settings).check_part_of_box();
  if (largest.find()) {
    Requirements all(lmp, me);
    check_cutoffs(all);
    all.refuse();
  }
  const std::vector<int> mine = arrivals.newcomers();
  if (!halo.anywhere(!mine.empty())) return;
  arrivals.welcome(mine, halo);
  sort_dumps_in_earnest(lmp);
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
