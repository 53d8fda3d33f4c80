/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// The layout is that of "VTK File Formats", Simple Legacy Formats (The VTK User's Guide), versions 1.0 to 5.1, and what
// VTK's own writers add: FIELD blocks before the grid, METADATA after an array.

#include "vtk_header.h"

#include <cmath>
#include <map>
#include <sstream>

using namespace LAMMPS_NS;
using namespace LAMMPS_NS::VtkWords;

/* ---------------------------------------------------------------------- */

VtkHeader::VtkHeader(GasFile &f) :
    file(f), in(f.path_), even(false), dimensions{0, 0, 0}, origin{0.0, 0.0, 0.0}, spacing{1.0, 1.0, 1.0},
    points(0), tuples(0), section(NOWHERE), velocity_at_cells(false)
{
  read_beginning();
  Words words;
  while (in.next(words)) {
    if (section == NOWHERE) read_geometry(words);
    else read_attribute(words);
  }
  if (section == NOWHERE) throw std::runtime_error("the file ends before POINT_DATA");
  if (!file.has(GasFile::VELOCITY))
    throw std::runtime_error(velocity_at_cells
                                 ? "array velocity is at cells (CELL_DATA): it must be at points (POINT_DATA)"
                                 : "no array velocity in POINT_DATA");
}

/* ---------------------------------------------------------------------- */

void VtkHeader::read_beginning()
{
  static const std::string mark = "# vtk DataFile Version ";
  std::string line;
  in.line(line);
  double version = 0.0;
  if (lower(line.substr(0, mark.size())) != lower(mark))
    throw std::runtime_error("not a legacy VTK file: its first line is '" + printable(line) + "', not '" + mark +
                             "3.0'");
  std::istringstream(line.substr(mark.size())) >> version;
  if (!(version >= 1.0 && version < 5.15))
    throw std::runtime_error("version '" + printable(line.substr(mark.size())) +
                             "' of VTK's format: known are 1.0 to 5.1");
  in.line(file.title_);
  if (!file.title_.empty() && file.title_.back() == '\r') file.title_.pop_back();

  Words words;
  in.next(words);
  const std::string format = words.empty() ? "" : lower(words[0]);
  if (format != "ascii" && format != "binary")
    throw std::runtime_error("the third line is '" + join(words) + "' (must be ASCII or BINARY)");
  in.set_binary(format == "binary");
  file.binary_ = in.binary();
  in.next(words);
  const std::string dataset = words.size() == 2 && lower(words[0]) == "dataset" ? lower(words[1]) : "";
  even = dataset == "structured_points";
  if (!even && dataset != "rectilinear_grid")
    throw std::runtime_error("'" + join(words) + "' (must be DATASET RECTILINEAR_GRID or STRUCTURED_POINTS)");
}

/* ---------------------------------------------------------------------- */

void VtkHeader::read_geometry(const Words &words)
{
  const std::string keyword = lower(words[0]);
  if (keyword == "field") read_fields(words);
  else if (keyword == "dimensions") {
    for (int k = 0; k < 3; k++)
      if ((dimensions[k] = integer(words, k + 1)) < 1 || dimensions[k] > INT32_MAX)
        throw std::runtime_error("'" + join(words) + "' (must be three integers >= 1)");
  } else if (!even && keyword.size() == 13 && keyword.substr(1) == "_coordinates" && keyword[0] >= 'x' &&
             keyword[0] <= 'z')
    read_coordinates(keyword[0] - 'x', words);
  else if (even && keyword == "origin")
    for (int k = 0; k < 3; k++) origin[k] = number(words, k + 1);
  else if (even && (keyword == "spacing" || keyword == "aspect_ratio"))
    for (int k = 0; k < 3; k++) spacing[k] = number(words, k + 1);
  else if (keyword == "point_data" || keyword == "cell_data") {
    check_grid();
    read_attribute(words);
  } else throw std::runtime_error("'" + join(words) + "' is not understood where the grid is described");
}

/* ---------------------------------------------------------------------- */

void VtkHeader::read_coordinates(int axis, const Words &words)
{
  static const char *names[3] = {"X_COORDINATES", "Y_COORDINATES", "Z_COORDINATES"};
  if (integer(words, 1) != dimensions[axis])
    throw std::runtime_error("'" + join(words) + "' does not fit DIMENSIONS, which has " +
                             std::to_string(dimensions[axis]));
  planes[axis] = in.numbers(dimensions[axis], word(words, 2), names[axis]);
}

/* ---------------------------------------------------------------------- */

void VtkHeader::check_grid()
{
  double all = 1.0;
  for (int axis = 0; axis < 3; axis++) {
    const std::string name = even ? std::string("ORIGIN and SPACING along ") + "xyz"[axis]
                                  : std::string(1, "XYZ"[axis]) + "_COORDINATES";
    auto &x = planes[axis];
    if (dimensions[axis] == 0) throw std::runtime_error("no DIMENSIONS before POINT_DATA");
    all *= static_cast<double>(dimensions[axis]);
    if (all > static_cast<double>(in.length()))    // before there is memory for them
      throw std::runtime_error("DIMENSIONS give more points than the file has bytes");
    if (even)
      for (std::int64_t k = 0; k < dimensions[axis]; k++) x.push_back(origin[axis] + k * spacing[axis]);
    if (x.empty()) throw std::runtime_error("no " + name + " before POINT_DATA");
    for (std::size_t k = 0; k < x.size(); k++) {
      const bool increases = k == 0 || x[k] > x[k - 1];
      if (std::isfinite(x[k]) && increases) continue;
      std::ostringstream fault;
      fault << name << ": plane " << k << " is at " << x[k];
      if (k) fault << " after one at " << x[k - 1];
      throw std::runtime_error(fault.str() + " (must be finite and increase)");
    }
  }
  points = static_cast<std::int64_t>(all);
  file.planes_ = std::make_shared<const GasFile::Planes>(std::move(planes));
}

/* ----------------------------------------------------------------------
   arrays of every kind: those of the gas are noted, others passed over
------------------------------------------------------------------------- */

void VtkHeader::read_attribute(const Words &words)
{
  static const std::map<std::string, int> components = {{"vectors", 3},   {"normals", 3},    {"tensors", 9},
                                                        {"tensors6", 6},  {"global_ids", 1}, {"pedigree_ids", 1},
                                                        {"edge_flags", 1}};
  const std::string keyword = lower(words[0]);
  const auto simple = components.find(keyword);
  if (keyword == "point_data") {
    section = POINTS;
    tuples = integer(words, 1);
    if (tuples != points)
      throw std::runtime_error("'" + join(words) + "' does not fit DIMENSIONS, which give " +
                               std::to_string(points));
  } else if (keyword == "cell_data") {
    section = CELLS;
    tuples = integer(words, 1);
  } else if (keyword == "field") read_fields(words);
  else if (simple != components.end()) array(word(words, 1), simple->second, tuples, word(words, 2));
  else if (keyword == "scalars") {
    const std::int64_t each = words.size() > 3 ? integer(words, 3) : 1;
    Words table;
    const auto here = in.place();
    if (in.next(table) && lower(table[0]) != "lookup_table") in.go_to(here);
    array(word(words, 1), each, tuples, word(words, 2));
  } else if (keyword == "texture_coordinates") array(word(words, 1), integer(words, 2), tuples, word(words, 3));
  else if (keyword == "color_scalars") array(word(words, 1), integer(words, 2), tuples, "unsigned_char");
  else if (keyword == "lookup_table") array(word(words, 1), 4, integer(words, 2), "unsigned_char");
  else throw std::runtime_error("'" + join(words) + "' is not understood among the arrays");
}

/* ---------------------------------------------------------------------- */

void VtkHeader::read_fields(const Words &words)
{
  Words one;
  for (std::int64_t k = integer(words, 2); k > 0; k--) {
    if (!in.next(one)) throw std::runtime_error("the file ends within '" + join(words) + "'");
    const std::int64_t each = integer(one, 1), n = integer(one, 2);
    if (section == NOWHERE && (one[0] == "TIME" || one[0] == "TimeValue") && each * n == 1) {
      file.time_ = in.numbers(1, word(one, 3), one[0])[0];
      file.has_time_ = true;
      if (!std::isfinite(file.time_)) throw std::runtime_error(one[0] + " is not finite");
    } else array(one[0], each, n, word(one, 3));
  }
}

/* ---------------------------------------------------------------------- */

void VtkHeader::array(const std::string &name, std::int64_t each, std::int64_t n, const std::string &type)
{
  if (section == CELLS && name == GasFile::name(GasFile::VELOCITY)) velocity_at_cells = true;
  for (int quantity = 0; section == POINTS && quantity < GasFile::QUANTITIES; quantity++) {
    if (name != GasFile::name(quantity)) continue;
    const std::string what = "array " + name;
    if (file.has(quantity)) throw std::runtime_error(what + " is given twice");
    if (each != GasFile::components(quantity) || n != points)
      throw std::runtime_error(what + " has " + std::to_string(each) + " components at " + std::to_string(n) +
                               " points (must have " + std::to_string(GasFile::components(quantity)) + " at " +
                               std::to_string(points) + ")");
    if (lower(type) != "float" && lower(type) != "double")
      throw std::runtime_error(what + " is of type " + printable(type) + " (must be float or double)");
    file.place_[quantity] = {in.place(), VtkStream::bytes_of(type)};
  }
  if (static_cast<double>(each) * static_cast<double>(n) >
      8.0 * static_cast<double>(in.length()))    // not even bits
    throw std::runtime_error("the file ends within array " + printable(name));
  in.pass(each * n, type, "array " + printable(name));
}
