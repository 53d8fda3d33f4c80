/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

#include "contact_sums.h"

#include "atom.h"
#include "force.h"

#include <algorithm>

using namespace LAMMPS_NS;

/* ----------------------------------------------------------------------
   with newton on, half of the pairs across ranks are known to the other side alone
------------------------------------------------------------------------- */

void ContactSums::add_up(const BreakMergeSettings &settings)
{
  const int nlocal = atom->nlocal;
  const int nall = nlocal + atom->nghost;
  const bool want_power = settings.size.looks_at_power();
  const bool want_sums = want_power || settings.event.test == EventSettings::IN_CONTACT;
  const bool want_ids = settings.event.test == EventSettings::CONTACT_ENDED;

  total = 0.0;
  if (want_sums) sums.assign(nall, {0.0, 0});
  if (want_ids) {
    touching.resize(std::max(static_cast<std::size_t>(nall), touching.size()));
    for (int i = 0; i < nall; i++) touching[i].clear();
  }

  pairs.find_contacts();
  for (const auto &contact : pairs.contacts()) {
    const int i = contact.i, j = contact.j;
    const bool both = force->newton_pair || j < nlocal;
    ContactSource::Load load = {0.0, 0.0};
    if (want_power || contact.noted) load = pairs.load(contact);
    total += load.force * ((atom->mask[i] & groupbit ? 1 : 0) + (both && atom->mask[j] & groupbit ? 1 : 0));
    if (want_sums) {
      sums[i].power += load.power;
      sums[i].number++;
      if (both) {
        sums[j].power += load.power;
        sums[j].number++;
      }
    }
    if (want_ids) {
      touching[i].push_back(atom->tag[j]);
      if (both) touching[j].push_back(atom->tag[i]);
    }
  }
  if (!force->newton_pair) return;
  if (want_sums)
    halo.reverse(sums, [](Sum &mine, const Sum &theirs) {
      mine.power += theirs.power;
      mine.number += theirs.number;
    });
  if (want_ids) halo.reverse_lists(touching);
}

/* ---------------------------------------------------------------------- */

bool ContactSums::ended_since(std::vector<tagint> &before, int i)
{
  std::vector<tagint> &now = touching[i];
  std::sort(now.begin(), now.end());
  now.erase(std::unique(now.begin(), now.end()), now.end());
  const bool ended = !std::includes(now.begin(), now.end(), before.begin(), before.end());
  before = now;
  return ended;
}
