// SPDX-License-Identifier: Apache-2.0
#include "carom/numerics/exact_integer.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace carom {
namespace {

using Int = ExactInteger<40>;
__extension__ using Wide = __int128;

Int from_wide(Wide x) {
  const Int high(static_cast<std::int64_t>(x >> 62));
  return high.shifted(62) + Int(static_cast<std::int64_t>(x & ((Wide{1} << 62) - 1)));
}

TEST(ExactInteger, AgreesWithMachineIntegers) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 20000; ++i) {
    const auto a = static_cast<std::int64_t>(random()) >> (random() % 64);
    const auto b = static_cast<std::int64_t>(random()) >> (random() % 64);
    EXPECT_EQ((Int(a) * Int(b) - from_wide(Wide{a} * b)).sign(), 0) << a << " * " << b;
    EXPECT_EQ((Int(a) + Int(b) - from_wide(Wide{a} + b)).sign(), 0) << a << " + " << b;
    EXPECT_EQ((Int(a) - Int(b)).sign(), a > b ? 1 : a < b ? -1 : 0);
  }
}

// (a + b)(a - b) = a^2 - b^2 with carries and borrows through many limbs
TEST(ExactInteger, KeepsAnIdentityOverManyLimbs) {
  std::mt19937_64 random(2);
  for (int i = 0; i < 5000; ++i) {
    Int a(1), b(1);
    for (std::uint64_t k = random() % 9; k-- > 0;) {
      // runs of ones and zeros make the longest carries
      const std::int64_t run = random() % 2 ? INT64_MAX : static_cast<std::int64_t>(random());
      a = a.shifted(static_cast<int>(random() % 70)) * Int(run) + Int(1);
      b = b.shifted(64) - Int(static_cast<std::int64_t>(random() % 3));
    }
    EXPECT_EQ(((a + b) * (a - b) - (a * a - b * b)).sign(), 0);
    EXPECT_EQ((a - a).sign(), 0);
    EXPECT_EQ((a - a).bit_length(), 0);
  }
}

TEST(ExactInteger, LeadingIsTheValueToADouble) {
  const Int three_cubed_shifted = Int(27).shifted(900);
  int exponent;
  const double m = three_cubed_shifted.leading(exponent);
  EXPECT_EQ(std::ldexp(m, exponent), std::ldexp(27.0, 900));  // exact: few bits
  EXPECT_EQ(three_cubed_shifted.bit_length(), 905);
  EXPECT_EQ((-three_cubed_shifted).leading(exponent), -m);
}

}  // namespace
}  // namespace carom
