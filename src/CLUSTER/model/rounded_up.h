/* ----------------------------------------------------------------------
   Cluster DEM for LAMMPS. Distributed under the GNU General Public License, version 2 or later.
------------------------------------------------------------------------- */

// A threshold as a message tells it: few digits, and what is typed from the message meets the threshold.

#ifndef CLUSTER_MODEL_ROUNDED_UP_H
#define CLUSTER_MODEL_ROUNDED_UP_H

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

namespace ClusterDEM {

// the smallest number of `digits` decimal digits (at most 15) that is not below x > 0
inline std::string rounded_up(double x, int digits = 4)
{
  char text[64];
  std::snprintf(text, sizeof text, "%.*e", digits - 1, x);    // d.ddde-XX, rounded to the nearest
  if (std::strtod(text, nullptr) < x) {
    const int exponent = std::atoi(std::strchr(text, 'e') + 1) - (digits - 1);
    const long whole = std::lround(std::atof(text) / std::pow(10.0, exponent)) + 1;
    std::snprintf(text, sizeof text, "%lde%d", whole, exponent);
  }
  std::snprintf(text, sizeof text, "%.*g", digits, std::strtod(text, nullptr));
  return text;
}

}    // namespace ClusterDEM
#endif
