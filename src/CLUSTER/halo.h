/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// What clusters tell each other across ranks and periodic sides. A rank holds owned clusters first, then ghosts, which are
// images of owned ones, its own or those of other ranks. No engine and no MPI here: the unit tests have ranks of their own.

#ifndef LMP_HALO_H
#define LMP_HALO_H

#include <cstring>
#include <type_traits>
#include <vector>

namespace LAMMPS_NS {

class Halo {
 public:
  virtual ~Halo() = default;

  // every ghost takes the value of its owner; one value per cluster, owned and ghosts
  template <class T> void forward(std::vector<T> &values)
  {
    One<T> parcel(values);
    send_forward(parcel);
  }

  // every owner takes in the values of its ghosts, one after the other: combine(mine, theirs)
  template <class T, class Combine> void reverse(std::vector<T> &values, Combine combine)
  {
    Combined<T, Combine> parcel(values, combine);
    send_reverse(parcel);
  }

  // the same for lists, which are joined
  template <class T> void reverse_lists(std::vector<std::vector<T>> &lists)
  {
    Joined<T> parcel(lists);
    send_reverse_lists(parcel);
  }

  virtual bool anywhere(bool here) = 0;    // on any rank

  // the largest message about one cluster, but for lists
  static constexpr int MOST_DOUBLES = 8;

  // What one exchange carries of a cluster, in numbers of the engine's messages.
  struct Parcel {
    virtual ~Parcel() = default;
    virtual int size(int i) const = 0;
    virtual int pack(int i, double *to) const = 0;
    virtual int unpack(int i, const double *from) = 0;
  };

 protected:
  virtual void send_forward(Parcel &) = 0;
  virtual void send_reverse(Parcel &) = 0;
  virtual void send_reverse_lists(Parcel &) = 0;

 private:
  template <class T> static constexpr int doubles()
  {
    static_assert(std::is_trivially_copyable_v<T>, "only plain data can be sent");
    return static_cast<int>((sizeof(T) + sizeof(double) - 1) / sizeof(double));
  }

  template <class T> struct One : Parcel {
    static_assert(doubles<T>() <= MOST_DOUBLES, "buffers are made for less");
    std::vector<T> &values;
    explicit One(std::vector<T> &v) : values(v) {}
    int size(int) const override { return doubles<T>(); }
    int pack(int i, double *to) const override
    {
      memcpy(to, &values[i], sizeof(T));
      return doubles<T>();
    }
    int unpack(int i, const double *from) override
    {
      memcpy(static_cast<void *>(&values[i]), from, sizeof(T));
      return doubles<T>();
    }
  };

  template <class T, class Combine> struct Combined : One<T> {
    Combine combine;
    Combined(std::vector<T> &v, Combine c) : One<T>(v), combine(c) {}
    int unpack(int i, const double *from) override
    {
      T theirs;
      memcpy(static_cast<void *>(&theirs), from, sizeof(T));
      combine(this->values[i], theirs);
      return doubles<T>();
    }
  };

  template <class T> struct Joined : Parcel {
    std::vector<std::vector<T>> &lists;
    explicit Joined(std::vector<std::vector<T>> &l) : lists(l) {}
    int size(int i) const override { return 1 + doubles<T>() * static_cast<int>(lists[i].size()); }
    int pack(int i, double *to) const override
    {
      *to++ = static_cast<double>(lists[i].size());
      for (const T &item : lists[i]) {
        memcpy(to, &item, sizeof(T));
        to += doubles<T>();
      }
      return size(i);
    }
    int unpack(int i, const double *from) override
    {
      const auto n = static_cast<int>(*from++);
      for (int k = 0; k < n; k++, from += doubles<T>()) {
        T item;
        memcpy(static_cast<void *>(&item), from, sizeof(T));
        lists[i].push_back(item);
      }
      return 1 + doubles<T>() * n;
    }
  };
};

}    // namespace LAMMPS_NS
#endif
