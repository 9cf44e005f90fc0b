// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/hands/hand_queue.h"
#include "app/hands/tools.h"
#include "app/session/quality_monitor.h"
#include "app/session/session.h"
#include "app/view/fine_view.h"
#include "app/view/picture.h"
#include "app/view/surface_view.h"
#include "folder.h"
#include "render/mark_rows.h"
#include "render/solid_rows.h"
#include "render/surface_normals.h"
#include "render/surface_places.h"
#include "values.h"

namespace incise_web {

/// A session under hands, as the window runs it: physics, tools, camera, undo, recordings, and the surface to draw.
/// Calls that fail return an `Error`, see `to_error`.
class WebSession {
 public:
  WebSession(std::unique_ptr<Folder> folder, incise::app::Session session);

  /// A mesh, a scene or a recording, told apart by what is in it. `files`: an object of further files by name, which a
  /// scene's or a recording's model is looked for in. `up`: of a mesh, three numbers.
  static val open(const val& bytes, const std::string& name, const val& files, const val& up);

  /// @param free_height  of the picture, around its middle, that controls leave free: bodies are framed there.
  void resize(int width, int height, int free_height);
  /// @param kind  0 move, 1 press, 2 release, 3 wheel. @param button  0 left, 1 right, 2 middle.
  /// @param keys  1 shift, 2 control, 4 alt.
  void pointer(int kind, double x, double y, int button, int keys, double wheel, double pressure);
  void choose(int tool);
  [[nodiscard]] int tool() const { return static_cast<int>(tools_.tool()); }
  bool cancel();
  /// A share of the body's shortest side, in [0.01, 2].
  void set_depth(double share);
  [[nodiscard]] double depth() const;
  void frame_body();

  val frame();
  /// Whether hands or a stroke that is followed move the blade, so that frames must go on.
  [[nodiscard]] bool is_busy() const;
  val undo();
  val redo();
  val reset();
  [[nodiscard]] bool is_replay() const { return session_.is_replay(); }
  [[nodiscard]] val place() const;
  val seek(double call);
  bool take_over();

  /// Catches up with the mesh. Returns whether triangles changed.
  bool refresh();
  [[nodiscard]] val surface() const;
  /// As the last call of `marks` left it: what that shows is not cut off.
  [[nodiscard]] val camera() const;
  /// Marks of the hands and the scene, as rows of numbers; instruments as triangles.
  [[nodiscard]] val marks();
  /// What colours tell: a place in `app::kColorNames`.
  [[nodiscard]] int color() const { return static_cast<int>(picture_.options.color); }
  void choose_color(int color);
  [[nodiscard]] val figures() const;
  [[nodiscard]] val quality();
  [[nodiscard]] val log() const;
  [[nodiscard]] unsigned pieces() const;
  [[nodiscard]] std::string title() const { return session_.title(); }
  [[nodiscard]] std::string hash() const;
  [[nodiscard]] std::string mesh_hash() const { return to_hex(session_.mesh().hash()); }
  /// What was done so far, as `incise replay` and `open` take it.
  [[nodiscard]] val recording() const;
  [[nodiscard]] val write(const std::string& extension) const;

 private:
  void set_hands();
  incise::Status bind_surface();
  void begin_anew();
  void lay_drapes();
  void follow();
  void fill_corners();
  void fill_rows();
  void frame_camera();

  std::unique_ptr<Folder> folder_;
  incise::app::Session session_;
  incise::app::SurfaceView surface_;
  std::optional<incise::app::FineView> fine_;  // shown in its place where the scene has a fine surface
  incise::app::ToolMachine tools_;
  incise::app::HandQueue queue_;
  incise::app::Picture picture_;
  incise::app::Camera framed_;  // as the picture's last looked at the whole body
  incise::app::Viewport viewport_;
  int free_height_ = viewport_.height;
  incise::app::QualityMonitor monitor_;
  incise::Box body_;
  incise::render::SurfaceNormals averages_;
  incise::render::SurfacePlaces places_;
  incise::render::MarkRows mark_rows_;
  incise::render::SolidRows solid_rows_;
  std::vector<Eigen::Vector3f> positions_, normals_;              // per corner of a triangle in use
  std::vector<Eigen::Vector4f> corner_places_;                    // likewise
  std::vector<incise::app::TriangleLook> looks_;                  // likewise
  std::vector<float> lines_, rims_, balls_, triangles_, solids_;  // rows
  double depth_share_ = 0.125;
};

}  // namespace incise_web
