/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// A legacy VTK file as a stream of lines with keywords and of arrays, in text or in binary. What is wrong is thrown as
// std::runtime_error.

#ifndef LMP_VTK_STREAM_H
#define LMP_VTK_STREAM_H

#include "vtk_words.h"

#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

namespace LAMMPS_NS {

class VtkStream {
 public:
  explicit VtkStream(const std::string &path);

  std::int64_t length() const { return length_; }    // of the file in bytes
  std::int64_t place() { return in_.tellg(); }
  void go_to(std::int64_t place) { in_.seekg(place); }
  bool binary() const { return binary_; }
  void set_binary(bool yes) { binary_ = yes; }    // as its third line says

  bool line(std::string &text);         // the next one, as it is
  bool next(VtkWords::Words &words);    // the next one that says something

  // an array goes by, or is read
  void pass(std::int64_t count, const std::string &type, const std::string &what);
  std::vector<double> numbers(std::int64_t count, const std::string &type, const std::string &what);

  static int bytes_of(const std::string &type);    // of a number in binary files, 0: unknown

 private:
  std::ifstream in_;
  std::int64_t length_ = 0;
  bool binary_ = false;
};

}    // namespace LAMMPS_NS
#endif
