// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "image/label_field.h"
#include "image/labelled_tets.h"

namespace incise {
inline namespace v0 {
namespace image {

/// What no move of a point may go beyond.
struct ShapeBounds {
  double most_lr = 20;                                  ///< longest edge over inradius
  double cos_least = 0.97815, cos_greatest = -0.96593;  ///< of dihedral angles: 12 and 165 degrees
};

/// Moves the points of interfaces onto them, evenly spread, and those near them where that makes tets better.
///
/// A point of two labels goes to where they are alike, one of three to the line of the three. Where the faces around a
/// point of two labels make an edge or a corner it goes to where the interface's planes meet, so that blocks keep their
/// edges, and no bias has to make up for chamfers. No tet leaves the bounds
/// of `ShapeBounds` if it was within: points stop short of the interface instead. In between the labels' biases are set
/// so that each label has its volume. The result does not depend on threads.
/// **Source:** J. Bronson, J. Levine, R. Whitaker, "Lattice cleaving", 2014 (interfaces of indicators); T. Ju et al.,
/// "Dual contouring of Hermite data", 2002 (edges by the planes around).
class InterfaceFit {
 public:
  /// `volumes`: of each label, mm³, those of the background are not asked for. The mesh has no background any more.
  InterfaceFit(LabelField& field, const std::vector<double>& volumes, const ShapeBounds& bounds, unsigned threads,
               LabelledTets& mesh);

  /// One round over all points; `spread` in [0, 1] says how far points go towards the middle of their neighbours.
  void move_points(double spread);
  /// Sets the biases anew after the volumes that the labels have now.
  void match_volumes();

  /// Volumes of the labels now, mm³.
  [[nodiscard]] std::vector<double> volumes() const;

 private:
  /// The labels around a point, the background included; more than four are one too many to be placed.
  struct Class {
    std::array<LabelIndex, 4> label = {0, 0, 0, 0};
    std::uint8_t n = 0;
    [[nodiscard]] bool has(LabelIndex l) const;
    [[nodiscard]] bool has_all_of(const Class& other) const;
    void add(LabelIndex l);
  };

  void find_classes();
  void find_interface_neighbours();
  void find_colours();
  void move_point(std::size_t p, double spread);
  void move_interface_point(std::size_t p, double spread);
  void move_inner_point(std::size_t p);
  bool go_towards(std::size_t p, const Vec3& target, int halvings);
  [[nodiscard]] Vec3 projected(const Vec3& from, const Class& labels, double edge) const;
  [[nodiscard]] Vec3 placed(std::size_t p, const Vec3& from) const;
  [[nodiscard]] bool is_creased(std::size_t p) const;
  [[nodiscard]] Vec3 sharpened(std::size_t p, const Vec3& from) const;
  bool find_plane(const Vec3& near, const Class& labels, double edge, Vec3& at, Vec3& normal) const;
  template <class Work>
  void for_each_face(std::size_t p, const Work& work) const;
  [[nodiscard]] bool is_star_sound(std::size_t p, const Vec3& at) const;
  [[nodiscard]] double worst_ratio(std::size_t p, const Vec3& at) const;

  LabelField& field_;
  std::vector<double> wanted_;
  ShapeBounds bounds_;
  unsigned threads_;
  LabelledTets& mesh_;
  std::vector<std::array<std::uint32_t, 4>> neighbours_;
  Stars stars_;
  std::vector<Class> class_;
  std::vector<std::size_t> first_beside_;  // of each point, in `beside_`
  std::vector<std::uint32_t> beside_;      // points along the interface
  std::vector<double> edge_;               // mean edge around each point
  double mean_edge_ = 0;                   // of the points of interfaces
  std::vector<std::vector<std::uint32_t>> colours_;
};

}  // namespace image
}  // namespace v0
}  // namespace incise
