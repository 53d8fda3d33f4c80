/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#include "prescribed_gas.h"

#include "style_arguments.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "text_file_reader.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace ClusterDEM;

/* ---------------------------------------------------------------------- */

void PrescribedGas::parse_properties(StyleArguments &args)
{
  gas.rho = args.positive("rho_g", "mass/volume");
  gas.nu = args.positive("nu_g", "length^2/time");
}

/* ----------------------------------------------------------------------
   columns: position along the axis, ux, uy, uz; # starts a comment
------------------------------------------------------------------------- */

void PrescribedGas::parse_profile(StyleArguments &args, const std::string &style)
{
  const std::string file = args.word("profile FILE");
  const int caret = args.caret();
  profile_axis = args.choice("profile axis", {"x", "y", "z"});

  std::vector<double> rows;
  if (comm->me == 0) {
    int line = 0;
    try {
      TextFileReader reader(file, "gas profile");
      while (char *text = reader.next_line()) {
        line++;
        ValueTokenizer values(text);
        if (values.count() != 4) throw TokenizerException("a row needs 4 numbers: position ux uy uz", text);
        for (int k = 0; k < 4; k++) {
          const double x = values.next_double();
          if (!std::isfinite(x)) throw TokenizerException("a value is not finite", text);
          rows.push_back(x);
        }
        const std::size_t n = rows.size();
        if (n >= 8 && !(rows[n - 4] > rows[n - 8])) throw TokenizerException("positions must ascend", text);
      }
    } catch (std::exception &e) {
      error->one(FLERR, caret, "Fix {}: cannot use gas profile {}, data row {}: {}", style, file, line, e.what());
    }
    if (rows.empty()) error->one(FLERR, caret, "Fix {}: gas profile {} has no data row", style, file);
  }
  int n = static_cast<int>(rows.size());
  MPI_Bcast(&n, 1, MPI_INT, 0, world);
  rows.resize(n);
  MPI_Bcast(rows.data(), n, MPI_DOUBLE, 0, world);
  profile = GasProfile();
  for (int k = 0; k < n; k += 4) {
    profile.s.push_back(rows[k]);
    profile.u.push_back({rows[k + 1], rows[k + 2], rows[k + 3]});
  }
}

/* ----------------------------------------------------------------------
   field FILE [edge axis periodic|clamp] ... [loop PERIOD]
------------------------------------------------------------------------- */

void PrescribedGas::parse_field(StyleArguments &args, const std::string &fix)
{
  const std::string file = args.word("field FILE");
  frames = std::make_unique<GasFrames>(lmp, fix, file, args.caret());
  while (args.next_is("edge") || args.next_is("loop")) {
    if (args.word("keyword") == "edge") {
      const int axis = args.choice("field edge axis", {"x", "y", "z"});
      frames->set_edge(
          axis, args.choice("field edge", {"periodic", "clamp"}) == 0 ? GasFrames::PERIODIC : GasFrames::CLAMP);
    } else {
      const double period = args.positive("field loop PERIOD", "time");
      frames->set_period(period, args.caret());
    }
  }
}

/* ---------------------------------------------------------------------- */

void PrescribedGas::settle(ClusterTable &table, int group, const std::string &fix)
{
  igroup = group;
  if (fluctuation.of_eddies() && !(frames && frames->has(GasFile::PERIOD)))
    error->all(FLERR, "{}: fluctuation PERIOD field needs the keyword field, with an array {} [time] in its file",
               fix, GasFile::name(GasFile::PERIOD));
  if (frames) {
    if (!fluctuation.any()) frames->leave_out(GasFile::FLUCTUATION);
    if (!fluctuation.of_eddies())
      for (const int quantity : {GasFile::PERIOD, GasFile::EDDY_SIZE}) frames->leave_out(quantity);
    frames->tell();
  }
  mean.add_columns(table);
  fluctuation.add_columns(table);
}

void PrescribedGas::init(const std::string &fix)
{
  me = fix;
  mean.init(me);
  if (frames) frames->init();
}

/* ---------------------------------------------------------------------- */

void PrescribedGas::prepare()
{
  const double t = update->atime + (update->ntimestep - update->atimestep) * update->dt;
  if (fluctuation.any()) fluctuation.prepare(t);
  if (frames) frames->prepare(t);
  mean.evaluate_if_never(me, igroup);
}

/* ----------------------------------------------------------------------
   velocity: mean + profile + field + fluctuation
------------------------------------------------------------------------- */

LocalGas PrescribedGas::at(int i)
{
  LocalGas here = {{}, gas};
  Vec3 &u = here.u;
  for (int k = 0; k < 3; k++) u[k] = mean.at(i, k);
  if (profile_axis >= 0) {
    double s = atom->x[i][profile_axis];
    if (domain->periodicity[profile_axis]) {    // a cluster may be just outside until it is wrapped
      if (s < domain->boxlo[profile_axis]) s += domain->prd[profile_axis];
      else if (s >= domain->boxhi[profile_axis]) s -= domain->prd[profile_axis];
    }
    u = u + profile.at(s);
  }
  EddyHere eddy = {INFINITY, INFINITY, {}, fluctuation.amplitudes()};
  Vec3 &a = eddy.amplitude;
  if (frames) {
    double values[GasFrames::MOST_VALUES];
    frames->at(atom->x[i], values);
    u = u + to_vec3(values);
    if (frames->has(GasFile::DENSITY)) here.gas.rho = values[frames->first(GasFile::DENSITY)];
    if (frames->has(GasFile::VISCOSITY)) here.gas.nu = values[frames->first(GasFile::VISCOSITY)];
    if (frames->has(GasFile::FLUCTUATION))
      for (int k = 0; k < 3; k++) a[k] *= values[frames->first(GasFile::FLUCTUATION) + k];
    if (frames->has(GasFile::PERIOD)) eddy.period = values[frames->first(GasFile::PERIOD)];
    if (frames->has(GasFile::EDDY_SIZE)) eddy.size = values[frames->first(GasFile::EDDY_SIZE)];
  }
  if (fluctuation.any()) {
    eddy.slip = u - to_vec3(atom->v[i]);
    const Vec3 &factor = fluctuation.of_eddies() ? fluctuation.factors(i, eddy) : fluctuation.factors(i);
    for (int k = 0; k < 3; k++) u[k] += a[k] * factor[k];
  }
  return here;
}

bool PrescribedGas::uniform_properties() const
{
  return !frames || !(frames->has(GasFile::DENSITY) || frames->has(GasFile::VISCOSITY));
}
