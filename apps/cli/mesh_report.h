// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "incise/image/image_file.h"
#include "incise/image/mesh_labels.h"
#include "label_names.h"
#include "mesh_arguments.h"

namespace incise_cli {

/// What `incise mesh` did. Nothing is owned but the names.
struct MeshReport {
  const MeshArguments* arguments = nullptr;
  const incise::image::ImageFile* file = nullptr;
  const incise::image::LabelMesh* made = nullptr;
  LabelNames names;
  bool is_scan = true;  ///< not a surface
  bool is_valid = false;
  double read_ms = 0, mesh_ms = 0;
};

/// JSON of format incise-mesh-report (docs/formats.md).
[[nodiscard]] std::string to_json(const MeshReport& report);
/// A few lines for people.
[[nodiscard]] std::string to_text(const MeshReport& report);

}  // namespace incise_cli
