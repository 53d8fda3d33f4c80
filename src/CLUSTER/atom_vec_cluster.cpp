/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#include "atom_vec_cluster.h"

#include "atom.h"
#include "error.h"
#include "fix.h"
#include "math_const.h"
#include "modify.h"

using namespace LAMMPS_NS;

static double sphere_volume(double radius)
{
  return 4.0 / 3.0 * MathConst::MY_PI * radius * radius * radius;
}

/* ---------------------------------------------------------------------- */

AtomVecCluster::AtomVecCluster(LAMMPS *lmp) :
    AtomVec(lmp), radius(nullptr), rmass(nullptr), radius_kept(0.0), mass_kept(0.0)
{
  mass_type = PER_ATOM;
  molecular = Atom::ATOMIC;
  atom->radius_flag = atom->rmass_flag = 1;

  fields_grow = {"radius", "rmass"};
  fields_copy = fields_border = fields_border_vel = fields_exchange = fields_grow;
  fields_restart = fields_create = fields_grow;
  fields_data_atom = {"id", "type", "radius", "rmass", "x"};
  fields_data_vel = {"id", "v"};
}

/* ---------------------------------------------------------------------- */

void AtomVecCluster::process_args(int narg, char **arg)
{
  if (narg) error->all(FLERR, "Illegal atom_style cluster value: {} (it takes no values)", arg[0]);
  setup_fields();
}

/* ---------------------------------------------------------------------- */

void AtomVecCluster::init()
{
  AtomVec::init();
  for (const auto &fix : modify->get_fix_by_style("^adapt"))
    if (fix->diam_flag)
      error->all(FLERR,
                 "Fix {} {} changes diameters, which atom_style cluster sends to other ranks only when the "
                 "neighbor lists are rebuilt: use atom_style sphere 1",
                 fix->style, fix->id);
}

/* ---------------------------------------------------------------------- */

void AtomVecCluster::grow_pointers()
{
  radius = atom->radius;
  rmass = atom->rmass;
}

/* ---------------------------------------------------------------------- */

void AtomVecCluster::create_atom_post(int i)
{
  radius[i] = 0.5;
  rmass[i] = sphere_volume(0.5);
}

/* ----------------------------------------------------------------------
   data files hold diameter and density; a diameter of 0 is a point with the density as its mass
------------------------------------------------------------------------- */

void AtomVecCluster::data_atom_post(int i)
{
  radius[i] *= 0.5;
  if (radius[i] > 0.0) rmass[i] *= sphere_volume(radius[i]);
  if (rmass[i] <= 0.0) error->one(FLERR, "Invalid density in Atoms section of data file");
}

void AtomVecCluster::pack_data_pre(int i)
{
  radius_kept = radius[i];
  mass_kept = rmass[i];
  if (radius[i] > 0.0) rmass[i] /= sphere_volume(radius[i]);
  radius[i] *= 2.0;
}

void AtomVecCluster::pack_data_post(int i)
{
  radius[i] = radius_kept;
  rmass[i] = mass_kept;
}
