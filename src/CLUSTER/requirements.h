/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// What a scene does not meet, told together in one refusal.

#ifndef LMP_REQUIREMENTS_H
#define LMP_REQUIREMENTS_H

#include "engine.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {

class Requirements : protected EnginePointers {
 public:
  Requirements(class LAMMPS *lmp, const std::string &fix) : EnginePointers(lmp), me(fix) {}

  // whole messages, the same on all ranks
  void unmet(const std::string &message) { messages.push_back(message); }
  void unmet_if(bool fault, const std::string &message)
  {
    if (fault) unmet(message);
  }
  void warn(const std::string &message) const;
  void refuse() const;    // stops with an error if anything is not met

 private:
  const std::string me;
  std::vector<std::string> messages;
};

// units in which a force is mass times acceleration; what is said of others, or nothing
std::string foreign_units(class LAMMPS *, const std::string &fix);

}    // namespace LAMMPS_NS
#endif
