// SPDX-License-Identifier: Apache-2.0
// One list of what must hold, each with a static text, so that the check in the thread at 1 kHz allocates nothing.
#include "incise/sim/haptic_snapshot.h"

#include <cmath>

#include "sim/haptic/amounts.h"

namespace incise {
inline namespace v0 {

namespace {

using detail::is_amount;
using detail::is_within_bounds;

/// No negative eigenvalue, by the principal minors; rounding of a part in 10⁹ is let pass.
bool is_semidefinite(const Eigen::Matrix3d& m) {
  const double scale = m.cwiseAbs().maxCoeff();
  const double slack = 1e-9;
  const auto minor = [&](int i, int j) { return m(i, i) * m(j, j) - m(i, j) * m(j, i); };
  return m.diagonal().minCoeff() >= -slack * scale && minor(0, 1) >= -slack * scale * scale &&
         minor(0, 2) >= -slack * scale * scale && minor(1, 2) >= -slack * scale * scale &&
         m.determinant() >= -slack * scale * scale * scale;
}

bool is_symmetric(const Eigen::Matrix3d& m) {
  return (m - m.transpose()).cwiseAbs().maxCoeff() <= 1e-6 * m.cwiseAbs().maxCoeff();
}

bool is_unit(const Vec3& direction) {
  return std::abs(direction.squaredNorm() - 1) <= 2e-6;
}

/// What is wrong with a snapshot, in static words; null where nothing is.
const char* find_defect(const HapticSnapshot& s) {
  if (!s.touches) return nullptr;
  if (!is_within_bounds(s.tool_position) || !is_within_bounds(s.contact_point)) {
    return "its places must be finite, and lie within 1e+15 m";
  }
  if (!is_within_bounds(s.force)) return "its force must be finite, and at most 1e+15 N";
  if (!is_unit(s.cutting_direction) || !is_unit(s.flat_normal)) return "its directions must have length 1";
  if (!(std::abs(s.cutting_direction.dot(s.flat_normal)) <= 1e-6)) {
    return "the blade's normal must be orthogonal to the cutting direction";
  }
  if (!(s.compliance.array().abs() <= detail::kGreatestAmount).all()) {
    return "its compliance must be finite, and at most 1e+15 m/N";
  }
  if (!is_symmetric(s.compliance)) return "its compliance must be symmetric";
  if (!is_semidefinite(s.compliance)) return "its compliance must have no negative eigenvalue";
  if (!is_amount(s.engaged_length) || !is_amount(s.toughness) || !is_amount(s.cut_friction)) {
    return "its length, toughness and friction must lie in [0, 1e+15]";
  }
  return nullptr;
}

}  // namespace

bool is_sound(const HapticSnapshot& snapshot) {
  return find_defect(snapshot) == nullptr;
}

Status check(const HapticSnapshot& snapshot) {
  const char* defect = find_defect(snapshot);
  if (defect == nullptr) return {};
  return Error{ErrorCode::kBadArgument, std::string("a haptic snapshot is refused: ") + defect, {snapshot.serial}};
}

}  // namespace v0
}  // namespace incise
