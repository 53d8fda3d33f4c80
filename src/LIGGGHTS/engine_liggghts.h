/* ----------------------------------------------------------------------
   Cluster DEM for LIGGGHTS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// LIGGGHTS 3.8 in the words of LAMMPS, as far as the fixes drag/cluster and cluster/breakmerge use them: their source in
// src/CLUSTER is that of both engines. LIGGGHTS left LAMMPS in 2013; what has another name there is said here.

#ifndef LMP_ENGINE_LIGGGHTS_H
#define LMP_ENGINE_LIGGGHTS_H

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix.h"
#include "force.h"
#include "modify.h"
#include "neighbor.h"
#include "pair.h"
#include "pointers.h"

#include "format_liggghts.h"
#include "model/rounded_up.h"

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

namespace LAMMPS_NS {

// Messages with values in them. What begins with "Fix STYLE ID" or "Fix STYLE" is said as LIGGGHTS says
// it: Fix STYLE (id ID): …
class ErrorWords {
 public:
  ErrorWords(Error *e, Fix *f = nullptr) : real(e), fix(f) {}

  template <class... Args>
  [[noreturn]] void all(const char *file, int line, const std::string &text, const Args &...args)
  {
    const std::string message = fmt::format(text, args...);
    if (fix)
      for (const std::string &me :
           {fmt::format("Fix {} {}", fix->style, fix->id), fmt::format("Fix {} ", fix->style)})
        if (message.compare(0, me.size(), me) == 0)
          real->fix_error(
              file, line, fix,
              message.substr(std::min(message.find_first_not_of(": ", me.size()), message.size())).c_str());
    real->all(file, line, in_its_words(message).c_str());
    std::abort();    // never reached: LIGGGHTS does not say that all() does not return
  }
  void warning(const char *file, int line, const std::string &message)
  {
    real->warning(file, line, message.c_str());
  }
  // LAMMPS marks the word `caret` of the input line; LIGGGHTS cannot
  template <class... Args>
  [[noreturn]] void all(const char *file, int line, int /*caret*/, const std::string &text, const Args &...args)
  {
    all(file, line, text, args...);
  }
  template <class... Args>
  [[noreturn]] void one(const char *file, int line, const std::string &text, const Args &...args)
  {
    const std::string message = fmt::format(text, args...);
    // LIGGGHTS prints to a buffer, which MPI_Abort loses where the output is no terminal
    std::fprintf(stderr, "ERROR: %s\n", message.c_str());
    real->one(file, line, message.c_str());
    std::abort();
  }
  template <class... Args>
  [[noreturn]] void one(const char *file, int line, int /*caret*/, const std::string &text, const Args &...args)
  {
    one(file, line, text, args...);
  }

 private:
  Error *real;
  Fix *fix;    // whose words these are; its rooms know its name alone

  // "Fix STYLE ID: …" as LIGGGHTS says it
  static std::string in_its_words(const std::string &message)
  {
    const std::size_t style = 4, id = message.find(' ', style) + 1, end = message.find(':', id);
    if (message.compare(0, style, "Fix ") || !id || end == std::string::npos || message.find(' ', id) < end)
      return message;
    return message.substr(0, id) + "(id " + message.substr(id, end - id) + ")" + message.substr(end);
  }
};

class ModifyWords {
 public:
  explicit ModifyWords(Modify *m) : real(m) {}

  std::vector<Fix *> get_fix_list() const { return {real->fix, real->fix + real->nfix}; }
  std::vector<Fix *> get_fix_by_style(const std::string &pattern) const
  {
    std::vector<Fix *> found;
    for (Fix *fix : get_fix_list())
      if (utils::strmatch(fix->style, pattern)) found.push_back(fix);
    return found;
  }
  Fix *get_fix_by_id(const std::string &id) const
  {
    const int k = real->find_fix(id.c_str());
    return k < 0 ? nullptr : real->fix[k];
  }
  void create_attribute(int i) const
  {
    for (Fix *fix : get_fix_list())
      if (fix->create_attribute) fix->set_arrays(i);
  }
  void clearstep_compute() { real->clearstep_compute(); }
  void addstep_compute(bigint step) { real->addstep_compute(step); }

 private:
  Modify *real;
};

class CommWords {
 public:
  const int &me, &nprocs, &ghost_velocity;
  const int *procgrid;
  const double *cutghost, &cutghostuser;

  explicit CommWords(Comm *c) :
      me(c->me), nprocs(c->nprocs), ghost_velocity(c->ghost_velocity), procgrid(c->procgrid),
      cutghost(c->cutghost), cutghostuser(c->cutghostuser), real(c)
  {
  }

  void forward_comm() { real->forward_comm(); }

 private:
  Comm *real;
};

class EnginePointers : protected Pointers {
 public:
  explicit EnginePointers(LAMMPS *lmp) : Pointers(lmp), error_words(Pointers::error), error(&error_words) {}

 private:
  ErrorWords error_words;

 protected:
  ErrorWords *error;
};

class EngineFix : public Fix {
 public:
  EngineFix(LAMMPS *lmp, int narg, char **arg) :
      Fix(lmp, narg, arg), error_words(Fix::error, this), modify_words(Fix::modify), comm_words(Fix::comm),
      error(&error_words), modify(&modify_words), comm(&comm_words)
  {
  }
  EngineFix(const EngineFix &) = delete;
  EngineFix &operator=(const EngineFix &) = delete;

  // what LAMMPS calls by these names; of the grid's communication there is none here
  virtual int pack_forward_comm(int, int *, double *, int, int *) { return 0; }
  virtual void unpack_forward_comm(int, int, double *) {}
  virtual int pack_reverse_comm_size(int, int) { return 0; }
  virtual void reset_grid() {}
  virtual void pack_forward_grid(int, void *, int, int *) {}
  virtual void unpack_forward_grid(int, void *, int, int *) {}
  virtual void pack_reverse_grid(int, void *, int, int *) {}
  virtual void unpack_reverse_grid(int, void *, int, int *) {}

  int pack_comm(int n, int *list, double *buf, int pbc_flag, int *pbc) final
  {
    pack_forward_comm(n, list, buf, pbc_flag, pbc);
    return comm_forward;
  }
  void unpack_comm(int n, int first, double *buf) final { unpack_forward_comm(n, first, buf); }

 private:
  ErrorWords error_words;
  ModifyWords modify_words;
  CommWords comm_words;

 protected:
  struct Atom {
    enum { GROW = 0, RESTART = 1 };
  };
  ErrorWords *error;
  ModifyWords *modify;
  CommWords *comm;
  int maxexchange = 0, maxexchange_dynamic = 0, pergrid_flag = 0;
};

// the size of a message, for one cluster, is asked back by pack_comm(); buffers are made for the largest
inline void forward_values(Comm *comm, Fix *fix, int size)
{
  const int most = fix->comm_forward;
  fix->comm_forward = size;
  comm->forward_comm_fix(fix);
  fix->comm_forward = most;
}
// newton is off: a rank knows all contacts of its clusters
inline void reverse_values(Comm *, Fix *, int) {}
inline void reverse_lists_of_values(Comm *, Fix *) {}

inline void use_hash_map(Atom *atom, const Domain *domain)
{
  if (atom->map_style) return;
  atom->map_style = 2;
  if (domain->box_exist) {
    atom->nghost = 0;
    atom->map_init();
    atom->map_set();
  }
}

inline std::vector<Fix *> all_fixes(LAMMPS *lmp)
{
  return ModifyWords(lmp->modify).get_fix_list();
}
inline std::vector<Fix *> find_fixes(LAMMPS *lmp, const std::string &style)
{
  return ModifyWords(lmp->modify).get_fix_by_style(style);
}

inline Fix *find_fix(LAMMPS *lmp, const std::string &id)
{
  return ModifyWords(lmp->modify).get_fix_by_id(id);
}

// Particles of fix insert/stream move with the stream until the step of their release, which the fix keeps for each: behind
// the place of insertion the step of insertion, 0 for all others, and that of release.
class MotionOfOthers {
 public:
  void find(LAMMPS *lmp)
  {
    const int k = lmp->modify->find_fix("release_fix_insert_stream");
    release = k < 0 ? nullptr : lmp->modify->fix[k];
  }
  bool holds(int i, bigint step) const
  {
    if (!release) return false;
    const double *row = release->array_atom[i];
    return row[3] != 0.0 && static_cast<double>(step) <= row[4];
  }

 private:
  Fix *release = nullptr;
};

// fixes whose values for an atom tell of its contacts, not of itself
inline std::vector<Fix *> fixes_that_remember_contacts(LAMMPS *lmp)
{
  std::vector<Fix *> found;
  for (const char *style : {"contacthistory", "contactproperty"})
    for (Fix *fix : find_fixes(lmp, style)) found.push_back(fix);
  return found;
}

// LIGGGHTS sorts dumps without a shortcut (LAMMPS: src/CLUSTER/sorted_dumps.h)
inline void sort_dumps_in_earnest(LAMMPS *) {}

inline void set_density(Atom *atom, int i, double density)
{
  atom->density[i] = density;
}

inline void prepare_regions(const std::vector<Region *> &) {}
inline std::string region_without_sides(const Region *)
{
  return "";
}

inline Region *region_of(Domain *domain, const std::string &id)
{
  const int k = domain->find_region(id.c_str());
  return k < 0 ? nullptr : domain->regions[k];
}

// what binds clusters behind the back of their breakups and merges
inline std::string not_for_clusters(LAMMPS *lmp, int)
{
  if (lmp->domain->triclinic) return "triclinic boxes";
  if (lmp->atom->molecular) return "molecules: use an atom style without bonds";
  return "";
}

// LIGGGHTS sends an atom only over half of the cutoff, half of the skin and its own radius: enough for contacts
inline double ghost_reach(LAMMPS *lmp, int, double radius)
{
  return 0.5 *
      (std::max(lmp->force->pair->cutforce + lmp->neighbor->skin, lmp->comm->cutghostuser) + lmp->neighbor->skin) +
      radius;
}
inline std::string ghosts_of_a_type(LAMMPS *, int)
{
  return "";
}
inline std::string ask_for_ghosts(LAMMPS *lmp, double reach)
{
  return fmt::format("communicate single vel yes cutoff {}",
                     ClusterDEM::rounded_up(2.0 * reach - lmp->neighbor->skin));
}

}    // namespace LAMMPS_NS
#endif
