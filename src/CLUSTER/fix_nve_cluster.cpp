/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#include "fix_nve_cluster.h"

#include "four_clusters.h"
#include "held_drag.h"
#include "requirements.h"
#include "style_arguments.h"

#include "atom.h"
#include "error.h"
#include "force.h"
#include "modify.h"
#include "output.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace FixConst;
using namespace ClusterDEM;

/* ---------------------------------------------------------------------- */

FixNVECluster::FixNVECluster(LAMMPS *lmp, int narg, char **arg) :
    FixNVE(lmp, narg, arg), g{0.0, 0.0, 0.0}, falling(false), drag(nullptr), alone(false), postponed(false),
    forces_postponed(false)
{
  if (!atom->rmass_flag)
    error->all(FLERR, "Fix {} requires an atom style with a mass per atom, as cluster and sphere have", style);

  StyleArguments args(lmp, narg, arg, 3);
  while (args.more()) {
    const std::string keyword = args.word("keyword");
    if (keyword == "gravity") {
      const double magnitude = args.number("gravity", "a finite number [acceleration]");
      Vec3 direction;
      for (double &component : direction) component = args.number("gravity direction");
      const double length = norm(direction);
      if (!(length > 0.0)) args.refuse("gravity direction", "one of three numbers that are not all 0");
      g = (magnitude / length) * direction;
      falling = magnitude != 0.0;
    } else if (keyword == "drag") drag_id = args.word("drag fix-ID");
    else args.unknown_keyword();
  }
}

/* ---------------------------------------------------------------------- */

int FixNVECluster::setmask()
{
  return INITIAL_INTEGRATE | POST_FORCE | FINAL_INTEGRATE | POST_RUN;
}

/* ---------------------------------------------------------------------- */

void FixNVECluster::init()
{
  FixNVE::init();
  if (utils::strmatch(update->integrate_style, "^respa"))
    error->all(FLERR, "Fix {} {} does not support run_style respa: use run_style verlet", style, id);

  const std::string units = foreign_units(lmp, fmt::format("Fix {} {}", style, id));
  if (falling && !units.empty()) error->all(FLERR, units);
  drag = nullptr;
  alone = true;
  Fix *dragging = nullptr;
  if (!drag_id.empty()) {
    dragging = modify->get_fix_by_id(drag_id);
    auto *holder = dynamic_cast<HoldsDrag *>(dragging);
    if (!holder) error->all(FLERR, "Fix {} {}: drag {} is not the ID of a fix drag/cluster", style, id, drag_id);
    if (modify->find_fix(drag_id) < modify->find_fix(id))
      error->all(FLERR, "Fix {} {} must be defined before fix drag/cluster {}", style, id, drag_id);
    if (dragging->igroup != igroup)
      error->all(FLERR, "Fix {} {} and fix drag/cluster {} must act on the same group", style, id, drag_id);
    drag = &holder->held_drag();
    alone = !holder->asks_variables();
  }

  observers.clear();
  for (int k = 0; k < modify->nfix; k++) {
    Fix *fix = modify->fix[k];
    const int mask = modify->fmask[k];
    if (fix != this && fix != dragging && (mask & (POST_FORCE | FINAL_INTEGRATE))) alone = false;
    if (mask & END_OF_STEP) observers.push_back(fix);
  }
}

/* ---------------------------------------------------------------------- */

void FixNVECluster::setup(int)
{
  postponed = forces_postponed = false;
  if (falling) add_gravity();
}

/* ----------------------------------------------------------------------
   does anybody look at velocities or forces at the end of this step?
------------------------------------------------------------------------- */

bool FixNVECluster::looked_at(bigint step) const
{
  if (step == output->next || step == update->laststep) return true;
  for (const Fix *fix : observers)
    if (fix->nevery <= 1 || step % fix->nevery == 0) return true;
  return false;
}

/* ---------------------------------------------------------------------- */

void FixNVECluster::add_gravity()
{
  for (int i = 0; i < atom->nlocal; i++)
    if (atom->mask[i] & groupbit)
      for (int k = 0; k < 3; k++) atom->f[i][k] += atom->rmass[i] * g[k];
}

/* ----------------------------------------------------------------------
   drag that is held since an earlier step can wait for the next pass, and gravity with it
------------------------------------------------------------------------- */

void FixNVECluster::post_force(int)
{
  postponed = alone && !looked_at(update->ntimestep);
  forces_postponed = postponed && (!drag || drag->hand_over());
  if (falling && !forces_postponed) add_gravity();
}

/* ---------------------------------------------------------------------- */

void FixNVECluster::final_integrate()
{
  if (!postponed) kick();
}

// not FixNVE's: a compiler may round it otherwise than advance(), and results would hang on what is looked at
void FixNVECluster::kick()
{
  const int nlocal = igroup == atom->firstgroup ? atom->nfirst : atom->nlocal;
  for (int i = 0; i < nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    const double dtfm = dtf / atom->rmass[i];
    for (int k = 0; k < 3; k++) atom->v[i][k] += dtfm * atom->f[i][k];
  }
}

/* ---------------------------------------------------------------------- */

void FixNVECluster::initial_integrate(int)
{
  if (forces_postponed) advance<true, true>();
  else if (postponed) advance<true, false>();
  else advance<false, false>();
  postponed = forces_postponed = false;
}

/* ----------------------------------------------------------------------
   The kicks of velocity Verlet and the drift between them. With END the last step's second kick comes first, with
   FORCES its gravity and held drag too: the same sums in the same order as in passes of their own.
------------------------------------------------------------------------- */

template <bool END, bool FORCES> void FixNVECluster::advance()
{
  const int nlocal = igroup == atom->firstgroup ? atom->nfirst : atom->nlocal;
  if (!nlocal) return;
  double *x = atom->x[0];
  double *v = atom->v[0];
  const double *f = atom->f[0];
  const double *rmass = atom->rmass;
  const int *mask = atom->mask;
  const bool dragged = FORCES && drag;
  const double *u = dragged ? drag->velocity() : nullptr;
  const double *b = dragged ? drag->coefficient() : nullptr;
  const Vec3 along = dragged ? drag->axes() : Vec3{0.0, 0.0, 0.0};

  int i = 0;
#ifdef CLUSTER_PACKS
  const Fourfold g_all(g), along_all(along);
  for (; igroup == 0 && i + 4 <= nlocal; i += 4) {
    const Pack masses = load(rmass + i);
    const Threefold dtfm(dtf / masses), mass(masses), coefficient(dragged ? load(b + i) : Pack{});
    for (int part = 0; part < 3; part++) {
      const int m = 3 * i + 4 * part;
      Pack force = load(f + m), speed = load(v + m);
      if (FORCES) force += mass.part[part] * g_all.part[part];
      if (dragged) force += held_drag(along_all.part[part], coefficient.part[part], load(u + m), speed);
      if (END) speed += dtfm.part[part] * force;
      speed += dtfm.part[part] * force;
      store(v + m, speed);
      store(x + m, load(x + m) + dtv * speed);
    }
  }
#endif
  for (; i < nlocal; i++) {
    if (!(mask[i] & groupbit)) continue;
    const double dtfm = dtf / rmass[i];
    for (int k = 0; k < 3; k++) {
      const int m = 3 * i + k;
      double force = f[m], speed = v[m];
      if (FORCES) force += rmass[i] * g[k];
      if (dragged) force += held_drag(along[k], b[i], u[m], speed);
      if (END) speed += dtfm * force;
      speed += dtfm * force;
      v[m] = speed;
      x[m] += dtv * speed;
    }
  }
}

/* ----------------------------------------------------------------------
   the end of the last step as if it had not been postponed
------------------------------------------------------------------------- */

void FixNVECluster::catch_up()
{
  if (forces_postponed) {
    if (falling) add_gravity();
    if (drag) drag->add();
  }
  if (postponed) kick();
  postponed = forces_postponed = false;
}

void FixNVECluster::post_run()
{
  catch_up();
}

void FixNVECluster::reset_dt()
{
  catch_up();
  FixNVE::reset_dt();
}
