/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// What atoms of LAMMPS carry: temperature, charge, and the columns of fix property/atom.

#include "carried_values.h"

#include "atom.h"

using namespace LAMMPS_NS;

/* ---------------------------------------------------------------------- */

void CarriedValues::init(const std::string &me, Requirements &all)
{
  columns.clear();
  Atom *a = atom;
  if (atom->temperature_flag) add("temperature", CarryRule::MEAN, [a](int i) { return &a->temperature[i]; });
  if (atom->q_flag) add("q", CarryRule::SPLIT, [a](int i) { return &a->q[i]; });
  for (const CarrySetting &said : settings.carry) add_named(said, me, all);
}

/* ----------------------------------------------------------------------
   d_NAME, d2_NAME (all of its columns), i_NAME and i2_NAME of fix property/atom
------------------------------------------------------------------------- */

void CarriedValues::add_named(const CarrySetting &said, const std::string &me, Requirements &all)
{
  if ((said.name == "temperature" && atom->temperature_flag) || (said.name == "q" && atom->q_flag)) return;
  const std::size_t bar = said.name.find('_');
  const std::string kind = said.name.substr(0, bar);
  int real = -1, wide = -1;
  const bool named = bar != std::string::npos && (kind == "d" || kind == "d2" || kind == "i" || kind == "i2");
  const int index = named ? atom->find_custom(said.name.substr(bar + 1).c_str(), real, wide) : -1;
  if (index < 0 || real != (kind[0] == 'd') || (wide > 0) != (kind.size() == 2)) {
    all.unmet(fmt::format(
        "{}: carry {}: there is no such value per atom (temperature, q, or i_NAME, d_NAME, i2_NAME, d2_NAME "
        "of fix property/atom)",
        me, said.name));
    return;
  }
  if (!real) {
    all.unmet_if(
        said.rule != CarryRule::COPY,
        fmt::format("{}: carry {}: an integer can be copied, not divided, summed up or averaged", me, said.name));
    return;
  }
  Atom *a = atom;
  if (!wide) columns.push_back({said.rule, [a, index](int i) { return &a->dvector[index][i]; }});
  for (int column = 0; column < wide; column++)
    columns.push_back({said.rule, [a, index, column](int i) { return &a->darray[index][i][column]; }});
}
