/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#include "step_scene.h"

#include "angle.h"
#include "atom.h"
#include "bond.h"
#include "dihedral.h"
#include "fix_wall_gran_region.h"
#include "force.h"
#include "improper.h"
#include "kspace.h"
#include "modify.h"
#include "pair_gran_cluster.h"
#include "pair_hybrid.h"
#include "region.h"

using namespace LAMMPS_NS;

// these tell nobody, but let those that inherit from them look
struct WallMotion : FixWallGran {
  static bool wiggles(const FixWallGran &wall) { return wall.*(&WallMotion::wiggle); }
};
struct HybridStyles : PairHybrid {
  static int count(const PairHybrid &hybrid) { return hybrid.*(&HybridStyles::nstyles); }
  static Pair *style(const PairHybrid &hybrid, int k) { return (hybrid.*(&HybridStyles::styles))[k]; }
  static std::string name(const PairHybrid &hybrid, int k) { return (hybrid.*(&HybridStyles::keywords))[k]; }
};

// Integrators whose state is what is put back: positions, velocities, angular velocities.
static bool moves_plainly(const std::string &style)
{
  for (const std::string plain : {"nve", "nve/sphere", "nve/noforce", "nve/limit", "nve/cluster"})
    if (style == plain || style == plain + "/omp") return true;
  return false;
}

/* ---------------------------------------------------------------------- */

static std::string why_unfit(const LAMMPS *lmp, Fix *fix, bool whole_steps)
{
  const std::string style = fix->style;
  if (style == "pour") return "times its insertions for one step: use fix deposit";
  if (style == "move")
    return "places its atoms by step number times time step: give them a velocity, hold it by fix setforce 0 0 0, "
           "and "
           "move them by fix nve";
  if (style == "deform" || style == "deform/pressure")
    return "changes the box by step number, rejected steps included: use a fixed time step";
  if (style == "wall/piston")
    return "places its wall by step number times time step: use fix wall/gran/region with a region moved by "
           "variables of 'time'";
  if (fix->rigid_flag)
    return "keeps the motion of its bodies to itself, and a repeated drift would move them twice";
  if (fix->time_integrate && !moves_plainly(style))
    return "integrates more than positions, velocities and angular velocities, which alone are put back: use fix "
           "nve, "
           "nve/sphere or nve/cluster";
  if (fix->time_integrate && utils::strmatch(style, "^nve/sphere") && lmp->atom->mu_flag)
    return "may turn dipoles, which are not put back: use fix nve, or an atom style without dipoles";
  if (const auto *wall = dynamic_cast<const FixWallGran *>(fix)) {
    if (WallMotion::wiggles(*wall))
      return "wiggles its wall by step number times time step: use fix wall/gran/region with a region moved by "
             "variables of 'time'";
    const auto *round = dynamic_cast<const FixWallGranRegion *>(wall);
    if (whole_steps && round && round->region->dynamic_check())
      return "takes the velocity of its moving region from the step before, which may not have been: use 'energy "
             "off'";
  }
  if (whole_steps && style == "heat/flow")
    return "integrates temperatures, which are not put back: use 'energy off'";
  return "";
}

std::vector<std::string> LAMMPS_NS::unfit_fixes(LAMMPS *lmp, bool whole_steps)
{
  std::vector<std::string> found;
  for (const auto &fix : lmp->modify->get_fix_list()) {
    const std::string why = why_unfit(lmp, fix, whole_steps);
    if (!why.empty()) found.push_back(fmt::format("fix {} ({}), which {}", fix->id, fix->style, why));
  }
  return found;
}

/* ---------------------------------------------------------------------- */

std::vector<std::string> LAMMPS_NS::other_forces(LAMMPS *lmp)
{
  const Force *force = lmp->force;
  std::vector<std::string> found;
  auto pair_style = [&](const Pair *pair, const std::string &name) {
    if (!dynamic_cast<const PairGranCluster *>(pair) && name != "zero") found.push_back("pair style " + name);
  };
  if (const auto *hybrid = dynamic_cast<const PairHybrid *>(force->pair))
    for (int k = 0; k < HybridStyles::count(*hybrid); k++)
      pair_style(HybridStyles::style(*hybrid, k), HybridStyles::name(*hybrid, k));
  else pair_style(force->pair, force->pair_style);
  if (force->bond) found.push_back("bond style " + std::string(force->bond_style));
  if (force->angle) found.push_back("angle style " + std::string(force->angle_style));
  if (force->dihedral) found.push_back("dihedral style " + std::string(force->dihedral_style));
  if (force->improper) found.push_back("improper style " + std::string(force->improper_style));
  if (force->kspace) found.push_back("kspace style " + std::string(force->kspace_style));
  return found;
}
