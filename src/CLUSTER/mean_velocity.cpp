/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#include "mean_velocity.h"

#include "style_arguments.h"

#include "error.h"
#include "input.h"
#include "update.h"
#include "variable.h"

#include <cmath>

using namespace LAMMPS_NS;

/* ---------------------------------------------------------------------- */

void MeanVelocity::parse(StyleArguments &args)
{
  const char *names[3] = {"velocity ux", "velocity uy", "velocity uz"};
  for (int k = 0; k < 3; k++) {
    components[k] = Component();
    if (args.more() && args.peek().rfind("v_", 0) == 0) components[k].variable = args.word(names[k]).substr(2);
    else components[k].value = args.number(names[k], "a finite number or v_name [velocity]");
  }
}

/* ----------------------------------------------------------------------
   which variables are atom-style is known at the start of a run only
------------------------------------------------------------------------- */

void MeanVelocity::add_columns(ClusterTable &table)
{
  bool any = false;
  for (const auto &c : components) any = any || !c.variable.empty();
  if (any) of_atoms = &table.add<ClusterDEM::Vec3>(ClusterTable::CARRIED);
}

// "Fix drag/cluster ID" after the first word of a sentence
static std::string in_sentence(std::string me)
{
  me[0] = 'f';
  return me;
}

void MeanVelocity::init(const std::string &me)
{
  fresh = false;
  for (auto &c : components) {
    if (c.variable.empty()) continue;
    c.index = input->variable->find(c.variable.data());
    if (c.index < 0) error->all(FLERR, "Variable {} for {} does not exist", c.variable, in_sentence(me));
    c.per_atom = input->variable->atomstyle(c.index);
    if (!c.per_atom && !input->variable->equalstyle(c.index))
      error->all(FLERR, "Variable {} for {} must be equal-style or atom-style", c.variable, in_sentence(me));
  }
}

/* ---------------------------------------------------------------------- */

bool MeanVelocity::any_variable() const
{
  for (const auto &c : components)
    if (c.index >= 0) return true;
  return false;
}

void MeanVelocity::evaluate(const std::string &me, int igroup)
{
  if (!any_variable()) return;
  fresh = true;
  modify->clearstep_compute();
  for (int k = 0; k < 3; k++) {
    Component &c = components[k];
    if (c.index < 0) continue;
    if (c.per_atom) {
      input->variable->compute_atom(c.index, igroup, &(*of_atoms)[0][k], 3, 0);
      continue;
    }
    c.value = input->variable->compute_equal(c.index);
    if (!std::isfinite(c.value))
      error->all(FLERR, "{}: variable {} gave {} at step {}: the gas velocity must be finite", me, c.variable,
                 c.value, update->ntimestep);
  }
  ask_for_next_step();
}

void MeanVelocity::evaluate_if_never(const std::string &me, int igroup)
{
  if (!fresh) evaluate(me, igroup);
}

void MeanVelocity::ask_for_next_step() const
{
  if (any_variable()) modify->addstep_compute(update->ntimestep + 1);
}
