/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// Goes through a legacy VTK file from keyword to keyword and notes where the arrays of a gas field lie.

#ifndef LMP_VTK_HEADER_H
#define LMP_VTK_HEADER_H

#include "gas_file.h"

#include <fstream>

namespace LAMMPS_NS {

class VtkHeader {
 public:
  explicit VtkHeader(GasFile &file);    // fills it in

 private:
  using Words = std::vector<std::string>;
  enum { NOWHERE, POINTS, CELLS };

  GasFile &file;
  std::ifstream in;
  std::int64_t length;    // of the file in bytes
  bool even;              // STRUCTURED_POINTS
  std::array<std::int64_t, 3> dimensions;
  std::array<double, 3> origin, spacing;
  GasFile::Planes planes;
  std::int64_t points;
  std::int64_t tuples;    // of each attribute of this section
  int section;            // that attributes belong to
  bool velocity_at_cells;

  void read_beginning();
  bool next(Words &words);
  void read_geometry(const Words &words);
  void read_attribute(const Words &words);
  void read_fields(const Words &words);
  void read_coordinates(int axis, const Words &words);
  void array(const std::string &name, std::int64_t each, std::int64_t n, const std::string &type);
  void pass(std::int64_t count, const std::string &type, const std::string &what);
  std::vector<double> numbers(std::int64_t count, const std::string &type, const std::string &what);
  void check_grid();

  std::int64_t integer(const Words &words, std::size_t k) const;
  double number(const Words &words, std::size_t k) const;
  const std::string &word(const Words &words, std::size_t k) const;
};

}    // namespace LAMMPS_NS
#endif
