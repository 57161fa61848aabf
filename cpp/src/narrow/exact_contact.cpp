// SPDX-License-Identifier: Apache-2.0
// The question in one form for both kinds of query: a convex polygon with corners V_i(t), linear in
// t, moves relative to the origin; when does it first contain it? Point-triangle: V_i = x_i - p.
// Edge-edge: the four corners a_j - b_k of the parallelogram of differences, in order.
//
// With c_i = V_i x V_{i+1}: at an instant where all V_i are linearly dependent (f = 0) every c_i is
// a multiple of one normal, and the origin is in the closed polygon exactly when
//   some component k has all c_i[k] of one weak sign, not all 0   (a proper polygon), or
//   all c_i = 0 and on every axis the V_i do not lie strictly on one side   (points of one line
//   through the origin).
// So only signs of quadratics at roots of a cubic are needed; section "exact" of the tests derives
// them again by Sturm sequences and quartics.
#include "exact_contact.hpp"

#include <cstdint>
#include <cstring>

#include "carom/numerics/exact_roots.hpp"
#include "carom/numerics/tolerance.hpp"

namespace carom::narrow {
namespace {

struct Decoded {
  std::int64_t mantissa;  // odd, or 0
  int exponent;
};

Decoded decode(double x) {
  std::uint64_t bits;
  std::memcpy(&bits, &x, sizeof bits);
  const int biased = static_cast<int>((bits >> 52) & 0x7ff);
  std::uint64_t m = bits & ((std::uint64_t{1} << 52) - 1);
  if (biased != 0) m |= std::uint64_t{1} << 52;
  if (m == 0) return {0, 0};
  const int zeros = std::countr_zero(m);
  const auto odd = static_cast<std::int64_t>(m >> zeros);
  return {x < 0 ? -odd : odd, (biased == 0 ? 1 : biased) - 1075 + zeros};
}

template <class Int, int Corners>
class Polygon {
 public:
  using Poly = ExactPolynomial<Int>;
  using Root = ExactRoot<Int>;

  Polygon(const Decoded (&x)[24], const int (&lowest)[3], const double* query) {
    // Scaling an axis changes no sign, so each axis has its own unit.
    Int point[2][4][3];
    for (int end = 0; end < 2; ++end)
      for (int j = 0; j < 4; ++j)
        for (int k = 0; k < 3; ++k) {
          const Decoded& d = x[12 * end + 3 * j + k];
          point[end][j][k] =
              d.mantissa == 0 ? Int(0) : Int(d.mantissa).shifted(d.exponent - lowest[k]);
        }
    for (int i = 0; i < Corners; ++i) {
      const int to = Corners == 3 ? i + 1 : (i == 1 || i == 2);
      const int from = Corners == 3 ? 0 : (i < 2 ? 2 : 3);
      for (int k = 0; k < 3; ++k) {
        start_[i][k] = point[0][to][k] - point[0][from][k];
        move_[i][k] = point[1][to][k] - point[1][from][k] - start_[i][k];
      }
    }
    rank_axes(query);
  }

  ExactContact first_contact() {
    Poly f;
    for (int k = 0; k < 3; ++k) {  // f = V_last . (V_0 x V_1)
      const Poly& c = cross(0, k);
      const Int &v = start_[Corners - 1][k], &w = move_[Corners - 1][k];
      f.c[0] = f.c[0] + v * c.c[0];
      f.c[1] = f.c[1] + v * c.c[1] + w * c.c[0];
      f.c[2] = f.c[2] + v * c.c[2] + w * c.c[1];
      f.c[3] = f.c[3] + w * c.c[2];
    }
    f.settle(3);
    best_ = {};
    best_.coplanar = f.degree < 0;
    if (f.degree < 0)
      try_coplanar();
    else
      try_roots(f);
    return best_;
  }

 private:
  const Poly& cross(int i, int k) {
    Poly& c = cross_[i][k];
    if (known_[i][k]) return c;
    known_[i][k] = true;
    const int j = (i + 1) % Corners, p = (k + 1) % 3, q = (k + 2) % 3;
    c.c[0] = start_[i][p] * start_[j][q] - start_[i][q] * start_[j][p];
    c.c[1] = (start_[i][p] * move_[j][q] - start_[i][q] * move_[j][p]) +
             (move_[i][p] * start_[j][q] - move_[i][q] * start_[j][p]);
    c.c[2] = move_[i][p] * move_[j][q] - move_[i][q] * move_[j][p];
    c.settle(2);
    return c;
  }

  // The component of the normal that is likely the largest goes first; any order is right.
  void rank_axes(const double* x) {
    double normal[3] = {0, 0, 0};
    for (int end = 0; end < 2; ++end) {
      const double* p = x + 12 * end;
      const double* s = Corners == 3 ? p + 3 : p;
      const double* e = Corners == 3 ? p + 3 : p + 6;
      for (int k = 0; k < 3; ++k) {
        const int a = (k + 1) % 3, b = (k + 2) % 3;
        const double* far = Corners == 3 ? p + 6 : p + 3;
        normal[k] +=
            std::fabs((far[a] - s[a]) * (p[9 + b] - e[b]) - (far[b] - s[b]) * (p[9 + a] - e[a]));
      }
    }
    std::sort(axes_, axes_ + 3, [&](int a, int b) { return normal[a] > normal[b]; });
  }

  bool contact_at(const Root& r) {
    for (const int k : axes_) {
      bool positive = false, negative = false;
      for (int i = 0; i < Corners; ++i) {
        const int s = sign_at(cross(i, k), r);
        positive |= s > 0;
        negative |= s < 0;
        if (positive && negative) return false;
      }
      if (positive || negative) return true;
    }
    for (int k = 0; k < 3; ++k) {
      bool below = false, above = false;
      for (int i = 0; i < Corners; ++i) {
        const int s = sign_at(line(i, k), r);
        below |= s <= 0;
        above |= s >= 0;
      }
      if (!below || !above) return false;
    }
    return true;
  }

  Poly line(int i, int k) const {
    Poly p;
    p.c[0] = start_[i][k];
    p.c[1] = move_[i][k];
    p.settle(1);
    return p;
  }

  // True when the candidate is a contact; keeps the earliest.
  bool consider(const Root& r) {
    if (best_.hit && r.lower >= best_.time) return true;  // cannot be the first
    if (!contact_at(r)) return false;
    best_.hit = true;
    best_.time = r.lower;
    return true;
  }

  void try_roots(const Poly& p) {
    visit_roots(p, tolerance::exact_time_bracket, [&](const Root& r) { return consider(r); });
  }

  // All points in one plane throughout: the first contact is at 0, or the origin then enters
  // through an edge i, where c_i = 0; if c_i vanishes identically, through a corner of that edge.
  void try_coplanar() {
    Root zero;
    zero.den = Int(1);
    zero.upper = 0;
    if (consider(zero)) return;
    for (int i = 0; i < Corners; ++i) {
      int k = 0;
      while (k < 3 && cross(i, axes_[k]).degree < 0) ++k;
      if (k < 3) {
        try_roots(cross(i, axes_[k]));
        continue;
      }
      for (const int corner : {i, (i + 1) % Corners})
        for (int axis = 0; axis < 3; ++axis) {
          const Poly p = line(corner, axis);
          if (p.degree < 0) continue;
          try_roots(p);
          break;
        }
    }
  }

  Int start_[Corners][3], move_[Corners][3];
  Poly cross_[Corners][3];
  bool known_[Corners][3] = {};
  int axes_[3] = {0, 1, 2};
  ExactContact best_;
};

// The widest number formed is the square in the sign of a surd, below 18 b + 64 bits for corner
// differences of b bits (a cubic has 3 b + 7, a quadratic 2 b + 3; 4 d^3 of the cubic's extrema and
// the cubic reduced by a quadratic come out equal).
constexpr int limbs_for(int difference_bits) {
  return (18 * difference_bits + 64 + 191) / 64 + 2;
}
constexpr int usual_bits = 220, widest_bits = 2104;

}  // namespace

template <int Corners>
ExactContact exact_contact(const double* query) {
  Decoded x[24];
  int lowest[3], bits = 0;
  for (int k = 0; k < 3; ++k) {
    int bottom = 1 << 20, top = -(1 << 20);
    for (int j = k; j < 24; j += 3) {
      x[j] = decode(query[j]);
      if (x[j].mantissa == 0) continue;
      bottom = std::min(bottom, x[j].exponent);
      const auto magnitude = static_cast<std::uint64_t>(std::abs(x[j].mantissa));
      top = std::max(top, x[j].exponent + static_cast<int>(std::bit_width(magnitude)));
    }
    lowest[k] = bottom;
    bits = std::max(bits, top - bottom + 2);
  }
  if (bits <= usual_bits)
    return Polygon<ExactInteger<limbs_for(usual_bits)>, Corners>(x, lowest, query).first_contact();
  return Polygon<ExactInteger<limbs_for(widest_bits)>, Corners>(x, lowest, query).first_contact();
}

template ExactContact exact_contact<3>(const double*);
template ExactContact exact_contact<4>(const double*);

}  // namespace carom::narrow
