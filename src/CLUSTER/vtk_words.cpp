/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#include "vtk_words.h"

#include "vtk_numbers.h"

#include <algorithm>

using namespace LAMMPS_NS;

static constexpr double MOST = 1.0e15;    // a count that a double holds

std::string VtkWords::lower(std::string word)
{
  std::transform(word.begin(), word.end(), word.begin(), [](unsigned char c) { return std::tolower(c); });
  return word;
}

std::string VtkWords::printable(const std::string &line)
{
  std::string text = line.substr(0, 40);
  std::replace_if(text.begin(), text.end(), [](unsigned char c) { return !std::isprint(c); }, '?');
  return text;
}

std::string VtkWords::join(const Words &words)
{
  std::string text;
  for (const auto &word : words) text += (text.empty() ? "" : " ") + word;
  return printable(text);
}

const std::string &VtkWords::word(const Words &words, std::size_t k)
{
  if (k >= words.size()) throw std::runtime_error("'" + join(words) + "' ends too early");
  return words[k];
}

double VtkWords::number(const Words &words, std::size_t k)
{
  double value;
  if (!to_number(word(words, k), value))
    throw std::runtime_error("'" + join(words) + "': " + printable(words[k]) + " is no number");
  return value;
}

std::int64_t VtkWords::integer(const Words &words, std::size_t k)
{
  const double value = number(words, k);
  if (value != std::floor(value) || !(value >= 0.0 && value <= MOST))
    throw std::runtime_error("'" + join(words) + "': " + printable(words[k]) + " is no integer from 0 to 1e15");
  return static_cast<std::int64_t>(value);
}
