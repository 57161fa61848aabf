// SPDX-License-Identifier: Apache-2.0
#include "carom/bodies/particles.hpp"

#include <random>

#include <gtest/gtest.h>

#include "carom/numerics/invalid_input.hpp"
#include "carom/numerics/rotation.hpp"
#include "carom/numerics/tolerance.hpp"

#include "bodies/near.hpp"

namespace carom {
namespace {

constexpr double u = tolerance::unit_roundoff;

/// Particles within 1 m of the origin, masses up to 1 kg.
Particles cloud(int n) {
  std::mt19937 engine(13);
  std::uniform_real_distribution<double> place(-1, 1), mass(0.01, 1);
  Particles p{Rows3(n, 3), Eigen::VectorXd(n)};
  for (int i = 0; i < n; ++i) {
    p.positions.row(i) << place(engine), place(engine), place(engine);
    p.masses[i] = mass(engine);
  }
  return p;
}

struct Flight {
  Particles body = centred(cloud(50));
  Pose pose{{3, -2, 5}, Eigen::Quaterniond(0.5, 0.1, -0.7, 0.4).normalized()};
  Eigen::Vector3d V{1, 2, -0.5}, omega{0.3, -2, 1.1};
  Rows3 x = to_world(body.positions, pose);
  Rows3 v = rigid_velocities(x, pose.position, V, omega);
  MassProperties rigid = mass_properties(body);
  Eigen::Matrix3d R = pose.orientation.toRotationMatrix();
  Eigen::Matrix3d I = R * rigid.inertia * R.transpose();
};
// Sums of 50 terms of size < 50: each rounding is u of that, some 10 per term.
constexpr double allowed = 50 * 50 * 10 * u;

TEST(Particles, GoToTheWorldAndBack) {
  const Flight f;
  EXPECT_TRUE(near(to_object(f.x, f.pose), f.body.positions, 32 * u * 8));
}

TEST(Particles, CentredHaveTheirCentreOfMassAtTheOrigin) {
  const Particles p = cloud(50);
  const MassProperties before = mass_properties(p), after = mass_properties(centred(p));
  EXPECT_TRUE(near(after.com, Eigen::Vector3d::Zero(), 2 * u));
  EXPECT_TRUE(near(after.inertia, before.inertia, 8 * u * before.inertia.norm() * 2));
  EXPECT_TRUE(near(centred(p).positions.rowwise() + before.com.transpose(), p.positions, 2 * u));
}

TEST(Particles, MoveAsTheMapXEqualsRpPlusXDoes) {
  // v = dx/dt by a central difference of the map itself: h^2 |omega|^3 / 6 + u |x| / h
  const Flight f;
  const double h = 1e-5;
  const auto at = [&](double t) {
    return to_world(f.body.positions, {f.pose.position + t * f.V,
                                       rotation_exponential(t * f.omega) * f.pose.orientation});
  };
  const Rows3 v = (at(h) - at(-h)) / (2 * h);
  EXPECT_TRUE(near(v, f.v, h * h * 4 + 8 * u * 8 / h));
}

TEST(Particles, CarryTheMomentumOfTheBody) {
  const Flight f;
  EXPECT_TRUE(near(momentum(f.body.masses, f.v), f.rigid.mass * f.V, allowed));
  EXPECT_TRUE(
      near(angular_momentum(f.body.masses, f.x, f.v, f.pose.position), f.I * f.omega, allowed));
  EXPECT_NEAR(kinetic_energy(f.body.masses, f.v),
              0.5 * f.rigid.mass * f.V.squaredNorm() + 0.5 * f.omega.dot(f.I * f.omega), allowed);
}

TEST(Particles, InertiaHasTheSignTheNotesLose) {
  // sum m x*^T x* = -sum m x* x*; as printed, without the transpose, it would be negative.
  const Flight f;
  Eigen::Matrix3d right = Eigen::Matrix3d::Zero(), printed = Eigen::Matrix3d::Zero();
  for (int i = 0; i < 50; ++i) {
    const Eigen::Matrix3d s = skew(f.x.row(i).transpose() - f.pose.position);
    right += f.body.masses[i] * s.transpose() * s;
    printed += f.body.masses[i] * s * s;
  }
  EXPECT_TRUE(near(right, f.I, allowed));
  EXPECT_TRUE(near(printed, -f.I, allowed));
}

TEST(Particles, WithInternalForcesFeelNoNetForceOrTorque) {
  const Flight f;
  Rows3 forces = Rows3::Zero(50, 3), crooked = Rows3::Zero(50, 3);
  for (int i = 0; i < 50; ++i)
    for (int j = 0; j < i; ++j) {
      const Eigen::RowVector3d along = std::cos(i * j) * (f.x.row(i) - f.x.row(j));
      forces.row(i) += along;
      forces.row(j) -= along;
      crooked.row(i) += Eigen::RowVector3d(1, 0, 0);  // equal and opposite, but not along the line
      crooked.row(j) -= Eigen::RowVector3d(1, 0, 0);
    }
  const Wrench net = net_wrench(forces, f.x, f.pose.position);
  EXPECT_TRUE(near(net.force, Eigen::Vector3d::Zero(), 50 * allowed));
  EXPECT_TRUE(near(net.torque, Eigen::Vector3d::Zero(), 50 * allowed));
  EXPECT_GT(net_wrench(crooked, f.x, f.pose.position).torque.norm(), 1);
}

TEST(Particles, AngularMomentumChangesByTheTorqueOnlyInTheSum) {
  // tau_i = d/dt [m (x_i - X) x v_i] fails for one particle, by -m V x v_i; the sum of those is 0.
  const Flight f;
  std::mt19937 engine(17);
  std::normal_distribution<double> normal;
  Rows3 forces(50, 3);
  for (int i = 0; i < 150; ++i) forces.data()[i] = normal(engine);
  // dX/dt = V, dv_i/dt = F_i/m_i: the rate of each term by the product rule
  Eigen::Vector3d rate = Eigen::Vector3d::Zero();
  double one_is_wrong_by = 0;
  for (int i = 0; i < 50; ++i) {
    const Eigen::Vector3d x = f.x.row(i).transpose() - f.pose.position;
    const Eigen::Vector3d v = f.v.row(i).transpose(), F = forces.row(i).transpose();
    const Eigen::Vector3d term = f.body.masses[i] * (v - f.V).cross(v) + x.cross(F);
    EXPECT_TRUE(near(term - x.cross(F), -f.body.masses[i] * f.V.cross(v), allowed));
    one_is_wrong_by = std::max(one_is_wrong_by, (term - x.cross(F)).norm());
    rate += term;
  }
  EXPECT_GT(one_is_wrong_by, 0.1);
  EXPECT_TRUE(near(rate, net_wrench(forces, f.x, f.pose.position).torque, allowed));
}

TEST(Particles, OnSpringsOfGrowingStiffnessMoveLikeTheRigidBody) {
  // The notes' own picture: every pair joined by a very stiff spring. Velocity Verlet on the
  // springs against the rigid equations by classical Runge-Kutta; they differ by the stretch under
  // the centrifugal load, which falls as 1/k.
  const Particles body =
      centred({(Rows3(4, 3) << 0, 0, 0, 1, 0, 0, 0, 0.7, 0, 0.2, 0.1, 0.5).finished(),
               Eigen::Vector4d(1, 2, 1.5, 0.7)});
  const Eigen::Vector3d V(0.5, -1, 0.2), omega0(0.4, 1.2, -0.8);
  const Eigen::Matrix3d I = mass_properties(body).inertia, J = inverse_inertia(I);
  const double horizon = 0.5;

  // Rigid: world L is constant; R' = (R J R^T L)* R.
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  const Eigen::Vector3d L = I * omega0;
  const auto rate = [&](const Eigen::Matrix3d& A) -> Eigen::Matrix3d {
    return skew(A * J * A.transpose() * L) * A;
  };
  const int n = 2000;
  for (int i = 0; i < n; ++i) {
    const double h = horizon / n;
    const Eigen::Matrix3d a = rate(R), b = rate(R + h / 2 * a), c = rate(R + h / 2 * b),
                          d = rate(R + h * c);
    R += h / 6 * (a + 2 * b + 2 * c + d);
  }
  const Rows3 expected = (body.positions * R.transpose()).rowwise() + horizon * V.transpose();

  const auto miss = [&](double k) {
    Rows3 x = body.positions;
    Rows3 v = rigid_velocities(x, Eigen::Vector3d::Zero(), V, omega0);
    const auto acceleration = [&] {
      Rows3 a = Rows3::Zero(4, 3);
      for (int i = 0; i < 4; ++i)
        for (int j = 0; j < i; ++j) {
          const Eigen::RowVector3d d = x.row(i) - x.row(j);
          const double rest = (body.positions.row(i) - body.positions.row(j)).norm();
          const Eigen::RowVector3d F = -k * (d.norm() - rest) * d.normalized();
          a.row(i) += F / body.masses[i];
          a.row(j) -= F / body.masses[j];
        }
      return a;
    };
    const int steps = 20000;
    const double h = horizon / steps;
    Rows3 a = acceleration();
    for (int i = 0; i < steps; ++i) {
      v += h / 2 * a;
      x += h * v;
      a = acceleration();
      v += h / 2 * a;
    }
    return (x - expected).rowwise().norm().maxCoeff();
  };
  const double soft = miss(1e4), stiff = miss(1e6);
  // stretch = m omega^2 r / k, twice that as the springs start to swing, times the lag it causes
  EXPECT_LT(stiff, 1e-5);
  EXPECT_GT(soft / stiff, 30);
  EXPECT_LT(soft / stiff, 300);
}

TEST(Particles, OnALineAreARodAndOneIsAPoint) {
  Rows3 line(5, 3);
  for (int i = 0; i < 5; ++i)
    line.row(i) = Eigen::RowVector3d(1e6, 3, -7) + i * Eigen::RowVector3d(0.1, 0.2, 0.7);
  const MassProperties rod = mass_properties({line, Eigen::VectorXd::Ones(5)});
  EXPECT_EQ(inertia_rank(rod.inertia), 2);
  EXPECT_TRUE(inverse_inertia(rod.inertia).allFinite());
  const MassProperties point = mass_properties({line.topRows(1), Eigen::VectorXd::Ones(1)});
  EXPECT_EQ(point.inertia, Eigen::Matrix3d::Zero());
  EXPECT_EQ(inertia_rank(point.inertia), 0);
}

TEST(Particles, OfManyBecomeTheIntegral) {
  // Cell centres of n^3 cells of a cube: 1/6 (1 - 1/n^2) exactly, by the sum of squares.
  const int n = 10;
  Particles p{Rows3(n * n * n, 3), Eigen::VectorXd::Constant(n * n * n, 1.0 / (n * n * n))};
  for (int i = 0; i < n * n * n; ++i)
    p.positions.row(i) << (i % n + 0.5) / n, (i / n % n + 0.5) / n, (i / n / n + 0.5) / n;
  const double expected = (1 - 1.0 / (n * n)) / 6;
  EXPECT_NEAR(mass_properties(p).inertia(1, 1), expected, 16 * u * expected);
}

TEST(Particles, ThatWeighNothingAreRefused) {
  EXPECT_THROW((void)mass_properties({Rows3::Zero(2, 3), Eigen::VectorXd::Zero(2)}), InvalidInput);
  EXPECT_THROW((void)mass_properties({Rows3::Zero(2, 3), Eigen::VectorXd::Ones(3)}), InvalidInput);
  EXPECT_THROW((void)mass_properties({Rows3::Zero(2, 3), Eigen::Vector2d(2, -1)}), InvalidInput);
  EXPECT_THROW((void)mass_properties({Rows3(0, 3), Eigen::VectorXd(0)}), InvalidInput);
}

}  // namespace
}  // namespace carom
