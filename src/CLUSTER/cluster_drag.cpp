/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#include "cluster_drag.h"

#include "style_arguments.h"

#include "model/cluster_kinds.h"
#include "model/drag_table.h"

#include "error.h"

using namespace LAMMPS_NS;
using namespace ClusterDEM;

/* ---------------------------------------------------------------------- */

ClusterDrag::ClusterDrag(LAMMPS *lmp) :
    EnginePointers(lmp), law(std::make_unique<TranCongDrag>(0.8, 1.1)), name("trancong"), local(lmp),
    constant_voidage(1.0), pressure(false), acts_along{true, true, true}, unshielded(0.0), particle_d(0.0),
    particle_mass(0.0), particle_given(false)
{
}

/* ---------------------------------------------------------------------- */

void ClusterDrag::parse_law(StyleArguments &args)
{
  name = args.word("law NAME");
  local.forget();    // the keyword may be given twice
  constant_voidage = 1.0;
  std::string known;
  for (const auto &entry : drag_laws()) {
    known += (known.empty() ? "" : " | ") + std::string(entry.name);
    if (name != entry.name) continue;
    std::vector<double> values;
    for (const auto &parameter : entry.parameters) {
      const std::string what = fmt::format("law {} {}", name, parameter.name);
      if (parameter.voidage && args.next_is("cells")) {
        args.word(what);
        local.parse(args);
        values.push_back(parameter.hi);
        continue;
      }
      const std::string rule = fmt::format("a number > {} and <= {}{}", parameter.lo, parameter.hi,
                                           parameter.voidage ? ", or cells nx ny nz" : "");
      const double x = args.number(what, rule);
      if (!(x > parameter.lo && x <= parameter.hi)) args.refuse(what, rule);
      values.push_back(x);
      if (parameter.voidage) constant_voidage = x;
    }
    law = entry.make(values.data());
    return;
  }
  args.refuse("law", known);
}

void ClusterDrag::parse_plane(StyleArguments &args)
{
  const int left_out = 2 - args.choice("plane", {"xy", "xz", "yz"});
  for (int k = 0; k < 3; k++) acts_along[k] = k != left_out;
}

void ClusterDrag::parse_unshielded(StyleArguments &args)
{
  unshielded = args.within("unshielded", 0.0, 1.0);
}

void ClusterDrag::parse_particle(StyleArguments &args)
{
  particle_d = args.positive("particle d_p", "length");
  const double rho_p = args.positive("particle rho_p", "mass/volume");
  particle_mass = ClusterGeometry{particle_d, rho_p}.particle_mass();
  particle_given = true;
}

void ClusterDrag::parse_pressure(StyleArguments &args)
{
  pressure = args.yes("pressure");
}

// the table is of one voidage
void ClusterDrag::settle(bool table_of_law, ClusterTable &table, const std::string &me)
{
  if (pressure && !dynamic_cast<const VoidageLaw *>(law.get()))
    error->all(FLERR, "{}: pressure yes needs a law with a voidage, which law {} has not", me, name);
  local.add_columns(table);
  if (table_of_law && !local.any()) law = std::make_unique<DragTable>(std::move(law));
}

/* ---------------------------------------------------------------------- */

void ClusterDrag::init(const std::string &me, Fix *owner)
{
  local.make_cells(owner);
  if (unshielded > 0.0 && !particle_given) find_primary_particle(me);
}

/* ----------------------------------------------------------------------
   unshielded drag counts primary particles: given by keyword, or as the size law has them
------------------------------------------------------------------------- */

void ClusterDrag::find_primary_particle(const std::string &me)
{
  const auto sizes = find_fixes(lmp, "^cluster/breakmerge");
  if (sizes.empty())
    error->all(FLERR,
               "{}: unshielded {} needs the primary particle: define a fix cluster/breakmerge "
               "or give the keyword particle d_p rho_p",
               me, unshielded);
  const ClusterKinds &kinds = dynamic_cast<const KnowsClusterKinds *>(sizes[0])->cluster_kinds();
  if (kinds.count() > 1)
    error->all(FLERR,
               "{}: unshielded {} knows one kind of primary particle only, but fix {} {} has several: use "
               "unshielded 0 or give the keyword particle d_p rho_p",
               me, unshielded, sizes[0]->style, sizes[0]->id);
  particle_d = kinds.kind(0).d_p;
  particle_mass = kinds.kind(0).particle_mass();
}
