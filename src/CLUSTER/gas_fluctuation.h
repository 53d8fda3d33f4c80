/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// The fluctuation of the gas velocity: random factors from -1 to 1 on an amplitude, one set for each gas cell or for each
// cluster, drawn anew after a period. Each is a pure function of its key (model/gas_field.h): the same on any ranks.

#ifndef LMP_GAS_FLUCTUATION_H
#define LMP_GAS_FLUCTUATION_H

#include "engine.h"

#include "cluster_table.h"
#include "model/gas_field.h"

#include <cstdint>

namespace LAMMPS_NS {
class StyleArguments;

class GasFluctuation : protected EnginePointers {
 public:
  GasFluctuation(class LAMMPS *lmp) :
      EnginePointers(lmp), kind(NONE), amplitude{}, cells{1, 1, 1}, period(0.0), seed(0), period_now(0),
      inverse_length{}, cached(nullptr), drawn(nullptr)
  {
  }

  void parse(StyleArguments &);
  void add_columns(ClusterTable &);
  bool any() const { return kind != NONE; }
  bool of_clusters() const { return kind == OWN; }
  const ClusterDEM::Vec3 &amplitudes() const { return amplitude; }    // of a field with its own: factors on that

  void prepare(double t);                    // before any factors() of a step
  const ClusterDEM::Vec3 &factors(int i);    // of owned cluster i

  // the draw number of cluster i, as files of version 0.1 have it alone
  void resume(int i, int draw);

 private:
  enum { NONE, PER_CELL, OWN } kind;
  ClusterDEM::Vec3 amplitude;
  int cells[3];
  double period;
  uint64_t seed;
  int64_t period_now;
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
};

}    // namespace LAMMPS_NS
#endif
