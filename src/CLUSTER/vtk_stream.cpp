/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#include "vtk_stream.h"

#include "vtk_numbers.h"

#include <map>
#include <sstream>

using namespace LAMMPS_NS;
using namespace LAMMPS_NS::VtkWords;

int VtkStream::bytes_of(const std::string &type)
{
  static const std::map<std::string, int> bytes = {
      {"char", 1},          {"unsigned_char", 1}, {"short", 2},         {"unsigned_short", 2}, {"int", 4},
      {"unsigned_int", 4},  {"long", 8},          {"unsigned_long", 8}, {"vtkidtype", 8},      {"vtktypeint64", 8},
      {"vtktypeuint64", 8}, {"float", 4},         {"double", 8}};
  const auto found = bytes.find(lower(type));
  return found == bytes.end() ? 0 : found->second;
}

/* ---------------------------------------------------------------------- */

VtkStream::VtkStream(const std::string &path) : in_(path, std::ios::binary)
{
  if (!in_) throw std::runtime_error("the file cannot be opened");
  in_.seekg(0, std::ios::end);
  length_ = in_.tellg();
  in_.seekg(0);
  if (length_ < 0) throw std::runtime_error("the file cannot be read: is it a folder?");
}

/* ---------------------------------------------------------------------- */

bool VtkStream::line(std::string &text)
{
  return static_cast<bool>(std::getline(in_, text));
}

/* ----------------------------------------------------------------------
   words of the next line that is not empty; METADATA, up to an empty line, is left out
------------------------------------------------------------------------- */

bool VtkStream::next(Words &words)
{
  std::string line;
  words.clear();
  while (words.empty()) {
    if (!std::getline(in_, line)) return false;
    std::istringstream text(line);
    for (std::string word; text >> word;) words.push_back(word);
    if (words.empty() || lower(words[0]) != "metadata") continue;
    while (std::getline(in_, line) && line.find_first_not_of(" \t\r") != std::string::npos) {}
    words.clear();
  }
  return true;
}

/* ---------------------------------------------------------------------- */

void VtkStream::pass(std::int64_t count, const std::string &type, const std::string &what)
{
  if (!binary_) {
    std::string number;
    for (std::int64_t k = 0; k < count; k++)
      if (!(in_ >> number))
        throw std::runtime_error("the file ends within " + what + ": " + std::to_string(k) + " of " +
                                 std::to_string(count) + " numbers");
    return;
  }
  const std::int64_t bytes = lower(type) == "bit" ? (count + 7) / 8 : count * bytes_of(type);
  if (count && !bytes) throw std::runtime_error(what + " is of the unknown type " + printable(type));
  const std::int64_t begin = in_.tellg();
  if (bytes > length_ - begin)
    throw std::runtime_error("the file ends within " + what + ": " + std::to_string(length_ - begin) + " of " +
                             std::to_string(bytes) + " bytes");
  in_.seekg(begin + bytes);
}

/* ---------------------------------------------------------------------- */

std::vector<double> VtkStream::numbers(std::int64_t count, const std::string &type, const std::string &what)
{
  if (lower(type) != "float" && lower(type) != "double")
    throw std::runtime_error(what + " of type " + printable(type) + " (must be float or double)");
  const std::int64_t begin = in_.tellg();
  pass(count, type, what);
  const std::int64_t end = in_.tellg();
  in_.seekg(begin);
  std::vector<double> values;
  values.reserve(count);
  const int size = bytes_of(type);
  char bytes[8];
  for (std::int64_t k = 0; k < count; k++)
    values.push_back(binary_ ? (in_.read(bytes, size), from_big_endian(bytes, size)) : next_number(in_, what));
  in_.seekg(end);
  return values;
}
