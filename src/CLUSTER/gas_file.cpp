/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#include "gas_file.h"

#include "vtk_header.h"
#include "vtk_numbers.h"

#include <algorithm>
#include <sstream>
#include <utility>

using namespace LAMMPS_NS;

const char *GasFile::name(int quantity)
{
  static const char *names[QUANTITIES] = {"velocity",  "fluctuation", "density",
                                          "viscosity", "period",      "eddy_size"};
  return names[quantity];
}

GasFile::GasFile(const std::string &path) : path_(path)
{
  VtkHeader header(*this);
}

/* ---------------------------------------------------------------------- */

std::string GasFile::packed() const
{
  std::ostringstream text;
  text.precision(17);
  text << path_ << '\n' << title_ << '\n' << binary_ << ' ' << has_time_ << ' ' << time_;
  for (const Place &place : place_) text << ' ' << place.offset << ' ' << place.bytes;
  return text.str();
}

GasFile::GasFile(const std::string &packed, std::shared_ptr<const Planes> planes) : planes_(std::move(planes))
{
  std::istringstream text(packed);
  std::getline(text, path_);
  std::getline(text, title_);
  text >> binary_ >> has_time_ >> time_;
  for (Place &place : place_) text >> place.offset >> place.bytes;
}

/* ---------------------------------------------------------------------- */

void GasFile::read(int quantity, const std::array<std::vector<int>, 3> &which, double *values, int stride) const
{
  if (binary_) read_binary(quantity, which, values, stride);
  else read_ascii(quantity, which, values, stride);
}

/* ----------------------------------------------------------------------
   the rows of a part: each stretch of planes next to each other along x is read at once
------------------------------------------------------------------------- */

void GasFile::read_binary(int quantity, const std::array<std::vector<int>, 3> &which, double *values,
                          int stride) const
{
  std::ifstream in(path_, std::ios::binary);
  const Place &place = place_[quantity];
  const auto nx = static_cast<std::int64_t>((*planes_)[0].size());
  const auto ny = static_cast<std::int64_t>((*planes_)[1].size());
  const int each = components(quantity);
  const std::int64_t bytes = static_cast<std::int64_t>(each) * place.bytes;    // of a point
  std::vector<char> row;

  for (const int z : which[2])
    for (const int y : which[1])
      for (std::size_t first = 0, end; first < which[0].size(); first = end) {
        end = first + 1;
        while (end < which[0].size() && which[0][end] == which[0][end - 1] + 1) end++;
        row.resize((end - first) * bytes);
        in.seekg(place.offset + ((z * ny + y) * nx + which[0][first]) * bytes);
        if (!in.read(row.data(), static_cast<std::streamsize>(row.size())))
          throw std::runtime_error(std::string("the file ends within array ") + name(quantity) +
                                   ", or cannot be read");
        const char *next = row.data();
        for (; first < end; first++, values += stride)
          for (int k = 0; k < each; k++, next += place.bytes) values[k] = from_big_endian(next, place.bytes);
      }
}

/* ----------------------------------------------------------------------
   words have no fixed length: all up to the last that is wanted pass by
------------------------------------------------------------------------- */

void GasFile::read_ascii(int quantity, const std::array<std::vector<int>, 3> &which, double *values,
                         int stride) const
{
  std::ifstream in(path_, std::ios::binary);
  in.seekg(place_[quantity].offset);
  const int each = components(quantity);
  const std::string what = std::string("array ") + name(quantity);

  // for each plane of the file the places that it goes to, and the last plane that is wanted
  std::array<std::vector<std::vector<std::size_t>>, 3> places;
  std::array<int, 3> last = {0, 0, 0};
  for (int axis = 0; axis < 3; axis++) {
    places[axis].resize((*planes_)[axis].size());
    for (std::size_t k = 0; k < which[axis].size(); k++) {
      places[axis][which[axis][k]].push_back(k);
      last[axis] = std::max(last[axis], which[axis][k]);
    }
  }
  std::string unused;
  const auto wanted = [&](int x, int y, int z) {
    return !places[0][x].empty() && !places[1][y].empty() && !places[2][z].empty();
  };
  for (int z = 0; z <= last[2]; z++)
    for (int y = 0; y < static_cast<int>((*planes_)[1].size()); y++)
      for (int x = 0; x < static_cast<int>((*planes_)[0].size()); x++) {
        if (!wanted(x, y, z)) {
          for (int k = 0; k < each; k++) in >> unused;
          continue;
        }
        double number[3];
        for (int k = 0; k < each; k++) number[k] = next_number(in, what);
        for (const std::size_t c : places[2][z])
          for (const std::size_t b : places[1][y])
            for (const std::size_t a : places[0][x])
              for (int k = 0; k < each; k++)
                values[((c * which[1].size() + b) * which[0].size() + a) * stride + k] = number[k];
      }
}
