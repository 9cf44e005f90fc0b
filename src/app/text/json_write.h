// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "incise/geom/vec.h"
#include "incise/mesh/quality_stats.h"
#include "incise/mesh/validate.h"

namespace incise {
inline namespace v0 {
namespace app {

using Json = nlohmann::ordered_json;

/// A number, or null where it is not finite.
Json encode(double number);
Json encode(const Vec3& point);
Json encode(const std::vector<Vec3>& points);
/// The figures are null where no tet was measured.
Json encode(const QualityStats& quality);
/// Without the judgement: counts of the kinds that occur, and the first few with ids.
Json encode(const ValidityReport& report);

/// A state hash as files and messages have it: 16 hexadecimal digits.
std::string hash_text(std::uint64_t hash);

}  // namespace app
}  // namespace v0
}  // namespace incise
