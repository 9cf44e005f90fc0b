// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "app/viewer/viewer.h"

namespace incise_view {

/// What panels need to know beside the viewer.
struct PanelContext {
  incise::app::Viewport viewport;
  std::string renderer_name;
  bool is_software = false;  ///< the processor draws
};

class FirstPanels;

class Panels {
 public:
  Panels();
  Panels(const Panels&) = delete;
  Panels& operator=(const Panels&) = delete;
  ~Panels();
  /// Draws all panels for a frame; what the person changes in them goes to the viewer.
  void draw(incise::app::Viewer& viewer, const PanelContext& context);

 private:
  std::unique_ptr<FirstPanels> first_;
};

}  // namespace incise_view
