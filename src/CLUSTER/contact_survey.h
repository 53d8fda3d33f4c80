/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// How near clusters are to each other, for the control of the time step: all pairs of the neighbor lists, on all ranks.

#ifndef LMP_CONTACT_SURVEY_H
#define LMP_CONTACT_SURVEY_H

#include "pointers.h"

#include "model/step_control.h"

namespace LAMMPS_NS {
class ContactSource;

class ContactSurvey : protected Pointers {
 public:
  ContactSurvey(class LAMMPS *lmp, const ContactSource &source) : Pointers(lmp), contacts(source) {}

  // The deepest overlap, as a share of the smaller diameter, and when the first pair would reach that depth `limit` at its
  // present speed of approach; over all ranks. With drift > 0, over the straight way of that time that led here: two
  // equal clusters that went through each other overlap no more than before. Pairs further apart than `near` are left
  // out.
  struct Near {
    int i = -1, j = -1;
    ClusterDEM::Approach approach = {};
  };
  struct Found {
    double deepest, soonest;
    double my_deepest = -INFINITY, my_soonest = INFINITY;    // of this rank, and the pairs they are of
    Near deepest_pair, soonest_pair;
  };
  Found look(double limit, double near, double drift = 0.0) const;

  // two clusters that meet, the same on all ranks
  struct Meeting {
    double tags[2];
    ClusterDEM::Approach approach;
    double mass;    // reduced; 0: nobody meets
  };
  Meeting deepest(const Found &found) const { return tell(found.deepest_pair, found.my_deepest == found.deepest); }
  Meeting soonest(const Found &found) const { return tell(found.soonest_pair, found.my_soonest == found.soonest); }

 private:
  const ContactSource &contacts;

  Meeting tell(const Near &pair, bool mine) const;
};

}    // namespace LAMMPS_NS
#endif
