// SPDX-License-Identifier: Apache-2.0
// One list in the order in which it is drawn, so that each kind is a range of it.
#include "render/solid_rows.h"

#include <algorithm>

namespace incise {
inline namespace v0 {
namespace render {

void SolidRows::gather(const app::Picture& picture) {
  corners_.clear();
  if (picture.ground) corners_ = *picture.ground;
  ground_ = corners_.size();
  for (const bool is_ghost : {false, true}) {
    for (const app::Instrument& instrument : picture.marks.instruments) {
      if (instrument.is_ghost == is_ghost) add_solid(instrument, corners_);
    }
    if (!is_ghost) opaque_ = corners_.size();
  }
  // A place that is not finite would take its triangle over the whole picture.
  const auto is_sound = [](const app::SolidCorner& corner) {
    return corner.at.allFinite() && corner.normal.allFinite();
  };
  if (!std::all_of(corners_.begin(), corners_.end(), is_sound)) {
    corners_.clear();
    ground_ = opaque_ = 0;
  }
}

}  // namespace render
}  // namespace v0
}  // namespace incise
