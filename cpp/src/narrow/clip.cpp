// SPDX-License-Identifier: Apache-2.0
#include "narrow/clip.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "carom/numerics/tolerance.hpp"

#include "geometry/features.hpp"

namespace carom {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// A face seen along the normal: plane coordinates and height of each corner.
template <template <class...> class List>
struct Flat {
  List<Vector2d> at;
  List<double> height, length;        // length: of the edge that starts at each corner
  Vector2d slope = Vector2d::Zero();  // of the height over the plane
  double size = 0, turn = 1;          // turn: -1 when corners run clockwise
  bool has_area = false;

  void set(const FaceOf<List>& face, const Vector3d& u, const Vector3d& v, const Vector3d& n,
           const Vector3d& origin) {
    const std::size_t count = face.points.size();
    at.resize(count);
    height.resize(count);
    length.resize(count);
    size = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const Vector3d x = face.points[i] - origin;
      at[i] = {u.dot(x), v.dot(x)};
      height[i] = n.dot(x);
      size = std::max(size, (at[i] - at[0]).squaredNorm());
    }
    size = std::sqrt(size);
    for (std::size_t i = 0; i < count; ++i) length[i] = (at[(i + 1) % count] - at[i]).norm();
    set_plane(face, u, v, n);
  }
  void set_plane(const FaceOf<List>& face, const Vector3d& u, const Vector3d& v,
                 const Vector3d& n) {
    Vector3d area = Vector3d::Zero();
    for (std::size_t i = 1; i + 1 < face.points.size(); ++i)
      area += (face.points[i] - face.points[0]).cross(face.points[i + 1] - face.points[0]);
    const double facing = area.dot(n);
    turn = facing < 0 ? -1 : 1;
    has_area = face.points.size() > 2 && std::abs(facing) > tolerance::flat_triangle * size * size;
    slope = has_area ? Vector2d(-area.dot(u) / facing, -area.dot(v) / facing) : Vector2d::Zero();
  }
  double height_at(const Vector2d& x) const { return height[0] + slope.dot(x - at[0]); }

  bool contains(const Vector2d& x) const {
    const double slack = tolerance::inside_polygon * size;
    for (std::size_t i = 0; i < at.size(); ++i) {
      const Vector2d e = at[i + 1 < at.size() ? i + 1 : 0] - at[i], w = x - at[i];
      if (turn * (e.x() * w.y() - e.y() * w.x()) < -slack * length[i]) return false;
    }
    return true;
  }
};

template <template <class...> class List>
struct Clipper {
  const FaceOf<List>&a, &b;
  const Vector3d &u, &v, &n, &origin;
  double margin;
  std::vector<ContactPoint>& out;

  void add(const Vector2d& x, double height_a, double height_b, std::uint32_t feature) const {
    if (height_b - height_a > margin) return;
    out.push_back({origin + x.x() * u + x.y() * v + 0.5 * (height_a + height_b) * n,
                   height_b - height_a, feature});
  }
};

template <template <class...> class List>
void crossings(const Clipper<List>& c, const Flat<List>& fa, const Flat<List>& fb) {
  const std::size_t na = fa.at.size(), nb = fb.at.size();
  for (std::size_t i = 0; i < (na == 2 ? 1 : na); ++i) {
    const std::size_t i1 = i + 1 < na ? i + 1 : 0;
    const Vector2d e = fa.at[i1] - fa.at[i];
    for (std::size_t j = 0; j < (nb == 2 ? 1 : nb); ++j) {
      const std::size_t j1 = j + 1 < nb ? j + 1 : 0;
      const Vector2d g = fb.at[j1] - fb.at[j], w = fb.at[j] - fa.at[i];
      const double cross = e.x() * g.y() - e.y() * g.x();
      const double size = std::abs(cross), sign = cross < 0 ? -1 : 1;
      if (size <= tolerance::inside_polygon * fa.length[i] * fb.length[j]) continue;
      const double over_s = sign * (w.x() * g.y() - w.y() * g.x());
      const double over_t = sign * (w.x() * e.y() - w.y() * e.x());
      if (!(over_s > 0 && over_s < size && over_t > 0 && over_t < size)) continue;
      const double s = over_s / size, t = over_t / size;
      c.add(fa.at[i] + s * e, fa.height[i] + s * (fa.height[i1] - fa.height[i]),
            fb.height[j] + t * (fb.height[j1] - fb.height[j]),
            feature::pair(c.a.edge_features[i], c.b.edge_features[j]));
    }
  }
}

/// Two segments side by side: the ends of the stretch they share.
template <template <class...> class List>
void side_by_side(const Clipper<List>& c, const Flat<List>& fa, const Flat<List>& fb) {
  const Vector2d e = fa.at[1] - fa.at[0], g = fb.at[1] - fb.at[0];
  const double cross = e.x() * g.y() - e.y() * g.x();
  const double sine = std::sqrt(1 - tolerance::facing * tolerance::facing);
  if (std::abs(cross) > sine * e.norm() * g.norm()) return;
  const auto ends = [&](const Flat<List>& of, const Flat<List>& on, bool of_a) {
    const Vector2d along = on.at[1] - on.at[0];
    for (int i = 0; i < 2; ++i) {
      const double t = (of.at[i] - on.at[0]).dot(along) / along.squaredNorm();
      if (!(t >= 0 && t <= 1)) continue;
      const double height = on.height[0] + t * (on.height[1] - on.height[0]);
      if (of_a)
        c.add(of.at[i], of.height[i], height,
              feature::pair(c.a.vertex_features[i], c.b.edge_features[0]));
      else
        c.add(of.at[i], height, of.height[i],
              feature::pair(c.a.edge_features[0], c.b.vertex_features[i]));
    }
  };
  ends(fa, fb, true);
  ends(fb, fa, false);
}

template <template <class...> class List>
void clip_faces(const FaceOf<List>& a, const FaceOf<List>& b, const Vector3d& normal, double margin,
                Flat<List>& fa, Flat<List>& fb, std::vector<ContactPoint>& out) {
  const Vector3d origin = a.points[0];
  const Vector3d u = normal.unitOrthogonal(), v = normal.cross(u);
  fa.set(a, u, v, normal, origin);
  fb.set(b, u, v, normal, origin);
  const Clipper<List> clipper{a, b, u, v, normal, origin, margin, out};
  if (fa.has_area)
    for (std::size_t j = 0; j < fb.at.size(); ++j)
      if (fa.contains(fb.at[j]))
        clipper.add(fb.at[j], fa.height_at(fb.at[j]), fb.height[j],
                    feature::pair(a.feature, b.vertex_features[j]));
  if (fb.has_area)
    for (std::size_t i = 0; i < fa.at.size(); ++i)
      if (fb.contains(fa.at[i]))
        clipper.add(fa.at[i], fa.height[i], fb.height_at(fa.at[i]),
                    feature::pair(a.vertex_features[i], b.feature));
  if (fa.at.size() > 1 && fb.at.size() > 1) crossings(clipper, fa, fb);
  if (fa.at.size() == 2 && fb.at.size() == 2) side_by_side(clipper, fa, fb);
}

}  // namespace

void clip(const Face& a, const Face& b, const Vector3d& normal, double margin,
          std::vector<ContactPoint>& out) {
  thread_local Flat<std::vector> fa, fb;
  clip_faces(a, b, normal, margin, fa, fb, out);
}

void clip(const Quad& a, const Quad& b, const Vector3d& normal, double margin,
          std::vector<ContactPoint>& out) {
  Flat<Four> fa, fb;
  clip_faces(a, b, normal, margin, fa, fb, out);
}

}  // namespace carom
