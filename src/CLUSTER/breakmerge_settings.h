/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// What the command of fix cluster/breakmerge says.

#ifndef LMP_BREAKMERGE_SETTINGS_H
#define LMP_BREAKMERGE_SETTINGS_H

#include "model/cluster_kinds.h"
#include "model/merging.h"
#include "model/size_law.h"

#include "engine.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {
class StyleArguments;

// the size law: which reading of each term, and its constants
struct SizeSettings {
  std::string drag_id;    // of the fix drag/cluster whose gas is asked
  bool k_from_emms = false;
  double k = 0.0;      // K, or U_p of K emms
  double umf = 0.0;    // 0: after Wen & Yu
  double eps_mf = 0.5;
  bool cells_given = false;
  int cells[3] = {1, 1, 1};
  ClusterDEM::NstReading nst = ClusterDEM::NstReading::PARTICLE;
  ClusterDEM::NsmfReading nsmf = ClusterDEM::NsmfReading::EMMS;
  ClusterDEM::UpReading up = ClusterDEM::UpReading::OWN;
  double ncc_factor = 1.0;
  bool term_st = true, term_cc = true, term_mf = true;
  bool gravity_given = false;
  double gravity = 9.81;
  int gravity_axis = 2;

  bool umf_from_wen_yu() const { return umf == 0.0; }
  bool cell_reading() const
  {
    return (term_st && nst == ClusterDEM::NstReading::CELL) || (term_mf && up != ClusterDEM::UpReading::OWN);
  }
  bool looks_at_power() const { return term_cc && ncc_factor > 0.0; }
};

// what becomes of a value that clusters carry
struct CarrySetting {
  std::string name;
  ClusterDEM::CarryRule rule;
};

// when clusters break and merge, and where fragments go
struct EventSettings {
  int every = 1;    // steps between checks
  enum Test { ALWAYS, IN_CONTACT, CONTACT_ENDED } test = ALWAYS;
  double hysteresis = 0.26;
  bool breaking = true, merging = true;
  bool break_refused = false;
  double merge_tolerance = 0.01;
  double claim = 0.0;    // 0: 1.6 times the largest diameter
  bool planar = true;    // fragments are placed in the xz plane
  bool plane_given = false;
  double spacing = 2.0;
  std::string region_id;    // fragments are placed inside of it
  std::vector<CarrySetting> carry;
};

struct BreakMergeSettings {
  ClusterDEM::ClusterKinds kinds;
  SizeSettings size;
  EventSettings event;

  BreakMergeSettings(StyleArguments &, int types);    // reads the words after the style; stops at what is wrong

  bool looks_at_contacts() const
  {
    return size.looks_at_power() || event.merging || event.test != EventSettings::ALWAYS;
  }
  bigint next_check(bigint step) const { return (step / event.every + 1) * event.every; }    // the first after it

 private:
  bool read_size(const std::string &keyword, StyleArguments &);
  bool read_event(const std::string &keyword, StyleArguments &);
  void read_kind(StyleArguments &, int types);
  void read_terms(StyleArguments &);
  void check(StyleArguments &, bool k_given);
};

}    // namespace LAMMPS_NS
#endif
