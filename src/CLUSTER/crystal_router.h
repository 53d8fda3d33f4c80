/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// Moves a few items to whatever ranks they are addressed to, as a crystal router does (Fox et al., Solving Problems on
// Concurrent Processors, 1988): the ranks are halved, what is for the other half goes there in one message, and so on. A rank
// sends log2 of the number of ranks messages and keeps nothing whose length is that number; LAMMPS' own irregular
// communication adds up an array of a counter per rank first.

#ifndef LMP_CRYSTAL_ROUTER_H
#define LMP_CRYSTAL_ROUTER_H

#include <mpi.h>

#include <algorithm>
#include <vector>

namespace LAMMPS_NS {

class CrystalRouter {
 public:
  explicit CrystalRouter(MPI_Comm world) : world_(world)
  {
    MPI_Comm_rank(world, &me_);
    MPI_Comm_size(world, &nprocs_);
  }

  // collective; afterwards `items` are those whose `to` is this rank, in the same order in every run
  template <class Item> void route(std::vector<Item> &items, int Item::*to) const
  {
    int first = 0;    // I am among `count` ranks from here
    for (int count = nprocs_; count > 1;) {
      const int half = (count + 1) / 2;    // the lower half has one more if the number is odd
      const bool upper = me_ >= first + half;
      const auto stay = std::stable_partition(
          items.begin(), items.end(), [&](const Item &item) { return (item.*to >= first + half) == upper; });
      std::vector<Item> leaving(stay, items.end());
      items.erase(stay, items.end());

      // the one more has no partner: it sends to that of its neighbor, who is sent two messages
      const int last = first + count - 1;
      const int partner = upper ? me_ - half : std::min(me_ + half, last);
      MPI_Request request;
      send(leaving, partner, request);
      if (upper || me_ + half <= last) receive(items, partner);
      if (upper && me_ == last && count % 2) receive(items, first + half - 1);
      MPI_Wait(&request, MPI_STATUS_IGNORE);
      if (upper) {
        first += half;
        count -= half;
      } else count = half;
    }
  }

 private:
  static constexpr int TAG = 1988;    // LAMMPS' own messages have the tag 0
  MPI_Comm world_;
  int me_, nprocs_;

  template <class Item> void send(const std::vector<Item> &items, int partner, MPI_Request &request) const
  {
    MPI_Isend(items.data(), static_cast<int>(items.size() * sizeof(Item)), MPI_BYTE, partner, TAG, world_,
              &request);
  }

  template <class Item> void receive(std::vector<Item> &items, int partner) const
  {
    MPI_Status status;
    MPI_Probe(partner, TAG, world_, &status);
    int bytes;
    MPI_Get_count(&status, MPI_BYTE, &bytes);
    const std::size_t before = items.size();
    items.resize(before + bytes / sizeof(Item));
    MPI_Recv(items.data() + before, bytes, MPI_BYTE, partner, TAG, world_, MPI_STATUS_IGNORE);
  }
};

}    // namespace LAMMPS_NS
#endif
