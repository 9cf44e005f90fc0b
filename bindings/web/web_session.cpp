// SPDX-License-Identifier: Apache-2.0
#include "web_session.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/hands/scene_hand_tools.h"
#include "app/scene/view_names.h"
#include "app/view/drapes.h"
#include "app/view/scene_camera.h"
#include "app/view/scene_fine_view.h"
#include "incise/io/mesh_export.h"
#include "incise/io/mesh_file.h"
#include "incise/mesh/bounds.h"
#include "incise/mesh/components.h"
#include "render/scene_box.h"

namespace incise_web {

namespace app = incise::app;
namespace render = incise::render;
using incise::Result;
using incise::Status;
using incise::Vec3;

namespace {

constexpr const char* kRecording = "recording.jsonl";

double shortest(const incise::Box& body) {
  return body.is_empty() ? 1 : std::max((body.hi - body.lo).minCoeff(), 0.01 * (body.hi - body.lo).maxCoeff());
}

void push(std::vector<float>& row, const Eigen::Vector3f& point) {
  row.insert(row.end(), {point.x(), point.y(), point.z()});
}

val to_array(const app::Mat4& matrix) {
  return copy_of("Float64Array", std::vector<double>(matrix.data(), matrix.data() + matrix.size()));
}

}  // namespace

WebSession::WebSession(std::unique_ptr<Folder> folder, app::Session session)
    : folder_(std::move(folder)),
      session_(std::move(session)),
      surface_(session_.mesh(), session_.engine().journal()),
      tools_(app::ToolSettings{}),
      monitor_(session_.mesh(), session_.engine().journal()) {}

val WebSession::open(const val& bytes, const std::string& name, const val& files, const val& up) {
  auto folder = std::make_unique<Folder>();
  Status status = folder->write(name, from_bytes(bytes));
  if (!files.isUndefined()) {
    const val names = val::global("Object").call<val>("keys", files);
    for (unsigned i = 0; status.ok() && i < names["length"].as<unsigned>(); ++i) {
      status = folder->write(names[i].as<std::string>(), from_bytes(files[names[i]]));
    }
  }
  if (!status.ok()) return to_error(status.error());
  app::SessionOptions options;
  options.plays_script = false;
  if (!up.isUndefined()) {
    const Result<Vec3> upwards = to_vec3(up, "up");
    if (!upwards.ok()) return to_error(upwards.error());
    if (upwards->isZero(0)) return to_error({incise::ErrorCode::kBadArgument, "up has to have a length", {}});
    options.up = upwards->normalized();
  }
  Result<app::Session> session = app::Session::open(folder->place_of(name), options);
  if (!session.ok()) return to_error(folder->named(session.error()));
  auto made = std::make_shared<WebSession>(std::move(folder), std::move(session).value());
  if (const Status bound = made->bind_surface(); !bound.ok()) return to_error(made->folder_->named(bound.error()));
  made->picture_.options = app::view_options_of(made->session_.scene());
  made->begin_anew();
  made->frame_camera();
  made->lay_drapes();
  return val(made);
}

/// Binds the fine surface that the scene names, if any.
Status WebSession::bind_surface() {
  fine_.reset();
  Result<std::optional<app::FineView>> made =
      app::fine_view_of(session_.scene(), session_.mesh(), session_.engine().journal());
  if (!made.ok()) return made.error();
  fine_ = std::move(made).value();
  return {};
}

/// Cloths around the body where the scene has them.
void WebSession::lay_drapes() {
  const app::Scene& scene = session_.scene();
  if (!scene.view || !scene.view->has_drapes) return;
  picture_.ground =
      std::make_shared<const std::vector<app::SolidCorner>>(app::drapes_around(body_, picture_.camera.up));
}

/// The body is where it starts: nothing is held.
void WebSession::begin_anew() {
  refresh();
  body_ = app::bounds_of(picture_.surface);
  tools_.reset(app::settings_for(session_.scene(), body_));
  set_depth(depth_share_);
  queue_.clear();
}

/// The body is framed as in a picture of the free height; the field of view is that of the whole.
void WebSession::frame_camera() {
  picture_.camera = app::camera_of(session_.scene(), body_, {viewport_.width, free_height_});
  picture_.camera.distance *= static_cast<double>(viewport_.height) / free_height_;
  framed_ = picture_.camera;
}

void WebSession::resize(int width, int height, int free_height) {
  if (width <= 0 || height <= 0) return;
  const bool is_framed = picture_.camera.distance == framed_.distance && picture_.camera.azimuth == framed_.azimuth &&
                         picture_.camera.elevation == framed_.elevation && picture_.camera.target == framed_.target;
  viewport_ = {width, height};
  free_height_ = std::clamp(free_height, 1, height);
  if (is_framed) frame_camera();  // else the person's view stays
}

void WebSession::pointer(int kind, double x, double y, int button, int keys, double wheel, double pressure) {
  app::PointerEvent event;
  event.kind = static_cast<app::PointerEvent::Kind>(std::clamp(kind, 0, 3));
  event.pixel = {x, y};
  event.button = static_cast<app::PointerEvent::Button>(std::clamp(button, 0, 2));
  event.shift = (keys & 1) != 0;
  event.control = (keys & 2) != 0;
  event.alt = (keys & 4) != 0;
  event.wheel = wheel;
  event.pressure = pressure;
  tools_.handle(event, {viewport_, &picture_.surface, body_}, picture_.camera);
  if (const auto stroke = tools_.take_stroke()) session_.follow(*stroke, tools_.tool());
  if (const auto stitch = tools_.take_stitch()) (void)session_.add_suture(stitch->rest_places, stitch->suture);
  set_hands();
}

void WebSession::set_hands() {
  queue_.push(tools_.hands());
}

void WebSession::choose(int tool) {
  tools_.choose(static_cast<app::ToolKind>(tool));
  set_hands();
}

bool WebSession::cancel() {
  const bool had = tools_.cancel();
  set_hands();
  return had;
}

void WebSession::set_depth(double share) {
  if (!std::isfinite(share)) return;
  depth_share_ = std::clamp(share, 0.01, 2.0);
  app::ToolSettings settings = tools_.settings();
  settings.depth = depth_share_ * shortest(body_);
  tools_.set(settings);
}

double WebSession::depth() const {
  return tools_.settings().depth / shortest(body_);
}

void WebSession::frame_body() {
  frame_camera();
}

val WebSession::frame() {
  return to_value(folder_->named(session_.frame(session_.is_following() ? queue_.pop_hooks() : queue_.pop())));
}

bool WebSession::is_busy() const {
  return tools_.is_busy() || session_.is_following();
}

val WebSession::undo() {
  cancel();
  return to_value(session_.undo());
}

val WebSession::redo() {
  cancel();
  return to_value(session_.redo());
}

val WebSession::reset() {
  Status status = session_.reset();
  if (status.ok()) status = bind_surface();
  if (status.ok()) begin_anew();
  return to_value(folder_->named(status));
}

val WebSession::place() const {
  val place = val::object();
  place.set("call", static_cast<double>(session_.place().call));
  place.set("calls", static_cast<double>(session_.place().calls));
  return place;
}

val WebSession::seek(double call) {
  return to_value(folder_->named(session_.seek(static_cast<std::uint64_t>(std::max(0.0, call)))));
}

bool WebSession::take_over() {
  queue_.clear();
  return session_.take_over();
}

bool WebSession::refresh() {
  const auto before = picture_.surface.topology;
  follow();
  const bool is_other = picture_.surface.topology != before;
  if (is_other) {
    averages_.find_creases(picture_.surface.topology->triangles, picture_.surface.positions);
    places_.find(picture_.surface);
  }
  fill_corners();
  return is_other;
}

void WebSession::follow() {
  const incise::TetMesh& mesh = session_.mesh();
  const incise::Journal& journal = session_.engine().journal();
  if (fine_ && fine_->show(mesh, journal, picture_.surface).ok()) return;
  fine_.reset();
  surface_.follow(mesh, journal);
  surface_.fill(mesh, picture_.surface);
}

void WebSession::fill_corners() {
  const app::SurfaceTopology& topology = *picture_.surface.topology;
  const std::vector<Eigen::Vector3f>& normals = averages_.average(topology.triangles, picture_.surface.positions);
  positions_.clear();
  normals_.clear();
  corner_places_.clear();
  looks_.clear();
  for (std::size_t i = 0; i < topology.triangles.size(); ++i) {
    const app::TriangleLook look = topology.looks[i];
    if ((look.flags & app::TriangleLook::kUnused) != 0) continue;
    for (const std::uint32_t point : topology.triangles[i]) {
      positions_.push_back(picture_.surface.positions[point]);
      normals_.push_back(normals[point]);
      corner_places_.push_back(places_.of_points()[point]);
      looks_.push_back(look);
    }
  }
}

val WebSession::surface() const {
  val surface = val::object();
  surface.set("positions", view_of<float>(std::span(positions_)));
  surface.set("normals", view_of<float>(std::span(normals_)));
  surface.set("looks", view_of<std::uint8_t>(std::span(looks_)));
  surface.set("places", view_of<float>(std::span(corner_places_)));
  surface.set("extent", places_.extent());
  surface.set("tissue", static_cast<int>(picture_.options.look));
  return surface;
}

val WebSession::camera() const {
  val camera = val::object();
  camera.set("view", to_array(picture_.camera.to_view()));
  camera.set("clip", to_array(app::to_clip(picture_.camera, viewport_, render::box_of_all(picture_, body_))));
  return camera;
}

void WebSession::choose_color(int color) {
  picture_.options.color =
      static_cast<app::ColorBy>(std::clamp(color, 0, static_cast<int>(app::kColorNames.size()) - 1));
}

val WebSession::marks() {
  picture_.marks = {};
  session_.draw(picture_.marks);
  tools_.draw({viewport_, &picture_.surface, body_}, picture_.camera, picture_.marks);
  mark_rows_.gather(picture_);
  solid_rows_.gather(picture_);
  fill_rows();
  val value = val::object();
  value.set("lines", view_of<float>(std::span(std::as_const(lines_))));
  value.set("rims", view_of<float>(std::span(std::as_const(rims_))));
  value.set("balls", view_of<float>(std::span(std::as_const(balls_))));
  value.set("triangles", view_of<float>(std::span(std::as_const(triangles_))));
  value.set("solids", view_of<float>(std::span(std::as_const(solids_))));
  value.set("solidCornersBeforeGhosts", static_cast<double>(solid_rows_.opaque()));
  return value;
}

/// Rows as the page has them: numbers of one kind.
void WebSession::fill_rows() {
  lines_.clear();
  for (const render::MarkRows::Line& line : mark_rows_.lines()) {
    push(lines_, line.from);
    push(lines_, line.to);
    lines_.push_back(line.width);
    for (const std::uint32_t number : {line.style, line.depth, line.is_dashed}) {
      lines_.push_back(static_cast<float>(number));
    }
  }
  rims_.clear();
  for (const render::MarkRows::Rim& rim : mark_rows_.rims()) {
    for (const Eigen::Vector3f& at : {rim.before, rim.from, rim.to, rim.after}) push(rims_, at);
  }
  balls_.clear();
  for (const render::MarkRows::Ball& ball : mark_rows_.balls()) {
    push(balls_, ball.centre);
    balls_.insert(balls_.end(), {ball.radius, static_cast<float>(ball.style), static_cast<float>(ball.is_in_pixels)});
  }
  triangles_.clear();
  for (const render::MarkRows::Corner& corner : mark_rows_.corners()) {
    push(triangles_, corner.at);
    triangles_.insert(triangles_.end(), {corner.opacity, static_cast<float>(corner.style)});
  }
  solids_.clear();
  for (const app::SolidCorner& corner : solid_rows_.corners()) {
    push(solids_, corner.at);
    push(solids_, corner.normal);
    for (const std::uint8_t channel : corner.finish.color) solids_.push_back(static_cast<float>(channel) / 255);
    solids_.push_back(corner.finish.gloss);
  }
}

val WebSession::figures() const {
  const app::SessionFigures& now = session_.figures();
  val figures = val::object();
  figures.set("frames", static_cast<double>(now.frames));
  figures.set("seconds", now.seconds);
  figures.set("frameMs", now.frame_ms);
  figures.set("frameSeconds", session_.scene().options.frame_seconds);
  figures.set("tets", static_cast<double>(now.tets));
  figures.set("tetsAtStart", static_cast<double>(now.tets_at_start));
  figures.set("vertices", static_cast<double>(now.vertices));
  figures.set("strokes", static_cast<double>(now.strokes));
  figures.set("cutTets", static_cast<double>(now.cut.cut_tets));
  figures.set("force", now.blade.force.norm());
  figures.set("peakForce", now.peak_force);
  return figures;
}

val WebSession::quality() {
  monitor_.follow(session_.mesh(), session_.engine().journal());
  const auto to_object = [](const app::QualityFigures& figures) {
    val object = val::object();
    object.set("lrMin", figures.lr_min);
    object.set("lrMean", figures.lr_mean);
    object.set("lrMax", figures.lr_max);
    object.set("lrOver200Pct", figures.lr_over_200_pct);
    val bins = val::array();
    for (const std::uint32_t count : figures.histogram) bins.call<void>("push", count);
    object.set("histogram", bins);
    return object;
  };
  val quality = val::object();
  quality.set("now", to_object(monitor_.now()));
  quality.set("before", to_object(monitor_.before()));
  return quality;
}

val WebSession::log() const {
  val lines = val::array();
  for (const app::Operation& operation : session_.log().operations()) lines.call<void>("push", operation.text);
  return lines;
}

unsigned WebSession::pieces() const {
  return static_cast<unsigned>(incise::find_components(session_.mesh()).count());
}

std::string WebSession::hash() const {
  return to_hex(session_.simulation() != nullptr ? session_.simulation()->hash() : session_.mesh().hash());
}

val WebSession::recording() const {
  if (const Status status = session_.save_recording(folder_->place_of(kRecording)); !status.ok()) {
    return to_error(folder_->named(status.error()));
  }
  const Result<std::string> bytes = folder_->read(kRecording);
  return bytes.ok() ? to_bytes(*bytes) : to_error(bytes.error());
}

val WebSession::write(const std::string& extension) const {
  const Result<std::string> bytes = incise::io::write_mesh_bytes(
      extension, incise::io::to_mesh_data(session_.mesh(), incise::find_components(session_.mesh()), {}));
  return bytes.ok() ? to_bytes(*bytes) : to_error(bytes.error());
}

}  // namespace incise_web
