// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "app/model/organ.h"
#include "mesh_arguments.h"

namespace incise_cli {

/// What `incise mesh` did. Nothing is owned but the layers.
struct MeshReport {
  const MeshArguments* arguments = nullptr;
  const incise::app::OrganInput* input = nullptr;
  const incise::app::Organ* organ = nullptr;
  std::vector<incise::image::Layer> layers;  ///< as asked for
  bool is_valid = false;
  double read_ms = 0, mesh_ms = 0;
};

/// JSON of format incise-mesh-report (docs/formats.md).
[[nodiscard]] std::string to_json(const MeshReport& report);
/// A few lines for people.
[[nodiscard]] std::string to_text(const MeshReport& report);

}  // namespace incise_cli
