// SPDX-License-Identifier: Apache-2.0
// Crumbs stay where they hang: each is joined again to one piece by its largest face, or to a crumb that hangs on one.
#include "cut/crumbs.h"

#include <algorithm>
#include <unordered_map>

#include "cut/constants.h"

namespace incise {
inline namespace v0 {

namespace {

class CrumbFinder {
 public:
  CrumbFinder(const TetMesh& mesh, const CrumbRules& rules, std::vector<IncisionFace>& incision,
              std::vector<IncisionFace>& dropped, CrumbScratch& scratch)
      : mesh_(mesh),
        rules_(rules),
        incision_(incision),
        dropped_(dropped),
        blocked_(scratch.blocked),
        state_(scratch.state) {
    for (std::uint32_t i = 0; i < incision_.size(); ++i) {
      mark(incision_[i].a);
      mark(incision_[i].b);
    }
    is_dropped_.resize(incision_.size(), false);
  }
  CrumbFinder(const CrumbFinder&) = delete;
  CrumbFinder& operator=(const CrumbFinder&) = delete;
  ~CrumbFinder() {
    for (const TetId tet : touched_) blocked_[tet.value] = state_[tet.value] = 0;
  }

  std::uint64_t run() {
    for (const IncisionFace& face : incision_) {
      for (const TetId seed : {face.a.tet(), face.b.tet()}) {
        if (state_[seed.value] == kUnseen && is_crumb(seed)) add_crumb();
      }
    }
    if (homes_.empty()) return 0;
    collect_borders();
    std::uint64_t kept = 0;
    do {
      for (; attach_next(); ++kept) {
      }
    } while (found_home());
    drop_faces();
    return kept;
  }

 private:
  enum State : std::uint8_t { kUnseen, kLarge, kCrumb };

  void mark(Side side) {
    blocked_.ensure(std::size_t{side.tet().value} + 1);
    state_.ensure(std::size_t{side.tet().value} + 1);
    blocked_[side.tet().value] = static_cast<std::uint8_t>(blocked_[side.tet().value] | 1U << side.side());
    touched_.push_back(side.tet());
  }
  [[nodiscard]] bool is_blocked(Side side) const {
    return ((unsigned{blocked_[side.tet().value]} >> side.side()) & 1U) != 0;
  }

  /// Floods from `seed` until the piece is complete or too large. Leaves its tets in `piece_`.
  bool is_crumb(TetId seed) {
    const double limit = rules_.limit(seed);
    Shaving shaving;
    piece_.assign(1, seed);
    state_[seed.value] = kCrumb;
    bool is_large = false;
    for (std::size_t i = 0; i < piece_.size() && !is_large; ++i) {
      add_to(shaving, piece_[i]);
      is_large = piece_.size() > kMaxCrumbTets || (shaving.volume >= limit && !may_be_thin(shaving));
      for (unsigned s = 0; s < 4 && !is_large; ++s) {
        const Link link = mesh_.links(piece_[i])[s];
        if (link.is_boundary() || is_blocked(Side(piece_[i], s))) {
          continue;
        }
        const TetId next = link.side().tet();
        state_.ensure(std::size_t{next.value} + 1);
        blocked_.ensure(std::size_t{next.value} + 1);
        if (state_[next.value] == kLarge) {
          is_large = true;
        } else if (state_[next.value] == kUnseen) {
          state_[next.value] = kCrumb;
          touched_.push_back(next);
          piece_.push_back(next);
        }
      }
    }
    is_large |= shaving.volume >= limit && !is_thin(shaving, 1.0);
    if (is_large) {
      for (const TetId tet : piece_) {
        state_[tet.value] = kLarge;
      }
    }
    return !is_large;
  }
  /// What tells a shaving.
  struct Shaving {
    double volume = 0, walls = 0;  ///< twice the area of its walls
  };
  void add_to(Shaving& shaving, TetId tet) const {
    shaving.volume += mesh_.rest_volume(tet);
    if (!(rules_.thin > 0)) return;
    for (unsigned s = 0; s < 4; ++s) {
      const Side side(tet, s);
      const Link link = mesh_.link(side);
      if ((link.is_boundary() && link.tag() != 0) || is_blocked(side)) shaving.walls += area_of(side);
    }
  }
  /// Whether the walls on either side are at most `slack` times the greatest thickness apart, on the average.
  [[nodiscard]] bool is_thin(const Shaving& shaving, double slack) const {
    return 4 * shaving.volume <= slack * rules_.thin * shaving.walls;
  }
  /// Whether the piece may turn out to be thin when all of it is known.
  [[nodiscard]] bool may_be_thin(const Shaving& shaving) const {
    return rules_.thin > 0 && (piece_.size() <= kFewTets || is_thin(shaving, kWhileGrowing));
  }
  [[nodiscard]] double area_of(Side side) const {
    const auto v = mesh_.vertices(side);
    return (mesh_.rest(v[1]) - mesh_.rest(v[0])).cross(mesh_.rest(v[2]) - mesh_.rest(v[0])).norm();
  }
  /// A face on which a crumb may hang; `behind` is no tet of that crumb.
  struct Border {
    std::uint32_t face, crumb, behind_crumb;  ///< `behind_crumb`: kInvalidIndex where `behind` is in none
    TetId behind;
    double area;
  };
  void add_crumb() {
    double volume = 0;
    for (const TetId tet : piece_) {
      crumb_of_.emplace(tet.value, static_cast<std::uint32_t>(homes_.size()));
      volume += mesh_.rest_volume(tet);
    }
    homes_.push_back({});
    crumbs_.push_back({piece_.front(), volume});
  }
  [[nodiscard]] std::uint32_t crumb_of(TetId tet) const {
    const auto found = crumb_of_.find(tet.value);
    return found == crumb_of_.end() ? kInvalidIndex : found->second;
  }
  void collect_borders() {
    for (std::uint32_t i = 0; i < incision_.size(); ++i) {
      const IncisionFace& face = incision_[i];
      const std::uint32_t a = crumb_of(face.a.tet()), b = crumb_of(face.b.tet());
      if (a == b || (rules_.stands_open && rules_.stands_open(face))) continue;
      if (rules_.are_apart && rules_.are_apart(face.a.tet(), face.b.tet())) continue;
      if (a != kInvalidIndex) borders_.push_back({i, a, b, face.b.tet(), area_of(face.b)});
      if (b != kInvalidIndex) borders_.push_back({i, b, a, face.a.tet(), area_of(face.a)});
    }
  }
  /// The piece behind a border, by one of its tets; invalid while that is a crumb that hangs on nothing yet.
  [[nodiscard]] TetId home_behind(const Border& border) const {
    return border.behind_crumb == kInvalidIndex ? border.behind : homes_[border.behind_crumb];
  }
  /// Hangs one more crumb on what is no crumb, or hangs on such a piece already: crumbs side by side would else hang on
  /// each other, and fall together. The largest face first. Returns whether there was one.
  bool attach_next() {
    const Border* largest = nullptr;
    for (const Border& border : borders_) {
      if (homes_[border.crumb].is_valid() || !home_behind(border).is_valid()) continue;
      if (largest == nullptr || border.area > largest->area) largest = &border;
    }
    if (largest == nullptr) return false;
    const TetId home = home_behind(*largest);
    homes_[largest->crumb] = home;
    if (rules_.hangs_on_one_face) {
      is_dropped_[largest->face] = true;
      return true;
    }
    const std::vector<TetId> piece = piece_around(home);
    for (const Border& border : borders_) {
      const TetId behind = home_behind(border);
      if (border.crumb != largest->crumb || !behind.is_valid()) continue;
      if (std::find(piece.begin(), piece.end(), behind) != piece.end()) is_dropped_[border.face] = true;
    }
    return true;
  }
  /// Where crumbs hang on each other and on nothing else, all of a piece is crumbs: it stays whole, and the others hang
  /// on the largest. Returns whether there was one.
  bool found_home() {
    std::uint32_t largest = kInvalidIndex;
    for (const Border& border : borders_) {
      const std::uint32_t crumb = border.crumb;
      if (homes_[crumb].is_valid() || border.behind_crumb == kInvalidIndex) continue;
      if (largest == kInvalidIndex || crumbs_[crumb].volume > crumbs_[largest].volume) largest = crumb;
    }
    if (largest == kInvalidIndex) return false;
    homes_[largest] = crumbs_[largest].tet;
    return true;
  }
  /// Some of the tets connected to `seed` without crossing the incision.
  [[nodiscard]] std::vector<TetId> piece_around(TetId seed) {
    std::vector<TetId> piece = {seed};
    for (std::size_t i = 0; i < piece.size() && piece.size() < kMaxPieceSearch; ++i) {
      for (unsigned s = 0; s < 4; ++s) {
        const Link link = mesh_.links(piece[i])[s];
        blocked_.ensure(std::size_t{piece[i].value} + 1);
        if (!link.is_boundary() && !is_blocked(Side(piece[i], s)) &&
            std::find(piece.begin(), piece.end(), link.side().tet()) == piece.end()) {
          piece.push_back(link.side().tet());
        }
      }
    }
    return piece;
  }
  void drop_faces() {
    std::size_t kept = 0;
    for (std::uint32_t i = 0; i < incision_.size(); ++i) {
      if (is_dropped_[i]) {
        dropped_.push_back(incision_[i]);
      } else {
        incision_[kept++] = incision_[i];
      }
    }
    incision_.resize(kept);
  }

  const TetMesh& mesh_;
  const CrumbRules& rules_;
  std::vector<IncisionFace>& incision_;
  std::vector<IncisionFace>& dropped_;
  ZeroedArray<std::uint8_t>&blocked_, &state_;
  std::vector<TetId> touched_;  // whose entries may not be zero
  std::vector<bool> is_dropped_;
  std::vector<TetId> piece_;  // the last one searched
  struct Crumb {
    TetId tet;  ///< one of it
    double volume;
  };
  std::vector<Crumb> crumbs_;
  /// By crumb: a tet of the piece that it hangs on, be it by other crumbs; invalid until it hangs on one.
  std::vector<TetId> homes_;
  std::unordered_map<std::uint32_t, std::uint32_t> crumb_of_;  // by tet slot; looked up, never iterated
  std::vector<Border> borders_;
};

}  // namespace

std::uint64_t keep_crumbs(const TetMesh& mesh, const CrumbRules& rules, std::vector<IncisionFace>& incision,
                          std::vector<IncisionFace>& dropped, CrumbScratch& scratch) {
  return CrumbFinder(mesh, rules, incision, dropped, scratch).run();
}

}  // namespace v0
}  // namespace incise
