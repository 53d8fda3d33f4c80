/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// Numbers of legacy VTK files: big-endian bytes, or words.

#ifndef LMP_VTK_NUMBERS_H
#define LMP_VTK_NUMBERS_H

#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <istream>
#include <stdexcept>
#include <string>

namespace LAMMPS_NS {

// a float or double that was written with its highest byte first
inline double from_big_endian(const char *bytes, int size)
{
  std::uint64_t bits = 0;
  for (int k = 0; k < size; k++) bits = bits << 8 | static_cast<unsigned char>(bytes[k]);
  if (size == 4) {
    const auto half = static_cast<std::uint32_t>(bits);
    float value;
    std::memcpy(&value, &half, sizeof(value));
    return value;
  }
  double value;
  std::memcpy(&value, &bits, sizeof(value));
  return value;
}

// false where the word is no number; nan and inf are
inline bool to_number(const std::string &word, double &value)
{
  const char *begin = word.data() + (word[0] == '+' ? 1 : 0), *end = word.data() + word.size();
  const auto result = std::from_chars(begin, end, value);
  if (result.ec == std::errc::result_out_of_range && result.ptr == end) {
    value = std::strtod(begin, nullptr);    // too small: 0 or nearly; too large: inf
    return true;
  }
  return result.ec == std::errc() && result.ptr == end;
}

inline double next_number(std::istream &in, const std::string &what)
{
  std::string word;
  double value = 0.0;
  if (!(in >> word)) throw std::runtime_error("the file ends within " + what);
  if (!to_number(word, value))
    throw std::runtime_error("'" + word.substr(0, 20) + "' within " + what + " is no number");
  return value;
}

}    // namespace LAMMPS_NS
#endif
