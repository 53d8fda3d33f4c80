/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#include "requirements.h"

#include "comm.h"
#include "error.h"

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
