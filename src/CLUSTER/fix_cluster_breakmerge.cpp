/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#include "fix_cluster_breakmerge.h"

#include "cell_averages.h"
#include "fix_drag_cluster.h"
#include "granular_walls.h"
#include "style_arguments.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "memory.h"
#include "modify.h"
#include "neighbor.h"
#include "pair.h"
#include "update.h"

#include <cstring>

using namespace LAMMPS_NS;
using namespace FixConst;
using namespace ClusterDEM;

static constexpr int COLUMNS = 6;
static constexpr double MOST_SITES = 1.0e7;    // of a lattice for fragments: 0.4 GB

/* ---------------------------------------------------------------------- */

FixClusterBreakMerge::FixClusterBreakMerge(LAMMPS *lmp, int narg, char **arg) :
    EngineFix(lmp, narg, arg), kinds(1), kind_of_type(atom->ntypes + 1, 0), k_given(false), k_from_emms(false),
    k_value(0.0), umf_value(0.0), umf_from_wen_yu(true), eps_mf(0.5), cells_given(false), cells{1, 1, 1},
    nst(NstReading::PARTICLE), nsmf(NsmfReading::EMMS), up(UpReading::OWN), ncc_factor(1.0), term_st(true),
    term_cc(true), term_mf(true), test(ALWAYS), hysteresis(0.26), breaking(true), merging(true),
    break_refused(false), merge_tolerance(0.01), gravity(9.81), gravity_axis(2), claim_max(0.0), planar(true),
    spacing(2.0), drag(nullptr), region(nullptr), pairs(lmp), count(nullptr), nmax_check(0), stable(nullptr),
    power(nullptr), ncontacts(nullptr), contact_force(0.0), suitor(nullptr), needs(nullptr), room(nullptr),
    proceeds(nullptr), comm_stage(CONTACTS), totals{}, newborn_tags(lmp), output{}, output_step(-1),
    start_counted(false), merging_now(false)
{
  force_reneighbor = 1;
  next_reneighbor = -1;
  restart_global = 1;
  create_attribute = 1;
  vector_flag = 1;
  size_vector = sizeof(output) / sizeof(output[0]);
  global_freq = 1;
  extvector = 0;
  peratom_flag = 1;
  size_peratom_cols = COLUMNS;
  peratom_freq = 1;
  comm_forward = 5;
  comm_reverse = 3;
  dynamic_group_allow = 0;

  if (!atom->radius_flag || !atom->rmass_flag)
    error->all(FLERR, "Fix {} requires atom style sphere or cluster: clusters have a diameter and a mass", style);
  if (domain->dimension == 2)
    error->all(FLERR,
               "Fix {} requires a 3-d simulation (clusters are spheres): for motion in a plane "
               "use dimension 3 with 'plane xz'",
               style);
  if (!atom->tag_enable) error->all(FLERR, "Fix {} requires atom IDs", style);
  if (force->pair == nullptr) error->all(FLERR, "Fix {} must be defined after the pair_style command", style);

  StyleArguments args(lmp, narg, arg, 3);
  nevery = args.integer("Nevery", 1);
  auto &first = kinds[0].rule.geometry;
  first.d_p = args.positive("d_p", "length");
  first.rho_p = args.positive("rho_p", "mass/volume");
  parse(args);

  use_hash_map(atom, domain);    // newborns find room and partners through it

  FixClusterBreakMerge::grow_arrays(atom->nmax);
  for (int i = 0; i < atom->nlocal; i++) FixClusterBreakMerge::set_arrays(i);
  atom->add_callback(Atom::GROW);
  if (test == CONTACT_ENDED) {
    restart_peratom = 1;
    atom->add_callback(Atom::RESTART);
  }
  maxexchange_dynamic = test == CONTACT_ENDED;
  maxexchange = 1 + COLUMNS + 1;
}

/* ---------------------------------------------------------------------- */

FixClusterBreakMerge::~FixClusterBreakMerge()
{
  if (count) {
    atom->delete_callback(id, Atom::GROW);
    if (restart_peratom) atom->delete_callback(id, Atom::RESTART);
  }
  memory->destroy(count);
  memory->destroy(array_atom);
  free_scratch();
}

/* ---------------------------------------------------------------------- */

void FixClusterBreakMerge::parse(StyleArguments &args)
{
  while (args.more()) {
    const std::string keyword = args.word("keyword");
    if (keyword == "drag") drag_id = args.word("drag FIX-ID");
    else if (keyword == "K") {
      k_given = true;
      k_from_emms = args.next_is("emms");
      if (k_from_emms) args.word("K");
      k_value = k_from_emms ? args.positive("K emms U_p", "velocity")
                            : args.positive("K", "length*power/mass, or emms U_p");
    } else if (keyword == "void") {
      auto &voidage = kinds[0].rule.geometry.voidage;
      voidage = args.number(keyword, "a number >= 0 and < 1");
      if (!(voidage >= 0.0 && voidage < 1.0)) args.refuse(keyword, "a number >= 0 and < 1");
    } else if (keyword == "kind") parse_kind(args);
    else if (keyword == "limits") {
      limits.lo = args.integer("limits lower", 1);
      limits.hi = args.integer("limits upper", limits.lo);
    } else if (keyword == "umf") {
      umf_from_wen_yu = args.next_is("wen/yu");
      if (umf_from_wen_yu) args.word("umf");
      else umf_value = args.positive("umf", "velocity, or wen/yu");
    } else if (keyword == "epsmf") {
      eps_mf = args.number(keyword, "a number >= 0 and < 1");
      if (!(eps_mf >= 0.0 && eps_mf < 1.0)) args.refuse(keyword, "a number >= 0 and < 1");
    } else if (keyword == "grid") {
      cells_given = true;
      double all = 1.0;
      for (int &n : cells) all *= n = args.integer("grid", 1);
      if (all > CellAverages::MOST)
        args.refuse("grid", fmt::format("at most {} cells in all", CellAverages::MOST));
    } else if (keyword == "nst")
      nst = static_cast<NstReading>(args.choice(keyword, {"particle", "cluster", "cell"}));
    else if (keyword == "nsmf") nsmf = static_cast<NsmfReading>(args.choice(keyword, {"emms", "paper"}));
    else if (keyword == "up") up = static_cast<UpReading>(args.choice(keyword, {"own", "cell", "superficial"}));
    else if (keyword == "ncc") {
      ncc_factor = args.number(keyword, "a number >= 0");
      if (ncc_factor < 0.0) args.refuse(keyword, "a number >= 0");
    } else if (keyword == "terms") parse_terms(args);
    else if (keyword == "test") {
      const int word = args.choice(keyword, {"always", "contact", "end"});
      test = word == 0 ? ALWAYS : word == 1 ? IN_CONTACT : CONTACT_ENDED;
    } else if (keyword == "hysteresis") {
      hysteresis = args.number(keyword, "a number >= 0");
      if (hysteresis < 0.0) args.refuse(keyword, "a number >= 0");
    } else if (keyword == "break") breaking = args.yes(keyword);
    else if (keyword == "merge") {
      if (args.next_is("yes") || args.next_is("no")) merging = args.yes(keyword);
      else {
        merging = true;
        merge_tolerance = args.number(keyword, "yes, no, or a number > 0");
        if (!(merge_tolerance > 0.0)) args.refuse(keyword, "yes, no, or a number > 0");
      }
    } else if (keyword == "refused") break_refused = args.choice(keyword, {"leave", "break"}) == 1;
    else if (keyword == "gravity") {
      gravity = args.positive("gravity g", "acceleration");
      gravity_axis = args.choice("gravity axis", {"x", "y", "z"});
    } else if (keyword == "claim") claim_max = args.positive(keyword, "length");
    else if (keyword == "region") region_id = args.word("region ID");
    else if (keyword == "plane") planar = args.choice(keyword, {"xz", "none"}) == 0;
    else if (keyword == "spacing") {
      spacing = args.number(keyword, "a number >= 1");
      if (!(spacing >= 1.0)) args.refuse(keyword, "a number >= 1");
    } else args.unknown_keyword();
  }

  for (Kind &k : kinds) k.rule.geometry.voidage = kinds[0].rule.geometry.voidage;
  if (claim_max == 0.0) claim_max = 1.6 * largest_diameter();
  if (!k_given) error->all(FLERR, "Illegal fix {} command: the keyword K is required", style);
  if (term_st && drag_id.empty())
    error->all(FLERR,
               "Illegal fix {} command: the term st needs the keyword drag FIX-ID (or leave st out "
               "of terms)",
               style);
  if ((term_mf || k_from_emms) && umf_from_wen_yu && drag_id.empty())
    error->all(FLERR,
               "Illegal fix {} command: umf wen/yu needs the gas of the keyword drag FIX-ID (or give "
               "umf a value)",
               style);
  const bool cell_reading = (term_st && nst == NstReading::CELL) || (term_mf && up != UpReading::OWN);
  if (cell_reading && !cells_given)
    error->all(FLERR,
               "Illegal fix {} command: the readings nst cell, up cell and up superficial need the "
               "keyword grid nx ny nz",
               style);
  if (!cell_reading) cells_given = false;    // no averages that nobody asks for
  if (term_mf && up == UpReading::SUPERFICIAL)
    for (const Kind &k : kinds)
      if (k.rule.geometry.rho_p != kinds[0].rule.geometry.rho_p)
        error->all(
            FLERR,
            "Illegal fix {} command: up superficial knows one density of primary particles only, not the {} and "
            "{} of keyword kind",
            style, kinds[0].rule.geometry.rho_p, k.rule.geometry.rho_p);
}

/* ----------------------------------------------------------------------
   an atom type with primary particles of its own
------------------------------------------------------------------------- */

void FixClusterBreakMerge::parse_kind(StyleArguments &args)
{
  const int type = args.integer("kind TYPE", 1);
  if (type > atom->ntypes) args.refuse("kind TYPE", fmt::format("an atom type from 1 to {}", atom->ntypes));
  if (kind_of_type[type]) args.refuse("kind TYPE", "a type that has no kind yet");
  kind_of_type[type] = static_cast<int>(kinds.size());
  Kind other = {};
  other.rule.geometry.d_p = args.positive("kind d_p", "length");
  other.rule.geometry.rho_p = args.positive("kind rho_p", "mass/volume");
  kinds.push_back(other);
}

/* ---------------------------------------------------------------------- */

void FixClusterBreakMerge::parse_terms(StyleArguments &args)
{
  term_st = term_cc = term_mf = false;
  args.word("terms: any of st, cc, mf");
  for (std::string word = args.last();; word = args.word("terms")) {
    if (word == "st") term_st = true;
    else if (word == "cc") term_cc = true;
    else if (word == "mf") term_mf = true;
    else args.refuse("terms", "any of st, cc, mf");
    if (!(args.next_is("st") || args.next_is("cc") || args.next_is("mf"))) return;
  }
}

/* ---------------------------------------------------------------------- */

int FixClusterBreakMerge::setmask()
{
  return POST_INTEGRATE | PRE_EXCHANGE | PRE_NEIGHBOR;
}

/* ---------------------------------------------------------------------- */

void FixClusterBreakMerge::init()
{
  const std::string me = fmt::format("Fix {} {}", style, id);
  if (utils::strmatch(update->integrate_style, "^respa"))
    error->all(FLERR, "{} does not support run_style respa: use run_style verlet", me);
  if (force->pair == nullptr) error->all(FLERR, "{} must be defined after the pair_style command", me);
  if (modify->get_fix_by_style("^cluster/breakmerge").size() > 1)
    error->all(FLERR, "{}: only one fix cluster/breakmerge at a time", me);

  check_order();
  find_drag();
  find_region();
  make_rules();
  const std::string foreign = not_for_clusters(lmp, groupbit);
  if (!foreign.empty()) error->all(FLERR, "{} does not support {}", me, foreign);
  pairs.find(me, groupbit, largest_diameter());
  if (looks_at_contacts()) pairs.expect_contacts(next_check(update->ntimestep));
  check_room();
  double finest = INFINITY;
  for (const Kind &k : kinds) finest = MIN(finest, spacing * k.rule.geometry.diameter(limits.lo));
  const double sites = ClusterDEM::Lattice::sites_within(planar, claim_max / finest + 1.0);
  if (sites > MOST_SITES)
    error->all(
        FLERR,
        "{}: the claim {} [length] holds {:.3g} sites of a lattice for fragments of {} particles, more than "
        "{:.3g}: raise the lower limit or the spacing, or use a smaller claim",
        me, claim_max, sites, limits.lo, MOST_SITES);
  const int axis0 = planar ? 0 : -1, axis1 = planar ? 2 : -1;
  lattices = std::make_unique<Lattices>(axis0, axis1, claim_max / finest + 1.0);
}

/* ----------------------------------------------------------------------
   fragments stay within non-periodic sides of the box; other walls must be told
------------------------------------------------------------------------- */

void FixClusterBreakMerge::find_region()
{
  region = nullptr;
  if (!region_id.empty()) {
    region = region_of(domain, region_id);
    if (!region) error->all(FLERR, "Fix {} {}: region ID {} does not exist", style, id, region_id);
    return;
  }
  const std::string wall = breaking ? wall_inside_the_box(lmp, planar) : "";
  if (!wall.empty())
    error->all(
        FLERR,
        "Fix {} {} does not see {}, and would place fragments behind it: let a fixed side of the box be that "
        "wall, or give the keyword region with the ID of a region within the walls",
        style, id, wall);
}

/* ---------------------------------------------------------------------- */

void FixClusterBreakMerge::make_rules()
{
  for (Kind &kind : kinds) {
    const ClusterGeometry &particles = kind.rule.geometry;
    kind.u_mf = umf_from_wen_yu && drag ? umf_in(drag->gas_properties(), particles) : umf_value;
    const double k = k_from_emms ? k_emms(particles.d_p, k_value, kind.u_mf, eps_mf, gravity) : k_value;
    if (!(k > 0.0))
      error->all(FLERR,
                 "Fix {} {}: K emms {} gives K = {}: U_p must be above {} (so that U_p/(1 - 0.9997) exceeds "
                 "the minimum fluidization)",
                 style, id, k_value, k, kind.u_mf * 3.0e-4);
    kind.rule = {k, hysteresis, particles, limits};
  }
}

double FixClusterBreakMerge::largest_diameter() const
{
  double largest = 0.0;
  for (const Kind &k : kinds) largest = MAX(largest, k.rule.geometry.diameter(limits.hi));
  return largest;
}

/* ---------------------------------------------------------------------- */

void FixClusterBreakMerge::find_drag()
{
  drag = nullptr;
  if (drag_id.empty()) return;
  Fix *fix = modify->get_fix_by_id(drag_id);
  if (!fix) error->all(FLERR, "Fix {} {}: drag fix ID {} does not exist", style, id, drag_id);
  drag = dynamic_cast<FixDragCluster *>(fix);
  if (!drag)
    error->all(FLERR, "Fix {} {}: drag fix {} is of style {}, not drag/cluster", style, id, drag_id, fix->style);
}

/* ----------------------------------------------------------------------
   Two events meet when their claims do: each rank must see every candidate within two claims of its
   own clusters, and newborns must not skip a whole rank.
------------------------------------------------------------------------- */

void FixClusterBreakMerge::check_room()
{
  const double largest = largest_diameter();
  if (claim_max < largest)
    error->all(FLERR,
               "Fix {} {}: claim {} [length] is below the largest cluster diameter {}: use a larger claim "
               "or a lower upper limit",
               style, id, claim_max, largest);
  const double halves = 0.5 * (spacing + 1.0) * largest * std::cbrt(0.5);
  if (breaking && claim_max < halves)
    error->all(FLERR,
               "Fix {} {}: claim {} [length] is below {}, the room that two halves of the largest cluster "
               "need at spacing {}: the largest could never break",
               style, id, claim_max, halves, spacing);
  const double needed = 2.0 * claim_max + neighbor->skin;
  const double have = ghost_reach(force->pair->cutforce + neighbor->skin, comm->cutghostuser, neighbor->skin);
  if (have < needed * (1.0 - 1.0e-12))
    error->all(FLERR,
               "Fix {} {}: the ghost cutoff {} is below {}, twice the claim {} plus the skin: use "
               "'{}' or a smaller claim",
               style, id, have, needed, claim_max, ask_for_ghosts(needed * 1.0001, neighbor->skin));
  for (int axis = 0; axis < 3; axis++) {
    if (planar && axis == 1) continue;
    if (domain->periodicity[axis] && domain->prd[axis] < 4.0 * claim_max)
      error->all(FLERR,
                 "Fix {} {}: the periodic box is {} long along {}, below four times the claim {}: an "
                 "event would meet its own image",
                 style, id, domain->prd[axis], "xyz"[axis], claim_max);
  }
}

/* ----------------------------------------------------------------------
   outputs of the first step; no event happens here
------------------------------------------------------------------------- */

void FixClusterBreakMerge::setup(int)
{
  if (cells_given) averages = std::make_unique<CellAverages>(lmp, this, cells);
  measure();
  output_step = -1;
}

bigint FixClusterBreakMerge::next_check(bigint step) const
{
  return (step / nevery + 1) * nevery;
}

/* ---------------------------------------------------------------------- */

void FixClusterBreakMerge::reset_grid()
{
  if (averages) averages->reset();
}

/* ---------------------------------------------------------------------- */

void FixClusterBreakMerge::post_integrate()
{
  events.clear();
  dying.clear();
  if (update->ntimestep % nevery) return;

  // clusters have moved, their ghosts have not
  if (looks_at_contacts()) comm->forward_comm();
  measure();
  note_forces();
  if (looks_at_contacts()) pairs.expect_contacts(next_check(update->ntimestep));
  if (breaking) propose_breaks();
  if (merging) propose_merges();

  int mine = static_cast<int>(events.size()), all = 0;
  MPI_Allreduce(&mine, &all, 1, MPI_INT, MPI_MAX, world);
  if (all == 0) return;
  if (!looks_at_contacts()) comm->forward_comm();
  make_room();
  arbitrate();
  mark_dying();

  mine = static_cast<int>(events.size());
  MPI_Allreduce(&mine, &all, 1, MPI_INT, MPI_MAX, world);
  if (all) next_reneighbor = update->ntimestep;
}

/* ----------------------------------------------------------------------
   clusters, particles, breakups, merges, fragments born, births deferred or shifted,
   energy lost in merges, energy put in by births, min, mean, max d; the other totals
------------------------------------------------------------------------- */

double FixClusterBreakMerge::compute_vector(int n)
{
  if (output_step != update->ntimestep) {
    output_step = update->ntimestep;
    double sum[3 + NTOTALS] = {0.0}, all[3 + NTOTALS];
    double most[2] = {-INFINITY, 0.0}, most_all[2];    // -min d, max d
    for (int i = 0; i < atom->nlocal; i++) {
      if (!(atom->mask[i] & groupbit)) continue;
      const double d = 2.0 * atom->radius[i];
      sum[0] += 1.0;
      sum[1] += particle_count(i);
      sum[2] += d;
      most[0] = MAX(most[0], -d);
      most[1] = MAX(most[1], d);
    }
    memcpy(sum + 3, totals, sizeof(totals));
    MPI_Allreduce(sum, all, 3 + NTOTALS, MPI_DOUBLE, MPI_SUM, world);
    MPI_Allreduce(most, most_all, 2, MPI_DOUBLE, MPI_MAX, world);
    output[0] = all[0];
    output[1] = all[1];
    memcpy(output + 2, all + 3, TESTS * sizeof(double));
    output[8] = all[0] > 0.0 ? -most_all[0] : 0.0;
    output[9] = all[0] > 0.0 ? all[2] / all[0] : 0.0;
    output[10] = most_all[1];
    memcpy(output + 11, all + 3 + TESTS, (NTOTALS - TESTS) * sizeof(double));
  }
  return output[n];
}

/* ---------------------------------------------------------------------- */

double FixClusterBreakMerge::memory_usage()
{
  double bytes = (double) atom->nmax * (COLUMNS * sizeof(double) + sizeof(int));
  bytes += (double) nmax_check * (4 * sizeof(int) + 5 * sizeof(double) + sizeof(Suitor));
  if (averages) bytes += averages->memory_usage();
  return bytes;
}
