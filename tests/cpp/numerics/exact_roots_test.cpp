// SPDX-License-Identifier: Apache-2.0
#include "carom/numerics/exact_roots.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace carom {
namespace {

using Int = ExactInteger<64>;
using Poly = ExactPolynomial<Int>;

Poly polynomial(std::initializer_list<std::int64_t> ascending) {
  Poly p;
  int n = 0;
  for (const std::int64_t c : ascending) p.c[n++] = Int(c);
  p.settle(n - 1);
  return p;
}

// signs of q at the roots of p in [0, 1]
std::vector<int> signs(const Poly& p, const Poly& q) {
  std::vector<int> s;
  visit_roots(p, 0x1p-40, [&](const auto& r) {
    s.push_back(sign_at(q, r));
    return false;
  });
  return s;
}

TEST(ExactRoots, OfACubicWithRationalRootsAreAllFoundInOrder) {
  const Poly p = polynomial({-6, 44, -96, 64});  // (4t - 1)(4t - 2)(4t - 3)
  std::vector<double> found;
  visit_roots(p, 0x1p-40, [&](const auto& r) {
    found.push_back(std::round(4 * r.lower) / 4);
    EXPECT_LE(r.lower, found.back());
    EXPECT_GE(r.upper, found.back());
    EXPECT_LE(r.upper - r.lower, 0x1p-40);
    return false;
  });
  EXPECT_EQ(found, (std::vector<double>{0.25, 0.5, 0.75}));
  EXPECT_EQ(signs(p, polynomial({-1, 2})), (std::vector<int>{-1, 0, 1}));
}

TEST(ExactRoots, CountAMultipleRootOnceAndClosedEndsAsInside) {
  EXPECT_EQ(signs(polynomial({-1, 6, -12, 8}), polynomial({1})).size(), 1u);  // (2t - 1)^3
  EXPECT_EQ(signs(polynomial({0, 0, -1, 1}), polynomial({-1, 2})), (std::vector<int>{-1, 1}));
  // (2t - 1)^2 (t + 1): a double root inside, a simple one outside
  EXPECT_EQ(signs(polynomial({1, -3, 0, 4}), polynomial({-1, 2})), (std::vector<int>{0}));
  EXPECT_TRUE(signs(polynomial({1, 1, 1, 1}), polynomial({1})).empty());
  EXPECT_TRUE(signs(polynomial({0, 0, 0, 0}), polynomial({1})).empty());
}

// (t^2 - 1/2)(t - 2): the irrational root 1/sqrt 2 of a cubic, against quadratics that vanish
// there, almost vanish there (p/q a convergent of 1/sqrt 2), or have it between their roots
TEST(ExactRoots, SignsAtAnIrrationalRootAreExact) {
  const Poly p = polynomial({2, -1, -4, 2});
  EXPECT_EQ(signs(p, polynomial({-1, 0, 2})), (std::vector<int>{0}));
  EXPECT_EQ(signs(p, polynomial({1, 0, -2})), (std::vector<int>{0}));
  // Pell: 665857^2 - 2 470832^2 = 1, so 470832 / 665857 is below 1/sqrt 2 by 1e-12
  EXPECT_EQ(signs(p, polynomial({-470832, 665857})), (std::vector<int>{1}));
  EXPECT_EQ(signs(p, polynomial({-470833, 665857})), (std::vector<int>{-1}));
  // squared, as a quadratic with one root on each side
  EXPECT_EQ(
      signs(p, polynomial({-std::int64_t{470832} * 470832, 0, std::int64_t{665857} * 665857})),
      (std::vector<int>{1}));
  EXPECT_EQ(signs(p, polynomial({3, -8, 4})), (std::vector<int>{-1}));  // (2t - 1)(2t - 3)
  EXPECT_EQ(signs(p, polynomial({1, -2, 1})), (std::vector<int>{1}));   // (t - 1)^2
  EXPECT_EQ(signs(p, polynomial({1, 0, 1})), (std::vector<int>{1}));    // no root
}

TEST(ExactRoots, OfAQuadraticKeepTheirSides) {
  const Poly p = polynomial({1, -6, 6});  // (3 -+ sqrt 3) / 6
  EXPECT_EQ(signs(p, polynomial({-1, 2})), (std::vector<int>{-1, 1}));
  EXPECT_EQ(signs(p, polynomial({-1, 6, -6})), (std::vector<int>{0, 0}));
  // a cubic at a quadratic's roots: t p(t) vanishes there, t p(t) + 2t - 1 does not
  const Int d = discriminant(p);
  for (const int which : {-1, 1}) {
    const QuadraticRoot<Int> r{&p, &d, which};
    EXPECT_EQ(sign_at(polynomial({0, 1, -6, 6}), r), 0);
    EXPECT_EQ(sign_at(polynomial({-1, 3, -6, 6}), r), which);
    EXPECT_EQ(sign_at(polynomial({1, -3, 6, -6}), r), -which);
  }
}

}  // namespace
}  // namespace carom
