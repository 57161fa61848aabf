// SPDX-License-Identifier: Apache-2.0
#include "carom/scene/effects.hpp"

#include <string>

#include "carom/numerics/invalid_input.hpp"
#include "carom/numerics/rotation.hpp"

namespace carom {
namespace {

constexpr EffectInfo table[] = {
    {"UniformGravity", "gravity", "F = m g", "U = -m g . x", "acceleration: m/s^2"},
    {"AppliedWrench", "applied_wrench", "F, T given; T += r x F", "P = F . v + T . omega",
     "force: N, torque: N m, point_b: m, until: s"},
    {"LinearDrag", "drag", "F = -coefficient (v - wind), T = -angular_coefficient omega",
     "P = F . v + T . omega", "coefficient: kg/s, angular_coefficient: N m s, wind: m/s"},
    {"TorsionSpring", "torsion", "T = -stiffness theta - damping omega",
     "U = stiffness theta^2 / 2; P = -damping omega^2",
     "stiffness: N m/rad, damping: N m s, rest: quaternion x y z w"},
    {"Repulsion", "repulsion", "dv = depth / dt along the normal; friction", "adds sum m v dv",
     "bounded: true or false, cap: m/s, interior_normals: true or false"},
};
static_assert(std::size(table) == std::variant_size_v<Effect>);

void require_finite(const Eigen::Vector3d& v, const std::string& field, std::string_view unit) {
  if (!v.allFinite()) throw InvalidInput(field, with_unit(v.transpose(), unit), "must be finite");
}

}  // namespace

std::span<const EffectInfo> effects_table() {
  return table;
}

std::optional<BodyId> body_of(const Effect& effect) {
  struct Body {
    std::optional<BodyId> operator()(const UniformGravity&) const { return {}; }
    std::optional<BodyId> operator()(const AppliedWrench& w) const { return w.body; }
    std::optional<BodyId> operator()(const LinearDrag& d) const { return d.body; }
    std::optional<BodyId> operator()(const TorsionSpring& s) const { return s.body; }
    std::optional<BodyId> operator()(const Repulsion&) const { return {}; }
  };
  return std::visit(Body{}, effect);
}

const EffectInfo& info_of(const Effect& effect) {
  return table[effect.index()];
}

void require_valid(const Effect& effect, std::string_view field) {
  struct Check {
    std::string field;
    void operator()(const UniformGravity& g) const {
      require_finite(g.acceleration, field + ".acceleration", "m/s^2");
    }
    void operator()(const AppliedWrench& w) const {
      require_finite(w.force, field + ".force", "N");
      require_finite(w.torque, field + ".torque", "N m");
      require_finite(w.point_b, field + ".point_b", "m");
      if (!(w.until >= 0))
        throw InvalidInput(field + ".until", with_unit(w.until, "s"), "must be >= 0");
    }
    void operator()(const LinearDrag& d) const {
      require_non_negative(d.coefficient, field + ".coefficient", "kg/s");
      require_non_negative(d.angular_coefficient, field + ".angular_coefficient", "N m s");
      require_finite(d.wind, field + ".wind", "m/s");
    }
    void operator()(const TorsionSpring& s) const {
      require_positive(s.stiffness, field + ".stiffness", "N m/rad",
                       "a damper alone is LinearDrag with an angular_coefficient");
      require_non_negative(s.damping, field + ".damping", "N m s");
      (void)unit_quaternion(s.rest.coeffs(), field + ".rest");
    }
    void operator()(const Repulsion& r) const { require_positive(r.cap, field + ".cap", "m/s"); }
  };
  std::visit(Check{std::string(field)}, effect);
}

}  // namespace carom
