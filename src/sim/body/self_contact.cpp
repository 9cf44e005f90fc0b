// SPDX-License-Identifier: Apache-2.0
// A grid of faces, made seldom and wide enough for several steps; the nearest face that looks at a vertex is its
// partner, and what was known of them goes on in the next step (docs/internals.md, 4).
#include "sim/body/self_contact.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/body/body_state.h"
#include "sim/body/constants.h"

namespace incise {
inline namespace v0 {
namespace detail {

using State = DeformableBody::State;

namespace {

/// Shares of the point of a triangle that is nearest to p (Ericson 2005, section 5.1.5).
std::array<double, 3> nearest_on(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, ap = p - a;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
  const Vec3 bp = p - b;
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return {1 - d1 / (d1 - d3), d1 / (d1 - d3), 0};
  const Vec3 cp = p - c;
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return {1 - d2 / (d2 - d6), 0, d2 / (d2 - d6)};
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const double t = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {0, 1 - t, t};
  }
  const double q = 1 / (va + vb + vc);
  return {1 - vb * q - vc * q, vb * q, vc * q};
}

/// Shares of a point of the triangle's plane, which may lie outside it.
std::array<double, 3> shares_of(const Vec3& p, const std::array<Vec3, 3>& at) {
  const Vec3 u = at[1] - at[0], w = at[2] - at[0], n = u.cross(w);
  const double area2 = n.squaredNorm();
  if (!(area2 > 0)) return {1, 0, 0};
  const double s = (p - at[0]).cross(w).dot(n) / area2, t = u.cross(p - at[0]).dot(n) / area2;
  return {1 - s - t, s, t};
}

std::array<Vec3, 3> places_of(const State& body, const std::array<std::uint32_t, 3>& corners) {
  return {body.places[corners[0]], body.places[corners[1]], body.places[corners[2]]};
}

Vec3 mix(const std::array<double, 3>& share, const std::array<Vec3, 3>& at) {
  return share[0] * at[0] + share[1] * at[1] + share[2] * at[2];
}

/// Of the local edge, but of no mere sliver.
double edge_at(const State& body, std::uint32_t vertex, double spacing) {
  return std::clamp(4 * static_cast<double>(body.motions[VertexId(vertex)].reach), 0.3 * spacing, spacing);
}

Vec3 velocity_of(const State& body, std::uint32_t v) {
  const double mass = body.mass_of(VertexId(v));
  return mass > 0 ? Vec3(body.momentum_of(VertexId(v)) / mass) : Vec3(Vec3::Zero());
}

/// Left out of contact: crumbs, and what fell far away.
bool is_left_out(const State& body, std::uint32_t v) {
  return body.in_crumb[VertexId(v)] != 0 || body.pieces[body.piece_of[VertexId(v)]].is_lost;
}

}  // namespace

double Contact::depth_left() const {
  return age < kFadingFrames ? depth * (kFadingFrames - age) / kFadingFrames : 0.0;
}

/// How far a vertex stands beside the nearest point of a face, along the face.
double SelfContact::beside(const Found& found) {
  return std::sqrt(std::max(0.0, found.distance * found.distance - found.gap * found.gap));
}

// --- following the mesh

void SelfContact::read_all(const State& body, const TetMesh& mesh) {
  surface_.keep(static_cast<std::uint32_t>(body.tets.size()));
  for (std::uint32_t t = 0; t < body.tets.size(); ++t) {
    surface_.set(mesh, TetId(t), body.tets[TetId(t)][0].is_valid());
  }
  if (surface_.refresh(mesh)) is_grid_stale_ = true;
  clear_until_.assign(mesh.vertex_slots(), 0);
}

void SelfContact::read(const State& body, const TetMesh& mesh, std::span<const std::uint32_t> tets) {
  clear_until_.resize(mesh.vertex_slots(), 0);
  for (const std::uint32_t slot : tets) {
    const TetId t(slot);
    const bool is_part = slot < body.tets.size() && body.tets[t][0].is_valid();
    surface_.set(mesh, t, is_part);
    if (!is_part) continue;
    for (const VertexId v : body.tets[t]) {
      clear_until_[v.value] = 0;
    }
  }
  if (surface_.refresh(mesh)) is_grid_stale_ = true;
}

void SelfContact::forget(const State& body, std::span<const std::uint32_t> fresh) {
  for (const std::uint32_t v : fresh) {
    if (Contact* contact = known(v)) contact->vertex = kInvalidIndex;
  }
  std::erase_if(contacts_, [&](const Contact& contact) {
    return contact.vertex >= body.places.size() || !body.is_live(VertexId(contact.vertex));
  });
  const auto is_gone = [&](const Contact& contact) {
    if (!surface_.has(contact.face)) return true;
    const TetVertices& tet = body.tets[contact.face.tet()];
    for (unsigned i = 0; i < 3; ++i) {
      if (tet[kSideCorners[contact.face.side()][i]].value != contact.corners[i]) return true;
    }
    return false;
  };
  for (Contact& contact : contacts_) {
    if (contact.face.value != kInvalidIndex && is_gone(contact)) contact.face = Side();
  }
  std::fill(contact_of_.begin(), contact_of_.end(), 0);
  contact_of_.resize(body.places.size(), 0);
  for (std::uint32_t i = 0; i < contacts_.size(); ++i) contact_of_[contacts_[i].vertex] = i + 1;
}

Contact* SelfContact::known(std::uint32_t vertex) {
  if (vertex >= contact_of_.size() || contact_of_[vertex] == 0) return nullptr;
  return &contacts_[contact_of_[vertex] - 1];
}

// --- broad phase

/// How far the next search must see: as far as anything may come in a step.
double SelfContact::needed_reach() const {
  return std::min(kLeastReach * surface_.spacing() + 2 * step_way_, kMostReach * surface_.spacing());
}

void SelfContact::build_grid(const State& body) {
  reach_ = kReachTimes * needed_reach() + kReachMore * surface_.spacing();
  middle_ = body.middle;
  normals_.assign(body.places.size(), Vec3::Zero());
  boxes_.clear();
  nearby_.clear();
  for (const ContactFace& face : surface_.faces()) {
    Box& box = boxes_.emplace_back();
    Nearby& nearby = nearby_.emplace_back();
    if (is_left_out(body, face.corners[0])) continue;
    const auto at = places_of(body, face.corners);
    const Vec3 normal = (at[1] - at[0]).cross(at[2] - at[0]), middle = (at[0] + at[1] + at[2]) / 3;
    const double length = normal.norm();
    double radius2 = 0;
    for (unsigned i = 0; i < 3; ++i) {
      normals_[face.corners[i]] += normal;
      box.extend(at[i]);
      radius2 = std::max(radius2, (at[i] - middle).squaredNorm());
      nearby.normal[i] = length > 0 ? static_cast<float>(normal.data()[i] / length) : 0.0F;
      nearby.middle[i] = static_cast<float>(middle.data()[i] - middle_.data()[i]);
    }
    nearby.radius = static_cast<float>(std::sqrt(radius2));
    box.lo -= Vec3::Constant(reach_);
    box.hi += Vec3::Constant(reach_);
  }
  grid_.build(boxes_, kGridCell * surface_.spacing() + 2 * reach_);
  is_grid_stale_ = false;
  grid_way_ = way_;
}

// --- narrow phase

/// Whether a face may be near as it was when the grid was made: `reach` says how far, with what has moved since.
bool SelfContact::may_be_near(const Nearby& face, const std::array<float, 3>& place, const std::array<float, 3>& normal,
                              float reach) const {
  const auto dot = [](const std::array<float, 3>& a, const std::array<float, 3>& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  };
  if (dot(face.normal, normal) > kTurnedSince - static_cast<float>(kFacing)) return false;
  const std::array<float, 3> off = {place[0] - face.middle[0], place[1] - face.middle[1], place[2] - face.middle[2]};
  const float farthest = face.radius + reach;
  return std::abs(dot(off, face.normal)) < reach + kTurnedSince * face.radius && dot(off, off) < farthest * farthest;
}

/// Whether a face is near the vertex and faces it.
bool SelfContact::try_face(const State& body, const Query& query, const ContactFace& face, Found& found) const {
  const auto at = places_of(body, face.corners);
  const Vec3 normal = (at[1] - at[0]).cross(at[2] - at[0]);
  const double facing = -normal.dot(query.normal);
  if (!(facing > 0) || (query.is_beside_front && face.is_at_front)) return false;
  const TetVertices& tet = body.tets[face.side.tet()];
  for (const VertexId corner : tet) {
    if (corner.value == query.vertex) return false;
  }
  const double deep = query.old != nullptr ? 1.2 * std::max(0.0, -query.old->gap) : 0.0;
  const double reach = std::max(reach_ - (way_ - grid_way_), deep), length = normal.norm();
  found.gap = normal.dot(query.place - at[0]) / length;
  if (!(std::abs(found.gap) < reach)) return false;
  found.share = nearest_on(query.place, at[0], at[1], at[2]);
  found.distance = (query.place - mix(found.share, at)).norm();
  if (!(found.distance < reach)) return false;
  found.face = &face;
  found.normal = normal / length;
  found.squareness = facing / length;
  return found.squareness > kFacing;
}

/// Whether a vertex is behind a face because there is tissue between them.
bool SelfContact::is_through_material(const State& body, const Query& query, const Found& found) const {
  const auto& corners = found.face->corners;
  if (body.piece_of[VertexId(query.vertex)] != body.piece_of[VertexId(corners[0])]) return false;
  const std::array<Vec3, 3> rest = {body.rest[VertexId(corners[0])], body.rest[VertexId(corners[1])],
                                    body.rest[VertexId(corners[2])]};
  const Vec3& p = body.rest[VertexId(query.vertex)];
  const Vec3 normal = (rest[1] - rest[0]).cross(rest[2] - rest[0]);
  const double gap = normal.dot(p - rest[0]) / normal.norm();
  const double distance = (p - mix(nearest_on(p, rest[0], rest[1], rest[2]), rest)).norm();
  return gap < -kBehindAtRest * query.edge && distance < 2 * query.edge;
}

/// What is known of a vertex before another face than in the last step, or for the first time: it starts with the force
/// that it had, whatever depth it is found at.
Contact SelfContact::contact_of(const State& body, const Query& query, const Found& found) const {
  Contact contact;
  contact.vertex = query.vertex;
  contact.face = found.face->side;
  contact.corners = found.face->corners;
  contact.share = contact.seen = found.share;
  contact.anchor = found.share;
  contact.normal = found.normal;
  contact.gap = found.gap;
  const Contact* old = query.old;
  if (old == nullptr) {
    contact.depth = std::min(found.gap, 0.0);
  } else if (old->face == contact.face) {
    contact.force = old->force;
    contact.depth = old->depth;
    contact.age = old->age + 1;
    contact.anchor = old->anchor;
  } else {
    contact.force = old->force;
    contact.depth = std::min(0.0, found.gap - std::min(0.0, old->gap - old->depth_left()));
    if (old->face.value != kInvalidIndex) {
      const Vec3 anchor = mix(old->anchor, places_of(body, old->corners));
      contact.anchor = shares_of(anchor, places_of(body, contact.corners));
    }
  }
  for (const double share : contact.anchor) {
    if (!(std::abs(share) < kFarthestAnchor)) {
      contact.anchor = found.share;
      break;
    }
  }
  const auto young_of = [&](TetId t) { return body.materials.of(body.regions[t]).young; };
  const double area = surface_.vertex(query.vertex).area;
  double per_area = body.options.self.stiffness * body.unit() * body.unit();
  if (!(per_area > 0)) {
    double young = young_of(contact.face.tet());
    body.stars.for_each_tet(VertexId(query.vertex), [&](TetId t) { young = std::min(young, young_of(t)); });
    per_area = young * body.unit() / query.edge;
  }
  const double share = (kBesideFace - beside(found) / query.edge) / (kBesideFace - kBesideALittle);
  contact.stiffness = per_area * area * std::clamp(share, 0.0, 1.0);
  return contact;
}

double SelfContact::nears(const State& body, const Query& query, const Found& found, double dt) const {
  Vec3 comes = velocity_of(body, query.vertex);
  for (unsigned i = 0; i < 3; ++i) comes -= found.share[i] * velocity_of(body, found.face->corners[i]);
  return std::max(0.0, -dt * comes.dot(found.normal));
}

SelfContact::Query SelfContact::query_of(const State& body, std::uint32_t vertex, const Contact* old) const {
  const double length = normals_[vertex].norm();
  const Vec3 normal = length > 0 ? Vec3(normals_[vertex] / length) : Vec3(Vec3::Zero());
  return {vertex, body.places[vertex],
          normal, edge_at(body, vertex, surface_.spacing()),
          old,    surface_.vertex(vertex).is_beside_front};
}

/// Whether a contact goes on before its face, without a look at others; then it is taken in as it is now.
bool SelfContact::stays(const State& body, const Contact& old, double dt) {
  if (old.face.value == kInvalidIndex || old.unseen >= kMostUnseen) return false;
  const ContactFace face{old.face, old.corners, false};
  const Query query = query_of(body, old.vertex, &old);
  Found found;
  if (!try_face(body, query, face, found) || beside(found) > kBesideALittle * query.edge) return false;
  const auto at = places_of(body, old.corners);
  if ((mix(found.share, at) - mix(old.seen, at)).norm() > kLookAgain * query.edge) return false;
  if (found.gap < kContactMargin * query.edge + nears(body, query, found, dt)) {
    next_.push_back(contact_of(body, query, found));
    next_.back().seen = old.seen;
    next_.back().unseen = old.unseen + 1;
  }
  return true;
}

void SelfContact::look(State& body, std::uint32_t vertex, Contact* old, double dt) {
  const Query query = query_of(body, vertex, old);
  const auto floats = [](const Vec3& v) {
    return std::array<float, 3>{static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
  };
  const std::array<float, 3> place_here = floats(query.place - middle_), normal_here = floats(query.normal);
  const auto reach = static_cast<float>(reach_ + (way_ - grid_way_));
  double clear = reach_ - (way_ - grid_way_);
  candidates_.clear();
  double nearest = std::numeric_limits<double>::infinity();
  const ContactFace last = old != nullptr ? ContactFace{old->face, old->corners, false} : ContactFace{};
  const auto consider = [&](const ContactFace& face) {
    Found found;
    if (!try_face(body, query, face, found)) return;
    const bool is_beside = beside(found) > kBesideFace * query.edge;
    const bool is_known = old != nullptr && old->face == found.face->side;
    const bool is_behind = !is_known && found.gap < 0 && is_through_material(body, query, found);
    if (is_behind) return;  // nor does it come to be one soon
    clear = std::min(clear, found.distance);
    if (found.distance > nearest + kKnownAsNear * query.edge) return;
    if (is_known) found.squareness += kKnownSquarer;
    found.nears = nears(body, query, found, dt);
    const double deepest =
        std::min(old != nullptr ? old->gap : 0.0, 0.0) - std::max(kDeepest * query.edge, kDeepestSteps * found.nears);
    if (!is_known && found.gap < deepest) return;
    nearest = std::min(nearest, found.distance);
    if (!is_beside) candidates_.push_back(found);
  };
  if (last.side.value != kInvalidIndex) consider(last);  // a deep one the grid may not see
  for (const std::uint32_t i : grid_.near(query.place)) {
    const ContactFace& face = surface_.faces()[i];
    if (face.side != last.side && may_be_near(nearby_[i], place_here, normal_here, reach)) consider(face);
  }
  clear_until_[vertex] = way_ + 0.5 * (clear - kContactMargin * query.edge);
  const Found* best = nullptr;
  for (const Found& found : candidates_) {
    const bool is_known = old != nullptr && old->face == found.face->side;
    if (found.distance > nearest + (is_known ? kKnownAsNear : kAsNear) * query.edge) continue;
    if (best == nullptr || found.squareness > best->squareness) best = &found;
  }
  if (best != nullptr && best->gap < kContactMargin * query.edge + best->nears) {
    next_.push_back(contact_of(body, query, *best));
  }
}

/// Whether nothing of a contact is awake, and it is as it was: then it stays as it is.
bool SelfContact::rests(State& body, Contact& contact) const {
  if (contact.face.value == kInvalidIndex || body.order.is_awake(VertexId(contact.vertex))) return false;
  for (const std::uint32_t v : contact.corners) {
    if (body.order.is_awake(VertexId(v))) return false;
  }
  const auto at = places_of(body, contact.corners);
  const double gap = contact.normal.dot(body.places[contact.vertex] - mix(contact.share, at));
  return std::abs(gap - contact.gap) < body.options.sleep_below * edge_at(body, contact.vertex, surface_.spacing());
}

void SelfContact::find(State& body, double dt) {
  way_ += jump_;
  jump_ = 0;
  const double spacing = surface_.spacing();
  const bool moves = body.order.count_awake() > 0;
  if (!moves) return;  // all is as it was, terms too
  const bool is_old = reach_ - (way_ - grid_way_) < needed_reach();
  next_.clear();
  if (is_grid_stale_ || is_old) build_grid(body);
  contact_of_.resize(body.places.size(), 0);
  clear_until_.resize(body.places.size(), 0);
  const double soon = way_ + step_way_;
  for (const std::uint32_t v : surface_.vertices()) {
    Contact* old = known(v);
    if (old == nullptr && soon < clear_until_[v]) continue;
    if (is_left_out(body, v)) continue;
    if (old != nullptr && rests(body, *old)) {
      next_.push_back(*old);
      continue;
    }
    if (surface_.vertex(v).is_at_front) continue;
    if (old == nullptr || !stays(body, *old, dt)) look(body, v, old, dt);
    if (next_.empty() || next_.back().vertex != v || old == nullptr) continue;
    const double least = body.options.sleep_below * edge_at(body, v, spacing);
    if (std::abs(next_.back().gap - old->gap) < least) continue;
    body.order.wake(VertexId(v));
    for (const std::uint32_t corner : next_.back().corners) body.order.wake(VertexId(corner));
  }
  for (const Contact& contact : contacts_) contact_of_[contact.vertex] = 0;
  contacts_.swap(next_);
  for (std::uint32_t i = 0; i < contacts_.size(); ++i) contact_of_[contacts_[i].vertex] = i + 1;
  list_terms(body);
}

// --- what the descent sees

void SelfContact::list_terms(State& body) {
  for (const ContactTerm& term : terms_) {
    for (const std::uint32_t v : term.vertices) {
      if (v < body.motions.size()) body.motions[VertexId(v)].contacts = 0;
    }
  }
  terms_.clear();
  for (const Contact& contact : contacts_) {
    if (contact.face.value == kInvalidIndex || !(contact.stiffness > 0)) continue;
    const auto at = places_of(body, contact.corners);
    const Vec3 off = body.places[contact.vertex] - mix(contact.share, at);
    const Vec3 slip = body.places[contact.vertex] - mix(contact.anchor, at);
    const Vec3& n = contact.normal;
    const Vec3 reference = off - (contact.gap - contact.depth_left()) * n - (slip - n.dot(slip) * n);
    ContactTerm term;
    term.vertices = {contact.vertex, contact.corners[0], contact.corners[1], contact.corners[2]};
    for (unsigned i = 0; i < 3; ++i) {
      term.share[i] = static_cast<float>(contact.share[i]);
      term.normal[i] = static_cast<float>(n.data()[i]);
      term.reference[i] = static_cast<float>(reference.data()[i]);
    }
    term.stiffness = static_cast<float>(contact.stiffness);
    term.limit = static_cast<float>(body.options.self.friction * contact.force);
    terms_.push_back(term);
  }
  list_uses(body);
}

void SelfContact::list_uses(State& body) {
  const auto for_each_use = [&](const auto& visit) {
    for (std::uint32_t t = 0; t < terms_.size(); ++t) {
      for (unsigned i = 0; i < 4; ++i) {
        if (terms_[t].weight(i) != 0) visit(4 * t + i, body.motions[VertexId(terms_[t].vertices[i])]);
      }
    }
  };
  for_each_use([](ContactUse /*use*/, Motion& motion) { ++motion.contacts; });
  std::uint32_t next = 0;
  for_each_use([&](ContactUse /*use*/, Motion& motion) {
    if (motion.contacts == 0) return;
    motion.first_contact = next;
    next += motion.contacts;
    motion.contacts = 0;
  });
  uses_.resize(next);
  for_each_use([&](ContactUse use, Motion& motion) { uses_[motion.first_contact + motion.contacts++] = use; });
}

/// A vertex before a face of the other part is visited with the seam in this step.
void SelfContact::add_lent(const State& body, std::vector<std::uint32_t>& lent) const {
  for (const ContactTerm& term : terms_) {
    bool touches[SweepOrder::kParts + 1] = {};
    for (const std::uint32_t v : term.vertices)
      touches[static_cast<std::size_t>(body.order.part_of(VertexId(v)))] = true;
    if (touches[0] && touches[1]) lent.push_back(term.vertices[0]);
  }
}

void SelfContact::finish(const State& body, double dt, double fastest) {
  step_way_ = 1.1 * dt * fastest;
  way_ += step_way_;
  for (Contact& contact : contacts_) {
    if (contact.face.value == kInvalidIndex) continue;
    const auto at = places_of(body, contact.corners);
    const Vec3& place = body.places[contact.vertex];
    const Vec3& n = contact.normal;
    contact.gap = n.dot(place - mix(contact.share, at));
    const double limit = body.options.self.friction * contact.force;
    Vec3 slip = place - mix(contact.anchor, at);
    slip -= n.dot(slip) * n;
    const double drag = contact.stiffness * slip.norm();
    if (drag > limit) {  // it has given way: the anchor comes along
      slip *= drag > 0 ? limit / drag : 0.0;
      const Vec3 foot = place - contact.gap * n;
      contact.anchor = shares_of(foot - slip, at);
    }
    contact.force = contact.stiffness * std::max(0.0, contact.depth_left() - contact.gap);
  }
}

std::size_t SelfContact::count_pressing() const {
  return static_cast<std::size_t>(
      std::count_if(contacts_.begin(), contacts_.end(), [](const Contact& contact) { return contact.force > 0; }));
}

void SelfContact::add_to(StateHash& hash) const {
  for (const Contact& contact : contacts_) {
    hash.add(std::uint64_t{contact.vertex} << 32U | contact.face.value);
    hash.add(std::uint64_t{contact.age} << 32U | contact.unseen);
    for (const double share : contact.anchor) hash.add(share);
    hash.add(contact.depth);
    hash.add(contact.force);
  }
}

}  // namespace detail
}  // namespace v0
}  // namespace incise
