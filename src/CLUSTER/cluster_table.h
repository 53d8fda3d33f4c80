/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// All that a fix of this package keeps per cluster, in columns of one type each. Rows are the engine's slots for atoms:
// they grow, change places, migrate and are written to restart files with the atoms, by the engine's callbacks
// (cluster_fix.h). Nothing else in the package does any of this.

#ifndef LMP_CLUSTER_TABLE_H
#define LMP_CLUSTER_TABLE_H

#include <cstring>
#include <memory>
#include <type_traits>
#include <vector>

namespace LAMMPS_NS {

class ClusterTable {
 public:
  enum Life {
    SCRATCH,    // there is a row for every slot, no more: whoever uses it fills it first
    CARRIED,    // goes with its cluster
    KEPT        // and is written to restart files
  };

  struct Column {
    Life life = SCRATCH;
    virtual ~Column() = default;
    virtual void grow(int rows) = 0;
    virtual void copy(int from, int to) = 0;
    virtual void clear(int row) = 0;
    virtual int size(int row) const = 0;    // of a message about the row, in doubles
    virtual int pack(int row, double *to) const = 0;
    virtual int unpack(int row, const double *from) = 0;
    virtual bool varies() const { return false; }    // is size() another one from row to row?
    virtual double bytes() const = 0;
  };

  // plain data; a cleared row holds T()
  template <class T> class Values : public Column {
    static_assert(std::is_trivially_copyable_v<T>, "only plain data can migrate");
    static constexpr int DOUBLES = (sizeof(T) + sizeof(double) - 1) / sizeof(double);

   public:
    T &operator[](int row) { return values[row]; }
    const T &operator[](int row) const { return values[row]; }
    const T *data() const { return values.data(); }
    void grow(int rows) override { values.resize(rows); }
    void copy(int from, int to) override { values[to] = values[from]; }
    void clear(int row) override { values[row] = T(); }
    int size(int) const override { return DOUBLES; }
    int pack(int row, double *to) const override
    {
      memcpy(to, &values[row], sizeof(T));
      return DOUBLES;
    }
    int unpack(int row, const double *from) override
    {
      memcpy(static_cast<void *>(&values[row]), from, sizeof(T));
      return DOUBLES;
    }
    double bytes() const override { return static_cast<double>(values.capacity() * sizeof(T)); }

   private:
    std::vector<T> values;
  };

  // a list per cluster
  template <class T> class Lists : public Column {
    static_assert(sizeof(T) <= sizeof(double), "one number per item");

   public:
    std::vector<T> &operator[](int row) { return lists[row]; }
    const std::vector<T> &operator[](int row) const { return lists[row]; }
    void grow(int rows) override { lists.resize(rows); }
    void copy(int from, int to) override { lists[to] = lists[from]; }
    void clear(int row) override { lists[row].clear(); }
    int size(int row) const override { return 1 + static_cast<int>(lists[row].size()); }
    bool varies() const override { return true; }
    int pack(int row, double *to) const override
    {
      *to++ = static_cast<double>(lists[row].size());
      for (const T &item : lists[row]) memcpy(to++, &item, sizeof(T));
      return size(row);
    }
    int unpack(int row, const double *from) override
    {
      lists[row].resize(static_cast<std::size_t>(*from++));
      for (T &item : lists[row]) memcpy(static_cast<void *>(&item), from++, sizeof(T));
      return size(row);
    }
    double bytes() const override
    {
      double sum = static_cast<double>(lists.capacity() * sizeof(std::vector<T>));
      for (const auto &list : lists) sum += static_cast<double>(list.capacity() * sizeof(T));
      return sum;
    }

   private:
    std::vector<std::vector<T>> lists;
  };

  // numbers that the engine reads as a per-atom array
  class Shown : public Column {
   public:
    explicit Shown(int columns) : columns(columns) {}
    double *operator[](int row) { return rows[row]; }
    const double *operator[](int row) const { return rows[row]; }
    double **array() { return rows.data(); }
    void grow(int n) override;
    void copy(int from, int to) override { memcpy(rows[to], rows[from], columns * sizeof(double)); }
    void clear(int row) override { memset(rows[row], 0, columns * sizeof(double)); }
    int size(int) const override { return columns; }
    int pack(int row, double *to) const override
    {
      memcpy(to, rows[row], columns * sizeof(double));
      return columns;
    }
    int unpack(int row, const double *from) override
    {
      memcpy(rows[row], from, columns * sizeof(double));
      return columns;
    }
    double bytes() const override { return static_cast<double>(rows.size() * (columns + 1) * sizeof(double)); }

   private:
    int columns;
    std::vector<double> numbers;
    std::vector<double *> rows;
  };

  template <class T> Values<T> &add(Life life) { return take(std::make_unique<Values<T>>(), life); }
  template <class T> Lists<T> &add_lists(Life life) { return take(std::make_unique<Lists<T>>(), life); }
  Shown &add_shown(int n) { return take(std::make_unique<Shown>(n), CARRIED); }

  bool keeps_any() const;    // is anything written to restart files?
  bool has_lists() const;    // does the size of a message differ from cluster to cluster?
  void grow(int rows);
  void copy(int from, int to);
  void clear(int row);

  // messages about one cluster, to another rank or to a restart file, in doubles
  int size(int row, Life least) const;
  int pack(int row, double *to, Life least) const;
  int unpack(int row, const double *from, Life least);

  double bytes() const;

 private:
  std::vector<std::unique_ptr<Column>> columns;

  template <class C> C &take(std::unique_ptr<C> column, Life life)
  {
    C &here = *column;
    here.life = life;
    columns.push_back(std::move(column));
    return here;
  }
};

}    // namespace LAMMPS_NS
#endif
