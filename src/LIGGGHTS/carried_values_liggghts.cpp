/* ----------------------------------------------------------------------
   Cluster DEM for LIGGGHTS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// What particles of LIGGGHTS carry: scalars of fix property/atom, such as Temp of fix heat/gran.

#include "carried_values.h"

using namespace LAMMPS_NS;

/* ---------------------------------------------------------------------- */

void CarriedValues::init(const std::string &me, Requirements &all)
{
  columns.clear();
  Fix *temperature = find_fix(lmp, "Temp");
  if (temperature) add("Temp", CarryRule::MEAN, [temperature](int i) { return &temperature->vector_atom[i]; });
  for (const CarrySetting &said : settings.carry) add_named(said, me, all);
}

void CarriedValues::add_named(const CarrySetting &said, const std::string &me, Requirements &all)
{
  Fix *property = find_fix(lmp, said.name);
  if (said.name == "Temp" && property) return;
  if (!property || !utils::strmatch(property->style, "^property/atom") || property->size_peratom_cols)
    all.unmet(fmt::format("{}: carry {}: there is no fix property/atom of one value per particle with this ID", me,
                          said.name));
  else columns.push_back({said.rule, [property](int i) { return &property->vector_atom[i]; }});
}
