// One axis of a rectilinear grid: its planes, what holds beyond the outermost ones, and between which planes a
// position lies. Finding them takes the same time on any number of planes: a guide of equal bins says which few planes
// to look at (one, where the planes are evenly spaced).

#ifndef CLUSTERDEM_GRID_AXIS_H
#define CLUSTERDEM_GRID_AXIS_H

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace ClusterDEM {

// between the planes `cell` and `cell` + 1, at this share of the way
struct AxisPlace {
  int cell;
  double weight;
};

// Some of the planes of an axis, one after the other; after the last plane of the axis comes its first. A share of an
// axis that closes upon itself can hold the first plane twice: once more after the last.
struct PlaneRange {
  int first = 0, count = 1;
  bool operator==(const PlaneRange &other) const { return first == other.first && count == other.count; }
};

// where positions are folded into, however far outside they lie; no length: they are not
struct Fold {
  double lo = 0.0, length = 0.0;
  double operator()(double x) const
  {
    if (length > 0.0 && (x < lo || x >= lo + length)) return x - length * std::floor((x - lo) / length);
    return x;
  }
};

class GridAxis {
 public:
  GridAxis() : GridAxis({0.0}, Fold()) {}

  // Planes in strictly ascending order; beyond the outermost their values hold. One plane: all is uniform along the axis.
  GridAxis(std::vector<double> planes, Fold box) : nodes_(std::move(planes)), fold_(box)
  {
    planes_ = static_cast<int>(nodes_.size());
    prepare();
  }

  // Periodic: between the last plane and the first of the next period it goes on. Where the last plane lies a period
  // after the first, it is the first once more.
  static GridAxis periodic(std::vector<double> planes, double period)
  {
    if (planes.size() == 1) return GridAxis(std::move(planes), Fold());
    GridAxis axis;
    axis.closed_ = closes(planes, period);
    if (axis.closed_) planes.pop_back();
    axis.planes_ = static_cast<int>(planes.size());
    axis.fold_ = {planes.front(), period};
    planes.push_back(planes.front() + period);
    axis.nodes_ = std::move(planes);
    axis.prepare();
    return axis;
  }

  // to the digits that a file of single precision has
  static bool closes(const std::vector<double> &planes, double period)
  {
    return std::fabs(planes.back() - planes.front() - period) <= 1.0e-6 * period;
  }

  int planes() const { return planes_; }    // different ones
  bool uniform() const { return cells_ == 0; }
  bool closed() const { return closed_; }    // the file's last plane is the first once more
  double plane(int k) const { return nodes_[k]; }

  AxisPlace find(double x) const
  {
    if (uniform()) return {0, 0.0};
    x = fold_(x);
    if (!(x > nodes_.front())) return {0, 0.0};
    if (x >= nodes_.back()) return {cells_ - 1, 1.0};
    const int bin = std::min(static_cast<int>((x - nodes_.front()) * bins_per_length_), bins_ - 1);
    // one plane further than the bin's, where rounding put x into the bin below its own
    const auto above = std::upper_bound(nodes_.begin() + guide_[bin] + 1, nodes_.begin() + guide_[bin + 1] + 2, x);
    const int cell = static_cast<int>(above - nodes_.begin()) - 1;
    return {cell, (x - nodes_[cell]) * inverse_[cell]};
  }

  // planes that positions from lo to hi ask for
  PlaneRange between(double lo, double hi) const
  {
    if (uniform()) return {0, 1};
    const int first = find(lo).cell, last = find(hi).cell;
    const int count = (last - first + planes_) % planes_ + 2;
    const bool once_round =
        fold_.length > 0.0 && (hi - lo >= fold_.length || (first == last && fold_(hi) < fold_(lo)));
    if (once_round || count > cells_ + 1) return {0, cells_ + 1};
    return {first, count};
  }

  // the place of a cell within a range: from 0 to count - 2 where the range holds both of its planes
  int within(const PlaneRange &range, int cell) const
  {
    const int k = cell - range.first;
    return k < 0 ? k + planes_ : k;
  }

 private:
  std::vector<double> nodes_;    // the planes; periodic: and the first of the next period
  std::vector<double> inverse_;
  std::vector<int> guide_;    // cell at the lower end of each bin
  Fold fold_;
  double bins_per_length_ = 0.0;
  int planes_ = 1, cells_ = 0, bins_ = 0;
  bool closed_ = false;

  void prepare()
  {
    cells_ = static_cast<int>(nodes_.size()) - 1;
    if (cells_ < 1) return;
    const double length = nodes_.back() - nodes_.front();
    double narrowest = length;
    for (int k = 0; k < cells_; k++) {
      inverse_.push_back(1.0 / (nodes_[k + 1] - nodes_[k]));
      narrowest = std::min(narrowest, nodes_[k + 1] - nodes_[k]);
    }
    bins_ = static_cast<int>(std::min(std::round(length / narrowest), 16.0 * cells_));
    bins_per_length_ = bins_ / length;
    guide_.reserve(bins_ + 1);
    for (int bin = 0, cell = 0; bin <= bins_; bin++) {
      // a little lower: rounding can put a position into the bin above its own, too
      const double lower = nodes_.front() + (bin - 1.0e-9) / bins_per_length_;
      while (cell < cells_ - 1 && nodes_[cell + 1] <= lower) cell++;
      guide_.push_back(bin == bins_ ? cells_ - 1 : cell);
    }
  }
};

}    // namespace ClusterDEM
#endif
