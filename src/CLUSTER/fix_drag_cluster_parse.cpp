/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// What the words of the command mean.

#include "fix_drag_cluster.h"

#include "gas_frames.h"
#include "style_arguments.h"

#include "comm.h"
#include "error.h"
#include "text_file_reader.h"

using namespace LAMMPS_NS;
using namespace ClusterDEM;

static constexpr double MOST_CELLS = 1.0e15;    // they are numbered by 64 bits, and stored nowhere

/* ---------------------------------------------------------------------- */

void FixDragCluster::parse_velocity(StyleArguments &args)
{
  const char *names[3] = {"velocity ux", "velocity uy", "velocity uz"};
  for (int k = 0; k < 3; k++) {
    velocity[k] = Component();
    if (args.more() && args.peek().rfind("v_", 0) == 0) velocity[k].variable = args.word(names[k]).substr(2);
    else velocity[k].value = args.number(names[k], "a finite number or v_name [velocity]");
  }
}

/* ---------------------------------------------------------------------- */

void FixDragCluster::parse_fluctuation(StyleArguments &args)
{
  for (double &a : amplitude) {
    a = args.number("fluctuation amplitude", "a number >= 0 [velocity]");
    if (a < 0.0) args.refuse("fluctuation amplitude", "a number >= 0 [velocity]");
  }
  fluctuation = args.choice("fluctuation", {"cell", "own"}) == 0 ? PER_CELL : OWN;
  if (fluctuation == PER_CELL) {
    double all = 1.0;
    for (int &n : cells) all *= n = args.integer("fluctuation cell count", 1);
    if (all > MOST_CELLS)
      args.refuse("fluctuation cell count", fmt::format("at most {:.1g} cells in all", MOST_CELLS));
  }
  if (args.next_is("frozen")) {
    args.word("PERIOD");
    period = 0.0;
  } else {
    period = args.number("fluctuation PERIOD", "frozen or a time > 0");
    if (!(period > 0.0)) args.refuse("fluctuation PERIOD", "frozen or a time > 0");
  }
  seed = args.integer("fluctuation SEED", 1);
}

/* ---------------------------------------------------------------------- */

void FixDragCluster::parse_law(StyleArguments &args)
{
  const std::string name = args.word("law NAME");
  std::string known;
  for (const auto &entry : drag_laws()) {
    known += (known.empty() ? "" : " | ") + std::string(entry.name);
    if (name != entry.name) continue;
    std::vector<double> values;
    for (const auto &parameter : entry.parameters) {
      const std::string what = fmt::format("law {} {}", name, parameter.name);
      const std::string rule = fmt::format("a number > {} and <= {}", parameter.lo, parameter.hi);
      const double x = args.number(what, rule);
      if (!(x > parameter.lo && x <= parameter.hi)) args.refuse(what, rule);
      values.push_back(x);
    }
    law = entry.make(values.data());
    return;
  }
  args.refuse("law", known);
}

/* ---------------------------------------------------------------------- */

void FixDragCluster::parse_plane(StyleArguments &args)
{
  const int left_out = 2 - args.choice("plane", {"xy", "xz", "yz"});
  for (int k = 0; k < 3; k++) acts_along[k] = k != left_out;
}

/* ----------------------------------------------------------------------
   columns: position along the axis, ux, uy, uz; # starts a comment
------------------------------------------------------------------------- */

void FixDragCluster::parse_profile(StyleArguments &args)
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

void FixDragCluster::parse_field(StyleArguments &args)
{
  const std::string file = args.word("field FILE");
  field = std::make_unique<GasFrames>(lmp, fmt::format("Fix {} {}", style, id), file, args.caret());
  while (args.next_is("edge") || args.next_is("loop")) {
    if (args.word("keyword") == "edge") {
      const int axis = args.choice("field edge axis", {"x", "y", "z"});
      field->set_edge(
          axis, args.choice("field edge", {"periodic", "clamp"}) == 0 ? GasFrames::PERIODIC : GasFrames::CLAMP);
    } else {
      const double period = args.positive("field loop PERIOD", "time");
      field->set_period(period, args.caret());
    }
  }
}
