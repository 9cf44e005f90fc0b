// SPDX-License-Identifier: Apache-2.0
// Everything in here lives in a namespace of its own, so that it does not meet the library's kernel at link time.
#define v0 v0_plain                    // NOLINT(readability-identifier-naming): the library's namespace
#include "sim/body/contact_terms.cpp"  // NOLINT(bugprone-suspicious-include): what the kernel calls
#include "sim/body/star_kernel.cpp"    // NOLINT(bugprone-suspicious-include): the file under test, without Highway
#undef v0

#include "plain_kernel.h"

static_assert(INCISE_WITH_HIGHWAY == 0);

namespace incise::test {

namespace {
namespace plain = incise::v0_plain::detail;

plain::Descent descent_of(const PlainDescent& d) {
  return {d.places,
          static_cast<const plain::StarBlock*>(d.blocks),
          static_cast<const plain::Star*>(d.stars),
          static_cast<const plain::Motion*>(d.motions),
          static_cast<const plain::PullTerm*>(d.terms),
          static_cast<const plain::PullUse*>(d.uses),
          nullptr,
          nullptr,
          d.rows,
          d.slots,
          static_cast<const plain::PackedStar*>(d.packed),
          static_cast<const plain::PackedStar*>(d.parts),
          static_cast<const plain::NearLanes*>(d.near),
          static_cast<const plain::TetLanes*>(d.tets),
          static_cast<const plain::NodeTerm*>(d.nodes),
          static_cast<const plain::StiffeningBlock*>(d.stiffening),
          static_cast<const plain::FibreBlock*>(d.fibres)};
}
}  // namespace

void plain_sweep(const PlainDescent& descent, std::span<const std::uint32_t> order, bool is_backward) {
  plain::sweep(descent_of(descent), order, is_backward);
}

void plain_find_pressures(const PlainDescent& descent, std::span<const std::uint32_t> vertices) {
  plain::find_pressures(descent_of(descent), vertices);
}

void plain_pick_starts(const PlainDescent& descent, std::span<const std::uint32_t> order) {
  plain::pick_starts(descent_of(descent), order);
}

}  // namespace incise::test
