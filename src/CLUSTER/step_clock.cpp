/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#include "step_clock.h"

#include "fix.h"
#include "force.h"
#include "modify.h"
#include "output.h"
#include "pair.h"
#include "update.h"

using namespace LAMMPS_NS;

void StepClock::pass(bigint step)
{
  if (update->atimestep >= step) return;
  update->atime += (step - update->atimestep) * update->dt;
  update->atimestep = step;
}

/* ---------------------------------------------------------------------- */

void StepClock::set(double dt)
{
  if (dt == update->dt) return;
  pass(update->ntimestep - 1);
  update->dt = dt;
  update->dt_default = 0;
  if (force->pair) force->pair->reset_dt();
  for (const auto &fix : modify->get_fix_list()) fix->reset_dt();
  output->reset_dt();
}

/* ---------------------------------------------------------------------- */

void StepClock::take_back()
{
  pass(update->ntimestep - 1);
  update->atimestep = update->ntimestep;
}

/* ---------------------------------------------------------------------- */

void StepClock::stand_at(bigint step)
{
  pass(step);
  update->ntimestep = step;
}
