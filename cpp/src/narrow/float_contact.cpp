// SPDX-License-Identifier: Apache-2.0
#include "float_contact.hpp"

#include <algorithm>

#include "carom/numerics/roots.hpp"

#include "polygon.hpp"

namespace carom::narrow {
namespace {

// V_0 . (edge_0 x edge_1) along the step, ascending powers
template <int Corners>
std::array<double, 4> coplanarity_cubic(const Polygon<Corners>& a, const Polygon<Corners>& b) {
  const Eigen::Vector3d v = a[0], dv = b[0] - a[0];
  const Eigen::Vector3d e = a[1] - a[0], de = (b[1] - b[0]) - e;
  const Eigen::Vector3d g = a[2] - a[1], dg = (b[2] - b[1]) - g;
  const Eigen::Vector3d n0 = e.cross(g), n1 = e.cross(dg) + de.cross(g), n2 = de.cross(dg);
  return {v.dot(n0), v.dot(n1) + dv.dot(n0), v.dot(n2) + dv.dot(n1), dv.dot(n2)};
}

// The inside test of the notes: all sub-normals agree with the normal.
template <int Corners>
bool origin_inside(const Polygon<Corners>& v) {
  const Eigen::Vector3d normal = (v[1] - v[0]).cross(v[2] - v[1]);
  if (!(normal.squaredNorm() > 0)) return false;
  for (int i = 0; i < Corners; ++i)
    if (v[i].cross(v[(i + 1) % Corners]).dot(normal) < 0) return false;
  return true;
}

}  // namespace

template <int Corners>
CcdHit float_contact(const double* query, const CcdOptions& options) {
  const Polygon<Corners> a = corner_differences<Corners>(query, 0);
  const Polygon<Corners> b = corner_differences<Corners>(query, 1);
  const auto cubic = coplanarity_cubic<Corners>(a, b);
  CubicRoots roots;
  if (std::all_of(cubic.begin(), cubic.end(), [](double c) { return std::isfinite(c); }))
    roots = cubic_roots(cubic, {.method = RootMethod::lecture});
  const bool near = options.method == CcdMethod::tolerance || options.thickness > 0;
  const double reach = options.thickness > 0 ? options.thickness : tolerance::float_contact;
  const auto contact = [&](double t) {
    const Polygon<Corners> v = interpolated<Corners>(a, b, t);
    return near ? nearest_to_origin<Corners>(v).norm() <= reach : origin_inside<Corners>(v);
  };
  if (near && contact(0)) return {true, 0, CcdStatus::certified};
  for (int i = 0; i < roots.count; ++i) {
    const double t = roots.root[static_cast<std::size_t>(i)];
    if (contact(t)) return {true, t, CcdStatus::certified};
  }
  if (near && contact(1)) return {true, 1, CcdStatus::certified};
  return {};
}

template CcdHit float_contact<3>(const double*, const CcdOptions&);
template CcdHit float_contact<4>(const double*, const CcdOptions&);

}  // namespace carom::narrow
