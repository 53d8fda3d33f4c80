/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#include "requirements.h"

#include "comm.h"
#include "error.h"
#include "force.h"
#include "update.h"

using namespace LAMMPS_NS;

/* ---------------------------------------------------------------------- */

void Requirements::warn(const std::string &message) const
{
  if (comm->me == 0) error->warning(FLERR, message);
}

void Requirements::refuse() const
{
  if (messages.empty()) return;
  std::string text = messages.front();
  if (messages.size() > 1) {
    text = fmt::format("{}: {} requirements are not met:", me, messages.size());
    for (const std::string &message : messages) text += "\n  " + message;
  }
  error->all(FLERR, text);
}

/* ---------------------------------------------------------------------- */

std::string LAMMPS_NS::foreign_units(LAMMPS *lmp, const std::string &fix)
{
  if (lmp->force->ftm2v == 1.0) return "";
  return fmt::format(
      "{} does not support units {}, where a force is not mass times length over time squared: use units si, "
      "cgs, micro, nano or lj",
      fix, lmp->update->unit_style);
}
