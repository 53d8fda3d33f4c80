/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// The words of one line of a legacy VTK file. What is wrong is thrown as std::runtime_error that quotes the line.

#ifndef LMP_VTK_WORDS_H
#define LMP_VTK_WORDS_H

#include <cstdint>
#include <string>
#include <vector>

namespace LAMMPS_NS::VtkWords {

using Words = std::vector<std::string>;

std::string lower(std::string word);
std::string printable(const std::string &line);    // of an unknown file, for a message
std::string join(const Words &words);              // the same of a line

// the k-th word; as a number; as an integer from 0 to 1e15
const std::string &word(const Words &words, std::size_t k);
double number(const Words &words, std::size_t k);
std::int64_t integer(const Words &words, std::size_t k);

}    // namespace LAMMPS_NS::VtkWords
#endif
