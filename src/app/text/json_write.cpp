// SPDX-License-Identifier: Apache-2.0
// What all reports encode alike: what is not finite becomes null, and a hash 16 digits.
#include "app/text/json_write.h"

#include <cmath>

#include "app/text/formatted.h"

namespace incise {
inline namespace v0 {
namespace app {

Json encode(double number) {
  return std::isfinite(number) ? Json(number) : Json();
}

Json encode(const Vec3& point) {
  return Json::array({encode(point.x()), encode(point.y()), encode(point.z())});
}

Json encode(const std::vector<Vec3>& points) {
  Json list = Json::array();
  for (const Vec3& point : points) list.push_back(encode(point));
  return list;
}

Json encode(const QualityStats& q) {
  const bool has_figures = q.tets > q.flat_tets;
  const auto figure = [&](double x) { return has_figures ? encode(x) : Json(); };
  return {{"tets", q.tets},
          {"flat_tets", q.flat_tets},
          {"lr_min", figure(q.lr_min)},
          {"lr_mean", figure(q.lr_mean)},
          {"lr_p99", figure(q.lr_p99)},
          {"lr_max", figure(q.lr_max)},
          {"lr_over_200_pct", q.tets > 0 ? encode(q.lr_over_200_pct) : Json()},
          {"dihedral_min_deg", figure(q.dihedral_min_deg)},
          {"dihedral_max_deg", figure(q.dihedral_max_deg)}};
}

Json encode(const ValidityReport& report) {
  Json root;
  root["ok"] = report.ok;
  root["violations"] = Json::object();
  for (std::size_t i = 0; i < kViolationKinds; ++i) {
    if (report.counts[i] > 0)
      root["violations"][std::string(name_of(static_cast<ViolationKind>(i)))] = report.counts[i];
  }
  root["first"] = Json::array();
  for (const Violation& v : report.first) {
    root["first"].push_back({{"kind", std::string(name_of(v.kind))}, {"ids", {v.ids[0], v.ids[1]}}});
  }
  return root;
}

std::string hash_text(std::uint64_t hash) {
  return formatted("{:016x}", hash);
}

}  // namespace app
}  // namespace v0
}  // namespace incise
