/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#include "step_settings.h"

#include "model/contact_law.h"
#include "style_arguments.h"

#include "model/step_control.h"

using namespace LAMMPS_NS;
using namespace ClusterDEM;

StepSettings::StepSettings(LAMMPS *lmp, int narg, char **arg) : contact_factor(PAPER_CONTACT_SHARE)
{
  StyleArguments args(lmp, narg, arg, 3);
  most = args.positive("DT_MAX", "time");
  while (args.more()) {
    const std::string keyword = args.word("keyword");
    if (keyword == "contact") {
      contact_factor = 0.0;
      if (args.next_is("off")) args.word(keyword);
      else contact_factor = args.positive(keyword, "off, or a share of sqrt(m/k_n)");
    } else if (keyword == "stiffness") stiffness = args.positive(keyword, "force/length");
    else if (keyword == "overlap") overlap_limit = args.within(keyword, 1.0e-6, 1.0e6);
    else if (keyword == "energy") {
      energy_test = !args.next_is("off");
      if (energy_test) tolerance = args.positive(keyword, "off, or a share of the energy");
      else args.word(keyword);
    } else if (keyword == "test") kinetic = args.choice(keyword, {"balance", "kinetic"}) == 1;
    else if (keyword == "floor") {
      floor = args.positive(keyword, "time");
      if (floor > most) args.refuse(keyword, fmt::format("at most DT_MAX = {}", most));
    } else if (keyword == "retries") retries = args.integer(keyword, 1);
    else if (keyword == "predict") predict = args.yes(keyword);
    else args.unknown_keyword();
  }
}
