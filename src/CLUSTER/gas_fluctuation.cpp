/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#include "gas_fluctuation.h"

#include "style_arguments.h"

#include "atom.h"
#include "domain.h"

#include <cstring>

using namespace LAMMPS_NS;
using namespace ClusterDEM;

static constexpr int MOST_GUSTS =
    1000;    // of a cluster from one look to the next: more would not be told from new ones
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
  parse_period(args);
  seed = args.integer("fluctuation SEED", 1);
  while (args.next_is("stagger") || args.next_is("exponential")) {
    if (args.word("option") == "stagger") {
      staggered = true;
      if (period == 0.0 && !eddies) args.refuse("fluctuation option", "left out where PERIOD is frozen");
    } else {
      lifetimes = Lifetimes::EXPONENTIAL;
      if (!eddies) args.refuse("fluctuation option", "left out unless PERIOD is field");
    }
  }
}

void GasFluctuation::parse_period(StyleArguments &args)
{
  const std::string rule = kind == OWN ? "frozen, field or a time > 0" : "frozen or a time > 0";
  period = 0.0;
  eddies = kind == OWN && args.next_is("field");
  if (eddies || args.next_is("frozen")) {
    args.word("PERIOD");
    return;
  }
  period = args.number("fluctuation PERIOD", rule);
  if (!(period > 0.0)) args.refuse("fluctuation PERIOD", rule);
}

/* ---------------------------------------------------------------------- */

void GasFluctuation::add_columns(ClusterTable &table)
{
  if (any()) cached = &table.add<Cached>(ClusterTable::SCRATCH);
  if (of_clusters()) drawn = &table.add<Drawn>(ClusterTable::KEPT);
  if (of_eddies()) clocks = &table.add<EddyClock>(ClusterTable::KEPT);
}

/* ----------------------------------------------------------------------
   Version 0.1 wrote the draw number alone. A file whose gusts had no clocks is read as if the first eddies began at time 0;
   clocks of a file are left where the gusts have none.
------------------------------------------------------------------------- */

bool GasFluctuation::resume(int i, const double *from, int n)
{
  static constexpr int OF_0_1 = 1, WITHOUT_CLOCK = 2, WITH_CLOCK = 4;
  if (!drawn || n == (clocks ? WITH_CLOCK : WITHOUT_CLOCK)) return false;
  Drawn &mine = (*drawn)[i];
  if (n == OF_0_1) {
    memcpy(&mine.number, from, sizeof(mine.number));
    mine.mass = atom->rmass[i];
  } else if (n == WITHOUT_CLOCK || n == WITH_CLOCK) {
    memcpy(static_cast<void *>(&mine), from, sizeof(mine));
    if (clocks) (*clocks)[i].gust = -1;    // so that gust 0 begins at time 0
  }
  return true;
}

/* ---------------------------------------------------------------------- */

void GasFluctuation::prepare(double t)
{
  now = t;
  for (int k = 0; k < 3; k++) inverse_length[k] = 1.0 / domain->prd[k];
}

const Vec3 &GasFluctuation::factors(int i)
{
  if (kind == OWN) {
    draw_anew(i);
    const int64_t tag = atom->tag[i];
    return drawn_as(i, tag, (*drawn)[i].number, period_of(tag));
  }
  const double *x = atom->x[i];
  int64_t cell = 0;
  for (int k = 2; k >= 0; k--)
    cell = cell * cells[k] + cell_index((x[k] - domain->boxlo[k]) * inverse_length[k], cells[k]);
  return drawn_as(i, cell, 0, period_of(cell));
}

/* ----------------------------------------------------------------------
   Gusts that ended since the last look are gone through one by one, so that it does not matter how often anybody looks.
------------------------------------------------------------------------- */

const Vec3 &GasFluctuation::factors(int i, const EddyHere &here)
{
  const Change change = draw_anew(i);
  const int64_t tag = atom->tag[i], draw = (*drawn)[i].number;
  EddyClock &clock = (*clocks)[i];
  auto lasts = [&]() {
    return lifetime_share(lifetimes, seed, tag, draw, clock.gust) *
        here.lifetime(drawn_as(i, tag, draw, clock.gust));
  };
  if (change != NONE_SINCE) {
    clock.gust = 0;
    const bool in_the_midst = change == FIRST && staggered && lifetimes == Lifetimes::FIXED;
    clock.ends = now + (in_the_midst ? phase(seed, tag) * lasts() : lasts());
  }
  for (int k = 0; now > clock.ends + 1.0e-6 * here.period; k++) {
    if (k == MOST_GUSTS) clock.ends = now;
    clock.gust++;
    clock.ends += lasts();
  }
  return drawn_as(i, tag, draw, clock.gust);
}

/* ----------------------------------------------------------------------
   a cluster that is another one than at the last look draws anew
------------------------------------------------------------------------- */

GasFluctuation::Change GasFluctuation::draw_anew(int i)
{
  Drawn &mine = (*drawn)[i];
  if (mine.mass == atom->rmass[i]) return NONE_SINCE;
  const Change change = mine.mass > 0.0 ? ANOTHER : FIRST;
  if (change == ANOTHER) mine.number++;
  mine.mass = atom->rmass[i];
  return change;
}

// each cell or cluster has a phase of its own if staggered
int64_t GasFluctuation::period_of(int64_t key) const
{
  return period_index(staggered ? now + phase(seed, key) * period : now, period);
}

const Vec3 &GasFluctuation::drawn_as(int i, int64_t a, int64_t b, int64_t number)
{
  Cached &here = (*cached)[i];
  if (here.a != a || here.b != b || here.period != number) {
    here.a = a;
    here.b = b;
    here.period = number;
    here.unit = kind == PER_CELL ? cell_fluctuation(seed, a, number) : own_fluctuation(seed, a, b, number);
  }
  return here.unit;
}
