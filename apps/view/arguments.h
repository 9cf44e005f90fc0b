// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/session/session.h"
#include "app/view/picture.h"
#include "shared/device_arguments.h"

namespace incise_view {

struct Arguments {
  std::string file;  ///< scene, mesh or recording; empty: a patch of skin
  unsigned threads = 1;
  std::string record;                                 ///< from the start
  std::size_t keep_undo = incise::app::kKeptStrokes;  ///< strokes; 0: all
  std::string device = "mouse";  ///< "mouse", "none", "haply[=host:port]", or a blade file that is the hand
  incise_apps::DeviceArguments haptic;
  std::string surface;  ///< a fine surface that is shown; empty: the scene's
  std::string up;       ///< empty: y for scans, z for all else
  bool is_paused = false;
  double speed = 1;

  // Of a segmented scan or a surface, which is meshed first.
  double tet_size = 0;      ///< mm
  std::string names, mesh;  ///< files
  std::vector<int> labels, layers_in;
  std::vector<std::string> layers;
  int halvings = 2;

  // How it is drawn.
  incise::app::Viewport size;
  std::optional<unsigned> samples;
  incise::app::ViewOptions view;
  bool has_view = false;  ///< asked for on the command line
  bool has_no_shadows = false;
  std::optional<incise::Vec3> from, target;
  double zoom = 1;
  std::optional<incise::app::HalfSpace> clip;

  // Without a window.
  bool is_headless = false;
  bool is_quiet = false;
  std::uint64_t frame = 0;
  bool has_frame = false;
  std::string screenshot;
  std::string sequence, film;
  std::uint64_t every = 1;
  double spread = 0;                ///< of pieces, a share of the body's size
  std::string trajectory;           ///< a blade file whose sweep is shown
  bool shows_incision = false;      ///< walls as incision faces
  bool shows_cut_vertices = false;  ///< balls where vertices were divided

  /// Whether the file is to be meshed.
  [[nodiscard]] bool has_scan() const;
  [[nodiscard]] incise::app::SessionOptions session_options() const;
};

/// Reads the command line. Returns the exit code where the program is to end at once: after --help, or wrong usage.
std::optional<int> parse(int argc, char** argv, Arguments& arguments);

/// The session that the arguments name: scans are meshed first, and what was done to them is said on stderr.
/// Errors: as `Session::open` and `make_scan_scene`.
incise::Result<incise::app::Session> open_session(const Arguments& arguments);

/// What the hand of `--device` does by itself; nothing for a mouse. Errors: as `read_blade`.
incise::Result<std::vector<incise::Stroke>> device_strokes(const Arguments& arguments);

}  // namespace incise_view
