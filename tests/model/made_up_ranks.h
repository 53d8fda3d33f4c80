// Ranks without MPI: a thread each, with the clusters of a strip of a box that is periodic in x. They talk as the engine's do:
// ghosts are images of owned clusters, within a cutoff of the strip.

#ifndef CLUSTERDEM_MADE_UP_RANKS_H
#define CLUSTERDEM_MADE_UP_RANKS_H

#include "halo.h"

#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace MadeUp {

class Barrier {
 public:
  explicit Barrier(int n) : n_(n) {}
  void wait()
  {
    std::unique_lock<std::mutex> lock(mutex_);
    const long turn = turn_;
    if (++here_ == n_) {
      here_ = 0;
      turn_++;
      all_.notify_all();
    } else all_.wait(lock, [&] { return turn_ != turn; });
  }

 private:
  const int n_;
  int here_ = 0;
  long turn_ = 0;
  std::mutex mutex_;
  std::condition_variable all_;
};

struct Owner {
  int rank, index;
};

// what all ranks share
struct World {
  explicit World(int ranks) : barrier(ranks), parcels(ranks), flags(ranks), ghosts(ranks), owned(ranks) {}
  Barrier barrier;
  std::vector<LAMMPS_NS::Halo::Parcel *> parcels;
  std::vector<char> flags;
  std::vector<std::vector<Owner>> ghosts;    // of each rank: whose images they are
  std::vector<int> owned;
};

class RankHalo : public LAMMPS_NS::Halo {
 public:
  RankHalo(World &w, int rank) : world(w), me(rank) {}

  bool anywhere(bool here) override
  {
    world.flags[me] = here;
    world.barrier.wait();
    bool any = false;
    for (const char flag : world.flags) any = any || flag;
    world.barrier.wait();
    return any;
  }

 private:
  World &world;
  int me;

  void send_forward(Parcel &parcel) override
  {
    world.parcels[me] = &parcel;
    world.barrier.wait();
    double message[MOST_DOUBLES];
    for (std::size_t g = 0; g < world.ghosts[me].size(); g++) {
      const Owner &owner = world.ghosts[me][g];
      world.parcels[owner.rank]->pack(owner.index, message);
      parcel.unpack(world.owned[me] + static_cast<int>(g), message);
    }
    world.barrier.wait();
  }

  void send_reverse(Parcel &parcel) override
  {
    world.parcels[me] = &parcel;
    world.barrier.wait();
    for (std::size_t rank = 0; rank < world.ghosts.size(); rank++)
      for (std::size_t g = 0; g < world.ghosts[rank].size(); g++) {
        const Owner &owner = world.ghosts[rank][g];
        if (owner.rank != me) continue;
        const int ghost = world.owned[rank] + static_cast<int>(g);
        std::vector<double> message(world.parcels[rank]->size(ghost));
        world.parcels[rank]->pack(ghost, message.data());
        parcel.unpack(owner.index, message.data());
      }
    world.barrier.wait();
  }
  void send_reverse_lists(Parcel &parcel) override { send_reverse(parcel); }
};

inline void run(int ranks, const std::function<void(int)> &on_rank)
{
  std::vector<std::thread> threads;
  for (int rank = 0; rank < ranks; rank++) threads.emplace_back(on_rank, rank);
  for (auto &thread : threads) thread.join();
}

}    // namespace MadeUp
#endif
