/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#include "gas_fluctuation.h"

#include "style_arguments.h"

#include "atom.h"
#include "domain.h"

using namespace LAMMPS_NS;
using namespace ClusterDEM;

static constexpr double MOST_CELLS = 1.0e15;    // they are numbered by 64 bits, and stored nowhere

/* ---------------------------------------------------------------------- */

void GasFluctuation::parse(StyleArguments &args)
{
  for (double &a : amplitude) {
    a = args.number("fluctuation amplitude", "a number >= 0 [velocity]");
    if (a < 0.0) args.refuse("fluctuation amplitude", "a number >= 0 [velocity]");
  }
  kind = args.choice("fluctuation", {"cell", "own"}) == 0 ? PER_CELL : OWN;
  if (kind == PER_CELL) {
    double all = 1.0;
    for (int &n : cells) all *= n = args.integer("fluctuation cell count", 1);
    if (all > MOST_CELLS)
      args.refuse("fluctuation cell count", fmt::format("at most {:.1g} cells in all", MOST_CELLS));
  }
  if (args.next_is("frozen")) {
    args.word("PERIOD");
    period = 0.0;
  } else {
    period = args.number("fluctuation PERIOD", "frozen or a time > 0");
    if (!(period > 0.0)) args.refuse("fluctuation PERIOD", "frozen or a time > 0");
  }
  seed = args.integer("fluctuation SEED", 1);
}

/* ---------------------------------------------------------------------- */

void GasFluctuation::add_columns(ClusterTable &table)
{
  if (any()) cached = &table.add<Cached>(ClusterTable::SCRATCH);
  if (of_clusters()) drawn = &table.add<Drawn>(ClusterTable::KEPT);
}

void GasFluctuation::resume(int i, int draw)
{
  if (drawn) (*drawn)[i] = {atom->rmass[i], draw};
}

/* ---------------------------------------------------------------------- */

void GasFluctuation::prepare(double t)
{
  period_now = period_index(t, period);
  for (int k = 0; k < 3; k++) inverse_length[k] = 1.0 / domain->prd[k];
}

const Vec3 &GasFluctuation::factors(int i)
{
  Cached &here = (*cached)[i];
  int64_t a, b = 0;
  if (kind == PER_CELL) {
    const double *x = atom->x[i];
    a = 0;
    for (int k = 2; k >= 0; k--)
      a = a * cells[k] + cell_index((x[k] - domain->boxlo[k]) * inverse_length[k], cells[k]);
  } else {
    Drawn &mine = (*drawn)[i];
    if (mine.mass != atom->rmass[i]) {
      if (mine.mass > 0.0) mine.number++;
      mine.mass = atom->rmass[i];
    }
    a = atom->tag[i];
    b = mine.number;
  }
  if (here.a != a || here.b != b || here.period != period_now) {
    here.a = a;
    here.b = b;
    here.period = period_now;
    here.unit = kind == PER_CELL ? cell_fluctuation(seed, a, period_now) : own_fluctuation(seed, a, b, period_now);
  }
  return here.unit;
}
