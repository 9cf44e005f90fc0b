// SPDX-License-Identifier: Apache-2.0
// Contact of a body with itself and of its pieces with each other: which vertex lies before which face, what is
// remembered of it from step to step, and what the descent sees of it.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "incise/core/hash.h"
#include "incise/core/id_array.h"
#include "incise/sim/body.h"
#include "sim/body/contact_grid.h"
#include "sim/body/contact_surface.h"
#include "sim/body/contact_terms.h"

namespace incise {
inline namespace v0 {
namespace detail {

/// A vertex before a face, kept from step to step. Lengths in the mesh's unit.
struct Contact {
  std::uint32_t vertex = 0;
  Side face;  ///< invalid: it went with a cut
  std::array<std::uint32_t, 3> corners{};
  std::array<double, 3> share{};   ///< of the nearest point of the face
  std::array<double, 3> anchor{};  ///< of the point of the face that friction holds the vertex to
  std::array<double, 3> seen{};    ///< `share` when all faces around were last looked at
  Vec3 normal = Vec3::Zero();
  double gap = 0;            ///< of the vertex before the face, below 0 within
  double depth = 0;          ///< at most 0: the gap that counts as none; it fades
  double force = 0;          ///< kg L/s²
  double stiffness = 0;      ///< kg/s²
  std::uint32_t age = 0;     ///< steps since `depth` was set
  std::uint32_t unseen = 0;  ///< steps since all faces around were looked at

  /// What is left of `depth`.
  [[nodiscard]] double depth_left() const;
};

class SelfContact {
 public:
  /// Reads the whole surface, or the sides of tets that a step named. `body` has these tets as they are.
  void read_all(const DeformableBody::State& body, const TetMesh& mesh);
  void read(const DeformableBody::State& body, const TetMesh& mesh, std::span<const std::uint32_t> tets);
  /// Forgets what was known of vertices that are new or gone, and of faces that are gone.
  void forget(const DeformableBody::State& body, std::span<const std::uint32_t> fresh);
  /// To be told where something is put elsewhere between two steps: by how much at most.
  void note_jump(double distance) { jump_ = std::max(jump_, distance); }

  /// Finds who touches whom, for a step of `dt` seconds; wakes whoever's partner has moved, and lists
  /// terms and their uses.
  void find(DeformableBody::State& body, double dt);
  /// Takes in what the step left: forces, and how far has slipped. `fastest`: the greatest speed in it, length unit/s.
  void finish(const DeformableBody::State& body, double dt, double fastest);

  [[nodiscard]] std::span<const Contact> contacts() const { return contacts_; }
  [[nodiscard]] std::span<const ContactTerm> terms() const { return terms_; }
  [[nodiscard]] const ContactUse* uses() const { return uses_.data(); }
  [[nodiscard]] const ContactSurface& surface() const { return surface_; }
  /// Appends the vertices to be lent to the seam: no vertex of the first part may share a term with one of the second.
  void add_lent(const DeformableBody::State& body, std::vector<std::uint32_t>& lent) const;
  /// How many are in force.
  [[nodiscard]] std::size_t count_pressing() const;
  void add_to(StateHash& hash) const;

  /// Lists what the descent reads of the contacts as they are known, with all where it stands now.
  void list_terms(DeformableBody::State& body);

 private:
  /// A vertex that is looked at.
  struct Query {
    std::uint32_t vertex = 0;
    Vec3 place = Vec3::Zero();
    Vec3 normal = Vec3::Zero();  // of the surface there
    double edge = 0;             // local
    const Contact* old = nullptr;
    bool is_beside_front = false;
  };
  /// A face that it may be before.
  struct Found {
    const ContactFace* face = nullptr;
    std::array<double, 3> share{};
    Vec3 normal = Vec3::Zero();
    double gap = 0, distance = 0;
    double squareness = 0;
    double nears = 0;  // by how much the two come nearer in a step, length unit
  };
  /// A face when the grid was made, in a few numbers: most are told off by them.
  struct Nearby {
    std::array<float, 3> normal{}, middle{};  // middle: against the body's
    float radius = 0;
  };

  [[nodiscard]] static double beside(const Found& found);
  void build_grid(const DeformableBody::State& body);
  [[nodiscard]] Contact* known(std::uint32_t vertex);
  [[nodiscard]] bool rests(DeformableBody::State& body, Contact& contact) const;
  [[nodiscard]] double needed_reach() const;
  [[nodiscard]] Query query_of(const DeformableBody::State& body, std::uint32_t vertex, const Contact* old) const;
  [[nodiscard]] bool stays(const DeformableBody::State& body, const Contact& old, double dt);
  [[nodiscard]] bool may_be_near(const Nearby& face, const std::array<float, 3>& place,
                                 const std::array<float, 3>& normal, float reach) const;
  void look(DeformableBody::State& body, std::uint32_t vertex, Contact* old, double dt);
  [[nodiscard]] double nears(const DeformableBody::State& body, const Query& query, const Found& found,
                             double dt) const;
  [[nodiscard]] bool try_face(const DeformableBody::State& body, const Query& query, const ContactFace& face,
                              Found& found) const;
  [[nodiscard]] bool is_through_material(const DeformableBody::State& body, const Query& query,
                                         const Found& found) const;
  [[nodiscard]] Contact contact_of(const DeformableBody::State& body, const Query& query, const Found& found) const;
  void list_uses(DeformableBody::State& body);

  ContactSurface surface_;
  ContactGrid grid_;
  std::vector<Vec3> normals_;  // by vertex slot, when the grid was made; not of length 1
  std::vector<Box> boxes_;
  std::vector<Nearby> nearby_;  // by face
  Vec3 middle_ = Vec3::Zero();  // of the body, when the grid was made
  double reach_ = 0;            // how far the grid saw when it was made
  bool is_grid_stale_ = true;
  double grid_way_ = 0;                    // `way_` when the grid was made
  double way_ = 0;                         // the most that anything has moved, ever
  double step_way_ = 0, jump_ = 0;         // in the last step; between the last two
  std::vector<double> clear_until_;        // by vertex slot: nothing is near before `way_` has reached this
  std::vector<Contact> contacts_, next_;   // by vertex
  std::vector<std::uint32_t> contact_of_;  // by vertex slot: index + 1
  std::vector<Found> candidates_;
  std::vector<ContactTerm> terms_;
  std::vector<ContactUse> uses_;
};

}  // namespace detail
}  // namespace v0
}  // namespace incise
