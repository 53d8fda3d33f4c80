/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#include "breakmerge_settings.h"

#include "cell_averages.h"
#include "style_arguments.h"

using namespace LAMMPS_NS;
using namespace ClusterDEM;

/* ---------------------------------------------------------------------- */

BreakMergeSettings::BreakMergeSettings(StyleArguments &args, int types) : kinds(types)
{
  event.every = args.integer("Nevery", 1);
  kinds.kind(0).d_p = args.positive("d_p", "length");
  kinds.kind(0).rho_p = args.positive("rho_p", "mass/volume");
  bool k_given = false;
  while (args.more()) {
    const std::string keyword = args.word("keyword");
    if (keyword == "K") k_given = true;
    if (keyword == "kind") read_kind(args, types);
    else if (!read_size(keyword, args) && !read_event(keyword, args)) args.unknown_keyword();
  }
  kinds.set_voidage(kinds.kind(0).voidage);
  if (event.claim == 0.0) event.claim = 1.6 * kinds.largest_diameter();
  check(args, k_given);
}

/* ---------------------------------------------------------------------- */

bool BreakMergeSettings::read_size(const std::string &keyword, StyleArguments &args)
{
  SizeSettings &s = size;
  if (keyword == "drag") s.drag_id = args.word("drag FIX-ID");
  else if (keyword == "K") {
    s.k_from_emms = args.next_is("emms");
    if (s.k_from_emms) args.word("K");
    s.k = s.k_from_emms ? args.positive("K emms U_p", "velocity")
                        : args.positive("K", "length*power/mass, or emms U_p");
  } else if (keyword == "void") {
    double &voidage = kinds.kind(0).voidage;
    voidage = args.number(keyword, "a number >= 0 and < 1");
    if (!(voidage >= 0.0 && voidage < 1.0)) args.refuse(keyword, "a number >= 0 and < 1");
  } else if (keyword == "limits") {
    kinds.limits.lo = args.integer("limits lower", 1);
    kinds.limits.hi = args.integer("limits upper", kinds.limits.lo);
  } else if (keyword == "umf") {
    s.umf = 0.0;
    if (args.next_is("wen/yu")) args.word("umf");
    else s.umf = args.positive("umf", "velocity, or wen/yu");
  } else if (keyword == "epsmf") {
    s.eps_mf = args.number(keyword, "a number >= 0 and < 1");
    if (!(s.eps_mf >= 0.0 && s.eps_mf < 1.0)) args.refuse(keyword, "a number >= 0 and < 1");
  } else if (keyword == "grid") {
    s.cells_given = true;
    double all = 1.0;
    for (int &n : s.cells) all *= n = args.integer("grid", 1);
    if (all > CellAverages::MOST) args.refuse("grid", fmt::format("at most {} cells in all", CellAverages::MOST));
  } else if (keyword == "nst")
    s.nst = static_cast<NstReading>(args.choice(keyword, {"particle", "cluster", "cell"}));
  else if (keyword == "nsmf") s.nsmf = static_cast<NsmfReading>(args.choice(keyword, {"emms", "paper"}));
  else if (keyword == "up")
    s.up = static_cast<UpReading>(args.choice(keyword, {"own", "cell", "superficial", "vector"}));
  else if (keyword == "ncc") {
    s.ncc_factor = args.number(keyword, "a number >= 0");
    if (s.ncc_factor < 0.0) args.refuse(keyword, "a number >= 0");
  } else if (keyword == "terms") read_terms(args);
  else if (keyword == "gravity") {
    s.gravity_given = true;
    s.gravity = args.positive("gravity g", "acceleration");
    s.gravity_axis = args.choice("gravity axis", {"x", "y", "z"});
  } else return false;
  return true;
}

/* ---------------------------------------------------------------------- */

bool BreakMergeSettings::read_event(const std::string &keyword, StyleArguments &args)
{
  EventSettings &e = event;
  if (keyword == "test")
    e.test = static_cast<EventSettings::Test>(args.choice(keyword, {"always", "contact", "end"}));
  else if (keyword == "hysteresis") {
    e.hysteresis = args.number(keyword, "a number >= 0");
    if (e.hysteresis < 0.0) args.refuse(keyword, "a number >= 0");
  } else if (keyword == "break") e.breaking = args.yes(keyword);
  else if (keyword == "merge") {
    if (args.next_is("yes") || args.next_is("no")) e.merging = args.yes(keyword);
    else {
      e.merging = true;
      e.merge_tolerance = args.number(keyword, "yes, no, or a number > 0");
      if (!(e.merge_tolerance > 0.0)) args.refuse(keyword, "yes, no, or a number > 0");
    }
  } else if (keyword == "carry") {
    const std::string name = args.word("carry NAME");
    for (const CarrySetting &said : e.carry)
      if (said.name == name) args.refuse("carry NAME", "a value that has no rule yet");
    e.carry.push_back({name, static_cast<CarryRule>(args.choice("carry rule", {"copy", "split", "mean", "sum"}))});
  } else if (keyword == "refused") e.break_refused = args.choice(keyword, {"leave", "break"}) == 1;
  else if (keyword == "claim") e.claim = args.positive(keyword, "length");
  else if (keyword == "region") e.region_id = args.word("region ID");
  else if (keyword == "plane") {
    e.plane_given = true;
    e.planar = args.choice(keyword, {"xz", "none"}) == 0;
  } else if (keyword == "spacing") {
    e.spacing = args.number(keyword, "a number >= 1");
    if (!(e.spacing >= 1.0)) args.refuse(keyword, "a number >= 1");
  } else return false;
  return true;
}

/* ----------------------------------------------------------------------
   an atom type with primary particles of its own
------------------------------------------------------------------------- */

void BreakMergeSettings::read_kind(StyleArguments &args, int types)
{
  const int type = args.integer("kind TYPE", 1);
  if (type > types) args.refuse("kind TYPE", fmt::format("an atom type from 1 to {}", types));
  if (kinds.of_type(type)) args.refuse("kind TYPE", "a type that has no kind yet");
  ClusterGeometry other = {};
  other.d_p = args.positive("kind d_p", "length");
  other.rho_p = args.positive("kind rho_p", "mass/volume");
  kinds.add(type, other);
}

void BreakMergeSettings::read_terms(StyleArguments &args)
{
  size.term_st = size.term_cc = size.term_mf = false;
  args.word("terms: any of st, cc, mf");
  for (std::string word = args.last();; word = args.word("terms")) {
    if (word == "st") size.term_st = true;
    else if (word == "cc") size.term_cc = true;
    else if (word == "mf") size.term_mf = true;
    else args.refuse("terms", "any of st, cc, mf");
    if (!(args.next_is("st") || args.next_is("cc") || args.next_is("mf"))) return;
  }
}

/* ----------------------------------------------------------------------
   words that need each other
------------------------------------------------------------------------- */

void BreakMergeSettings::check(StyleArguments &args, bool k_given)
{
  SizeSettings &s = size;
  if (!k_given) args.incomplete("the keyword K is required");
  if (s.term_st && s.drag_id.empty())
    args.incomplete("the term st needs the keyword drag FIX-ID (or leave st out of terms)");
  if ((s.term_mf || s.k_from_emms) && s.umf_from_wen_yu() && s.drag_id.empty())
    args.incomplete("umf wen/yu needs the gas of the keyword drag FIX-ID (or give umf a value)");
  if (s.cell_reading() && !s.cells_given)
    args.incomplete("the readings nst cell, up cell, up superficial and up vector need the keyword grid nx ny nz");
  s.cells_given = s.cell_reading();    // no averages that nobody asks for
  if (s.term_mf && s.up == UpReading::SUPERFICIAL)
    for (int k = 1; k < kinds.count(); k++)
      if (kinds.kind(k).rho_p != kinds.kind(0).rho_p)
        args.incomplete(fmt::format(
            "up superficial knows one density of primary particles only, not the {} and {} of keyword kind",
            kinds.kind(0).rho_p, kinds.kind(k).rho_p));
}
