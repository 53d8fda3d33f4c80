/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#include "gas_frames.h"

#include "error.h"
#include "update.h"

#include <glob.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <stdexcept>

using namespace LAMMPS_NS;
using namespace ClusterDEM;

/* ---------------------------------------------------------------------- */

GasFrames::GasFrames(LAMMPS *lmp, const std::string &fix, const std::string &word, int caret) :
    EnginePointers(lmp), me(fix + ": field " + word), period(0.0), edges{AS_THE_BOX, AS_THE_BOX, AS_THE_BOX},
    wanted{}, begin{}, nvalues(0), box{}, mine{}, lo{}, hi{}, before(nullptr), after(nullptr)
{
  if (comm->me == 0) {
    try {
      files = open_all(word);
    } catch (std::runtime_error &e) {
      error->one(FLERR, caret, "{}: {}", me, e.what());
    }
  }
  share(caret);
  for (const GasFile &file : files) times.push_back(file.time());
  for (int q = 0; q < GasFile::QUANTITIES; q++) wanted[q] = files[0].has(q);
}

/* ----------------------------------------------------------------------
   the headers of all files, in the order of their times; one rank reads them
------------------------------------------------------------------------- */

std::vector<GasFile> GasFrames::open_all(const std::string &word) const
{
  std::vector<std::string> paths = {word};
  const bool series = word.find('*') != std::string::npos;
  if (series) {
    glob_t found;
    const bool any = glob(word.c_str(), 0, nullptr, &found) == 0;
    if (any) paths.assign(found.gl_pathv, found.gl_pathv + found.gl_pathc);
    globfree(&found);
    if (!any) throw std::runtime_error("no file has such a name");
  }

  std::vector<GasFile> opened;
  for (const std::string &path : paths) {
    try {
      opened.emplace_back(path);
      const GasFile &file = opened.back();
      if (paths.size() > 1 && !file.has_time())
        throw std::runtime_error("a frame of a series needs its time: FIELD FieldData 1, TIME 1 1 double");
      check_alike(file, opened.front());
    } catch (std::runtime_error &e) {
      throw std::runtime_error(series ? path + ": " + e.what() : e.what());
    }
  }
  std::stable_sort(opened.begin(), opened.end(),
                   [](const GasFile &a, const GasFile &b) { return a.time() < b.time(); });
  for (std::size_t k = 1; k < opened.size(); k++)
    if (!(opened[k].time() > opened[k - 1].time()))
      throw std::runtime_error(fmt::format("{} and {} have the same TIME {}", opened[k - 1].path(),
                                           opened[k].path(), opened[k].time()));
  return opened;
}

/* ----------------------------------------------------------------------
   frames have one grid, to the digits of single precision, and the same arrays
------------------------------------------------------------------------- */

void GasFrames::check_alike(const GasFile &file, const GasFile &first) const
{
  for (int axis = 0; axis < 3; axis++) {
    const auto &a = (*file.planes())[axis], &b = (*first.planes())[axis];
    const double tolerance = 1.0e-6 * (b.back() - b.front());
    bool same = a.size() == b.size();
    for (std::size_t k = 0; same && k < a.size(); k++) same = std::fabs(a[k] - b[k]) <= tolerance;
    if (!same)
      throw std::runtime_error(
          fmt::format("its grid along {} is not that of {}: {} planes from {} to {}, not {} from {} to {}",
                      "xyz"[axis], first.path(), a.size(), a.front(), a.back(), b.size(), b.front(), b.back()));
  }
  for (int q = 0; q < GasFile::QUANTITIES; q++)
    if (file.has(q) != first.has(q))
      throw std::runtime_error(fmt::format("array {} is in {} alone", GasFile::name(q),
                                           file.has(q) ? "this frame, not in " + first.path() : first.path()));
}

/* ----------------------------------------------------------------------
   what one rank has found is told to all
------------------------------------------------------------------------- */

static void broadcast(std::string &text, MPI_Comm world)
{
  int n = static_cast<int>(text.size());
  MPI_Bcast(&n, 1, MPI_INT, 0, world);
  text.resize(n);
  MPI_Bcast(&text[0], n, MPI_CHAR, 0, world);
}

static void broadcast(std::vector<double> &values, MPI_Comm world)
{
  int n = static_cast<int>(values.size());
  MPI_Bcast(&n, 1, MPI_INT, 0, world);
  values.resize(n);
  MPI_Bcast(values.data(), n, MPI_DOUBLE, 0, world);
}

void GasFrames::share(int caret)
{
  GasFile::Planes planes;
  if (comm->me == 0) planes = *files[0].planes();
  for (auto &along : planes) broadcast(along, world);
  const auto shared = std::make_shared<const GasFile::Planes>(std::move(planes));

  int n = static_cast<int>(files.size());
  MPI_Bcast(&n, 1, MPI_INT, 0, world);
  std::vector<GasFile> all;
  for (int k = 0; k < n; k++) {
    std::string packed = comm->me == 0 ? files[k].packed() : "";
    broadcast(packed, world);
    all.emplace_back(packed, shared);
  }
  files.swap(all);
  check_units(caret);
}

/* ----------------------------------------------------------------------
   a file that names its units
------------------------------------------------------------------------- */

void GasFrames::check_units(int caret) const
{
  for (const GasFile &file : files)
    if (file.title().find("SI units") != std::string::npos && strcmp(update->unit_style, "si") != 0)
      error->all(FLERR, caret,
                 "{}: the title line of {} says SI units, the units of this run are {}: numbers are taken as "
                 "they are, so convert them and change that line",
                 me, file.path(), update->unit_style);
}

/* ---------------------------------------------------------------------- */

void GasFrames::set_period(double p, int caret)
{
  if (times.size() < 2)
    error->all(FLERR, caret, "{}: loop needs a series of at least two files, given by a name with *", me);
  if (p < times.back() - times.front())
    error->all(FLERR, caret, "{}: loop {} [time] is shorter than the series, which lasts {}", me, p,
               times.back() - times.front());
  period = p;
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
  const auto &planes = *files[0].planes();
  std::string text =
      fmt::format("{}: {} x {} x {} points, {}", me, planes[0].size(), planes[1].size(), planes[2].size(), arrays);
  if (times.size() > 1)
    text += fmt::format("; {} frames from {} to {}", times.size(), times.front(), times.back());
  for (FILE *out : {screen, logfile})
    if (out) fprintf(out, "%s\n", text.c_str());
}

/* ---------------------------------------------------------------------- */

void GasFrames::prepare(double t)
{
  if (outdated(box, domain->boxlo, domain->boxhi)) fit_box();
  if (outdated(mine, domain->sublo, domain->subhi)) fit_part();
  hold(frames_at(times, period, t));
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
  const GasFile &file = files[frame];
  into.values.resize(part.points() * nvalues);
  try {
    for (int q = 0; q < GasFile::QUANTITIES; q++) {
      if (!wanted[q]) continue;
      file.read(q, held_planes(), into.values.data() + begin[q], nvalues);
      check_values(file, q, into.values.data() + begin[q]);
    }
    for (int axis = 0; axis < 3; axis++) check_seam(file, axis);
  } catch (std::runtime_error &e) {
    error->one(FLERR, "{}: {}: {}", me, file.path(), e.what());
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
  static const char *rules[GasFile::QUANTITIES] = {"finite", "finite and >= 0", "finite and > 0",
                                                   "finite and > 0"};
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
