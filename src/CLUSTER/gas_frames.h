/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// The gas field of fix drag/cluster: one file, or a series of frames in time. Each rank holds the points that its part
// of the box asks for, of the two frames around the present time, and reads them by itself.

#ifndef LMP_GAS_FRAMES_H
#define LMP_GAS_FRAMES_H

#include "engine.h"

#include "gas_series.h"
#include "model/gas_grid.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {

class GasFrames : protected EnginePointers {
 public:
  enum Edge { AS_THE_BOX, PERIODIC, CLAMP };
  static constexpr int MOST_VALUES = 10;    // of a point: all quantities of a GasFile

  // `fix` is the fix in messages; `word` a file, or a pattern with * for several; `caret` its place in the command
  GasFrames(class LAMMPS *lmp, const std::string &fix, const std::string &word, int caret);

  // the choices of the command, before init()
  void set_edge(int axis, Edge edge) { edges[axis] = edge; }
  void set_period(double period, int caret) { series.set_period(period, caret); }
  void leave_out(int quantity) { wanted[quantity] = false; }

  bool has(int quantity) const { return wanted[quantity]; }
  void tell() const;    // in the log

  void init();
  void prepare(double t);    // once per step: what all clusters are about to ask for

  // all values at a place; those of a quantity begin at its first()
  void at(const double *x, double *values);
  int first(int quantity) const { return begin[quantity]; }

  double bytes() const;    // that this rank holds

 private:
  GasSeries series;
  std::array<Edge, 3> edges;
  std::array<bool, GasFile::QUANTITIES> wanted;
  std::array<int, GasFile::QUANTITIES> begin;
  int nvalues;

  // for the box as it was when they were made
  ClusterDEM::GridAxes axes;
  std::array<double, 6> box, mine;    // lower and upper ends of the box, of this rank's part
  ClusterDEM::Vec3 lo, hi;            // where this rank's clusters are expected
  ClusterDEM::GridPart part;

  struct Held {
    int frame = -1;
    std::vector<double> values;
  };
  std::array<Held, 2> held;
  ClusterDEM::FramePair now;
  const double *before, *after;

  void fit_box();
  void fit_axis(int axis);
  void fit_part();
  void reach(const double *x);
  bool outdated(std::array<double, 6> &ends, const double *lower, const double *upper) const;

  void hold(const ClusterDEM::FramePair &pair);
  void load(Held &into, int frame);
  std::array<std::vector<int>, 3> held_planes() const;
  void check_values(const GasFile &file, int quantity, const double *values) const;
  void check_seam(const GasFile &file, int axis) const;
};

}    // namespace LAMMPS_NS
#endif
