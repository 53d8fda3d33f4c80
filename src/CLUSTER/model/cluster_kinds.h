// Which primary particles the clusters of each atom type hold, and how many at least and at most.

#ifndef CLUSTERDEM_CLUSTER_KINDS_H
#define CLUSTERDEM_CLUSTER_KINDS_H

#include "cluster.h"

#include <algorithm>
#include <vector>

namespace ClusterDEM {

class ClusterKinds {
 public:
  explicit ClusterKinds(int types) : kinds_(1), kind_of_type_(types + 1, 0) {}

  SizeLimits limits;

  // kind 0 is that of the command, the others those of keyword kind
  int count() const { return static_cast<int>(kinds_.size()); }
  ClusterGeometry &kind(int k) { return kinds_[k]; }
  const ClusterGeometry &kind(int k) const { return kinds_[k]; }
  int of_type(int type) const { return kind_of_type_[type]; }
  const ClusterGeometry &geometry(int type) const { return kinds_[kind_of_type_[type]]; }

  void add(int type, const ClusterGeometry &geometry)
  {
    kind_of_type_[type] = count();
    kinds_.push_back(geometry);
  }
  void set_voidage(double voidage)
  {
    for (ClusterGeometry &k : kinds_) k.voidage = voidage;
  }

  double largest_diameter() const
  {
    double largest = 0.0;
    for (const ClusterGeometry &k : kinds_) largest = std::max(largest, k.diameter(limits.hi));
    return largest;
  }
  double smallest_diameter() const
  {
    double smallest = INFINITY;
    for (const ClusterGeometry &k : kinds_) smallest = std::min(smallest, k.diameter(limits.lo));
    return smallest;
  }

 private:
  std::vector<ClusterGeometry> kinds_;
  std::vector<int> kind_of_type_;
};

// Somebody who knows them, and tells others: fix cluster/breakmerge.
class KnowsClusterKinds {
 public:
  virtual const ClusterKinds &cluster_kinds() const = 0;

 protected:
  ~KnowsClusterKinds() = default;
};

}    // namespace ClusterDEM
#endif
