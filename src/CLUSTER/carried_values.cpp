/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#include "carried_values.h"

#include "atom.h"
#include "model/merging.h"

using namespace LAMMPS_NS;
using namespace ClusterDEM;

/* ---------------------------------------------------------------------- */

void CarriedValues::add(const std::string &name, CarryRule by_default, const Place &place)
{
  CarryRule rule = by_default;
  for (const CarrySetting &said : settings.carry)
    if (said.name == name) rule = said.rule;
  columns.push_back({rule, place});
}

/* ---------------------------------------------------------------------- */

void CarriedValues::prepare(std::vector<Event> &events, Halo &halo) const
{
  for (const Column &column : columns) {
    if (!sums_up(column.rule) && !is_mean(column.rule)) continue;    // the leading cluster's
    std::vector<double> values(atom->nlocal + atom->nghost);
    for (int i = 0; i < atom->nlocal; i++) values[i] = *column.of(i);
    halo.forward(values);
    for (Event &e : events)
      if (e.merges())
        e.carried.push_back(is_mean(column.rule)
                                ? mass_mean(atom->rmass[e.i], values[e.i], atom->rmass[e.j], values[e.j])
                                : values[e.i] + values[e.j]);
  }
}

void CarriedValues::merge(const Event &e) const
{
  auto value = e.carried.begin();
  for (const Column &column : columns)
    if (sums_up(column.rule) || is_mean(column.rule)) *column.of(e.i) = *value++;
}

/* ----------------------------------------------------------------------
   the parent, which is the first piece, keeps what the others do not take: the sum stays
------------------------------------------------------------------------- */

void CarriedValues::divide(const Event &e, int first) const
{
  for (const Column &column : columns) {
    if (column.rule != CarryRule::SPLIT) continue;
    const double whole = *column.of(e.i);
    double left = whole;
    for (int piece = 1; piece < e.plan.pieces(); piece++) {
      const double share = whole * e.plan.particles(piece) / e.particles;
      *column.of(first + piece - 1) = share;
      left -= share;
    }
    *column.of(e.i) = left;
  }
}
