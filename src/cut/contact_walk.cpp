// SPDX-License-Identifier: Apache-2.0
// From the tets met before and the surface near the strip, faces lead from tet to tet; a tet is passed over only where
// a plane shows that the strip misses it. Order is that of slots (docs/internals.md, 3.2).
#include "cut/contact_walk.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "cut/constants.h"

namespace incise {
inline namespace v0 {

namespace {

Box box_of(const std::array<Vec3, 4>& p) {
  return {p[0].cwiseMin(p[1]).cwiseMin(p[2]).cwiseMin(p[3]), p[0].cwiseMax(p[1]).cwiseMax(p[2]).cwiseMax(p[3])};
}

/// The way from a point out of the body.
struct Ray {
  SosPoint from, to;

  [[nodiscard]] bool crosses(const TetMesh& mesh, Side side) const {
    const auto v = mesh.vertices(side);
    return segment_crosses_triangle(from, to, {mesh.rest(v[0]), v[0].value}, {mesh.rest(v[1]), v[1].value},
                                    {mesh.rest(v[2]), v[2].value});
  }
  /// Whether it comes from within the tet behind a side that it crosses.
  [[nodiscard]] bool leaves(const TetMesh& mesh, Side side) const {
    const auto v = mesh.vertices(side);
    return orient3d_sos({mesh.rest(v[0]), v[0].value}, {mesh.rest(v[1]), v[1].value}, {mesh.rest(v[2]), v[2].value},
                        from) < 0;
  }
  /// How far along it passes the plane of a side.
  [[nodiscard]] double distance_to(const TetMesh& mesh, Side side) const {
    const auto v = mesh.vertices(side);
    const Vec3 normal = (mesh.rest(v[1]) - mesh.rest(v[0])).cross(mesh.rest(v[2]) - mesh.rest(v[0]));
    const double slope = normal.dot(to.position - from.position);
    return slope == 0 ? 0.0 : normal.dot(mesh.rest(v[0]) - from.position) / slope;
  }
};

/// The boundary side that a ray leaves the body through first, and whether it starts inside.
struct Exit {
  Side side;
  bool starts_inside = false;
};

Exit find_exit(const TetMesh& mesh, const SurfaceIndex& surface, const Ray& ray) {
  std::vector<Side> crossed;
  const Box box{ray.from.position.cwiseMin(ray.to.position), ray.from.position.cwiseMax(ray.to.position)};
  const auto note = [&](Side side) {
    if (ray.crosses(mesh, side)) crossed.push_back(side);
  };
  surface.for_each_near(mesh, box, note);
  surface.for_each_waiting(mesh, note);
  std::sort(crossed.begin(), crossed.end());
  crossed.erase(std::unique(crossed.begin(), crossed.end()), crossed.end());
  Exit exit;
  double nearest = 2.0;
  int depth = 0;  // walls stand on one another: what the ray enters there is not what it leaves
  for (const Side side : crossed) {
    const bool leaves = ray.leaves(mesh, side);
    depth += leaves ? 1 : -1;
    const double distance = ray.distance_to(mesh, side);
    if (leaves && distance < nearest) {
      nearest = distance;
      exit.side = side;
    }
  }
  exit.starts_inside = depth > 0;
  return exit;
}

constexpr std::uint64_t kRayKey = ~std::uint64_t{0};

}  // namespace

TetId locate(const TetMesh& mesh, const SurfaceIndex& surface, const SosPoint& point) {
  const Box& bounds = surface.bounds();
  if (bounds.is_empty() || bounds.distance2(point.position) > 0) return {};
  const Vec3 extent = bounds.hi - bounds.lo;
  const Vec3 beyond = point.position +
                      Vec3(bounds.hi.x() - point.position.x() + 0.5 * extent.x(), 1e-3 * extent.y(), 1e-3 * extent.z());
  const Ray ray{point, {beyond, kRayKey}};
  const Exit exit = find_exit(mesh, surface, ray);
  if (!exit.starts_inside) return {};
  Side entered = exit.side;
  for (std::size_t steps = 0; steps < mesh.tet_count(); ++steps) {
    unsigned out = 4;
    for (unsigned s = 0; s < 4; ++s) {
      if (s != entered.side() && ray.crosses(mesh, Side(entered.tet(), s))) out = s;
    }
    if (out == 4) return entered.tet();
    const Link link = mesh.link(Side(entered.tet(), out));
    if (link.is_boundary()) return {};
    entered = link.side();
  }
  return {};
}

ContactWalk::Prism ContactWalk::prism_of(const Strip& strip, std::uint32_t triangle) const {
  std::array<Vec3, 3> p;
  double size = 0;
  for (unsigned k = 0; k < 3; ++k) {
    p[k] = strip.sheet.point(triangle, k).position;
    size = std::max(size, p[k].cwiseAbs().maxCoeff());
  }
  const auto plane = [&](const Vec3& normal, const Vec3& through) {
    return Plane{normal, normal.dot(through), kBoxRounding * size * normal.norm()};
  };
  Prism prism;
  const Vec3 normal = strip.sheet.normal(triangle);
  prism.face = plane(normal, p[0]);
  for (unsigned k = 0; k < 3; ++k) {
    prism.walls[k] = plane((p[(k + 1) % 3] - p[k]).cross(normal), p[k]);
  }
  return prism;
}

void ContactWalk::prepare(const Strip& strip) {
  prisms_.clear();
  for (std::uint32_t t = 0; t < strip.sheet.triangle_count(); ++t) {
    prisms_.push_back(prism_of(strip, t));
  }
}

bool ContactWalk::meets(const std::array<Vec3, 4>& corners) const {
  if (prisms_.size() <= kFewTriangles) {
    return meets_some(corners);
  }
  const Box box = box_of(corners);
  bool meets = false;
  strip_->sheet.tree().for_each_overlap(box, [&](std::uint32_t) { meets = true; });
  return meets;
}

bool ContactWalk::meets_some(const std::array<Vec3, 4>& corners) const {
  const auto heights_over = [&](const Plane& plane) {
    std::array<double, 4> heights;
    for (unsigned c = 0; c < 4; ++c) heights[c] = plane.normal.dot(corners[c]) - plane.offset;
    return heights;
  };
  const auto least = [](const std::array<double, 4>& h) {
    return std::min(std::min(h[0], h[1]), std::min(h[2], h[3]));
  };
  for (const Prism& prism : prisms_) {
    const std::array<double, 4> over_face = heights_over(prism.face);
    if (least(over_face) > prism.face.margin) continue;
    const double most = std::max(std::max(over_face[0], over_face[1]), std::max(over_face[2], over_face[3]));
    if (most < -prism.face.margin) continue;
    if (least(heights_over(prism.walls[0])) > prism.walls[0].margin) continue;
    if (least(heights_over(prism.walls[1])) > prism.walls[1].margin) continue;
    if (least(heights_over(prism.walls[2])) > prism.walls[2].margin) continue;
    return true;
  }
  return false;
}

void ContactWalk::visit(std::uint32_t master) {
  Master& m = (*complex_)[master];
  if (m.seen == step_ || m.missed == step_ || m.split == nullptr) return;
  const std::array<Vec3, 4> corners = {mesh_->rest(m.vertices[0]), mesh_->rest(m.vertices[1]),
                                       mesh_->rest(m.vertices[2]), mesh_->rest(m.vertices[3])};
  if (meets(corners)) {
    if (m.is_settled) {
      m.missed = step_;
      left_behind_.push_back(m.vertices);
      return;
    }
    m.seen = step_;
    if (m.first_met == 0) m.first_met = step_;
    met_.push_back(master);
  } else {
    m.missed = step_;
  }
}

void ContactWalk::visit(const TetMesh& mesh, TetId tet) {
  if (const std::uint32_t master = complex_->find(tet); master != Master::kNone) {
    visit(master);
    return;
  }
  rejected_.ensure(std::size_t{tet.value} + 1);
  if (rejected_[tet.value] == walk_) return;
  const TetVertices& v = mesh.vertices(tet);
  if (meets({mesh.rest(v[0]), mesh.rest(v[1]), mesh.rest(v[2]), mesh.rest(v[3])})) {
    if (complex_->is_at_settled(mesh, tet)) {
      rejected_[tet.value] = walk_;
      left_behind_.push_back(
          {complex_->closed(v[0]), complex_->closed(v[1]), complex_->closed(v[2]), complex_->closed(v[3])});
      return;
    }
    const std::uint32_t master = complex_->adopt(mesh, tet);
    (*complex_)[master].seen = (*complex_)[master].first_met = step_;
    met_.push_back(master);
  } else {
    rejected_[tet.value] = walk_;
  }
}

void ContactWalk::walk_on(const TetMesh& mesh, std::uint32_t master) {
  for (unsigned s = 0; s < 4; ++s) {
    const std::uint32_t behind = (*complex_)[master].behind[s];
    if (behind != Master::kNone) {
      visit(behind);
      continue;
    }
    const Link link = complex_->outside(mesh, (*complex_)[master], s);
    if (!link.is_boundary()) visit(mesh, link.side().tet());
  }
}

/// In the order of the tets, whatever that of the index: equal meshes are walked alike.
void ContactWalk::seed_from_surface(const TetMesh& mesh, const Strip& strip, const SurfaceIndex& surface) {
  near_.clear();
  found_near_.ensure(mesh.tet_slots());
  for (std::uint32_t t = 0; t < strip.sheet.triangle_count(); ++t) {
    for_each_side_near(
        mesh, surface,
        {strip.sheet.point(t, 0).position, strip.sheet.point(t, 1).position, strip.sheet.point(t, 2).position},
        [&](Side side) {
          if (std::exchange(found_near_[side.tet().value], walk_) != walk_) near_.push_back(side.tet());
        });
  }
  surface.for_each_waiting(mesh, [&](Side side) {  // a blade that trembles comes back to what the last strip left
    if (std::exchange(found_near_[side.tet().value], walk_) != walk_) near_.push_back(side.tet());
  });
  std::sort(near_.begin(), near_.end());
  for (const TetId tet : near_) visit(mesh, tet);
}

const std::vector<std::uint32_t>& ContactWalk::find(const TetMesh& mesh, const Strip& strip,
                                                    const SurfaceIndex& surface, ClosedComplex& complex,
                                                    std::uint32_t step) {
  strip_ = &strip;
  complex_ = &complex;
  mesh_ = &mesh;
  step_ = step;
  ++walk_;
  left_behind_.clear();
  prepare(strip);
  std::swap(met_, last_);
  met_.clear();
  for (const std::uint32_t master : front_) visit(master);
  for (const std::uint32_t master : last_) visit(master);
  seed_from_surface(mesh, strip, surface);
  if (front_.empty() && last_.empty()) {  // a sheet that starts inside the body
    const TetId tet = locate(mesh, surface, strip.sheet.point(0, 0));
    if (tet.is_valid()) visit(mesh, tet);
  }
  for (std::size_t i = 0; i < met_.size(); ++i) {
    walk_on(mesh, met_[i]);
  }
  return met_;
}

void ContactWalk::keep_front(const TetMesh& mesh, const ClosedComplex& complex, std::span<const SosPoint> row) {
  front_.insert(front_.end(), met_.begin(), met_.end());
  std::sort(front_.begin(), front_.end());
  front_.erase(std::unique(front_.begin(), front_.end()), front_.end());
  const auto is_left = [&](std::uint32_t index) {
    const Master& master = complex[index];
    if (master.split == nullptr) return true;
    const Box box = box_of({mesh.rest(master.vertices[0]), mesh.rest(master.vertices[1]), mesh.rest(master.vertices[2]),
                            mesh.rest(master.vertices[3])});
    const double margin = kCloseBy * (box.hi - box.lo).norm();
    for (std::size_t c = 0; c + 1 < row.size(); ++c) {
      if (segment_meets(box, margin, row[c].position, row[c + 1].position)) return false;
    }
    return true;
  };
  std::erase_if(front_, is_left);
}

void ContactWalk::forget_released(const ClosedComplex& complex) {
  const auto is_released = [&](std::uint32_t index) { return complex[index].split == nullptr; };
  std::erase_if(front_, is_released);
  std::erase_if(met_, is_released);
  std::erase_if(last_, is_released);
}

}  // namespace v0
}  // namespace incise
