/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// Reads the words of a command one after the other. Every refusal names the word, the value
// and the rule, and LAMMPS prints the input line with a caret under the word.

#ifndef LMP_STYLE_ARGUMENTS_H
#define LMP_STYLE_ARGUMENTS_H

#include "engine.h"
#include "error.h"
#include "input.h"
#include "pointers.h"

#include <cmath>
#include <cstdlib>
#include <initializer_list>
#include <string>

namespace LAMMPS_NS {

class StyleArguments : protected EnginePointers {
 public:
  // of a fix: ID group style and what follows
  StyleArguments(LAMMPS *lmp, int narg, char **arg, int first) :
      EnginePointers(lmp), narg_(narg), arg_(arg), i_(first), offset_(0), command_(std::string("fix ") + arg[2])
  {
  }
  // of any other command that hands over the words after its first ones; `command` names it in messages
  StyleArguments(LAMMPS *lmp, const std::string &command, int narg, char **arg) :
      EnginePointers(lmp), narg_(narg), arg_(arg), i_(0), offset_(static_cast<int>(arg - input->arg)),
      command_(command)
  {
  }

  bool more() const { return i_ < narg_; }
  bool next_is(const char *word) const { return more() && peek() == word; }
  std::string peek() const { return arg_[i_]; }
  std::string last() const { return arg_[i_ - 1]; }
  int caret() const { return offset_ + i_ - 1; }    // where LAMMPS' caret goes for the word read last

  // the keyword or value that stands next; `what` names it in the message when it is missing
  std::string word(const std::string &what)
  {
    if (!more()) error->all(FLERR, "Illegal {} command: missing {}", command_, what);
    return arg_[i_++];
  }

  [[noreturn]] void refuse(const std::string &what, const std::string &rule) const
  {
    error->all(FLERR, caret(), "Illegal {} {} value: {} (must be {})", command_, what, arg_[i_ - 1], rule);
  }

  [[noreturn]] void unknown_keyword() const
  {
    error->all(FLERR, caret(), "Unknown {} keyword: {}", command_, arg_[i_ - 1]);
  }

  // words that do not go together, or one that is missing
  [[noreturn]] void incomplete(const std::string &why) const
  {
    error->all(FLERR, "Illegal {} command: {}", command_, why);
  }

  double number(const std::string &what, const std::string &rule = "a finite number")
  {
    const std::string value = word(what);
    if (!utils::is_double(value)) refuse(what, rule);
    const double x = std::strtod(value.c_str(), nullptr);    // infinite where LAMMPS' own stops without a caret
    if (!std::isfinite(x)) refuse(what, rule);
    return x;
  }
  double positive(const std::string &what, const std::string &unit = "")
  {
    const std::string rule = "a number > 0" + (unit.empty() ? "" : " [" + unit + "]");
    const double x = number(what, rule);
    if (!(x > 0.0)) refuse(what, rule);
    return x;
  }
  double within(const std::string &what, double lo, double hi)
  {
    const std::string rule = fmt::format("a number from {} to {}", lo, hi);
    const double x = number(what, rule);
    if (!(x >= lo && x <= hi)) refuse(what, rule);
    return x;
  }
  int integer(const std::string &what, int lo)
  {
    const std::string rule = fmt::format("an integer from {} to {}", lo, MAXSMALLINT);
    const std::string value = word(what);
    if (!utils::is_integer(value)) refuse(what, rule);
    // as a double first: a value beyond the range of int is refused here, in these words
    const double x = std::strtod(value.c_str(), nullptr);
    if (x < lo || x > MAXSMALLINT) refuse(what, rule);
    return static_cast<int>(x);
  }

  // one of a few words; gives its position
  int choice(const std::string &what, std::initializer_list<const char *> words)
  {
    const std::string value = word(what);
    std::string rule;
    int k = 0;
    for (const char *w : words) {
      if (value == w) return k;
      rule += (k++ ? " | " : "") + std::string(w);
    }
    refuse(what, rule);
  }
  bool yes(const std::string &what) { return choice(what, {"no", "yes"}) == 1; }

 private:
  int narg_;
  char **arg_;
  int i_;
  int offset_;    // of arg_ in the command that LAMMPS points into
  std::string command_;
};

}    // namespace LAMMPS_NS
#endif
