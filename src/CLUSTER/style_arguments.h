/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// Reads the words of a fix command one after the other. Every refusal names the word, the value
// and the rule, and LAMMPS prints the input line with a caret under the word.

#ifndef LMP_STYLE_ARGUMENTS_H
#define LMP_STYLE_ARGUMENTS_H

#include "error.h"
#include "pointers.h"
#include "utils.h"

#include <cmath>
#include <initializer_list>
#include <string>

namespace LAMMPS_NS {

class StyleArguments : protected Pointers {
 public:
  StyleArguments(LAMMPS *lmp, int narg, char **arg, int first) :
      Pointers(lmp), narg_(narg), arg_(arg), i_(first), style_(arg[2])
  {
  }

  bool more() const { return i_ < narg_; }
  bool next_is(const char *word) const { return more() && peek() == word; }
  std::string peek() const { return arg_[i_]; }
  std::string last() const { return arg_[i_ - 1]; }

  // the keyword or value that stands next; `what` names it in the message when it is missing
  std::string word(const std::string &what)
  {
    if (!more()) error->all(FLERR, "Illegal fix {} command: missing {}", style_, what);
    return arg_[i_++];
  }

  [[noreturn]] void refuse(const std::string &what, const std::string &rule) const
  {
    error->all(FLERR, i_ - 1, "Illegal fix {} {} value: {} (must be {})", style_, what, arg_[i_ - 1],
               rule);
  }

  [[noreturn]] void unknown_keyword() const
  {
    error->all(FLERR, i_ - 1, "Unknown fix {} keyword: {}", style_, arg_[i_ - 1]);
  }

  double number(const std::string &what, const std::string &rule = "a finite number")
  {
    const std::string value = word(what);
    if (!utils::is_double(value)) refuse(what, rule);
    const double x = utils::numeric(FLERR, value, false, lmp);
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
    const double x = std::stod(value);
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

  const std::string &style() const { return style_; }

 private:
  int narg_;
  char **arg_;
  int i_;
  std::string style_;
};

}    // namespace LAMMPS_NS
#endif
