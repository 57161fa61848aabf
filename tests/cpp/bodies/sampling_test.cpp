// SPDX-License-Identifier: Apache-2.0
#include "carom/bodies/sampling.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "carom/numerics/invalid_input.hpp"

#include "bodies/near.hpp"

namespace carom {
namespace {

using Points = TriangleMesh::Vertices;
const Eigen::Vector3d lower(-1, -1, -1), upper(1, 1, 1);
const DensityField ball =
    uniform_density([](const Eigen::Vector3d& p) { return p.squaredNorm() <= 1; }, 1000);

/// Root mean square error over seeds of one moment, relative to the closed form.
double rms(SamplingMethod method, long samples, int seeds) {
  const double exact = MassProperties::sphere(1, 1000).inertia(2, 2);
  double sum = 0;
  for (int seed = 0; seed < seeds; ++seed) {
    const MassProperties m =
        sampled(ball, lower, upper, {samples, method, static_cast<std::uint64_t>(seed)});
    sum += std::pow(m.inertia(2, 2) / exact - 1, 2);
  }
  return std::sqrt(sum / seeds);
}

TEST(Sampling, ErrorFallsAsTheRootOfTheSamples) {
  // Over 3 decades the slope from rms of 24 seeds each end: sigma = 2 / sqrt(48) / ln(1000) = 0.03
  const double slope = std::log10(rms(SamplingMethod::monte_carlo, 200'000, 24) /
                                  rms(SamplingMethod::monte_carlo, 200, 24)) /
                       3;
  EXPECT_NEAR(slope, -0.5, 0.1);
}

TEST(Sampling, StratifiedFallsSteeper) {
  // theory: -2/3 where cells on the surface rule
  const double slope = std::log10(rms(SamplingMethod::stratified, 200'000, 24) /
                                  rms(SamplingMethod::stratified, 200, 24)) /
                       3;
  EXPECT_NEAR(slope, -2.0 / 3, 0.1);
}

TEST(Sampling, StandardErrorIsTheScatterOverSeeds) {
  for (const SamplingMethod method : {SamplingMethod::monte_carlo, SamplingMethod::stratified}) {
    const MassProperties exact = MassProperties::sphere(1, 1000);
    const int seeds = 60;
    Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero(), claimed = Eigen::Matrix3d::Zero();
    double mass = 0, mass_claimed = 0;
    Eigen::Vector3d com = Eigen::Vector3d::Zero(), com_claimed = Eigen::Vector3d::Zero();
    for (int seed = 0; seed < seeds; ++seed) {
      const MassProperties m =
          sampled(ball, lower, upper, {4000, method, static_cast<std::uint64_t>(seed + 100)});
      scatter += (m.inertia - exact.inertia).cwiseAbs2();
      claimed += m.error->inertia.cwiseAbs2();
      mass += std::pow(m.mass - exact.mass, 2);
      mass_claimed += std::pow(m.error->mass, 2);
      com += m.com.cwiseAbs2();
      com_claimed += m.error->com.cwiseAbs2();
    }
    // a variance from 60 draws is off by sqrt(2/60) = 18 %, its root by 9 %; 4 sigma
    const auto as_claimed = [](double seen, double said) {
      return std::abs(std::sqrt(seen / said) - 1) < 0.37;
    };
    EXPECT_TRUE(as_claimed(mass, mass_claimed));
    for (int k = 0; k < 3; ++k) EXPECT_TRUE(as_claimed(com[k], com_claimed[k]));
    for (int k = 0; k < 9; ++k)
      EXPECT_TRUE(as_claimed(scatter.data()[k], claimed.data()[k])) << "entry " << k;
  }
}

TEST(Sampling, OfADensityThatVariesMeetsTheClosedForm) {
  // rho = 1000 (1 + z/2) in [-1, 1]^3: m = 8000, com z = 1/6, Izz = 8000 * 2/3,
  // Ixx about com = 8000 (2/3 - 1/36)
  const DensityField slope = [](const Points& p) -> Eigen::VectorXd {
    return 1000 * (1 + 0.5 * p.col(2).array());
  };
  const MassProperties m = sampled(slope, lower, upper, {100'000, SamplingMethod::stratified, 3});
  // 5 standard errors, themselves checked above
  EXPECT_NEAR(m.mass, 8000, 5 * m.error->mass);
  EXPECT_TRUE(near(m.com, Eigen::Vector3d(0, 0, 1.0 / 6), 5 * m.error->com.maxCoeff()));
  const Eigen::Vector3d moments(8000 * (2.0 / 3 - 1.0 / 36), 8000 * (2.0 / 3 - 1.0 / 36),
                                8000 * 2.0 / 3);
  EXPECT_TRUE(
      near(m.inertia, moments.asDiagonal().toDenseMatrix(), 5 * m.error->inertia.maxCoeff()));
  EXPECT_LT(m.error->mass, 8000 * 1e-4);
}

TEST(Sampling, GridOfCellCentresIsExactForItsSum) {
  // n^3 centres of the unit cube: 1/12 (1 - 1/n^2) per axis, and no estimate of the error
  const DensityField full = [](const Points& p) { return Eigen::VectorXd::Ones(p.rows()).eval(); };
  const MassProperties m = sampled(full, {0, 0, 0}, {1, 1, 1}, {1000, SamplingMethod::grid, 0});
  EXPECT_NEAR(m.inertia(0, 0), (1 - 0.01) / 6, 1e-14);  // sums of 1000 terms, u each
  EXPECT_TRUE(std::isnan(m.error->mass));
  EXPECT_EQ(m.error->samples, 1000);
}

TEST(Sampling, FarAwayAndTinyIsTheSameBody) {
  const MassProperties here = sampled(ball, lower, upper, {5000, SamplingMethod::stratified, 9});
  const Eigen::Vector3d far = Eigen::Vector3d::Constant(0x1p20);
  const auto moved =
      uniform_density([&](const Eigen::Vector3d& p) { return (p - far).squaredNorm() <= 1; }, 1000);
  const MassProperties there =
      sampled(moved, lower + far, upper + far, {5000, SamplingMethod::stratified, 9});
  // points are rounded to ulp(2^20) = 2e-10 there; few change sides
  EXPECT_TRUE(near(there.inertia, here.inertia, 1e-8 * here.inertia.norm()));
}

TEST(Sampling, SameSeedGivesTheSameBits) {
  const SamplingOptions options{3000, SamplingMethod::monte_carlo, 42};
  EXPECT_EQ(sampled(ball, lower, upper, options).inertia,
            sampled(ball, lower, upper, options).inertia);
  EXPECT_NE(sampled(ball, lower, upper, options).inertia,
            sampled(ball, lower, upper, {3000, SamplingMethod::monte_carlo, 43}).inertia);
}

TEST(Sampling, ErrorsAddUpInAUnion) {
  const MassProperties a = sampled(ball, lower, upper, {4000, SamplingMethod::monte_carlo, 1});
  const MassProperties pair =
      a + a.transformed(Eigen::Matrix3d::Identity(), Eigen::Vector3d(10, 0, 0));
  EXPECT_NEAR(pair.error->mass, std::sqrt(2.0) * a.error->mass, 1e-12 * a.error->mass);
  EXPECT_EQ(pair.error->samples, 8000);
  // At 5 m from the joint centre Izz gains 25 M, so 25 sigma_M of each dominates.
  const double arm = 25 * std::sqrt(2.0) * a.error->mass;
  EXPECT_GT(pair.error->inertia(2, 2), arm);
  EXPECT_LT(pair.error->inertia(2, 2), 1.5 * arm);
  const MassProperties exact = MassProperties::sphere(1, 1000);
  EXPECT_FALSE((exact + exact).error.has_value());
}

TEST(Sampling, RefusesWhatItCannotUse) {
  EXPECT_THROW((void)sampled(ball, upper, lower), InvalidInput);
  EXPECT_THROW((void)sampled(ball, lower, upper, {1, SamplingMethod::stratified, 0}), InvalidInput);
  const DensityField nothing = [](const Points& p) {
    return Eigen::VectorXd::Zero(p.rows()).eval();
  };
  EXPECT_THROW((void)sampled(nothing, lower, upper), InvalidInput);
  const DensityField negative = [](const Points& p) {
    return Eigen::VectorXd::Constant(p.rows(), -1).eval();
  };
  EXPECT_THROW((void)sampled(negative, lower, upper), InvalidInput);
}

TEST(Sampling, SaysWhenTheMassIsPoorlyKnown) {
  const auto speck =
      uniform_density([](const Eigen::Vector3d& p) { return p.squaredNorm() <= 0.05; }, 1000);
  EXPECT_FALSE(
      sampled(speck, lower, upper, {1000, SamplingMethod::monte_carlo, 0}).warnings.empty());
  EXPECT_TRUE(sampled(ball, lower, upper, {1000, SamplingMethod::monte_carlo, 0}).warnings.empty());
}

}  // namespace
}  // namespace carom
