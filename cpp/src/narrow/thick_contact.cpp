// SPDX-License-Identifier: Apache-2.0
// Minimum separation breaks the cubic, so time is divided instead. Over a cell take a direction
// n(t), linear between the unit witnesses of the distance at both ends; |n(t)| <= 1. For every
// corner V_i of the polygon n(t) . V_i(t) is a quadratic; if its Bernstein coefficients all exceed
// thickness, so does the distance throughout. For a turning face n(t) follows the normal to second
// order in the width, so a grazing approach costs a few cells per halving instead of ever more.
#include "thick_contact.hpp"

#include <algorithm>
#include <cmath>

#include "carom/numerics/tolerance.hpp"

#include "polygon.hpp"

namespace carom::narrow {
namespace {

// With components below 2: difference, interpolation, unit direction and dot product are off by
// less than 60 u together; distances likewise.
constexpr double rounding = 128 * tolerance::unit_roundoff;
// Nearer than this, of the largest corner, directions are made better than division gives them: the
// nearest point's rounding of some u turns them by u over this, which far corners would show. A
// choice of speed alone: any unit direction is a valid witness.
constexpr double careful = 1e-4;
constexpr double time_width = 0x1p-31;  // below half of tolerance::contact_time
constexpr int max_depth = 46;           // here a cell's motion is below thickness_slack
constexpr int max_cells = 1 << 14;  // bounds the time; of 37,800 hard cases the worst took 2,685

struct Cell {
  double start, width;
};

// A unit direction along which all corners lie as far out as can be told: that of the nearest point
// `from`, or, where that is so near that its rounding u turns it by more than a far corner bears,
// the same made orthogonal to the edge it lies on. Any unit vector is a valid witness.
template <int Corners>
Eigen::Vector3d witness(const Polygon<Corners>& v, const Eigen::Vector3d& from) {
  const auto least_along = [&](const Eigen::Vector3d& n) {
    double least = n.dot(v[0]);
    for (int i = 1; i < Corners; ++i) least = std::min(least, n.dot(v[i]));
    return least;
  };
  Eigen::Vector3d best = from / from.norm();
  double most = least_along(best);
  const Eigen::Vector3d plain = best;
  const auto offer = [&](const Eigen::Vector3d& n) {
    const double length = n.norm();
    if (!(length > 0)) return;
    const double least = least_along(n / length);
    if (least > most) most = least, best = n / length;
  };
  for (int i = 0; i < Corners; ++i) {
    const Eigen::Vector3d edge = v[(i + 1) % Corners] - v[i];
    const double length = edge.squaredNorm();
    if (length > 0) offer(plain - (plain.dot(edge) / length) * edge);
  }
  const Eigen::Vector3d normal = (v[1] - v[0]).cross(v[2] - v[1]);
  offer(normal.dot(plain) < 0 ? Eigen::Vector3d(-normal) : normal);
  return best;
}

}  // namespace

template <int Corners>
CcdHit thick_contact(const double* query, double thickness, int* cells) {
  Polygon<Corners> a = corner_differences<Corners>(query, 0);
  Polygon<Corners> b = corner_differences<Corners>(query, 1);
  const auto largest = [&] {
    double m = 0;
    for (int i = 0; i < Corners; ++i)
      m = std::max({m, a[i].cwiseAbs().maxCoeff(), b[i].cwiseAbs().maxCoeff()});
    return m;
  };
  double size = largest();
  if (!std::isfinite(size)) {  // differences of numbers near the largest double
    double quarter[24];
    for (int i = 0; i < 24; ++i) quarter[i] = query[i] / 4;
    a = corner_differences<Corners>(quarter, 0);
    b = corner_differences<Corners>(quarter, 1);
    thickness /= 4;
    size = largest();
  }
  if (cells != nullptr) *cells = 0;
  if (thickness >= 4 * size) return {true, 0, CcdStatus::certified};  // every corner is this near
  const int exponent = std::ilogb(size);
  for (int i = 0; i < Corners; ++i)
    for (int k = 0; k < 3; ++k) {
      a[i][k] = std::ldexp(a[i][k], -exponent);
      b[i][k] = std::ldexp(b[i][k], -exponent);
    }
  const double reach = std::ldexp(thickness, -exponent);
  const double slack = tolerance::thickness_slack * (reach + 1) / 2;

  Cell stack[max_depth + 2];
  int size_of_stack = 1;
  stack[0] = {0, 1};
  for (int count = 1; size_of_stack > 0; ++count) {
    if (cells != nullptr) *cells = count;
    const Cell cell = stack[--size_of_stack];
    const double middle = cell.start + 0.5 * cell.width, end = cell.start + cell.width;
    const Polygon<Corners> first = interpolated<Corners>(a, b, cell.start);
    const Polygon<Corners> last = interpolated<Corners>(a, b, end);
    const Eigen::Vector3d from = nearest_to_origin<Corners>(first);
    const Eigen::Vector3d to = nearest_to_origin<Corners>(last);
    const double at_start = from.norm(), at_end = to.norm();
    if (at_start <= reach + rounding)
      return {true, cell.start,
              at_start <= reach - rounding ? CcdStatus::certified : CcdStatus::conservative};
    if (at_end > reach) {
      const bool near = std::min(at_start, at_end) < careful;
      const Eigen::Vector3d n0 = near ? witness<Corners>(first, from) : from / at_start;
      const Eigen::Vector3d n1 = near ? witness<Corners>(last, to) : to / at_end;
      double least = reach + 1;
      for (int i = 0; i < Corners; ++i)
        least = std::min(
            {least, n0.dot(first[i]), n1.dot(last[i]), 0.5 * (n0.dot(last[i]) + n1.dot(first[i]))});
      if (least > reach + rounding) continue;
    }
    if (cell.width <= time_width) {
      if (at_end <= reach - rounding) return {true, cell.start, CcdStatus::certified};
      if (std::min(at_start, at_end) <= reach + slack)
        return {true, cell.start, CcdStatus::conservative};
    }
    if (cell.width < std::ldexp(1.0, 1 - max_depth) || count >= max_cells)
      return {true, cell.start, CcdStatus::conservative};
    stack[size_of_stack++] = {middle, 0.5 * cell.width};
    stack[size_of_stack++] = {cell.start, 0.5 * cell.width};
  }
  return {};
}

template CcdHit thick_contact<3>(const double*, double, int*);
template CcdHit thick_contact<4>(const double*, double, int*);

}  // namespace carom::narrow
