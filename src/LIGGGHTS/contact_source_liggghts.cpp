/* ----------------------------------------------------------------------
   Cluster DEM for LIGGGHTS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// Contacts of LIGGGHTS' pair style gran: the neighbor list tells who touches, the pair style stores the forces.

#include "contact_source.h"

#include "atom.h"
#include "engine.h"
#include "fix_contact_property_atom.h"
#include "fix_property_global.h"
#include "force.h"
#include "model/contact_law.h"
#include "modify.h"
#include "pair_gran.h"

using namespace LAMMPS_NS;
using namespace ClusterDEM;

/* ---------------------------------------------------------------------- */

void ContactSource::find(const std::string &fix, bool looked_at)
{
  ErrorWords words(error);
  pairs.clear();
  auto *gran = dynamic_cast<PairGran *>(force->pair_match("gran", 0));
  if (!gran)
    words.all(FLERR, "{} needs a granular pair style (gran), but the pair style is {}", fix,
              force->pair_style ? force->pair_style : "none");
  if (looked_at && !gran->contact_match("normal", "hooke/stiffness"))
    words.all(FLERR, "{} needs a linear contact: pair_style gran model hooke/stiffness", fix);
  if (force->newton_pair) words.all(FLERR, "{} needs the contacts across ranks on both of them: newton off", fix);
  pairs.push_back(gran);
}

/* ---------------------------------------------------------------------- */

// LIGGGHTS asks for the largest radius itself
std::string ContactSource::short_cutoff(const std::string &, const LargestDiameters &) const
{
  return "";
}

void ContactSource::expect_contacts(bigint) {}

bool ContactSource::take_noted(Pair *)
{
  return false;
}

/* ----------------------------------------------------------------------
   of the last evaluation of forces, which had none for a contact that has only just begun
------------------------------------------------------------------------- */

Vec3 ContactSource::contact_force(const Contact &c) const
{
  FixContactPropertyAtom *forces = static_cast<PairGran *>(c.pair)->fix_contact_forces();
  const int partner = forces->has_partner(c.i, atom->tag[c.j]);
  return partner < 0 ? Vec3{0.0, 0.0, 0.0} : to_vec3(forces->contacthistory(c.i, partner));
}

/* ----------------------------------------------------------------------
   model hooke/stiffness alone: find() takes no other
------------------------------------------------------------------------- */

static double kn(const Atom *atom, Modify *modify, int i, int j)
{
  const int n = atom->ntypes;
  auto *values = modify->find_fix_property("kn", "property/global", "peratomtypepair", n, n, "cluster/breakmerge");
  return static_cast<FixPropertyGlobal *>(values)->compute_array(atom->type[i] - 1, atom->type[j] - 1);
}

// LIGGGHTS has a fix check/timestep/gran of its own
double ContactSource::stiffest(int, double) const
{
  return 0.0;
}

double ContactSource::energy(int i, int j, double radius_i, double distance) const
{
  return linear_energy(kn(atom, modify, i, j), std::max(0.0, radius_i + atom->radius[j] - distance));
}

// of the normal spring: what LIGGGHTS keeps of the tangential one is not looked at
double ContactSource::energy_now(const Contact &c) const
{
  return energy(c.i, c.j, atom->radius[c.i], norm(to_vec3(atom->x[c.i]) - to_vec3(atom->x[c.j])));
}

/* ---------------------------------------------------------------------- */

bool ContactSource::can_bond(const Pair *) const
{
  return false;
}

bool ContactSource::bonded(const Pair *, int, int, int, double) const
{
  return false;
}
