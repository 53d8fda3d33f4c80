/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// The fluctuation of the gas velocity: random factors from -1 to 1 on an amplitude, one set for each gas cell or for each
// cluster, drawn anew after a period, or when the eddy that the cluster is in has ended. Each is a pure function of its key
// (model/gas_field.h): the same on any ranks.

#ifndef LMP_GAS_FLUCTUATION_H
#define LMP_GAS_FLUCTUATION_H

#include "engine.h"

#include "cluster_table.h"
#include "model/eddy.h"
#include "model/gas_field.h"

#include <cstdint>

namespace LAMMPS_NS {
class StyleArguments;

class GasFluctuation : protected EnginePointers {
 public:
  GasFluctuation(class LAMMPS *lmp) :
      EnginePointers(lmp), kind(NONE), amplitude{}, cells{1, 1, 1}, period(0.0), eddies(false), staggered(false),
      lifetimes(ClusterDEM::Lifetimes::FIXED), seed(0), now(0.0), inverse_length{}, cached(nullptr),
      drawn(nullptr), clocks(nullptr)
  {
  }

  void parse(StyleArguments &);
  void add_columns(ClusterTable &);
  bool any() const { return kind != NONE; }
  bool of_clusters() const { return kind == OWN; }
  const ClusterDEM::Vec3 &amplitudes() const { return amplitude; }    // of a field with its own: factors on that

  bool of_eddies() const { return eddies; }    // lifetimes come from the field

  void prepare(double t);    // before any factors of a step
  // of owned cluster i
  const ClusterDEM::Vec3 &factors(int i);
  const ClusterDEM::Vec3 &factors(int i, const ClusterDEM::EddyHere &);    // of_eddies()

  // From restart files whose fluctuation was another one: the n values of cluster i. False: they are as now.
  bool resume(int i, const double *from, int n);

 private:
  enum { NONE, PER_CELL, OWN } kind;
  ClusterDEM::Vec3 amplitude;
  int cells[3];
  double period;
  bool eddies, staggered;
  ClusterDEM::Lifetimes lifetimes;
  uint64_t seed;
  double now;
  ClusterDEM::Vec3 inverse_length;    // of the box

  // What was last computed for a slot of the atom arrays: it stays right whichever cluster comes to use the slot.
  struct Cached {
    int64_t a = -1, b = -1, period = -1;
    ClusterDEM::Vec3 unit = {};
  };
  ClusterTable::Values<Cached> *cached;

  // A cluster that has broken, merged or been born is another one, which its mass tells, and draws anew.
  struct Drawn {
    double mass = 0.0;
    int64_t number = 0;
  };
  ClusterTable::Values<Drawn> *drawn;
  ClusterTable::Values<ClusterDEM::EddyClock> *clocks;

  void parse_period(StyleArguments &);
  enum Change { NONE_SINCE, FIRST, ANOTHER };
  Change draw_anew(int i);
  int64_t period_of(int64_t key) const;
  const ClusterDEM::Vec3 &drawn_as(int i, int64_t a, int64_t b, int64_t period);
};

}    // namespace LAMMPS_NS
#endif
