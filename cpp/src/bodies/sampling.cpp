// SPDX-License-Identifier: Apache-2.0
#include "carom/bodies/sampling.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "carom/numerics/invalid_input.hpp"
#include "carom/numerics/tolerance.hpp"

#include "bodies/sampled_moments.hpp"

namespace carom {
namespace {

constexpr Eigen::Index chunk = 8192;  // points per call: a Python callable is dear, memory is not
using Points = TriangleMesh::Vertices;

/// Numbers in [0, 1) from the top 53 bits: the standard's own distributions differ by library.
struct Uniform {
  std::mt19937_64 engine;
  double operator()() { return static_cast<double>(engine() >> 11) * 0x1p-53; }
};

/// The most cells, nearly cubic, whose number is at most `budget`.
Eigen::Array3d cells_of(const Eigen::Vector3d& extents, double budget) {
  Eigen::Array3d n = Eigen::Array3d::Ones();
  for (;;) {
    Eigen::Index axis = 0;
    (extents.array() / n).maxCoeff(&axis);
    Eigen::Array3d more = n;
    more[axis] += 1;
    if (more.prod() > budget) return n;
    n = more;
  }
}

/// Evaluates the density with its answers checked; `unit` holds points in [-1, 1]^3.
Eigen::VectorXd evaluated(const DensityField& density, const Points& unit,
                          const Eigen::Vector3d& centre, const Eigen::Vector3d& half) {
  const Points points = (unit * half.asDiagonal()).rowwise() + centre.transpose();
  Eigen::VectorXd rho = density(points);
  if (rho.size() != points.rows())
    throw InvalidInput("density", std::to_string(rho.size()) + " values",
                       "must be one for each of " + std::to_string(points.rows()) + " points");
  for (Eigen::Index i = 0; i < rho.size(); ++i)
    if (!(rho[i] >= 0) || !std::isfinite(rho[i]))
      throw InvalidInput("density",
                         with_unit(rho[i], "kg/m^3") + " at " + with_unit(points.row(i), "m"),
                         "must be finite and >= 0 everywhere");
  return rho;
}

SampledMoments monte_carlo(const DensityField& density, const Eigen::Vector3d& centre,
                           const Eigen::Vector3d& half, const SamplingOptions& options) {
  SampledMoments m;
  Uniform uniform{std::mt19937_64(options.seed)};
  for (long done = 0; done < options.samples;) {
    Points unit(std::min<long>(chunk, options.samples - done), 3);
    for (Eigen::Index i = 0; i < unit.size(); ++i) unit.data()[i] = 2 * uniform() - 1;
    const Eigen::VectorXd rho = evaluated(density, unit, centre, half);
    for (Eigen::Index i = 0; i < rho.size(); ++i) {
      if (rho[i] == 0) continue;
      const SampledMoments::Vector f = rho[i] * SampledMoments::basis(unit.row(i).transpose());
      m.value += f;
      m.covariance.selfadjointView<Eigen::Lower>().rankUpdate(f);
    }
    done += unit.rows();
  }
  const double n = static_cast<double>(options.samples), volume = 8 * half.prod();
  m.covariance = m.covariance.selfadjointView<Eigen::Lower>();
  m.covariance -= m.value * m.value.transpose() / n;
  m.covariance *= volume * volume / (n * (n - 1));
  m.value *= volume / n;
  m.samples = options.samples;
  return m;
}

/// `per_cell` = 2: two random points in each cell; 1: its centre.
SampledMoments by_cells(const DensityField& density, const Eigen::Vector3d& centre,
                        const Eigen::Vector3d& half, const SamplingOptions& options, int per_cell) {
  SampledMoments m;
  const Eigen::Array3d n = cells_of(half, static_cast<double>(options.samples / per_cell));
  const long nx = static_cast<long>(n[0]), ny = static_cast<long>(n[1]);
  const long cells = static_cast<long>(n.prod());
  Uniform uniform{std::mt19937_64(options.seed)};
  for (long done = 0; done < cells;) {
    const long count = std::min<long>(chunk / per_cell, cells - done);
    Points unit(count * per_cell, 3);
    for (long i = 0; i < count; ++i) {
      const long cell = done + i;
      const Eigen::Array3d corner(static_cast<double>(cell % nx),
                                  static_cast<double>(cell / nx % ny),
                                  static_cast<double>(cell / (nx * ny)));
      for (int k = 0; k < per_cell; ++k) {
        Eigen::Array3d in_cell = Eigen::Array3d::Constant(0.5);
        if (per_cell == 2) in_cell = Eigen::Array3d::NullaryExpr([&] { return uniform(); });
        unit.row(i * per_cell + k) = 2 * (corner + in_cell) / n - 1;
      }
    }
    const Eigen::VectorXd rho = evaluated(density, unit, centre, half);
    for (long i = 0; i < count; ++i) {
      const auto f = [&](long row) -> SampledMoments::Vector {
        return rho[row] * SampledMoments::basis(unit.row(row).transpose());
      };
      if (per_cell == 1) {
        m.value += f(i);
        continue;
      }
      const SampledMoments::Vector a = f(2 * i), b = f(2 * i + 1);
      m.value += 0.5 * (a + b);
      m.covariance.selfadjointView<Eigen::Lower>().rankUpdate(a - b, 0.25);
    }
    done += count;
  }
  const double share = 8 * half.prod() / static_cast<double>(cells);
  m.covariance = m.covariance.selfadjointView<Eigen::Lower>();
  m.covariance *= share * share;
  m.value *= share;
  m.samples = cells * per_cell;
  return m;
}

}  // namespace

DensityField uniform_density(std::function<bool(const Eigen::Vector3d&)> inside, double density) {
  require_positive(density, "density", "kg/m^3");
  return [inside = std::move(inside), density](const Points& points) {
    Eigen::VectorXd rho(points.rows());
    for (Eigen::Index i = 0; i < points.rows(); ++i)
      rho[i] = inside(points.row(i).transpose()) ? density : 0.0;
    return rho;
  };
}

MassProperties sampled(const DensityField& density, const Eigen::Vector3d& lower,
                       const Eigen::Vector3d& upper, const SamplingOptions& options) {
  for (int k = 0; k < 3; ++k) {
    require_finite(lower[k], "lower", "m");
    require_finite(upper[k], "upper", "m");
    if (!(lower[k] < upper[k]))
      throw InvalidInput("lower", with_unit(lower[k], "m"), "must be below upper on every axis");
  }
  if (options.samples < 2)
    throw InvalidInput("samples", std::to_string(options.samples), "must be 2 at least");
  const Eigen::Vector3d centre = 0.5 * lower + 0.5 * upper, half = 0.5 * upper - 0.5 * lower;
  SampledMoments moments;
  switch (options.method) {
    case SamplingMethod::monte_carlo:
      moments = monte_carlo(density, centre, half, options);
      break;
    case SamplingMethod::stratified:
      moments = by_cells(density, centre, half, options, 2);
      break;
    case SamplingMethod::grid:
      moments = by_cells(density, centre, half, options, 1);
      break;
  }
  MassProperties body = body_of(moments, centre, half);
  if (!(body.mass > 0) || !std::isfinite(body.mass))
    throw InvalidInput("inside", std::to_string(moments.samples) + " samples, none inside",
                       "must hold a sample", "give tighter bounds or more samples");
  if (options.method == SamplingMethod::grid) {
    const double unknown = std::numeric_limits<double>::quiet_NaN();
    body.error->mass = unknown;
    body.error->com.setConstant(unknown);
    body.error->inertia.setConstant(unknown);
  } else if (!(body.error->mass <= tolerance::poor_sampling * body.mass)) {
    body.warnings.push_back("the mass is known to " +
                            with_unit(100 * body.error->mass / body.mass, "%") +
                            " only; give more samples or tighter bounds");
  }
  return body;
}

}  // namespace carom
