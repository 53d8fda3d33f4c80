/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// One file with a gas field: legacy VTK, a rectilinear grid with values at its points. The header says where each array
// lies; then any part of an array is read without the rest. Knows no engine: what is wrong is thrown as
// std::runtime_error.

#ifndef LMP_GAS_FILE_H
#define LMP_GAS_FILE_H

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace LAMMPS_NS {

class GasFile {
 public:
  enum Quantity { VELOCITY, FLUCTUATION, DENSITY, VISCOSITY, PERIOD, EDDY_SIZE, QUANTITIES };
  static const char *name(int quantity);
  static int components(int quantity) { return quantity < DENSITY ? 3 : 1; }

  // the header and the coordinates; values of ASCII files are passed over
  using Planes = std::array<std::vector<double>, 3>;    // coordinates along each axis
  explicit GasFile(const std::string &path);

  const std::string &path() const { return path_; }
  const std::string &title() const { return title_; }
  bool has(int quantity) const { return place_[quantity].offset > 0; }
  bool has_time() const { return has_time_; }
  double time() const { return time_; }
  const std::shared_ptr<const Planes> &planes() const { return planes_; }

  // Values of a quantity at the points that lie on these planes of each axis, in any order: points in the order x, y,
  // z, `stride` numbers from one to the next.
  void read(int quantity, const std::array<std::vector<int>, 3> &which, double *values, int stride) const;

  // what other ranks need to know, as text, but for the planes, which all frames share
  std::string packed() const;
  GasFile(const std::string &packed, std::shared_ptr<const Planes> planes);

 private:
  struct Place {
    std::int64_t offset = 0;    // of the first byte; 0: the file has no such array
    int bytes = 8;              // of a binary number
  };
  std::string path_, title_;
  bool binary_ = false, has_time_ = false;
  double time_ = 0.0;
  std::shared_ptr<const Planes> planes_;
  std::array<Place, QUANTITIES> place_;

  void read_binary(int quantity, const std::array<std::vector<int>, 3> &which, double *values, int stride) const;
  void read_ascii(int quantity, const std::array<std::vector<int>, 3> &which, double *values, int stride) const;

  friend class VtkHeader;
};

}    // namespace LAMMPS_NS
#endif
