/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#include "gas_series.h"

#include "error.h"
#include "update.h"

#include <glob.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

using namespace LAMMPS_NS;

/* ---------------------------------------------------------------------- */

GasSeries::GasSeries(LAMMPS *lmp, const std::string &fix, const std::string &word, int caret) :
    EnginePointers(lmp), me(fix + ": field " + word), period(0.0), told_before(false), told_after(false)
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
}

/* ----------------------------------------------------------------------
   the headers of all files, in the order of their times; one rank reads them
------------------------------------------------------------------------- */

std::vector<GasFile> GasSeries::open_all(const std::string &word) const
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

void GasSeries::check_alike(const GasFile &file, const GasFile &first) const
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

void GasSeries::share(int caret)
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

void GasSeries::check_units(int caret) const
{
  for (const GasFile &file : files)
    if (file.title().find("SI units") != std::string::npos && strcmp(update->unit_style, "si") != 0)
      error->all(FLERR, caret,
                 "{}: the title line of {} says SI units, the units of this run are {}: numbers are taken as "
                 "they are, so convert them and change that line",
                 me, file.path(), update->unit_style);
}

/* ---------------------------------------------------------------------- */

void GasSeries::set_period(double p, int caret)
{
  if (times.size() < 2)
    error->all(FLERR, caret, "{}: loop needs a series of at least two files, given by a name with *", me);
  if (p < times.back() - times.front())
    error->all(FLERR, caret, "{}: loop {} [time] is shorter than the series, which lasts {}", me, p,
               times.back() - times.front());
  period = p;
}

/* ----------------------------------------------------------------------
   before its first frame and after its last a series stands still, which is seldom meant
------------------------------------------------------------------------- */

void GasSeries::warn_outside(double t)
{
  if (times.size() < 2 || period > 0.0) return;
  const double rounding = 1.0e-6 * (times.back() - times.front());
  const bool before = t<times.front() - rounding, after = t> times.back() + rounding;
  bool &told = before ? told_before : told_after;
  if (!(before || after) || told) return;
  told = true;
  if (comm->me == 0)
    error->warning(FLERR,
                   fmt::format("{}: time {:.6g} of the run is {} the series, which goes from {:.6g} to {:.6g}: "
                               "its {} frame holds. Give "
                               "the run or the series another start, or the keyword loop",
                               me, t, before ? "before" : "after", times.front(), times.back(),
                               before ? "first" : "last"));
}
