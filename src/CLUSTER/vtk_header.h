/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// Goes through a legacy VTK file from keyword to keyword and notes where the arrays of a gas field lie.

#ifndef LMP_VTK_HEADER_H
#define LMP_VTK_HEADER_H

#include "gas_file.h"
#include "vtk_stream.h"

namespace LAMMPS_NS {

class VtkHeader {
 public:
  explicit VtkHeader(GasFile &file);    // fills it in

 private:
  using Words = VtkWords::Words;
  enum { NOWHERE, POINTS, CELLS };

  GasFile &file;
  VtkStream in;
  bool even;    // STRUCTURED_POINTS
  std::array<std::int64_t, 3> dimensions;
  std::array<double, 3> origin, spacing;
  GasFile::Planes planes;
  std::int64_t points;
  std::int64_t tuples;    // of each attribute of this section
  int section;            // that attributes belong to
  bool velocity_at_cells;

  void read_beginning();
  void read_geometry(const Words &words);
  void read_attribute(const Words &words);
  void read_fields(const Words &words);
  void read_coordinates(int axis, const Words &words);
  void array(const std::string &name, std::int64_t each, std::int64_t n, const std::string &type);
  void check_grid();
};

}    // namespace LAMMPS_NS
#endif
