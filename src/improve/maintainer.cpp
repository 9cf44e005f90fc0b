// SPDX-License-Identifier: Apache-2.0
#include "incise/improve/maintainer.h"

namespace incise::inline v0 {

class Maintainer::Queue {};

Maintainer::Maintainer(MaintainOptions) : queue_(std::make_unique<Queue>()) {}
Maintainer::Maintainer(Maintainer&&) noexcept = default;
Maintainer& Maintainer::operator=(Maintainer&&) noexcept = default;
Maintainer::~Maintainer() = default;
void Maintainer::set_reference(std::uint32_t, TriangleTree) {}
void Maintainer::take_up(const TetMesh&, const Journal&, std::size_t) {}
void Maintainer::take_up_all(const TetMesh&) {}
MaintainStatistics Maintainer::run(TetMesh&, Journal&, std::uint64_t, StageTimes&) {
  return {};
}
bool Maintainer::has_work() const {
  return false;
}
void Maintainer::forget() {}

}  // namespace incise::inline v0
