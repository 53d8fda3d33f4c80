/* ----------------------------------------------------------------------
   Cluster DEM for LIGGGHTS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// The few functions of LAMMPS' fmt and utils that messages and arguments need: texts with {} or {:.3g} in them.

#ifndef LMP_FORMAT_LIGGGHTS_H
#define LMP_FORMAT_LIGGGHTS_H

#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <type_traits>
#include <vector>

namespace fmt {

// `spec` is what stands after the colon: that of printf, or nothing for the shortest text that gives the number back
template <class T> std::string to_text(const T &value, const std::string &spec)
{
  if constexpr (std::is_floating_point_v<T>) {
    char text[64];
    if (!spec.empty()) {
      std::snprintf(text, sizeof(text), ("%" + spec).c_str(), static_cast<double>(value));
      return text;
    }
    for (int digits = 6; digits <= 17; digits++) {
      std::snprintf(text, sizeof(text), "%.*g", digits, static_cast<double>(value));
      if (std::strtod(text, nullptr) == value) break;
    }
    return text;
  } else if constexpr (std::is_same_v<T, char>) return std::string(1, value);
  else if constexpr (std::is_integral_v<T>) return std::to_string(value);
  else return std::string(value);
}

template <class... Args> std::string format(const std::string &text, const Args &...args)
{
  const std::vector<std::function<std::string(const std::string &)>> texts = {
      [&args](const std::string &spec) { return to_text(args, spec); }...};
  std::string result;
  std::size_t next = 0;
  for (std::size_t k = 0; k < text.size(); k++) {
    const std::size_t end = text[k] == '{' ? text.find('}', k) : std::string::npos;
    if (end == std::string::npos || next >= texts.size()) {
      result += text[k];
      continue;
    }
    const std::string inside = text.substr(k + 1, end - k - 1);
    result += texts[next++](inside.empty() ? inside : inside.substr(1));
    k = end;
  }
  return result;
}

}    // namespace fmt

namespace LAMMPS_NS {
namespace utils {

// a pattern that starts with ^ stands at the beginning
inline bool strmatch(const std::string &text, const std::string &pattern)
{
  if (!pattern.empty() && pattern[0] == '^') return text.compare(0, pattern.size() - 1, pattern, 1) == 0;
  return text.find(pattern) != std::string::npos;
}

inline bool is_integer(const std::string &text)
{
  const std::size_t first = !text.empty() && (text[0] == '-' || text[0] == '+') ? 1 : 0;
  return text.size() > first && text.find_first_not_of("0123456789", first) == std::string::npos;
}

inline bool is_double(const std::string &text)
{
  if (text.empty() || text.find_first_not_of("0123456789-+.eE") != std::string::npos) return false;
  char *end;
  std::strtod(text.c_str(), &end);
  return *end == '\0';
}

}    // namespace utils
}    // namespace LAMMPS_NS
#endif
