// SPDX-License-Identifier: Apache-2.0
#pragma once
// The tests of one ray or point against one triangle, in double, that every index answers with.
// Everything has internal linkage: files compiled for different CPU levels each have their own, and
// since no multiplication is fused all levels give the same bits.
#include <cstdint>
#include <limits>

namespace carom::broad {

/// start + t step, t in [0, t_max]. `step` is scaled by a power of two so that its largest
/// component lies in [1/2, 1).
struct Ray {
  double start[3], step[3];
  double t_max;
  double shear[3];  ///< step[kx] / step[kz], step[ky] / step[kz], 1 / step[kz]
  int kx, ky, kz;   ///< kz: the axis of the largest component
};

struct Nearest {
  double t;
  int face;
};

static inline double smaller(double a, double b) {
  return a < b ? a : b;
}
static inline double larger(double a, double b) {
  return a > b ? a : b;
}

static inline void prepare(Ray& ray) {
  const auto size = [&](int k) { return ray.step[k] < 0 ? -ray.step[k] : ray.step[k]; };
  // Arithmetic, since a processor guesses the largest of three unknown numbers wrongly.
  const int first = static_cast<int>(size(0) > size(1));
  ray.kz = 2 - static_cast<int>(larger(size(0), size(1)) > size(2)) * (1 + first);
  ray.kx = ray.kz == 2 ? 0 : ray.kz + 1;
  ray.ky = ray.kx == 2 ? 0 : ray.kx + 1;
  ray.shear[0] = ray.step[ray.kx] / ray.step[ray.kz];
  ray.shear[1] = ray.step[ray.ky] / ray.step[ray.kz];
  ray.shear[2] = 1 / ray.step[ray.kz];
}

/// The time t of a hit, brought between where the ray enters and leaves the bounding box of corners
/// a, b, c: rounding of a face seen nearly edge-on cannot place a hit outside the volumes and cells
/// that hold it, so every index finds it where it says it is.
static inline double within_box(const Ray& ray, double t, const double* a, const double* b,
                                const double* c) {
  double entry = 0, exit = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    if (ray.step[k] == 0) continue;
    const double ends[2] = {smaller(smaller(a[k], b[k]), c[k]), larger(larger(a[k], b[k]), c[k])};
    const auto back = static_cast<int>(ray.step[k] < 0);  // an index: no branch to guess wrongly
    entry = larger(entry, (ends[back] - ray.start[k]) / ray.step[k]);
    exit = smaller(exit, (ends[1 - back] - ray.start[k]) / ray.step[k]);
  }
  return larger(entry, smaller(t, exit));
}

/// Keeps the hit if it is the nearer, or as near with a lower index.
static inline void keep_nearer(Nearest& best, double t, int face) {
  if (t < best.t || (t == best.t && (best.face < 0 || face < best.face))) best = {t, face};
}

/// The watertight test of Woop, Benthin and Wald (2013): shear the ray onto an axis, then three
/// edge functions whose signs two neighbours compute from the same rounded numbers.
/// @returns t, or NaN for none; -0 and below are none except t = 0 itself
static inline double hit_time(const Ray& ray, const double* a, const double* b, const double* c) {
  const int kx = ray.kx, ky = ray.ky, kz = ray.kz;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double az = a[kz] - ray.start[kz], bz = b[kz] - ray.start[kz], cz = c[kz] - ray.start[kz];
  const double ax = (a[kx] - ray.start[kx]) - ray.shear[0] * az;
  const double ay = (a[ky] - ray.start[ky]) - ray.shear[1] * az;
  const double bx = (b[kx] - ray.start[kx]) - ray.shear[0] * bz;
  const double by = (b[ky] - ray.start[ky]) - ray.shear[1] * bz;
  const double cx = (c[kx] - ray.start[kx]) - ray.shear[0] * cz;
  const double cy = (c[ky] - ray.start[ky]) - ray.shear[1] * cz;
  const double u = cx * by - cy * bx, v = ax * cy - ay * cx, w = bx * ay - by * ax;
  if ((u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0)) return nan;
  const double det = (u + v) + w;
  if (det == 0) return nan;
  const double t = (((u * az + v * bz) + w * cz) / det) * ray.shear[2];
  if (!(t >= 0)) return nan;
  return within_box(ray, t, a, b, c);
}

/// The point of the triangle nearest to p: the best of the nearest points of the three edges and,
/// where p lies above the inside, of its projection. Each candidate is a point of the triangle, so
/// needles and points give no worse than their best edge.
/// @returns the squared distance
static inline double closest_on_triangle(const double* p, const double* a, const double* b,
                                         const double* c, double* q) {
  double ab[3], ac[3], ap[3];
  double abab = 0, acac = 0, abac = 0, abap = 0, acap = 0;
  for (int k = 0; k < 3; ++k) {
    ab[k] = b[k] - a[k];
    ac[k] = c[k] - a[k];
    ap[k] = p[k] - a[k];
    abab += ab[k] * ab[k];
    acac += ac[k] * ac[k];
    abac += ab[k] * ac[k];
    abap += ab[k] * ap[k];
    acap += ac[k] * ap[k];
  }
  const double whole = abab * acac - abac * abac;
  const double vb = acac * abap - abac * acap, vc = abab * acap - abac * abap;
  double best = std::numeric_limits<double>::infinity();
  const auto consider = [&](const double* from, const double* along, double w, const double* too,
                            double w_too) {
    double at[3], sum = 0;
    for (int k = 0; k < 3; ++k) {
      at[k] = from[k] + (along[k] * w + too[k] * w_too);
      // Inside the bounding box whatever the rounding, so that no volume is passed over wrongly.
      at[k] = smaller(larger(at[k], smaller(smaller(a[k], b[k]), c[k])),
                      larger(larger(a[k], b[k]), c[k]));
      sum += (p[k] - at[k]) * (p[k] - at[k]);
    }
    if (sum < best) {
      best = sum;
      for (int k = 0; k < 3; ++k) q[k] = at[k];
    }
  };
  if (whole > 0 && vb > 0 && vc > 0 && vb + vc < whole) {
    consider(a, ab, vb / whole, ac, vc / whole);
  }
  const double* const corner[4] = {a, b, c, a};
  for (int e = 0; e < 3; ++e) {
    const double* const from = corner[e];
    double edge[3], along = 0, length2 = 0;
    for (int k = 0; k < 3; ++k) {
      edge[k] = corner[e + 1][k] - from[k];
      along += (p[k] - from[k]) * edge[k];
      length2 += edge[k] * edge[k];
    }
    consider(from, edge, length2 > 0 ? smaller(larger(along / length2, 0), 1) : 0, edge, 0);
  }
  return best;
}

}  // namespace carom::broad
