// SPDX-License-Identifier: Apache-2.0
// A step keeps images of all that it changed. What comes back is sampled in the tets that stand in its place now.
#include "cut/reversal.h"

#include <algorithm>
#include <vector>

#include "cut/constants.h"
#include "cut/old_children.h"
#include "incise/geom/quality.h"
#include "incise/mesh/star.h"
#include "incise/mesh/transaction.h"

namespace incise {
inline namespace v0 {

namespace {

class Reversal {
 public:
  Reversal(TetMesh& mesh, const Step& step) : mesh_(mesh), step_(step) {
    for (std::size_t i = 0; i < step.consumed.size(); ++i) tets_.push_back(step.consumed_image(i));
    for (const TetId tet : step.kept) tets_.push_back({tet, mesh.vertices(tet), mesh.links(tet), mesh.region(tet)});
    std::vector<TetImage*> by_id;
    for (TetImage& image : tets_) by_id.push_back(&image);
    std::sort(by_id.begin(), by_id.end(), [](const TetImage* a, const TetImage* b) { return a->id < b->id; });
    const auto at = [&](TetId tet) -> TetImage& {
      return **std::lower_bound(by_id.begin(), by_id.end(), tet, [](const TetImage* a, TetId b) { return a->id < b; });
    };
    for (const RewiredTet& tet : step.rewired) at(tet.id).vertices = tet.old_vertices;
    for (const SideImage& image : step.before.sides) at(image.side.tet()).links[image.side.side()] = image.link;
  }

  void run(Journal& journal) {
    find_tets();
    find_middles();
    Transaction first(mesh_);
    restore_places(first);
    for (std::uint32_t i = 0; i < given_way_; ++i) first.remove_tet(present_.id(i));
    if (waits_) {
      for (const TetImage* image : coming_)
        aside_.push_back(first.add_tet_beside(image->vertices, parent_of(*image), ids_));
      journal.append(first.commit());
      Transaction second(mesh_);
      for (const TetId tet : aside_) second.remove_tet(tet);
      finish(second, journal);
    } else {
      finish(first, journal);
    }
  }

 private:
  /// A vertex that comes back, or goes back to where it was.
  struct Back {
    const VertexImage* image;
    Vec3 middle = Vec3::Zero();         ///< of the largest tet that it had
    double volume6 = -1.0;              ///< of that
    std::uint32_t first = 0, last = 0;  ///< the tets around it, in `stars_`
  };

  /// The tets that come back, and those that stand in their place: first those that give way.
  void find_tets() {
    bool is_rewired = false;
    for (const TetImage& image : tets_) {
      ids_.push_back(image.id);
      const bool is_back = !mesh_.is_live(image.id);
      is_rewired |= !is_back && mesh_.vertices(image.id) != image.vertices;
      if (is_back) coming_.push_back(&image);
    }
    std::sort(ids_.begin(), ids_.end());
    waits_ = is_rewired && !coming_.empty();
    for (const TetId tet : step_.new_tets) {
      if (mesh_.is_live(tet)) present_.add(mesh_, tet);
    }
    for (const TetImage& image : tets_) {
      if (!waits_ || !mesh_.is_live(image.id) || mesh_.vertices(image.id) == image.vertices) continue;
      present_.add(mesh_, image.id);
      coming_.push_back(&image);
    }
    given_way_ = present_.size();
    for (const TetImage& image : tets_) {
      if (mesh_.is_live(image.id) && (!waits_ || mesh_.vertices(image.id) == image.vertices))
        present_.add(mesh_, image.id);
    }
  }
  void find_middles() {
    images_.reserve(step_.before.vertices.size());
    for (const VertexImage& image : step_.before.vertices) {
      images_.push_back(&image);
      if (!mesh_.is_live(image.id) || mesh_.rest(image.id) != image.rest) backs_.push_back({&image});
    }
    std::sort(images_.begin(), images_.end(), [](const VertexImage* a, const VertexImage* b) { return a->id < b->id; });
    for (const TetImage& image : tets_) note_middle(image);
    for (Back& back : backs_) {
      if (mesh_.is_live(back.image->id)) keep_star(back);
    }
  }
  void keep_star(Back& back) {
    back.first = stars_.size();
    for (const TetId tet : walker_.star(mesh_, back.image->id)) stars_.add(mesh_, tet);
    back.last = stars_.size();
  }
  void note_middle(const TetImage& tet) {
    std::array<Vec3, 4> p;
    for (unsigned c = 0; c < 4; ++c) p[c] = rest_before(tet.vertices[c]);
    const double volume6 = signed_volume6(p[0], p[1], p[2], p[3]);
    for (Back& back : backs_) {
      const bool has_it = std::find(tet.vertices.begin(), tet.vertices.end(), back.image->id) != tet.vertices.end();
      if (!has_it || volume6 <= back.volume6) continue;
      back.volume6 = volume6;
      back.middle = 0.25 * (p[0] + p[1] + p[2] + p[3]);
    }
  }
  [[nodiscard]] const Vec3& rest_before(VertexId vertex) const {
    const auto at = std::lower_bound(images_.begin(), images_.end(), vertex,
                                     [](const VertexImage* image, VertexId v) { return image->id < v; });
    return at != images_.end() && (*at)->id == vertex ? (*at)->rest : mesh_.rest(vertex);
  }
  /// The present tet that holds a vertex that comes back.
  [[nodiscard]] std::uint32_t holder_of(const Back& back) const {
    const Vec3& place = back.image->rest;
    const Vec3 inwards = back.volume6 > 0 ? Vec3(place + kReversalInwards * (back.middle - place)) : place;
    return present_.holding(inwards, 0, present_.size());
  }
  void restore_places(Transaction& transaction) {
    for (const Back& back : backs_) {
      if (mesh_.is_live(back.image->id)) continue;
      const MaterialPlace place = present_.place_in(holder_of(back), back.image->rest);
      transaction.revive_vertex(*back.image, place.basis, place.weights, place.current);
    }
    for (auto back = backs_.rbegin(); back != backs_.rend(); ++back) {
      if (mesh_.rest(back->image->id) != back->image->rest) move(transaction, *back);
    }
  }
  /// The others have moved by now, and its tet may be flat: then the one around it that it lies outside of least holds
  /// it, and where all are flat its tet as that was before anything moved.
  void move(Transaction& transaction, const Back& back) {
    const Vec3& rest = back.image->rest;
    const std::uint32_t holder = stars_.holding(rest, back.first, back.last);
    MaterialPlace place = place_in(mesh_, stars_.id(holder), rest);
    for (std::size_t i = back.first; i < back.last && !(place.inside > kLeastSampledWeight); ++i) {
      const MaterialPlace other = place_in(mesh_, stars_.id(static_cast<std::uint32_t>(i)), rest);
      if (!(place.inside >= other.inside)) place = other;
    }
    if (!(place.inside > kLeastSampledWeight)) place = stars_.place_in(holder, rest);
    transaction.move(back.image->id, rest, place.basis, place.weights);
  }
  /// Of the tets that give way the one in which the middle of another one lies.
  [[nodiscard]] TetId parent_of(const TetImage& image) const {
    Vec3 middle = Vec3::Zero();
    for (const VertexId v : image.vertices) middle += 0.25 * rest_before(v);
    return present_.id(present_.holding(middle, 0, given_way_ > 0 ? given_way_ : present_.size()));
  }

  void finish(Transaction& transaction, Journal& journal) {
    for (std::size_t i = 0; i < coming_.size(); ++i) {
      transaction.revive_tet(*coming_[i], waits_ ? aside_[i] : parent_of(*coming_[i]));
    }
    for (const TetImage& image : tets_) restore(transaction, image);
    for (const OpenedFace& face : step_.closed) transaction.open(face.a, face.b, face.tag);
    for (const VertexId vertex : step_.new_vertices) {
      if (mesh_.is_live(vertex)) transaction.remove_vertex(vertex);
    }
    const auto tie = [&](const auto& image) {
      if (mesh_.tet_of(image.id) != image.tet) transaction.set_tet_of(image.id, image.tet);
      if (mesh_.shape_of(image.id) != image.shape) transaction.set_shape(image.id, image.shape);
    };
    for (const VertexImage& image : step_.before.vertices) tie(image);
    for (const TiedVertex& image : step_.before.ties) tie(image);
    journal.append(transaction.commit());
  }
  void restore(Transaction& transaction, const TetImage& image) {
    for (unsigned k = 0; k < 4; ++k) {
      if (mesh_.vertices(image.id)[k] != image.vertices[k]) transaction.set_corner(image.id, k, image.vertices[k]);
      const Side side(image.id, k);
      if (mesh_.link(side) != image.links[k]) transaction.set_link(side, image.links[k]);
    }
  }

  TetMesh& mesh_;
  const Step& step_;
  StarWalker walker_;
  OldChildren present_, stars_;
  std::uint32_t given_way_ = 0;  // of the present ones: so many give way
  bool waits_ = false;           // tets come back in two steps
  std::vector<TetImage> tets_;   // before the step, of all that it changed
  std::vector<const TetImage*> coming_;
  std::vector<TetId> ids_, aside_;  // ascending, of all images; of those that wait, beside `coming_`
  std::vector<Back> backs_;
  std::vector<const VertexImage*> images_;  // by id
};

}  // namespace

void reverse(TetMesh& mesh, Journal& journal, std::size_t index) {
  const Step& step = journal.step(index);  // stays in place while others are appended
  Reversal(mesh, step).run(journal);
}

}  // namespace v0
}  // namespace incise
