// SPDX-License-Identifier: Apache-2.0
#include "cut/rebuild.h"

#include <algorithm>
#include <array>

#include "cut/older_walls.h"
#include "cut/parity.h"
#include "incise/mesh/star.h"

namespace incise {
inline namespace v0 {

namespace {

constexpr unsigned kMaxPinchRounds = 64;

/// Which side of the sheet a child of a complete master lies on: the colour of any corner that is not on the sheet.
unsigned colour_of_child(const SplitTemplate::Child& child, const Master& master) {
  for (const std::uint8_t code : child) {
    if (code < SplitTemplate::kFirstSplit && ((unsigned{master.on} >> code) & 1U) == 0) {
      return colour_of(master.flagged, code);
    }
  }
  return colour_of(master.flagged, child[0] < SplitTemplate::kFirstSplit ? child[0] : 0);
}

/// The lines in which the cut meets the sides of a master that the blade is still in: pairs of template codes.
class IncisionLines {
 public:
  IncisionLines(const Master& master, const ClosedComplex& complex) : master_(master), complex_(complex) {
    for (unsigned s = 0; s < 4; ++s) add_side(s);
  }
  [[nodiscard]] bool contains(std::uint8_t a, std::uint8_t b) const {
    const std::array<std::uint8_t, 2> line = {std::min(a, b), std::max(a, b)};
    return std::find(lines_.begin(), lines_.begin() + count_, line) != lines_.begin() + count_;
  }

 private:
  /// What stands for the crossing of a flagged edge: its split point, or the end that takes part in the cut; of two
  /// such ends the one of lower rank, so that all masters of the edge agree.
  [[nodiscard]] std::uint8_t crossing_of(unsigned edge) const {
    const auto [a, b] = kEdgeCorners[edge];
    const bool is_a_on = is_on(a), is_b_on = is_on(b);
    if (is_a_on && is_b_on) return rank(a) < rank(b) ? a : b;
    if (is_a_on || is_b_on) return is_a_on ? a : b;
    return static_cast<std::uint8_t>(SplitTemplate::kFirstSplit + edge);
  }
  [[nodiscard]] bool is_on(std::uint8_t corner) const { return ((unsigned{master_.on} >> corner) & 1U) != 0; }
  [[nodiscard]] std::uint64_t rank(std::uint8_t corner) const { return complex_.rank(master_.vertices[corner]); }
  void add_side(unsigned side) {
    std::array<std::uint8_t, 3> crossings{};
    unsigned count = 0;
    for (const unsigned edge : kSideEdges[side]) {
      if (((unsigned{master_.flagged} >> edge) & 1U) != 0) crossings[count++] = crossing_of(edge);
    }
    if (count == 2) {
      toggle(crossings[0], crossings[1]);
    } else if (master_.points[side] != Master::kNone) {
      const auto point = static_cast<std::uint8_t>(SplitTemplate::kFirstPoint + side);
      for (unsigned k = 0; k < count; ++k) toggle(crossings[k], point);
    }
  }
  void toggle(std::uint8_t a, std::uint8_t b) {
    if (a == b) return;
    const std::array<std::uint8_t, 2> line = {std::min(a, b), std::max(a, b)};
    const auto end = lines_.begin() + count_;
    const auto at = std::find(lines_.begin(), end, line);
    if (at == end) {
      lines_[count_++] = line;
    } else {
      *at = lines_[--count_];
    }
  }

  const Master& master_;
  const ClosedComplex& complex_;
  std::array<std::array<std::uint8_t, 2>, 16> lines_{};
  std::uint8_t count_ = 0;
};

/// Whether a segment passes through a sheet an odd number of times. Exact.
bool crosses(const OwnSheet& sheet, const SosPoint& p, const SosPoint& q) {
  const Box box{p.position.cwiseMin(q.position), p.position.cwiseMax(q.position)};
  bool is_odd = false;
  for (const auto& strip : sheet.strips()) {
    const Sheet& part = strip->sheet;
    part.tree().for_each_overlap(box, [&](std::uint32_t t) {
      is_odd ^= segment_crosses_triangle(p, q, part.point(t, 0), part.point(t, 1), part.point(t, 2));
    });
  }
  return is_odd;
}

}  // namespace

class Rebuild::Run {
 public:
  Run(Rebuild& owner, Transaction& transaction, ClosedComplex& complex, const OwnSheet& sheet, const Settings& settings)
      : owner_(owner),
        transaction_(transaction),
        mesh_(transaction.mesh()),
        complex_(complex),
        sheet_(sheet),
        dirty_(complex.dirty()),
        settings_(settings),
        divider_(mesh_, owner.templates_, complex),
        old_(owner.old_),
        pieces_(owner.pieces_),
        incision_(owner.incision_),
        dropped_(owner.dropped_),
        ranges_(owner.ranges_),
        children_(owner.children_),
        star_(owner.star_),
        ring_(owner.ring_),
        surface_(owner.surface_),
        edges_(owner.edges_) {
    ranges_.clear();
    surface_.clear();
    old_.clear();
    incision_.clear();
    owner_.renamed_.clear();
  }

  RebuildStatistics run() {
    if (owner_.sizes_.new_tets <= kMostChildren * dirty_.size()) transaction_.reserve(owner_.sizes_);  // alike steps
    keep_old();
    make_vertices();
    for (std::uint32_t i = 0; i < dirty_.size(); ++i) make_children(i);
    remove_old();
    for (std::uint32_t i = 0; i < dirty_.size(); ++i) link(i);
    keep_crumbs();
    separate();
    for (unsigned round = 0; round < kMaxPinchRounds && close_pinched_faces(); ++round) separate();
    open_faces();
    bury_retired();
    pieces_.forget();
    owner_.sizes_ = transaction_.sizes();
    for (const std::uint32_t index : dirty_) complex_[index].is_dirty = false;
    dirty_.clear();
    return result_;
  }

 private:
  // --- before --------------------------------------------------------------------------------------------------------

  void keep_old() {
    ranges_.reserve(dirty_.size());
    for (const std::uint32_t index : dirty_) keep_old(complex_[index]);
    if (settings_.keeps_pieces) find_pieces();
  }
  /// Finds of which pieces the material is, of the dirty masters and of the tets beside them, before anything changes.
  void find_pieces() {
    std::vector<TetId>& seeds = owner_.seeds_;
    seeds.clear();
    for (std::uint32_t old = 0; old < old_.size(); ++old) seeds.push_back(old_.id(old));
    for (const std::uint32_t index : dirty_) {
      for (unsigned s = 0; s < 4; ++s) note_beside(complex_[index], s);
    }
    pieces_.find(mesh_, seeds);
  }
  /// The tets behind a side of a dirty master, where these stay as they are.
  void note_beside(const Master& master, unsigned side) {
    const std::uint32_t behind = master.behind[side];
    if (behind == Master::kNone) {
      const Link link = complex_.outside(mesh_, master, side);
      if (!link.is_boundary()) owner_.seeds_.push_back(link.side().tet());
    } else if (!complex_[behind].is_dirty) {
      for (const TetId child : complex_.children(complex_[behind])) owner_.seeds_.push_back(child);
    }
  }
  /// Whether two sides are of two pieces: no step joins them. Of masters that are taken in later, where a wall is
  /// between them; what this step itself parts counts as apart there.
  [[nodiscard]] bool stand_apart(Side a, Side b) {
    if (!settings_.keeps_pieces) return false;
    if (pieces_.knows(a.tet()) && pieces_.knows(b.tet())) return pieces_.are_apart(a.tet(), b.tet());
    const StrokeTags& tags = settings_.tags;
    return tags.own(mesh_.link(a)) && tags.own(mesh_.link(b)) && !pieces_.hang_together(mesh_, a.tet(), b.tet());
  }
  /// The same for a face of the cut, where nothing is linked yet.
  [[nodiscard]] bool would_join_pieces(const IncisionFace& face) {
    const TetId a = face.a.tet(), b = face.b.tet();
    if (pieces_.knows(a) && pieces_.knows(b)) return pieces_.are_apart(a, b);
    return settings_.keeps_pieces && stands_open(face) && !pieces_.hang_together(mesh_, a, b);
  }
  void keep_old(Master& master) {
    OldRange range{old_.size(), 0, {}};
    for (const TetId child : complex_.children(master)) {
      old_.add(mesh_, child);
      for (const Link link : mesh_.links(child)) {
        result_.closed_sides += settings_.tags.own(link) ? 1U : 0U;
      }
    }
    range.last = old_.size();
    for (unsigned s = 0; s < 4; ++s) {
      if (master.behind[s] == Master::kNone) range.outside[s] = complex_.outside(mesh_, master, s);
    }
    master.entry = static_cast<std::uint32_t>(ranges_.size());
    ranges_.push_back(range);
    master.is_pinched = master.has_latent_faces = false;
  }
  /// What a dirty master was made of; null for others.
  [[nodiscard]] const OldRange* range_of(std::uint32_t master) const {
    return complex_[master].is_dirty ? &ranges_[complex_[master].entry] : nullptr;
  }

  // --- vertices ------------------------------------------------------------------------------------------------------

  void make_vertices() {
    for (const std::uint32_t index : dirty_) {
      Master& master = complex_[index];
      for (unsigned e = 0; e < 6; ++e) update_split_point(index, e);
      for (const std::uint32_t point : master.points) {
        if (point != Master::kNone) update_front_point(complex_.point(point));
      }
      if (divider_.is_cone(master)) {
        update_middle(index);
      } else if (master.middle.is_valid()) {
        retire(master.middle);
        master.middle = {};
      }
    }
  }
  void retire(VertexId vertex) { complex_.retire(vertex); }
  void update_split_point(std::uint32_t master, unsigned e) {
    ClosedEdge& edge = complex_.edges()[complex_[master].edges[e]];
    if (!needs_split(complex_[master], e)) {
      if (edge.split.is_valid()) {
        retire(edge.split);
        edge.split = {};
        edge.halves = {};
      }
      return;
    }
    if (edge.split.is_valid()) return;
    const bool is_whole = !complex_.has_copies(edge.a) && !complex_.has_copies(edge.b);
    edge.split = is_whole ? transaction_.add_vertex_on_edge(edge.a, edge.b, edge.t)
                          : add_vertex_at(transaction_, edge.position, place_of(edge.position, {master, master}));
    const unsigned at_front = mesh_.shape_of(edge.a) & mesh_.shape_of(edge.b) & shape::kFront;
    if (at_front != 0) transaction_.set_shape(edge.split, shape::kFront);
  }
  void update_front_point(FrontPoint& point) {
    if (point.vertex.is_valid() && mesh_.rest(point.vertex) == point.position) return;
    if (point.vertex.is_valid()) retire(point.vertex);
    point.vertex = add_vertex_at(transaction_, point.position, place_of(point.position, point.masters));
  }
  void update_middle(std::uint32_t index) {
    Master& master = complex_[index];
    const Vec3 place = divider_.middle_of(master);
    if (master.middle.is_valid() && mesh_.rest(master.middle) == place) return;
    if (master.middle.is_valid()) retire(master.middle);
    master.middle = add_vertex_at(transaction_, place, place_of(place, {index, index}));
  }
  /// Where a rest point stood in the old children of one or the other master.
  [[nodiscard]] MaterialPlace place_of(const Vec3& rest, const std::array<std::uint32_t, 2>& masters) const {
    MaterialPlace best;
    for (const std::uint32_t master : masters) {
      const OldRange* range = master == Master::kNone ? nullptr : range_of(master);
      if (range == nullptr) continue;
      const MaterialPlace place = old_.place_in(old_.holding(rest, range->first, range->last), rest);
      if (place.inside > best.inside) best = place;
    }
    return best;
  }

  // --- children ------------------------------------------------------------------------------------------------------

  [[nodiscard]] VertexId vertex_of(const Master& master, std::uint8_t code) const {
    if (code < SplitTemplate::kFirstSplit) return master.vertices[code];
    if (code < SplitTemplate::kFirstPoint) {
      return complex_.edges()[master.edges[code - SplitTemplate::kFirstSplit]].split;
    }
    if (code < SplitTemplate::kMiddle) return complex_.point(master.points[code - SplitTemplate::kFirstPoint]).vertex;
    return master.middle;
  }
  void make_children(std::uint32_t i) {
    const std::uint32_t index = dirty_[i];
    const Master& master = complex_[index];
    const SplitTemplate& split = divider_.find(master);
    complex_[index].is_kept = is_divided_so(master, split);
    if (master.is_kept) {
      note_kept(ranges_[i]);
      return;
    }
    children_.clear();
    for (const SplitTemplate::Child& child : split.children) {
      TetVertices v;
      Vec3 middle = Vec3::Zero();
      for (unsigned c = 0; c < 4; ++c) {
        v[c] = vertex_of(master, child[c]);
        middle += 0.25 * mesh_.rest(v[c]);
      }
      const std::uint32_t old = old_.holding(middle, ranges_[i].first, ranges_[i].last);
      const TetId tet = transaction_.add_tet(v, old_.id(old));
      for (const VertexId vertex : v) transaction_.set_tet_of(vertex, tet);
      children_.push_back(tet);
      note_old(tet, old);
    }
    complex_.set_children(index, split, children_);
  }

  void note_kept(const OldRange& range) {
    for (std::uint32_t old = range.first; old < range.last; ++old) note_old(old_.id(old), old);
  }
  void note_old(TetId tet, std::uint32_t old) {
    owner_.old_of_.ensure(std::size_t{tet.value} + 1);
    owner_.old_of_[tet.value] = old;
    pieces_.follow(tet, old_.id(old));
  }
  /// Whether a master's children are those of a template already, down to the vertices.
  [[nodiscard]] bool is_divided_so(const Master& master, const SplitTemplate& split) const {
    if (master.split != &split) return false;
    const auto children = complex_.children(master);
    for (std::size_t k = 0; k < children.size(); ++k) {
      for (unsigned c = 0; c < 4; ++c) {
        if (complex_.closed(mesh_.vertices(children[k])[c]) != vertex_of(master, split.children[k][c])) return false;
      }
    }
    return true;
  }
  void remove_old() {
    for (std::uint32_t i = 0; i < dirty_.size(); ++i) {
      if (complex_[dirty_[i]].is_kept) continue;
      for (std::uint32_t k = ranges_[i].first; k < ranges_[i].last; ++k) transaction_.remove_tet(old_.id(k));
    }
  }

  // --- links ---------------------------------------------------------------------------------------------------------

  void link(std::uint32_t i) {
    link_inner(dirty_[i]);
    for (unsigned s = 0; s < 4; ++s) {
      const std::uint32_t behind = complex_[dirty_[i]].behind[s];
      if (behind == Master::kNone) {
        link_outside(dirty_[i], s, ranges_[i].outside[s]);
      } else if (!complex_[behind].is_dirty || i < complex_[behind].entry) {
        link_masters(dirty_[i], s, behind);
      }
    }
  }
  void link_inner(std::uint32_t index) {
    const Master& master = complex_[index];
    const SplitTemplate& split = *master.split;
    if (split.inner.empty()) return;
    const bool is_cone = divider_.is_cone(master);
    const IncisionLines lines(master, complex_);
    for (const auto& [a, b] : split.inner) {
      const auto &first = split.children[a / 4U], &second = split.children[b / 4U];
      const bool is_incision = is_cone ? lies_on_line(lines, first, a & 3U)
                                       : colour_of_child(first, master) != colour_of_child(second, master);
      meet(complex_.facet(master, a), complex_.facet(master, b), is_incision);
    }
  }
  /// Whether a face of a cone stands on a line of the incision.
  [[nodiscard]] static bool lies_on_line(const IncisionLines& lines, const SplitTemplate::Child& child, unsigned side) {
    std::array<std::uint8_t, 2> foot{};
    unsigned count = 0;
    for (const unsigned c : kSideCorners[side]) {
      if (child[c] != SplitTemplate::kMiddle) foot[count++] = child[c];
    }
    return lines.contains(foot[0], foot[1]);
  }
  void meet(Side a, Side b, bool is_crossed) {
    const StrokeTags& tags = settings_.tags;
    const bool is_incision = is_crossed || stand_apart(a, b);
    if (is_incision && !is_crossed) note_apart(a);
    if (is_incision && tags.own(mesh_.link(a)) && tags.own(mesh_.link(b))) standing_.push_back(a);
    set_link(a, is_incision ? tags.wall() : Link(b));
    set_link(b, is_incision ? tags.wall() : Link(a));
    if (is_incision) incision_.push_back({a, b});
  }
  /// A face that the sheet does not pass, between two pieces: its vertices need copies, wherever they are.
  void note_apart(Side side) {
    for (const VertexId v : mesh_.vertices(side)) apart_.push_back({complex_.closed(v), complex_.find(side.tet())});
  }
  void set_link(Side side, Link link) {
    if (mesh_.link(side) != link) transaction_.set_link(side, link);
  }
  void link_outside(std::uint32_t index, unsigned side, Link outside) {
    const Master& master = complex_[index];
    for (const auto child_side : master.split->outer[side]) {
      const Side facet = complex_.facet(master, child_side);
      if (outside.is_boundary()) {
        set_link(facet, outside);
        note_surface(facet, outside.tag() == 0 ? shape::kSkin : shape::kWall);
      } else {
        if (pieces_.are_apart(facet.tet(), outside.side().tet())) complex_.adopt(mesh_, outside.side().tet());
        meet(facet, outside.side(), false);
      }
    }
  }
  /// The vertices of a boundary side lie on its surface.
  void note_surface(Side side, std::uint8_t bit) {
    for (const VertexId v : mesh_.vertices(side)) {
      if ((mesh_.shape_of(v) & bit) == 0) {
        transaction_.set_shape(v, static_cast<std::uint8_t>(mesh_.shape_of(v) | bit));
      }
    }
  }
  void link_masters(std::uint32_t index, unsigned side, std::uint32_t behind) {
    const Master &master = complex_[index], &other = complex_[behind];
    const auto& sides = other.behind;
    const auto other_side = static_cast<unsigned>(std::find(sides.begin(), sides.end(), index) - sides.begin());
    const auto &outer = master.split->outer[side], &facing = other.split->outer[other_side];
    if (outer.size() == 1) {
      meet(complex_.facet(master, outer[0]), complex_.facet(other, facing[0]),
           lies_across(master, side, other, other_side));
      return;
    }
    constexpr std::size_t kMostFacets = 6;
    std::array<std::array<VertexId, 3>, kMostFacets> there;
    for (std::size_t k = 0; k < facing.size(); ++k) there[k] = closed_facet(other, facing[k]);
    for (const auto a : outer) {
      const std::array<VertexId, 3> here = closed_facet(master, a);
      for (std::size_t k = 0; k < facing.size(); ++k) {
        if (are_same(here, there[k])) meet(complex_.facet(master, a), complex_.facet(other, facing[k]), false);
      }
    }
  }
  /// The closed vertices of a facet of a master.
  [[nodiscard]] std::array<VertexId, 3> closed_facet(const Master& master, SplitTemplate::ChildSide side) const {
    const auto v = mesh_.vertices(complex_.facet(master, side));
    return {complex_.closed(v[0]), complex_.closed(v[1]), complex_.closed(v[2])};
  }
  [[nodiscard]] static bool are_same(const std::array<VertexId, 3>& u, const std::array<VertexId, 3>& v) {
    return std::all_of(u.begin(), u.end(), [&](VertexId x) { return x == v[0] || x == v[1] || x == v[2]; });
  }
  /// Whether an undivided face lies on the sheet: three ON vertices, and the two masters on opposite sides.
  [[nodiscard]] bool lies_across(const Master& master, unsigned side, const Master& other, unsigned other_side) const {
    const unsigned face = 15U & ~(1U << side), other_face = 15U & ~(1U << other_side);
    if ((master.on & face) != face || (other.on & other_face) != other_face || has_odd_face(master.flagged) ||
        has_odd_face(other.flagged)) {
      return false;
    }
    const VertexId common = master.vertices[side == 0 ? 1 : 0];
    return is_beyond(common, master, side) != is_beyond(common, other, other_side);
  }
  /// Whether the sheet passes between an ON vertex and the inside of a master that has it, seen over one of its sides.
  [[nodiscard]] bool is_beyond(VertexId from, const Master& master, unsigned side) const {
    if (((unsigned{master.on} >> side) & 1U) != 0) {  // all four vertices coincide with the sheet: ask for the middle
      Vec3 middle = Vec3::Zero();
      for (const VertexId v : master.vertices) middle += 0.25 * mesh_.rest(v);
      const std::uint64_t key = 2 * kFirstBladeKey + complex_.children(master)[0].value;
      return crosses(sheet_, {mesh_.rest(from), from.value}, {middle, key});
    }
    const auto corner = static_cast<unsigned>(std::find(master.vertices.begin(), master.vertices.end(), from) -
                                              master.vertices.begin());
    return ((unsigned{master.flagged} >> kEdgeOfCorners[corner][side]) & 1U) != 0;
  }

  // --- separation ----------------------------------------------------------------------------------------------------

  void keep_crumbs() {
    std::sort(standing_.begin(), standing_.end());
    if (!settings_.keeps_crumbs) return;
    CrumbRules rules;
    rules.limit = [&](TetId tet) {
      const std::uint32_t index = complex_.find(tet);
      if (index == Master::kNone) return 0.0;
      double sum = 0;
      for (const std::uint32_t e : complex_[index].edges) {
        sum += (mesh_.rest(complex_.edges()[e].b) - mesh_.rest(complex_.edges()[e].a)).norm();
      }
      return crumb_limit(std::max(sum / 6.0, 0.5 * settings_.spacing));
    };
    rules.thin = settings_.thin;
    rules.is_older = [&](Side side) { return is_older_wall(mesh_, complex_, side); };
    rules.stands_open = [&](const IncisionFace& face) { return stands_open(face); };
    if (pieces_.has_several()) rules.are_apart = [&](TetId a, TetId b) { return pieces_.are_apart(a, b); };
    dropped_.clear();
    result_.crumbs_kept += incise::keep_crumbs(mesh_, rules, incision_, dropped_, owner_.crumbs_);
    for (const IncisionFace& face : dropped_) {
      close(face);
      if (settings_.keeps_pieces) note_closed(face);
    }
  }
  /// Whether a face was open before, between tets that stay: it is never joined again but where nothing separates it.
  [[nodiscard]] bool stands_open(const IncisionFace& face) const {
    return std::binary_search(standing_.begin(), standing_.end(), face.a);
  }
  /// Leaves the material joined at an incision face.
  void close(const IncisionFace& face) { transaction_.join(face.a, face.b); }
  /// Whether the material of a new tet had the vertex before.
  [[nodiscard]] bool was_home(const StarTet& tet, VertexId vertex) const {
    if (tet.old == kInvalidIndex) return false;
    const TetVertices& corners = old_.vertices(tet.old);
    return std::find(corners.begin(), corners.end(), vertex) != corners.end();
  }
  /// The code of a closed vertex in a master; those of the ends of its edge, where it splits one.
  struct Codes {
    std::uint8_t vertex;
    std::uint8_t a = kNoCode, b = kNoCode;
  };
  static constexpr std::uint8_t kNoCode = SplitTemplate::kCodes;
  /// The live tets of some masters around a closed vertex, into `star_`. `codes_in(master)` tells which of a template's
  /// vertices it is: cheaper than asking for the copies of every corner.
  template <class Masters, class CodesIn>
  void gather(const Masters& masters, CodesIn&& codes_in) {
    star_.clear();
    is_beside_closed_ = false;
    for (const std::uint32_t index : masters) {
      const Master& master = complex_[index];
      is_beside_closed_ |= master.is_pinched || master.has_latent_faces || ends_without_point(master);
      const SplitTemplate& split = *master.split;
      const Codes codes = codes_in(master);
      const auto tets = complex_.children(master);
      const bool is_new = master.is_dirty && !master.is_kept;
      for (const std::uint8_t at : split.around[codes.vertex]) {
        const unsigned k = at / 4U, has = split.codes[k];
        const auto ends = codes.vertex < SplitTemplate::kFirstSplit
                              ? sides_of(master, codes.vertex, has)
                              : static_cast<std::uint8_t>(((has >> codes.a) & 1U) | ((has >> codes.b) & 1U) << 1U);
        const std::uint32_t old = master.is_dirty ? owner_.old_of_[tets[k].value] : kInvalidIndex;
        star_.push_back({tets[k], at & 3U, is_new, old, 0, ends});
      }
    }
  }
  /// Of a child that has a corner of its master, by the codes that it has: bit 0 where another corner is on the same
  /// side of the sheet, bit 1 where one is across. Corners that take part in the cut are on neither.
  [[nodiscard]] static std::uint8_t sides_of(const Master& master, std::uint8_t corner, unsigned has) {
    unsigned sides = 0;
    for (unsigned c = 0; c < 4; ++c) {
      if (c == corner || ((has >> c) & 1U) == 0 || ((unsigned{master.on} >> c) & 1U) != 0) continue;
      sides |= 1U + ((unsigned{master.flagged} >> kEdgeOfCorners[corner][c]) & 1U);
    }
    return static_cast<std::uint8_t>(sides);
  }
  /// Whether the cut ends in a side that has no front point, since an older cut is beside it: it ends at split points.
  [[nodiscard]] static bool ends_without_point(const Master& master) {
    if (!has_odd_face(master.flagged)) return false;
    bool does_end = false;
    for (unsigned s = 0; s < 4; ++s) does_end |= master.points[s] == Master::kNone && is_odd_side(master, s);
    return does_end;
  }
  [[nodiscard]] static Codes codes_of_corner(const Master& master, VertexId vertex) {
    const auto& corners = master.vertices;
    return {static_cast<std::uint8_t>(std::find(corners.begin(), corners.end(), vertex) - corners.begin())};
  }
  [[nodiscard]] static Codes codes_of_split_point(const Master& master, std::uint32_t edge, VertexId a) {
    const auto e =
        static_cast<std::size_t>(std::find(master.edges.begin(), master.edges.end(), edge) - master.edges.begin());
    const auto [first, second] = kEdgeCorners[e];
    const auto code = static_cast<std::uint8_t>(SplitTemplate::kFirstSplit + e);
    return master.vertices[first] == a ? Codes{code, first, second} : Codes{code, second, first};
  }
  [[nodiscard]] Codes codes_of_point(const Master& master, VertexId vertex) const {
    std::uint8_t s = 0;
    while (master.points[s] == Master::kNone || complex_.point(master.points[s]).vertex != vertex) ++s;
    return {static_cast<std::uint8_t>(SplitTemplate::kFirstPoint + s)};
  }
  void note_visited(VertexId vertex) {
    owner_.visited_.ensure(std::size_t{vertex.value} + 1);
    owner_.visited_[vertex.value] = owner_.round_;
  }
  [[nodiscard]] bool is_first(VertexId vertex) {
    if (vertex.value < owner_.visited_.capacity() && owner_.visited_[vertex.value] == owner_.round_) return false;
    note_visited(vertex);
    return true;
  }
  /// Every vertex of the cut around the dirty masters gets one copy per part of its star.
  void separate() {
    surface_.clear();
    ++owner_.round_;
    for (const std::uint32_t index : dirty_) {
      if (!complex_[index].is_divided() && complex_[index].on == 0 && !settings_.keeps_pieces) continue;
      for (unsigned c = 0; c < 4; ++c) {
        const VertexId corner = complex_[index].vertices[c];
        if (complex_[index].is_kept && complex_.is_half_baked(corner)) continue;  // it has the copy that it had
        const bool is_apart = settings_.keeps_pieces && complex_.has_copies(corner);
        if (((unsigned{complex_[index].on} >> c) & 1U) != 0 || is_apart) divide_corner(index, corner);
      }
      for (unsigned e = 0; e < 6; ++e) {
        if (complex_.edges()[complex_[index].edges[e]].split.is_valid()) divide_split_point(index, e);
      }
      for (const std::uint32_t point : complex_[index].points) {
        if (point != Master::kNone) divide_front_point(complex_.point(point));
      }
      if (complex_[index].middle.is_valid()) divide_middle(index);
    }
    for (const auto& [vertex, master] : apart_) {
      const auto& corners = complex_[master].vertices;
      if (std::find(corners.begin(), corners.end(), vertex) != corners.end()) divide_corner(master, vertex);
    }
    std::sort(surface_.begin(), surface_.end());
    surface_.erase(std::unique(surface_.begin(), surface_.end()), surface_.end());
  }
  /// Returns what the closed vertex is called now.
  VertexId divide(VertexId vertex, const StarParts::Home& home, bool makes_twins, bool may_be_named) {
    const bool keeps = settings_.keeps_pieces;
    const StarParts::Settings settings{settings_.tags, makes_twins, keeps, keeps && may_be_named, &pieces_, across_};
    const StarParts::Division done = owner_.parts_.divide(transaction_, complex_, old_, vertex, star_, home, settings);
    result_.copied_vertices += done.made;
    if (done.closed != vertex) note_visited(done.closed);
    note_surface_around(done.closed);
    return done.closed;
  }
  /// Notes the boundary sides around a vertex where two fans of tets might touch along an edge, or a face of the cut
  /// that is not rebuilt might be separated no more: at rest, not at points of the cut inside the body.
  void note_surface_around(VertexId vertex) {
    bool is_plain =
        !complex_.is_on(vertex) && !is_beside_closed_ && result_.crumbs_kept == 0 && !settings_.keeps_pieces;
    for (const StarTet& tet : star_) is_plain &= has_plain_sides(tet);
    if (is_plain) return;
    for (const StarTet& tet : star_) {
      for (unsigned s = 0; s < 4; ++s) {
        if (s != tet.corner && mesh_.links(tet.tet)[s].is_boundary()) surface_.emplace_back(tet.tet, s);
      }
    }
  }
  [[nodiscard]] bool has_plain_sides(const StarTet& tet) const {
    bool is_plain = true;
    for (unsigned s = 0; s < 4; ++s) {
      const Link link = mesh_.links(tet.tet)[s];
      if (s != tet.corner && link.is_boundary()) is_plain &= settings_.tags.own(link) && tet.is_new;
    }
    return is_plain;
  }
  void divide_corner(std::uint32_t master, VertexId vertex) {
    if (!is_first(vertex)) return;
    const std::vector<std::uint32_t>& masters = complex_.star(mesh_, master, vertex);
    gather(masters, [&](const Master& m) { return codes_of_corner(m, vertex); });
    find_across(masters, vertex);
    const bool may_be_named = complex_.is_known_around(vertex, masters);
    const VertexId named = divide(
        vertex, [&](std::span<const StarTet> part) { return home_of_corner(vertex, part); }, false, may_be_named);
    across_.clear();
    if (named == vertex) return;
    complex_.rename(vertex, named, masters);
    for (ApartVertex& apart : apart_) apart.vertex = apart.vertex == vertex ? named : apart.vertex;
    owner_.renamed_.push_back({vertex, named});
  }
  /// The neighbours across the sheet of a vertex that takes part in the cut for the first time, in a body that moves.
  void find_across(std::span<const std::uint32_t> masters, VertexId vertex) {
    across_.clear();
    if (!settings_.keeps_pieces || complex_.has_copies(vertex)) return;
    for (const std::uint32_t index : masters) {
      const Master& master = complex_[index];
      const unsigned c = codes_of_corner(master, vertex).vertex;
      for (unsigned other = 0; other < 4; ++other) {
        const bool is_on = ((unsigned{master.on} >> other) & 1U) != 0;
        if (other == c || is_on || ((unsigned{master.flagged} >> kEdgeOfCorners[c][other]) & 1U) == 0) continue;
        across_.push_back(master.vertices[other]);
      }
    }
  }
  /// The part in whose material the vertex stood keeps it: that on its side of the sheet. Until it takes part in the
  /// cut it is told from the other one by that; what snapping takes over from one to the other says nothing.
  [[nodiscard]] VertexId home_of_corner(VertexId vertex, std::span<const StarTet> part) const {
    unsigned sides = 0;
    for (const StarTet& tet : part) sides |= tet.ends;
    if (!across_.empty() && sides != 0) return (sides & 1U) != 0 ? vertex : VertexId();
    const bool is_home = std::any_of(part.begin(), part.end(), [&](const StarTet& t) { return was_home(t, vertex); });
    return is_home ? vertex : VertexId();
  }
  void divide_split_point(std::uint32_t master, unsigned e) {
    const std::uint32_t at = complex_[master].edges[e];
    const VertexId vertex = complex_.edges()[at].split;
    if (!is_first(vertex)) return;
    ring_.clear();
    complex_.for_each_around(at, [&](std::uint32_t m) { ring_.push_back(m); });
    gather(ring_, [&, a = complex_.edges()[at].a](const Master& m) { return codes_of_split_point(m, at, a); });
    complex_.edges()[at].split = divide(
        vertex,
        [&](std::span<const StarTet> part) {
          const unsigned half = half_of(part);
          return half < 2 ? complex_.edges()[at].halves[half] : VertexId();
        },
        true, true);
    note_halves(complex_.edges()[at]);
  }
  /// Which end of its edge a part of a split point's star contains: 0 for a, 1 for b, 2 for both or neither.
  [[nodiscard]] static unsigned half_of(std::span<const StarTet> part) {
    unsigned ends = 0;
    for (const StarTet& tet : part) ends |= tet.ends;
    return ends == 1 || ends == 2 ? ends - 1 : 2;
  }
  void note_halves(ClosedEdge& edge) {
    edge.halves = {};
    for (const StarTet& tet : star_) {
      for (const unsigned half : {0U, 1U}) {
        if (((unsigned{tet.ends} >> half) & 1U) != 0) edge.halves[half] = mesh_.vertices(tet.tet)[tet.corner];
      }
    }
  }
  void divide_front_point(FrontPoint& point) {
    if (!is_first(point.vertex)) return;
    ring_.clear();
    for (const std::uint32_t master : point.masters) {
      if (master != Master::kNone) ring_.push_back(master);
    }
    gather(ring_, [&](const Master& m) { return codes_of_point(m, point.vertex); });
    point.vertex = divide(
        point.vertex, [&](std::span<const StarTet> part) { return home_of_corner(point.vertex, part); }, false, true);
  }
  void divide_middle(std::uint32_t master) {
    if (!is_first(complex_[master].middle)) return;
    ring_.assign(1, master);
    gather(ring_, [](const Master&) { return Codes{SplitTemplate::kMiddle}; });
    const VertexId middle = complex_[master].middle;
    complex_[master].middle = divide(
        middle, [&](std::span<const StarTet> part) { return home_of_corner(middle, part); }, false, true);
  }

  // --- after ---------------------------------------------------------------------------------------------------------

  /// Closes faces beside edges along which two fans of tets touch: the incision leaves them out until the blade has
  /// passed. Returns whether there were any.
  bool close_pinched_faces() {
    if (!settings_.closes_pinched) return false;
    collect_surface_edges();
    std::vector<Side>& closed = owner_.closed_;
    closed.clear();
    for (const SurfaceEdges::Edge& edge : edges_.all()) {
      if (edge.count < 2) continue;
      const SurfaceEdges::Use &last = edges_.use(edge.last), &first = edges_.use(last.before);
      if (edge.count == 2 && are_one_fan(edge, first.side, last.side)) continue;
      for (std::uint32_t use = edge.last; use != kInvalidIndex; use = edges_.use(use).before) {
        closed.push_back(edges_.use(use).side);
      }
    }
    if (closed.empty()) return false;
    std::sort(closed.begin(), closed.end());
    const auto is_closed = [&](Side side) { return std::binary_search(closed.begin(), closed.end(), side); };
    std::size_t kept = 0;
    result_.left_pinched = 0;
    for (const IncisionFace& face : incision_) {
      if (is_latent(face) || !(is_closed(face.a) || is_closed(face.b))) {
        incision_[kept++] = face;
        continue;
      }
      for (const Side side : {face.a, face.b}) complex_[complex_.find(side.tet())].is_pinched = true;
      if (would_join_pieces(face)) {
        incision_[kept++] = face;
        ++result_.left_pinched;
      } else {
        close(face);
      }
    }
    bool has_changed = kept < incision_.size();
    incision_.resize(kept);
    for (const Side side : closed) has_changed |= take_in(side);
    return has_changed;
  }
  /// Makes the incision of the master that a wall belongs to part of the rebuild, where it was not: its children stay.
  bool take_in(Side side) {
    const std::uint32_t index = complex_.find(side.tet());
    if (!settings_.tags.own(mesh_.link(side)) || index == Master::kNone || complex_[index].is_dirty ||
        complex_.is_half_baked(index)) {
      return false;
    }
    complex_.mark_dirty(index);
    keep_old(complex_[index]);
    complex_[index].is_kept = true;
    note_kept(ranges_.back());
    link(complex_[index].entry);
    std::sort(standing_.begin(), standing_.end());
    return true;
  }
  /// The edges of the noted boundary sides whose vertices were both looked at in this round, or one of them.
  void collect_surface_edges() {
    edges_.clear();
    for (const Side side : surface_) {
      const auto v = mesh_.vertices(side);
      const std::array<bool, 3> is_near = {is_visited(v[0]), is_visited(v[1]), is_visited(v[2])};
      for (unsigned k = 0; k < 3; ++k) {
        const unsigned next = (k + 1) % 3;
        if (is_near[k] || is_near[next]) edges_.add(v[k], v[next], side);
      }
    }
  }
  [[nodiscard]] bool is_visited(VertexId vertex) const {
    const VertexId closed = complex_.closed(vertex);
    return closed.value < owner_.visited_.capacity() && owner_.visited_[closed.value] == owner_.round_;
  }
  /// Joins faces of the cut that are not rebuilt and that nothing separates any more.
  void join_latent_walls() {
    auto& walls = owner_.walls_;
    walls.clear();
    std::array<std::uint8_t, 1024> counts{};  // of walls by a hash of their vertices: most have no match
    const auto count_of = [&](Side side) -> std::uint8_t& {
      const auto v = mesh_.vertices(side);
      return counts[((v[0].value + v[1].value + v[2].value) * 0x9E3779B9U) >> 22U];
    };
    const auto is_wall = [&](Side side) { return settings_.tags.own(mesh_.link(side)); };
    for (const Side side : surface_) {
      if (!is_wall(side)) continue;
      std::uint8_t& count = count_of(side);
      count = static_cast<std::uint8_t>(std::min(2, count + 1));
    }
    for (const Side side : surface_) {
      if (!is_wall(side) || count_of(side) < 2) continue;
      auto v = mesh_.vertices(side);
      std::sort(v.begin(), v.end());
      walls.emplace_back(v, side);
    }
    std::sort(walls.begin(), walls.end());
    for (std::size_t i = 0; i + 1 < walls.size(); ++i) {
      if (walls[i].first != walls[i + 1].first) continue;
      if (!is_opened_now(walls[i].second)) close_latent({walls[i].second, walls[i + 1].second});
    }
  }
  [[nodiscard]] bool is_opened_now(Side side) const {
    return std::any_of(incision_.begin(), incision_.end(),
                       [&](const IncisionFace& face) { return face.a == side || face.b == side; });
  }
  void close_latent(const IncisionFace& face) {
    close(face);
    note_closed(face);
    ++result_.latent_faces;
  }
  /// A face of the cut was left joined: once the blade has passed it is looked at again. What is one piece around a
  /// crumb now may be two by then.
  void note_closed(const IncisionFace& face) {
    for (const Side side : {face.a, face.b}) {
      const std::uint32_t master = complex_.find(side.tet());
      if (master != Master::kNone) complex_[master].has_latent_faces = true;
    }
  }
  /// Whether two boundary sides are the two ends of one fan of tets around an edge.
  [[nodiscard]] bool are_one_fan(const SurfaceEdges::Edge& edge, Side first, Side second) const {
    bool is_one = false;
    walk_edge_ring(
        mesh_, edge.a, edge.b, first.tet(), [](Side) { return false; },
        [&](TetId tet) { is_one |= tet == second.tet(); });
    return is_one;
  }
  [[nodiscard]] bool is_latent(const IncisionFace& face) const {
    const auto u = mesh_.vertices(face.a), v = mesh_.vertices(face.b);
    return std::all_of(u.begin(), u.end(), [&](VertexId x) { return x == v[0] || x == v[1] || x == v[2]; });
  }
  void open_faces() {
    std::size_t kept = 0;
    for (const IncisionFace& face : incision_) {
      if (is_latent(face)) {
        close_latent(face);
      } else {
        transaction_.open(face.a, face.b, settings_.tags.last);
        for (const Side side : {face.a, face.b}) result_.opened_sides += is_dirty(side.tet()) ? 1U : 0U;
        incision_[kept++] = face;
      }
    }
    incision_.resize(kept);
    join_latent_walls();
  }
  [[nodiscard]] bool is_dirty(TetId tet) const {
    const std::uint32_t master = complex_.find(tet);
    return master != Master::kNone && complex_[master].is_dirty;
  }
  void bury_retired() {
    for (const VertexId vertex : complex_.retired()) {
      if (complex_.has_copies(vertex)) {
        for (const VertexId copy : complex_.copies_of(vertex)) transaction_.remove_vertex(copy);
        complex_.drop_copies(vertex);
      }
      transaction_.remove_vertex(vertex);
    }
    complex_.retired().clear();
  }

  Rebuild& owner_;
  Transaction& transaction_;
  const TetMesh& mesh_;
  ClosedComplex& complex_;
  const OwnSheet& sheet_;
  std::vector<std::uint32_t>& dirty_;
  const Settings& settings_;
  Divider divider_;
  OldChildren& old_;
  MaterialPieces& pieces_;
  std::vector<IncisionFace>& incision_;
  std::vector<IncisionFace>& dropped_;
  std::vector<OldRange>& ranges_;
  std::vector<TetId>& children_;
  std::vector<StarTet>& star_;
  std::vector<std::uint32_t>& ring_;
  std::vector<Side>& surface_;  // boundary sides to be looked at
  std::vector<Side> standing_;  // incision faces that were open before, by their first side; ascending
  SurfaceEdges& edges_;
  RebuildStatistics result_;
  struct ApartVertex {
    VertexId vertex;
    std::uint32_t master;
  };
  std::vector<ApartVertex> apart_;  // of faces that are left open since two pieces meet there, with a master each
  std::vector<VertexId> across_;    // of the corner that is being divided, see `find_across`
  bool is_beside_closed_ = false;   // `star_`: beside faces of the cut that were left joined
};

RebuildStatistics Rebuild::run(Transaction& transaction, ClosedComplex& complex, const OwnSheet& sheet,
                               const Settings& settings) {
  return Run(*this, transaction, complex, sheet, settings).run();
}

}  // namespace v0
}  // namespace incise
