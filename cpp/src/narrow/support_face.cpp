// SPDX-License-Identifier: Apache-2.0
#include "narrow/support_face.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "carom/numerics/tolerance.hpp"

#include "geometry/features.hpp"

namespace carom {
namespace {

using Eigen::Vector3d;

const double sideways = std::sqrt(1 - tolerance::facing * tolerance::facing);

struct Put {
  const Frame& frame;
  Vector3d growth;
  Face& out;

  void operator()(const Vector3d& p, std::uint32_t vertex, std::uint32_t edge) const {
    out.push(frame * p + growth, vertex, edge);
  }
};

void of_polytope(const Convex& body, const Vector3d& n, const Put& put) {
  const Polytope& p = *body.polytope;
  int best = 0;
  for (int f = 1; f < p.face_count(); ++f)
    if (p.normals[f].dot(n) > p.normals[best].dot(n)) best = f;
  if (p.normals[best].dot(n) > tolerance::facing) {
    put.out.feature = feature::face(best);
    for (int k = p.first[best]; k < p.first[best + 1]; ++k)
      put(p.vertices[p.corners[k]], feature::vertex(p.corners[k]),
          feature::edge(p.corner_edges[k]));
    return;
  }
  int tip = 0, side = -1;
  for (int v = 1; v < static_cast<int>(p.vertices.size()); ++v)
    if (p.vertices[v].dot(n) > p.vertices[tip].dot(n)) tip = v;
  double flattest = sideways;
  for (int e = 0; e < static_cast<int>(p.edges.size()); ++e) {
    if (p.edges[e].v0 != tip && p.edges[e].v1 != tip) continue;
    const Vector3d along = p.vertices[p.edges[e].v1] - p.vertices[p.edges[e].v0];
    if (const double s = std::abs(along.dot(n)) / along.norm(); s < flattest)
      flattest = s, side = e;
  }
  if (side < 0) return put(p.vertices[tip], feature::vertex(tip), feature::vertex(tip));
  for (int v : {p.edges[side].v0, p.edges[side].v1})
    put(p.vertices[v], feature::vertex(v), feature::edge(side));
}

void of_box(const Convex& body, const Vector3d& n, const Put& put) {
  int axis;
  n.cwiseAbs().maxCoeff(&axis);
  const Vector3d tip = body.support(n);
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const auto number = [&](const Vector3d& c) {
    return (c.x() > 0) | (c.y() > 0) << 1 | (c.z() > 0) << 2;
  };
  const auto corner = [&](double su, double sv) {
    Vector3d c = tip;
    c[u] = su * body.size[u];
    c[v] = sv * body.size[v];
    return c;
  };
  const bool up = n[axis] > 0;
  if (std::abs(n[axis]) > tolerance::facing) {
    put.out.feature = feature::face(2 * axis + up);
    const double turn = up ? 1 : -1;
    const double signs[4][2] = {{-1, -turn}, {turn, -1}, {1, turn}, {-turn, 1}};
    int numbers[4];
    for (int k = 0; k < 4; ++k) numbers[k] = number(corner(signs[k][0], signs[k][1]));
    for (int k = 0; k < 4; ++k) {
      const int a = numbers[k], b = numbers[(k + 1) % 4];
      put(corner(signs[k][0], signs[k][1]), feature::vertex(a),
          feature::edge(std::min(a, b) << 3 | std::max(a, b)));
    }
    return;
  }
  int along;
  if (n.cwiseAbs().minCoeff(&along) < sideways) {  // an edge
    Vector3d from = tip, to = tip;
    from[along] = -body.size[along];
    to[along] = body.size[along];
    const auto name = feature::edge(number(from) << 3 | number(to));
    put(from, feature::vertex(number(from)), name);
    put(to, feature::vertex(number(to)), name);
    return;
  }
  put(tip, feature::vertex(number(tip)), feature::vertex(number(tip)));
}

void disc(double radius, double z, bool up, const Put& put) {
  put.out.feature = feature::face(up);
  for (int k = 0; k < 8; ++k) {
    const double angle = (up ? 1 : -1) * k * std::numbers::pi / 4;
    put({radius * std::cos(angle), radius * std::sin(angle), z}, feature::vertex(8 * up + k),
        feature::edge(8 * up + k));
  }
}

void of_cylinder(const Convex& body, const Vector3d& n, const Put& put) {
  const double r = body.size.x(), half = body.size.z(), across = std::hypot(n.x(), n.y());
  if (std::abs(n.z()) > tolerance::facing) return disc(r, n.z() > 0 ? half : -half, n.z() > 0, put);
  const Vector3d tip = body.support(n);
  if (std::abs(n.z()) < sideways) {
    const Vector3d side(r * n.x() / across, r * n.y() / across, 0);
    put(side - half * Vector3d::UnitZ(), feature::curve(0), feature::curve(2));
    put(side + half * Vector3d::UnitZ(), feature::curve(1), feature::curve(2));
    return;
  }
  put(tip, feature::curve(n.z() > 0), feature::curve(n.z() > 0));
}

void of_cone(const Convex& body, const Vector3d& n, const Put& put) {
  const double r = body.size.x(), length = 2 * body.size.z(), across = std::hypot(n.x(), n.y());
  const double base = -0.25 * length, apex = 0.75 * length, slant = std::hypot(r, length);
  if (-n.z() > tolerance::facing) return disc(r, base, false, put);
  if (across > 0 && (n.z() * r + across * length) / slant > tolerance::facing) {  // along its side
    put({r * n.x() / across, r * n.y() / across, base}, feature::curve(0), feature::curve(2));
    put({0, 0, apex}, feature::curve(1), feature::curve(2));
    return;
  }
  const Vector3d tip = body.support(n);
  put(tip, feature::curve(tip.z() > 0), feature::curve(tip.z() > 0));
}

void of_points(const Convex& body, const Vector3d& n, const Put& put) {
  const auto points = body.corners();
  if (points.size() == 2 &&
      std::abs((points[1] - points[0]).dot(n)) <= sideways * (points[1] - points[0]).norm()) {
    put(points[0], feature::vertex(0), feature::edge(0));
    put(points[1], feature::vertex(1), feature::edge(0));
    return;
  }
  std::size_t best = 0;
  for (std::size_t i = 1; i < points.size(); ++i)
    if (points[i].dot(n) > points[best].dot(n)) best = i;
  const auto name = feature::vertex(static_cast<int>(best));
  put(points[best], name, name);
}

}  // namespace

void support_face(const Convex& body, const Vector3d& n, const Frame& frame, Face& out) {
  out.clear();
  out.feature = feature::curve(7);
  const Put put{frame, body.radius * (frame.rotation * n), out};
  switch (body.kind) {
    case Convex::Kind::box:
      return of_box(body, n, put);
    case Convex::Kind::cylinder:
      return of_cylinder(body, n, put);
    case Convex::Kind::cone:
      return of_cone(body, n, put);
    case Convex::Kind::ellipsoid:
      return put(body.support(n), feature::curve(0), feature::curve(0));
    case Convex::Kind::points:
      return body.polytope ? of_polytope(body, n, put) : of_points(body, n, put);
  }
}

}  // namespace carom
