// SPDX-License-Identifier: Apache-2.0
// The line is divided into a hundred parts, each with its skin and its normal. Edges of the cut's contour and of its
// walls are taken in short pieces, and each piece counts for the part nearest to it.
#include "app/scene/exercise_measure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>

#include "incise/geom/triangle_tree.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace {

constexpr double kNearTolerances = 3;  // how many tolerances of the line from it a cut is an attempt at it
constexpr double kSteepestWall = 80;   // degrees, of what is counted as below the line
constexpr double kPiecesPerBin = 2;    // so that no part of the line is stepped over

/// The boundary of a mesh as a soup, in the rest shape.
struct SkinSoup {
  std::vector<Vec3> points;
  std::vector<TriangleTree::Triangle> triangles;
};

SkinSoup skin_of(const TetMesh& mesh) {
  SkinSoup soup;
  soup.points.resize(mesh.vertex_slots(), Vec3::Zero());
  mesh.for_each_vertex([&](VertexId v) { soup.points[v.value] = mesh.rest(v); });
  for_each_boundary_side(mesh, [&](TetId, const std::array<VertexId, 3>& v, std::uint32_t) {
    soup.triangles.push_back({v[0].value, v[1].value, v[2].value});
  });
  return soup;
}

Vec3 normal_of(const SkinSoup& soup, std::uint32_t triangle) {
  const auto& [a, b, c] = soup.triangles[triangle];
  const Vec3 n = (soup.points[b] - soup.points[a]).cross(soup.points[c] - soup.points[a]);
  return n.isZero(0) ? Vec3(Vec3::UnitZ()) : n.stableNormalized();
}

}  // namespace

TargetLine::TargetLine(const Exercise& exercise, const TetMesh& mesh)
    : points_(exercise.target),
      arcs_(1, 0.0),
      is_closed_(app::is_closed(exercise)),
      end_(exercise.tolerances.line),
      near_(kNearTolerances * exercise.tolerances.line) {
  for (std::size_t i = 1; i < points_.size(); ++i) {
    arcs_.push_back(arcs_.back() + (points_[i] - points_[i - 1]).norm());
  }
  const double steepest = std::min(exercise.angle + exercise.tolerances.angle, kSteepestWall);
  slope_ = std::tan(steepest * std::numbers::pi / 180);
  skin_.resize(kBins);
  find_skin(mesh);
}

void TargetLine::find_skin(const TetMesh& mesh) {
  const SkinSoup soup = skin_of(mesh);
  const TriangleTree tree(soup.points, soup.triangles);
  for (std::size_t bin = 0; bin < kBins; ++bin) {
    const Vec3 middle = point_at(length() * (static_cast<double>(bin) + 0.5) / static_cast<double>(kBins));
    const TriangleTree::Hit hit = tree.closest(middle);
    if (!hit.is_valid()) continue;
    skin_[bin] = {hit.point, normal_of(soup, hit.triangle), hit.distance2 <= near_ * near_};
  }
}

Vec3 TargetLine::point_at(double arc) const {
  std::size_t i = 1;
  while (i + 1 < arcs_.size() && arc > arcs_[i]) ++i;
  return points_[i - 1] + (arc - arcs_[i - 1]) / (arcs_[i] - arcs_[i - 1]) * (points_[i] - points_[i - 1]);
}

TargetLine::Foot TargetLine::foot_of(const Vec3& point, bool is_prolonged) const {
  Foot best;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < points_.size(); ++i) {
    const double length = arcs_[i] - arcs_[i - 1];
    const Vec3 along = (points_[i] - points_[i - 1]) / length;
    const bool goes_back = is_prolonged && i == 1, goes_on = is_prolonged && i + 1 == points_.size();
    double t = (point - points_[i - 1]).dot(along);
    if (!goes_back) t = std::max(t, 0.0);
    if (!goes_on) t = std::min(t, length);
    const Vec3 foot = points_[i - 1] + t * along;
    const double distance2 = (point - foot).squaredNorm();
    if (distance2 < least) {
      least = distance2;
      best = {arcs_[i - 1] + t, foot};
    }
  }
  return best;
}

std::size_t TargetLine::bin_at(double arc) const {
  const double bin = arc / length() * static_cast<double>(kBins);
  return static_cast<std::size_t>(std::clamp(bin, 0.0, static_cast<double>(kBins - 1)));
}

LinePlace TargetLine::place_of(const Vec3& point) const {
  const Foot foot = foot_of(point, !is_closed_);
  const Skin& skin = skin_[bin_at(foot.arc)];
  const Vec3 off = point - foot.point;
  const Vec3 beside = off - off.dot(skin.normal) * skin.normal;
  return {foot.arc, beside.norm(), (skin.point - point).dot(skin.normal), beside};
}

bool TargetLine::is_end(std::size_t bin) const {
  const double arc = length() * (static_cast<double>(bin) + 0.5) / static_cast<double>(kBins);
  return !is_closed_ && std::min(arc, length() - arc) < end_;
}

double TargetLine::distance(const Vec3& point) const {
  return (point - foot_of(point, false).point).norm();
}

namespace {

using Edge = std::array<std::uint32_t, 2>;

Edge edge_of(VertexId a, VertexId b) {
  return {std::min(a.value, b.value), std::max(a.value, b.value)};
}

/// The cuts of a mesh in the rest shape.
struct Cuts {
  std::vector<std::array<VertexId, 3>> walls;
  std::vector<Edge> wall_edges;  ///< each once
  std::vector<Edge> contour;     ///< of them, those on the skin, of both lips
};

void sort_out(std::vector<Edge>& edges) {
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
}

Cuts cuts_of(const TetMesh& mesh) {
  Cuts cuts;
  std::vector<Edge> skin;
  const auto is_at_wall = [&](VertexId v) { return (mesh.shape_of(v) & shape::kWall) != 0; };
  for_each_boundary_side(mesh, [&](TetId, const std::array<VertexId, 3>& v, std::uint32_t tag) {
    if (tag > 0) cuts.walls.push_back(v);
    for (unsigned i = 0; i < 3; ++i) {
      const VertexId a = v[i], b = v[(i + 1) % 3];
      if (tag > 0) cuts.wall_edges.push_back(edge_of(a, b));
      if (tag == 0 && is_at_wall(a) && is_at_wall(b)) skin.push_back(edge_of(a, b));
    }
  });
  sort_out(cuts.wall_edges);
  sort_out(skin);
  std::set_intersection(skin.begin(), skin.end(), cuts.wall_edges.begin(), cuts.wall_edges.end(),
                        std::back_inserter(cuts.contour));
  return cuts;
}

/// Compares the cuts of a mesh with the target line.
class MeshMeasure {
 public:
  MeshMeasure(const Exercise& exercise, const TargetLine& line, const TetMesh& mesh, ExerciseScore& score)
      : exercise_(exercise), line_(line), mesh_(mesh), score_(score) {
    beside_.fill(Vec3::Zero());
  }

  void run() {
    const Cuts cuts = cuts_of(mesh_);
    for (const auto& wall : cuts.walls) add_area(wall);
    for (const Edge& edge : cuts.contour) {
      for_each_piece(edge, [&](const LinePlace& place, double length) { add_contour(place, length); });
    }
    for (const Edge& edge : cuts.wall_edges) {
      for_each_piece(edge, [&](const LinePlace& place, double) { add_wall(place); });
    }
    finish_line();
    finish_depth();
    finish_profile();
  }

 private:
  /// Calls `visit(place, length)` for the middle of each short piece of an edge.
  template <class Visit>
  void for_each_piece(const Edge& edge, const Visit& visit) const {
    const Vec3& a = mesh_.rest(VertexId(edge[0]));
    const Vec3& b = mesh_.rest(VertexId(edge[1]));
    const double length = (b - a).norm();
    const double most = line_.length() / (kPiecesPerBin * static_cast<double>(TargetLine::kBins));
    const double count = std::clamp(std::ceil(length / most), 1.0, kMostPieces);
    for (double i = 0; i < count; ++i) visit(line_.place_of(a + (i + 0.5) / count * (b - a)), length / count);
  }

  void add_area(const std::array<VertexId, 3>& wall) {
    const Vec3 &a = mesh_.rest(wall[0]), &b = mesh_.rest(wall[1]), &c = mesh_.rest(wall[2]);
    const double area = 0.25 * (b - a).cross(c - a).norm();  // half of the triangle's: there are two lips
    const LinePlace place = line_.place_of((a + b + c) / 3);
    score_.cut_area += area;
    if (place.lateral > line_.reach(place.depth)) score_.away_area += area;
  }

  void add_contour(const LinePlace& place, double length) {
    const std::size_t bin = line_.bin_at(place.arc);
    if (place.lateral > line_.reach(place.depth) || !line_.is_on_skin(bin)) {
      score_.away_length += 0.5 * length;
    } else if (place.depth > 0.5 * exercise_.depth) {  // cut from within: of a wall that was opened
      score_.is_through = score_.is_through || place.depth > exercise_.depth + exercise_.tolerances.depth;
    } else {
      add_entry(place, length, bin);
    }
  }

  void add_entry(const LinePlace& place, double length, std::size_t bin) {
    const double beyond = line_.is_closed() ? 0 : std::max(-place.arc, place.arc - line_.length());
    score_.overshoot = std::max(score_.overshoot, beyond);
    weight_ += length;
    sum_ += length * place.lateral;
    sum2_ += length * place.lateral * place.lateral;
    most_ = std::max(most_, place.lateral);
    if (beyond > 0) return;
    is_covered_[bin] = true;
    beside_[bin] += length * place.beside;
    lengths_[bin] += length;
  }

  void add_wall(const LinePlace& place) {
    if (place.arc < 0 || place.arc > line_.length() || place.lateral > line_.reach(place.depth)) return;
    double& deepest = deepest_[line_.bin_at(place.arc)];
    deepest = std::max(deepest, place.depth);
  }

  void finish_line() {
    const auto missed = static_cast<double>(std::count(is_covered_.begin(), is_covered_.end(), false));
    score_.target_length = line_.length();
    score_.missed_length = line_.length() * missed / static_cast<double>(TargetLine::kBins);
    score_.coverage_pct = 100 * (static_cast<double>(TargetLine::kBins) - missed) / TargetLine::kBins;
    if (!(weight_ > 0)) return;
    score_.line_mean = sum_ / weight_;
    score_.line_rms = std::sqrt(sum2_ / weight_);
    score_.line_max = most_;
  }

  void finish_depth() {
    double count = 0, depth = 0, error = 0, most = 0;
    for (std::size_t bin = 0; bin < TargetLine::kBins; ++bin) {
      if (!is_covered_[bin]) continue;
      const double off = deepest_[bin] - exercise_.depth;
      score_.too_deep = std::max(score_.too_deep, off);
      if (line_.is_end(bin)) continue;
      count += 1;
      depth += deepest_[bin];
      error += std::abs(off);
      most = std::max(most, std::abs(off));
    }
    if (!(count > 0)) return;
    score_.depth_mean = depth / count;
    score_.depth_error_mean = error / count;
    score_.depth_error_max = most;
  }
  void finish_profile() {
    score_.profile.assign(TargetLine::kBins, {});
    for (std::size_t bin = 0; bin < TargetLine::kBins; ++bin) {
      ExercisePlace& place = score_.profile[bin];
      place.ideal = line_.skin_at(bin);
      place.normal = line_.skin_normal(bin);
      place.is_cut = is_covered_[bin];
      if (!place.is_cut) continue;
      if (lengths_[bin] > 0) place.beside = beside_[bin] / lengths_[bin];
      place.depth = deepest_[bin];
    }
  }

  static constexpr double kMostPieces = 1000;  // of an edge that is far longer than the line

  const Exercise& exercise_;
  const TargetLine& line_;
  const TetMesh& mesh_;
  ExerciseScore& score_;
  std::array<bool, TargetLine::kBins> is_covered_{};
  std::array<double, TargetLine::kBins> deepest_{};
  std::array<Vec3, TargetLine::kBins> beside_;  // sum over the contour, by length
  std::array<double, TargetLine::kBins> lengths_{};
  double weight_ = 0, sum_ = 0, sum2_ = 0, most_ = 0;
};

}  // namespace

void measure_mesh(const Exercise& exercise, const TargetLine& line, const TetMesh& mesh, ExerciseScore& score) {
  MeshMeasure(exercise, line, mesh, score).run();
}

}  // namespace app
}  // namespace v0
}  // namespace incise
