/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// The layout is that of "VTK File Formats", Simple Legacy Formats (The VTK User's Guide), versions 1.0 to 5.1, and what
// VTK's own writers add: FIELD blocks before the grid, METADATA after an array.

#include "vtk_header.h"

#include "vtk_numbers.h"

#include <algorithm>
#include <map>
#include <sstream>

using namespace LAMMPS_NS;

static constexpr double MOST = 1.0e15;    // a count that a double holds

static std::string lower(std::string word)
{
  std::transform(word.begin(), word.end(), word.begin(), [](unsigned char c) { return std::tolower(c); });
  return word;
}

// of an unknown file, for a message
static std::string printable(const std::string &line)
{
  std::string text = line.substr(0, 40);
  std::replace_if(text.begin(), text.end(), [](unsigned char c) { return !std::isprint(c); }, '?');
  return text;
}

static std::string join(const std::vector<std::string> &words)
{
  std::string text;
  for (const auto &word : words) text += (text.empty() ? "" : " ") + word;
  return printable(text);
}

// in binary files
static int bytes_of(const std::string &type)
{
  static const std::map<std::string, int> bytes = {
      {"char", 1},          {"unsigned_char", 1}, {"short", 2},         {"unsigned_short", 2}, {"int", 4},
      {"unsigned_int", 4},  {"long", 8},          {"unsigned_long", 8}, {"vtkidtype", 8},      {"vtktypeint64", 8},
      {"vtktypeuint64", 8}, {"float", 4},         {"double", 8}};
  const auto found = bytes.find(lower(type));
  return found == bytes.end() ? 0 : found->second;
}

/* ---------------------------------------------------------------------- */

VtkHeader::VtkHeader(GasFile &f) :
    file(f), in(f.path_, std::ios::binary), length(0), even(false), dimensions{0, 0, 0}, origin{0.0, 0.0, 0.0},
    spacing{1.0, 1.0, 1.0}, points(0), tuples(0), section(NOWHERE), velocity_at_cells(false)
{
  if (!in) throw std::runtime_error("the file cannot be opened");
  in.seekg(0, std::ios::end);
  length = in.tellg();
  in.seekg(0);
  if (length < 0) throw std::runtime_error("the file cannot be read: is it a folder?");

  read_beginning();
  Words words;
  while (next(words)) {
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
  std::getline(in, line);
  double version = 0.0;
  if (lower(line.substr(0, mark.size())) != lower(mark))
    throw std::runtime_error("not a legacy VTK file: its first line is '" + printable(line) + "', not '" + mark +
                             "3.0'");
  std::istringstream(line.substr(mark.size())) >> version;
  if (!(version >= 1.0 && version < 5.15))
    throw std::runtime_error("version '" + printable(line.substr(mark.size())) +
                             "' of VTK's format: known are 1.0 to 5.1");
  std::getline(in, file.title_);
  if (!file.title_.empty() && file.title_.back() == '\r') file.title_.pop_back();

  Words words;
  next(words);
  const std::string format = words.empty() ? "" : lower(words[0]);
  if (format != "ascii" && format != "binary")
    throw std::runtime_error("the third line is '" + join(words) + "' (must be ASCII or BINARY)");
  file.binary_ = format == "binary";
  next(words);
  const std::string dataset = words.size() == 2 && lower(words[0]) == "dataset" ? lower(words[1]) : "";
  even = dataset == "structured_points";
  if (!even && dataset != "rectilinear_grid")
    throw std::runtime_error("'" + join(words) + "' (must be DATASET RECTILINEAR_GRID or STRUCTURED_POINTS)");
}

/* ----------------------------------------------------------------------
   words of the next line that is not empty; METADATA, up to an empty line, is left out
------------------------------------------------------------------------- */

bool VtkHeader::next(Words &words)
{
  std::string line;
  words.clear();
  while (words.empty()) {
    if (!std::getline(in, line)) return false;
    std::istringstream text(line);
    for (std::string word; text >> word;) words.push_back(word);
    if (words.empty() || lower(words[0]) != "metadata") continue;
    while (std::getline(in, line) && line.find_first_not_of(" \t\r") != std::string::npos) {}
    words.clear();
  }
  return true;
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
  planes[axis] = numbers(dimensions[axis], word(words, 2), names[axis]);
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
    if (all > static_cast<double>(length))    // before there is memory for them
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
    const auto here = in.tellg();
    if (next(table) && lower(table[0]) != "lookup_table") in.seekg(here);
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
    if (!next(one)) throw std::runtime_error("the file ends within '" + join(words) + "'");
    const std::int64_t each = integer(one, 1), n = integer(one, 2);
    if (section == NOWHERE && (one[0] == "TIME" || one[0] == "TimeValue") && each * n == 1) {
      file.time_ = numbers(1, word(one, 3), one[0])[0];
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
    file.place_[quantity] = {in.tellg(), bytes_of(type)};
  }
  if (static_cast<double>(each) * static_cast<double>(n) > 8.0 * static_cast<double>(length))    // not even bits
    throw std::runtime_error("the file ends within array " + printable(name));
  pass(each * n, type, "array " + printable(name));
}

/* ---------------------------------------------------------------------- */

void VtkHeader::pass(std::int64_t count, const std::string &type, const std::string &what)
{
  if (!file.binary_) {
    std::string number;
    for (std::int64_t k = 0; k < count; k++)
      if (!(in >> number))
        throw std::runtime_error("the file ends within " + what + ": " + std::to_string(k) + " of " +
                                 std::to_string(count) + " numbers");
    return;
  }
  const std::int64_t bytes = lower(type) == "bit" ? (count + 7) / 8 : count * bytes_of(type);
  if (count && !bytes) throw std::runtime_error(what + " is of the unknown type " + printable(type));
  const std::int64_t begin = in.tellg();
  if (bytes > length - begin)
    throw std::runtime_error("the file ends within " + what + ": " + std::to_string(length - begin) + " of " +
                             std::to_string(bytes) + " bytes");
  in.seekg(begin + bytes);
}

/* ---------------------------------------------------------------------- */

std::vector<double> VtkHeader::numbers(std::int64_t count, const std::string &type, const std::string &what)
{
  if (lower(type) != "float" && lower(type) != "double")
    throw std::runtime_error(what + " of type " + printable(type) + " (must be float or double)");
  const std::int64_t begin = in.tellg();
  pass(count, type, what);
  const std::int64_t end = in.tellg();
  in.seekg(begin);
  std::vector<double> values;
  values.reserve(count);
  const int size = bytes_of(type);
  char bytes[8];
  for (std::int64_t k = 0; k < count; k++)
    values.push_back(file.binary_ ? (in.read(bytes, size), from_big_endian(bytes, size)) : next_number(in, what));
  in.seekg(end);
  return values;
}

/* ---------------------------------------------------------------------- */

const std::string &VtkHeader::word(const Words &words, std::size_t k) const
{
  if (k >= words.size()) throw std::runtime_error("'" + join(words) + "' ends too early");
  return words[k];
}

double VtkHeader::number(const Words &words, std::size_t k) const
{
  double value;
  if (!to_number(word(words, k), value))
    throw std::runtime_error("'" + join(words) + "': " + printable(words[k]) + " is no number");
  return value;
}

std::int64_t VtkHeader::integer(const Words &words, std::size_t k) const
{
  const double value = number(words, k);
  if (value != std::floor(value) || !(value >= 0.0 && value <= MOST))
    throw std::runtime_error("'" + join(words) + "': " + printable(words[k]) + " is no integer from 0 to 1e15");
  return static_cast<std::int64_t>(value);
}
