// SPDX-License-Identifier: Apache-2.0
#include "geometry/spline.hpp"

#include <cstddef>

namespace carom {
namespace {

constexpr int beyond = 3;  // samples made up at either end

/// f holds count samples from f[beyond] on; c gets count + 2 coefficients.
void solve(std::vector<double>& f, std::vector<double>& c, int count) {
  const int last = beyond + count - 1;
  for (int k = 1; k <= beyond; ++k) {  // no fourth difference: the cubic of the last four goes on
    const double *l = &f[beyond - k], *r = &f[last + k];
    f[beyond - k] = 4 * l[1] - 6 * l[2] + 4 * l[3] - l[4];
    f[last + k] = 4 * r[-1] - 6 * r[-2] + 4 * r[-3] - r[-4];
  }
  for (int i = 0; i < count + 2; ++i) {
    const double* at = &f[beyond - 1 + i];
    const double second = at[-1] - 2 * at[0] + at[1];
    const double fourth = at[-2] - 4 * at[-1] + 6 * at[0] - 4 * at[1] + at[2];
    c[i] = at[0] - second / 6 + fourth / 36;
  }
}

}  // namespace

std::vector<double> spline_coefficients(const std::vector<double>& samples,
                                        const Eigen::Vector3i& count) {
  const Eigen::Vector3i size = count.array() + 2;
  const std::array<std::ptrdiff_t, 3> stride = {1, size.x(), std::ptrdiff_t{size.x()} * size.y()};
  std::vector<double> out(static_cast<std::size_t>(stride[2]) * size.z());
  std::size_t from = 0;
  for (int k = 0; k < count.z(); ++k)
    for (int j = 0; j < count.y(); ++j)
      for (int i = 0; i < count.x(); ++i)
        out[i + 1 + (j + 1) * stride[1] + (k + 1) * stride[2]] = samples[from++];
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> line(count[axis] + 2 * beyond), solved(size[axis]);
    // Axes done already have coefficients at both ends, too; the others have none there yet.
    const int one = axis == 0 ? 1 : 0, two = axis == 2 ? 1 : 2;
    const auto ends = [&](int other) { return other < axis ? 0 : 1; };
    for (int q = ends(two); q < size[two] - ends(two); ++q)
      for (int p = ends(one); p < size[one] - ends(one); ++p) {
        double* first = &out[p * stride[one] + q * stride[two]];
        for (int i = 0; i < count[axis]; ++i) line[beyond + i] = first[(i + 1) * stride[axis]];
        solve(line, solved, count[axis]);
        for (int i = 0; i < size[axis]; ++i) first[i * stride[axis]] = solved[i];
      }
  }
  return out;
}

}  // namespace carom
