/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#ifdef FIX_CLASS
// clang-format off
FixStyle(cluster/breakmerge,FixClusterBreakMerge);
// clang-format on
#else

#ifndef LMP_FIX_CLUSTER_BREAKMERGE_H
#define LMP_FIX_CLUSTER_BREAKMERGE_H

#include "engine.h"

#include "contact_source.h"
#include "model/decisive_terms.h"
#include "model/merging.h"
#include "model/placement.h"
#include "model/size_law.h"
#include "newborn_tags.h"

#include <memory>

namespace LAMMPS_NS {
class CellAverages;
class FixDragCluster;
class Region;
class StyleArguments;

class FixClusterBreakMerge : public EngineFix {
 public:
  FixClusterBreakMerge(class LAMMPS *, int, char **);
  ~FixClusterBreakMerge() override;
  int setmask() override;
  void init() override;
  void setup_pre_exchange() override;
  void setup(int) override;
  void post_integrate() override;
  void pre_exchange() override;
  void pre_neighbor() override;
  void reset_grid() override;

  void grow_arrays(int) override;
  void copy_arrays(int, int, int) override;
  void set_arrays(int) override;
  int pack_exchange(int, double *) override;
  int unpack_exchange(int, double *) override;
  void write_restart(FILE *) override;
  void restart(char *) override;
  int pack_restart(int, double *) override;
  void unpack_restart(int, int) override;
  int size_restart(int) override;
  int maxsize_restart() override;

  int pack_forward_comm(int, int *, double *, int, int *) override;
  void unpack_forward_comm(int, int, double *) override;
  int pack_reverse_comm_size(int, int) override;
  int pack_reverse_comm(int, int, double *) override;
  void unpack_reverse_comm(int, int *, double *) override;
  void pack_forward_grid(int, void *, int, int *) override;
  void unpack_forward_grid(int, void *, int, int *) override;
  void pack_reverse_grid(int, void *, int, int *) override;
  void unpack_reverse_grid(int, void *, int, int *) override;

  double compute_vector(int) override;
  double memory_usage() override;

  const ClusterDEM::ClusterGeometry &cluster_geometry(int type) const
  {
    return kinds[kind_of_type[type]].rule.geometry;
  }
  bool one_kind() const { return kinds.size() == 1; }
  const ClusterDEM::SizeLimits &size_limits() const { return limits; }
  bool looks_at_power() const { return term_cc && ncc_factor > 0.0; }

  // does a check at this step change what later checks decide, even without events?
  bool remembers(bigint step) const { return test == CONTACT_ENDED && step % nevery == 0; }

 private:
  // ---- settings
  // clusters of one kind of primary particle; kind 0 is that of the command, the others those of keyword kind
  struct Kind {
    ClusterDEM::SizeRule rule;
    double u_mf;    // in a gas of uniform properties
  };
  std::vector<Kind> kinds;
  std::vector<int> kind_of_type;    // by atom type
  ClusterDEM::SizeLimits limits;
  std::string drag_id;
  bool k_given, k_from_emms;
  double k_value;    // K, or U_p of K emms
  double umf_value;
  bool umf_from_wen_yu;
  double eps_mf;
  bool cells_given;
  int cells[3];
  ClusterDEM::NstReading nst;
  ClusterDEM::NsmfReading nsmf;
  ClusterDEM::UpReading up;
  double ncc_factor;
  bool term_st, term_cc, term_mf;
  enum { ALWAYS, IN_CONTACT, CONTACT_ENDED } test;
  double hysteresis;
  bool breaking, merging, break_refused;
  double merge_tolerance;
  double gravity;
  int gravity_axis;
  double claim_max;
  bool planar;    // fragments placed in the xz plane
  double spacing;
  std::string region_id;    // fragments are placed inside of it

  // ---- what init() finds or derives
  FixDragCluster *drag;
  Region *region;
  ContactSource pairs;
  std::unique_ptr<CellAverages> averages;
  std::unique_ptr<ClusterDEM::Lattices> lattices;

  // ---- per cluster; columns of array_atom: n d l N_st N_cc N_smf
  int *count;                                   // primary particles; 0: not yet known
  std::vector<std::vector<tagint>> partners;    // in contact at the last test (test end only)

  // ---- of one check, owned and ghost clusters
  int nmax_check;
  int *stable;      // n_l; negative once the cluster is to break
  double *power;    // sum of F_ij . dU_ij
  int *ncontacts;
  double contact_force;    // sum over my clusters of |F_ij|
  struct Suitor {          // best partner to merge with
    double slip;           // |dV| / min |V|
    double stiffness;      // of their contact
    tagint tag;            // 0: none
    bool better_than(const Suitor &other) const
    {
      return slip < other.slip || (slip == other.slip && tag < other.tag);
    }
  } *suitor;
  int *needs;    // terms without which the merge would be refused: bits
  enum { NEEDS_ST = 1, NEEDS_MF = 2 };
  double **room;    // claim: radius, centre relative to the cluster
  int *proceeds;
  std::vector<std::vector<tagint>> touching_tags;
  enum { CONTACTS, TAGS, SIZES, SUITORS, PARTNERS, CLAIMS, VERDICTS, IDS } comm_stage;

  // One break, or one merge; a refused merge that breaks is both. Led by owned cluster i.
  struct Event {
    int i, j = -1;    // j < 0: no partner
    ClusterDEM::BreakPlan plan;
    ClusterDEM::Placement placement;
    ClusterDEM::Body body = {};     // parent, or both combined
    ClusterDEM::Vec3 omega = {};    // of the merged cluster
    double stiffness = 0.0;         // of the merging contact
    double energy_lost = 0.0;       // kinetic energy that the merge takes out
    double energy_born = 0.0;       // elastic energy that the merged cluster puts in
    double reach = 0.0;             // how far to look for others
    int needs = 0;                  // of either partner
  };
  std::vector<Event> events;
  std::vector<int> dying;    // owned partners of proceeding merges

  // ---- totals since the fix was defined, on this rank
  enum {
    BREAKUPS,
    MERGES,
    BORN,
    DEFERRED,
    E_LOST,
    E_BORN,
    TESTS,
    SHARE_ST,
    SHARE_CC,
    SHARE_MF,
    BREAKUPS_BY_ST,
    BREAKUPS_BY_CC,
    WHOLE_BY_ST,
    WHOLE_BY_MF,
    MERGES_BY_ST,
    MERGES_BY_MF,
    DRAG_FORCE,
    CONTACT_FORCE,
    WEIGHT,
    FED,
    LEFT,
    CLUSTERS_FED,
    CLUSTERS_LEFT,
    NTOTALS
  };
  double totals[NTOTALS];
  NewbornTags newborn_tags;
  double output[5 + NTOTALS];
  bigint output_step;

  const Kind &kind(int i) const { return kinds[kind_of_type[atom->type[i]]]; }
  const ClusterDEM::ClusterGeometry &geometry(int i) const { return kind(i).rule.geometry; }
  double largest_diameter() const;
  bigint next_check(bigint step) const;    // the first check after it
  void parse(StyleArguments &);
  void parse_terms(StyleArguments &);
  void parse_kind(StyleArguments &);
  void make_rules();
  void find_drag();
  void find_region();
  void check_order();
  void check_room();

  // fix_cluster_breakmerge_check.cpp: what holds now
  int particle_count(int i);
  void check_size(int i);
  bool looks_at_contacts() const { return looks_at_power() || merging || test != ALWAYS; }
  void size_scratch();
  void free_scratch();
  void check_finite();
  void measure();
  void add_up_contacts();
  void average_cells();
  double umf_in(const ClusterDEM::Gas &gas, const ClusterDEM::ClusterGeometry &particles) const;
  bool local_umf() const;
  void find_stable_sizes();
  bool contact_ended(int i);
  void exchange(int stage, int size);

  // fix_cluster_breakmerge_flow.cpp: clusters that come and go by other commands
  bool start_counted;    // what is found from now on has come in
  bool merging_now;      // clusters vanish because they merge
  void check_part_of_box();
  void welcome();
  void number_by_place(const std::vector<int> &mine);
  void note_deleted(int i);
  void note_arrived(int i);

  // fix_cluster_breakmerge_decide.cpp: which events happen
  void propose_breaks();
  void propose_merges();
  void choose_suitors();
  void make_room();
  void place(Event &, const std::vector<ClusterDEM::Obstacle> &);
  void arbitrate();
  void mark_dying();
  ClusterDEM::Body body_of(int i) const;

  // fix_cluster_breakmerge_needs.cpp: which terms decide
  ClusterDEM::PowerParts power_parts(int i) const;
  void note_forces();
  void note_whole(int i);
  void note_breakup(int i);
  int needed_to_merge(int i, int n) const;

  // fix_cluster_breakmerge_apply.cpp: the events themselves
  void become(int i, int n, const ClusterDEM::Vec3 &x, const ClusterDEM::Vec3 &v);
  void create_fragments(const Event &, tagint first);
  void delete_dying();
};

}    // namespace LAMMPS_NS

#endif
#endif
