/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#include "gas_frames.h"

#include "error.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

using namespace LAMMPS_NS;
using namespace ClusterDEM;

/* ---------------------------------------------------------------------- */

GasFrames::GasFrames(LAMMPS *lmp, const std::string &fix, const std::string &word, int caret) :
    EnginePointers(lmp), series(lmp, fix, word, caret), edges{AS_THE_BOX, AS_THE_BOX, AS_THE_BOX}, wanted{},
    begin{}, nvalues(0), box{}, mine{}, lo{}, hi{}, before(nullptr), after(nullptr)
{
  for (int q = 0; q < GasFile::QUANTITIES; q++) wanted[q] = series.file(0).has(q);
}

/* ---------------------------------------------------------------------- */

void GasFrames::init()
{
  nvalues = 0;
  for (int q = 0; q < GasFile::QUANTITIES; q++) {
    begin[q] = nvalues;
    if (wanted[q]) nvalues += GasFile::components(q);
  }
  fit_box();
}

void GasFrames::tell() const
{
  if (comm->me) return;
  std::string arrays;
  for (int q = 0; q < GasFile::QUANTITIES; q++)
    if (wanted[q]) arrays += (q ? ", " : "") + std::string(GasFile::name(q));
  const auto &planes = series.planes();
  std::string text = fmt::format("{}: {} x {} x {} points, {}", series.name(), planes[0].size(), planes[1].size(),
                                 planes[2].size(), arrays);
  if (series.frames() > 1)
    text += fmt::format("; {} frames from {} to {}", series.frames(), series.begin(), series.end());
  for (FILE *out : {screen, logfile})
    if (out) fprintf(out, "%s\n", text.c_str());
}

/* ---------------------------------------------------------------------- */

void GasFrames::prepare(double t)
{
  if (outdated(box, domain->boxlo, domain->boxhi)) fit_box();
  if (outdated(mine, domain->sublo, domain->subhi)) fit_part();
  series.warn_outside(t);
  hold(series.at(t));
}

/* ---------------------------------------------------------------------- */

void GasFrames::at(const double *x, double *values)
{
  GridPlace place;
  bool found = find_place(axes, part, x, nvalues, place);
  if (!found && std::isfinite(x[0] + x[1] + x[2])) {
    reach(x);
    found = find_place(axes, part, x, nvalues, place);
  }
  if (!found) {    // of a cluster that is nowhere; whoever asked looks at the sum of the forces
    std::fill(values, values + nvalues, NAN);
    return;
  }
  interpolate(before, place, nvalues, values);
  if (before == after) return;
  double later[MOST_VALUES];
  interpolate(after, place, nvalues, later);
  for (int k = 0; k < nvalues; k++) values[k] = between(values[k], later[k], now.weight);
}

/* ----------------------------------------------------------------------
   the two frames around the present time are held, the later of them for the next interval, too
------------------------------------------------------------------------- */

void GasFrames::hold(const FramePair &pair)
{
  now = pair;
  int slot = held[1].frame == pair.before;
  if (held[slot].frame != pair.before) {
    slot = held[0].frame == pair.after;
    load(held[slot], pair.before);
  }
  before = after = held[slot].values.data();
  if (!(pair.weight > 0.0)) return;
  Held &other = held[1 - slot];
  if (other.frame != pair.after) load(other, pair.after);
  after = other.values.data();
}

/* ---------------------------------------------------------------------- */

void GasFrames::load(Held &into, int frame)
{
  const GasFile &file = series.file(frame);
  into.values.resize(part.points() * nvalues);
  try {
    for (int q = 0; q < GasFile::QUANTITIES; q++) {
      if (!wanted[q]) continue;
      file.read(q, held_planes(), into.values.data() + begin[q], nvalues);
      check_values(file, q, into.values.data() + begin[q]);
    }
    for (int axis = 0; axis < 3; axis++) check_seam(file, axis);
  } catch (std::runtime_error &e) {
    error->one(FLERR, "{}: {}: {}", series.name(), file.path(), e.what());
  }
  into.frame = frame;
}

/* ----------------------------------------------------------------------
   planes of the file that are held, along each axis
------------------------------------------------------------------------- */

std::array<std::vector<int>, 3> GasFrames::held_planes() const
{
  std::array<std::vector<int>, 3> which;
  for (int axis = 0; axis < 3; axis++) {
    const PlaneRange &range = part.range(axis);
    for (int k = 0; k < range.count; k++) which[axis].push_back((range.first + k) % axes[axis].planes());
  }
  return which;
}

/* ---------------------------------------------------------------------- */

void GasFrames::check_values(const GasFile &file, int quantity, const double *values) const
{
  static const char *rules[GasFile::QUANTITIES] = {"finite",         "finite and >= 0", "finite and > 0",
                                                   "finite and > 0", "finite and > 0",  "finite and > 0"};
  const auto which = held_planes();
  for (const int z : which[2])
    for (const int y : which[1])
      for (const int x : which[0]) {
        for (int k = 0; k < GasFile::components(quantity); k++) {
          const double v = values[k];
          const bool good = std::isfinite(v) &&
              (quantity == GasFile::VELOCITY || v > 0.0 || (quantity == GasFile::FLUCTUATION && v == 0.0));
          if (good) continue;
          const auto &planes = *file.planes();
          throw std::runtime_error(fmt::format("array {} is {} at point {} {} {}, position {} {} {} (must be {})",
                                               GasFile::name(quantity), v, x, y, z, planes[0][x], planes[1][y],
                                               planes[2][z], rules[quantity]));
        }
        values += nvalues;
      }
}

/* ----------------------------------------------------------------------
   where the last plane of a periodic axis is the first once more, its values must be
------------------------------------------------------------------------- */

void GasFrames::check_seam(const GasFile &file, int axis) const
{
  auto first = held_planes();
  if (!axes[axis].closed() || std::find(first[axis].begin(), first[axis].end(), 0) == first[axis].end()) return;
  first[axis] = {0};
  auto last = first;
  last[axis] = {axes[axis].planes()};
  const std::size_t points = first[0].size() * first[1].size() * first[2].size();
  for (int q = 0; q < GasFile::QUANTITIES; q++) {
    if (!wanted[q]) continue;
    const int n = GasFile::components(q);
    std::vector<double> a(points * n), b(points * n);
    file.read(q, first, a.data(), n);
    file.read(q, last, b.data(), n);
    double largest = 0.0, worst = 0.0;
    for (std::size_t k = 0; k < a.size(); k++) {
      largest = std::max({largest, std::fabs(a[k]), std::fabs(b[k])});
      worst = std::max(worst, std::fabs(a[k] - b[k]));
    }
    if (!(worst <= 1.0e-6 * largest))    // single precision
      throw std::runtime_error(
          fmt::format("array {} differs by up to {} between the first and the last plane along {}, which are one "
                      "period of the box apart (must be equal; leave out the last plane, or use 'edge {} clamp')",
                      GasFile::name(q), worst, "xyz"[axis], "xyz"[axis]));
  }
}

/* ---------------------------------------------------------------------- */

double GasFrames::bytes() const
{
  double sum = 0.0;
  for (const Held &frame : held) sum += static_cast<double>(frame.values.capacity()) * sizeof(double);
  return sum;
}
