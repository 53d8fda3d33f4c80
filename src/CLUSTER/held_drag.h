/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// Drag between two refreshes: gas velocity and coefficient of each cluster are held for some steps. Slots of the atom arrays
// change hands only when the neighbor lists are rebuilt, and then all is computed anew.

#ifndef LMP_HELD_DRAG_H
#define LMP_HELD_DRAG_H

#include "engine.h"

#include "cluster_table.h"
#include "model/drag_law.h"

namespace LAMMPS_NS {

// total force on the clusters of this rank, and its power
struct DragTotals {
  ClusterDEM::Vec3 force = {};
  double power = 0.0;
  bool finite() const;
};

class HeldDrag : protected EnginePointers {
 public:
  HeldDrag(class LAMMPS *lmp) :
      EnginePointers(lmp), refresh(1), u(nullptr), b(nullptr), along{}, dt(0.0), elsewhere(false)
  {
  }

  void hold_for(int steps, ClusterTable &);
  void act_along(const ClusterDEM::Vec3 &axes) { along = axes; }    // 1 where drag acts, else 0

  bool any() const { return refresh > 1; }
  bool due() const;    // must drag be computed anew at this step?
  void start();        // it is about to be
  void hold(int i, const ClusterDEM::Vec3 &gas_velocity, double coefficient)
  {
    (*u)[i] = gas_velocity;
    (*b)[i] = coefficient;
  }
  DragTotals add() const;    // the held drag to the forces of this step

  // Somebody else takes the held drag of this step into a pass of its own: true if there is one.
  bool hand_over();
  bool handed_over();                                             // was it? Asked once.
  const double *velocity() const { return u->data()->data(); }    // 3 per cluster
  const double *coefficient() const { return b->data(); }         // 1 per cluster
  const ClusterDEM::Vec3 &axes() const { return along; }

 private:
  int refresh;    // steps
  ClusterTable::Values<ClusterDEM::Vec3> *u;
  ClusterTable::Values<double> *b;
  ClusterDEM::Vec3 along;
  double dt;    // that the coefficients are made for
  bool elsewhere;
};

// Somebody who holds drag: fix drag/cluster.
class HoldsDrag {
 public:
  virtual HeldDrag &held_drag() = 0;
  virtual bool asks_variables() const = 0;    // which may look at anything, each step

 protected:
  ~HoldsDrag() = default;
};

}    // namespace LAMMPS_NS
#endif
