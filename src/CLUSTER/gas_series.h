/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// The files of a gas field in the order of their times: one file, or a series that may repeat. One rank looks for them
// and reads their headers, all know them.

#ifndef LMP_GAS_SERIES_H
#define LMP_GAS_SERIES_H

#include "engine.h"

#include "gas_file.h"
#include "model/gas_grid.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {

class GasSeries : protected EnginePointers {
 public:
  // `fix` is the fix in messages; `word` a file, or a pattern with * for several; `caret` its place in the command
  GasSeries(class LAMMPS *lmp, const std::string &fix, const std::string &word, int caret);

  void set_period(double period, int caret);

  const std::string &name() const { return me; }    // in messages
  const GasFile &file(int frame) const { return files[frame]; }
  const GasFile::Planes &planes() const { return *files[0].planes(); }
  std::size_t frames() const { return times.size(); }
  double begin() const { return times.front(); }
  double end() const { return times.back(); }
  ClusterDEM::FramePair at(double t) const { return ClusterDEM::frames_at(times, period, t); }
  void warn_outside(double t);    // once before and once after its frames

 private:
  std::string me;
  std::vector<GasFile> files;    // by time
  std::vector<double> times;
  double period;    // in time; 0: the series does not repeat
  bool told_before, told_after;

  std::vector<GasFile> open_all(const std::string &word) const;
  void check_alike(const GasFile &file, const GasFile &first) const;
  void share(int caret);
  void check_units(int caret) const;
};

}    // namespace LAMMPS_NS
#endif
