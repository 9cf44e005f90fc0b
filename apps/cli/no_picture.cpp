// SPDX-License-Identifier: Apache-2.0
// Stands for picture.cpp where the program is built without what draws.
#include "picture.h"

namespace incise_cli {
namespace {

incise::Error not_built() {
  return {incise::ErrorCode::kUnsupported,
          "--picture: this program was built without what draws; configure it with -DINCISE_BUILD_VIEW=ON",
          {}};
}

}  // namespace

incise::Status check_drawing() {
  return not_built();
}

incise::Status draw_cut(const incise::Engine& /*engine*/, incise::app::FineView* /*fine*/,
                        const std::filesystem::path& /*file*/) {
  return not_built();
}

incise::Status draw_labels(const incise::Engine& /*engine*/, const std::filesystem::path& /*file*/) {
  return not_built();
}

}  // namespace incise_cli
