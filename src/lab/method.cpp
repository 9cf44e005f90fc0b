// SPDX-License-Identifier: Apache-2.0
// One entry for all methods: a sweep that meets itself comes in parts, each part is a sheet, and a cut that fails is
// taken back as a whole.
#include "incise/lab/method.h"

#include <algorithm>

#include "cut/blade_constants.h"
#include "cut/constants.h"
#include "cut/cut_context.h"
#include "cut/spacing.h"
#include "cut/sweep.h"
#include "lab/bielser.h"
#include "lab/constants.h"
#include "lab/minimal.h"
#include "lab/moving.h"
#include "lab/removal.h"
#include "lab/snapping.h"

namespace incise {
inline namespace v0 {

namespace {

Status cut_sheet(LabMethod method, const CutContext& context, const Sheet& sheet, std::uint32_t tag, unsigned threads) {
  switch (method) {
    case LabMethod::kRemoval:
      return lab::remove_elements(context, sheet, tag, threads);
    case LabMethod::kSnapping:
      return lab::snap_nodes(context, sheet, tag, threads);
    case LabMethod::kMinimal:
      return lab::divide_minimally(context, sheet, tag, threads);
    case LabMethod::kMoving:
      return lab::move_and_divide(context, sheet, tag, threads);
    case LabMethod::kSeventeen:
      return lab::divide_into_17(context, sheet, tag, threads);
    case LabMethod::kAdaptive:
      return lab::divide_adaptively(context, sheet, tag, threads);
  }
  return Error{ErrorCode::kBadArgument, "there is no such method", {}};
}

Status cut_parts(LabMethod method, const CutContext& context, const Stroke& stroke, std::uint32_t tag,
                 unsigned threads) {
  context.statistics.steps = stroke.times.size() - 1;
  const double spacing = typical_spacing(context.mesh);
  const SweptSurface surface = sweep(stroke, kOwnSlit * spacing);
  for (const auto& part : split_at_self_crossings(surface, lab::kPartOverlap * spacing, kCoincident * spacing)) {
    if (Status status = cut_sheet(method, context, Sheet(surface, part), tag, threads); !status) return status;
    ++context.statistics.sheets;
  }
  return {};
}

}  // namespace

std::optional<LabMethod> find_lab_method(std::string_view name) {
  const auto* const found = std::find(kLabMethodNames.begin(), kLabMethodNames.end(), name);
  if (found == kLabMethodNames.end()) return std::nullopt;
  return static_cast<LabMethod>(found - kLabMethodNames.begin());
}

Result<CutStatistics> cut_by(LabMethod method, TetMesh& mesh, Journal& journal, const Stroke& stroke, std::uint32_t tag,
                             unsigned threads) {
  if (Status status = check(stroke); !status) return status.error();
  if (method != LabMethod::kMinimal && mesh.touched_itself_at_load()) {
    return Error{ErrorCode::kBadArgument,
                 "tets of the mesh touch without sharing a face, which the method " + std::string(name_of(method)) +
                     " cannot part; cut it with another profile",
                 {}};
  }
  StageTimes times;
  return cut_or_take_back(mesh, journal, times,
                          [&](const CutContext& context) { return cut_parts(method, context, stroke, tag, threads); });
}

}  // namespace v0
}  // namespace incise
