// SPDX-License-Identifier: Apache-2.0
// Gmsh MSH 4.1, ASCII and binary, and 2.2 ASCII, after the format chapter of the Gmsh reference manual. In 4.1 an
// element belongs to an entity, and the entity to physical groups: each region, and each stroke, is an entity of its
// own with one group. The blocks of entities lose the order of the elements, which is kept as data of its own.
#include <algorithm>
#include <map>

#include "incise/geom/box.h"
#include "io/region_names.h"
#include "io/writer.h"

namespace incise {
inline namespace v0 {
namespace io {
namespace {

constexpr int kTriangleType = 2, kTetType = 4;
constexpr int kSurfaceDimension = 2, kVolumeDimension = 3;

// One code path for ASCII and binary: numbers of a row, and its end.
class MshText {
 public:
  explicit MshText(bool binary) : binary_(binary) {}

  MshText& text(std::string_view words) {
    out_ += words;
    return *this;
  }
  MshText& integer(std::int32_t value) { return binary_ ? bytes(value) : word(value); }
  MshText& size(std::size_t value) { return binary_ ? bytes(std::uint64_t{value}) : word(value); }
  MshText& real(double value) {
    if (binary_) return bytes(value);
    separate();
    append_double(out_, value);
    return *this;
  }
  MshText& point(const Vec3& p) { return real(p.x()).real(p.y()).real(p.z()); }
  MshText& end_row() {
    if (!binary_) out_ += '\n';
    return *this;
  }
  void begin_section(std::string_view name) { text("$").text(name).text("\n"); }
  void end_section(std::string_view name) { text(binary_ ? "\n$End" : "$End").text(name).text("\n"); }

  [[nodiscard]] bool is_binary() const { return binary_; }
  std::string take() { return std::move(out_); }

 private:
  template <class Int>
  MshText& word(Int value) {
    separate();
    append_int(out_, static_cast<std::int64_t>(value));
    return *this;
  }
  template <class T>
  MshText& bytes(T value) {
    append_bytes(out_, value);
    return *this;
  }
  void separate() {
    if (!out_.empty() && out_.back() != '\n') out_ += ' ';
  }

  bool binary_;
  std::string out_;
};

// $ElementData or $NodeData with one value for every element or node, in the order of the file: readers such as meshio
// want no fewer, and no other order.
void add_data(MshText& out, std::string_view section, std::string_view name, const Labels& values) {
  out.begin_section(section);
  const std::string count = std::to_string(values.size());
  out.text("1\n\"").text(name).text("\"\n1\n0\n3\n0\n1\n").text(count).text("\n");
  for (std::size_t i = 0; i < values.size(); ++i) {
    out.integer(static_cast<std::int32_t>(i + 1)).real(values[i]).end_row();
  }
  out.end_section(section);
}

// Elements, tets before triangles, in the order of the file; empty where that is rising.
using Order = std::vector<std::size_t>;

Labels in_order(const Labels& values, const Order& order) {
  if (order.empty()) return values;
  Labels ordered(values.size());
  for (std::size_t row = 0; row < values.size(); ++row) ordered[row] = values[order[row]];
  return ordered;
}

void add_all_data(MshText& out, const MeshData& data, bool with_regions, const Order& order = {}) {
  const auto add_cells = [&](std::string_view name, const Labels& of_tets, const Labels& of_triangles) {
    if (of_tets.empty() && of_triangles.empty()) return;
    add_data(out, "ElementData", name, in_order(cell_array(data, of_tets, of_triangles), order));
  };
  if (with_regions) add_cells("region", data.soup.regions, {});
  add_cells("piece", data.piece, {});
  if (has_strokes(data)) add_cells("stroke", {}, data.triangle_stroke);
  for (const NamedLabels& array : point_arrays(data)) add_data(out, "NodeData", array.name, array.values);
}

void add_names_22(MshText& out, const RegionNames& names) {
  std::string lines;
  std::size_t count = 0;
  for (const auto& [region, name] : names) {
    if (region <= 0) continue;
    ++count;
    lines +=
        std::to_string(kVolumeDimension) + " " + std::to_string(region) + " \"" + written_name(names, region) + "\"\n";
  }
  if (count == 0) return;
  out.text("$PhysicalNames\n").text(std::to_string(count)).text("\n").text(lines).text("$EndPhysicalNames\n");
}

std::string write_msh_22(const MeshData& data) {
  MshText out(false);
  const auto& soup = data.soup;
  out.text("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n");
  add_names_22(out, data.region_names);
  out.text("$Nodes\n").size(soup.points.size()).end_row();
  for (std::size_t i = 0; i < soup.points.size(); ++i) out.size(i + 1).point(soup.points[i]).end_row();
  out.text("$EndNodes\n$Elements\n").size(soup.tets.size() + data.triangles.size()).end_row();
  const auto add = [&out](std::size_t number, int type, std::int32_t physical, const auto& vertices) {
    out.size(number).integer(type).integer(2).integer(physical).integer(std::max(physical, 1));
    for (const std::uint32_t v : vertices) out.size(v + std::size_t{1});
    out.end_row();
  };
  for (std::size_t i = 0; i < soup.tets.size(); ++i) add(i + 1, kTetType, label(soup.regions, i), soup.tets[i]);
  for (std::size_t i = 0; i < data.triangles.size(); ++i) {
    add(soup.tets.size() + i + 1, kTriangleType, label(data.triangle_stroke, i), data.triangles[i]);
  }
  out.text("$EndElements\n");
  add_all_data(out, data, true);
  return out.take();
}

// The elements of one label, which are an entity of Gmsh.
struct Entity {
  std::vector<std::size_t> elements;
  Box box;
};

template <std::size_t N>
std::map<std::int32_t, Entity> entities_of(const std::vector<std::array<std::uint32_t, N>>& elements,
                                           const Labels& labels, const std::vector<Vec3>& points) {
  std::map<std::int32_t, Entity> entities;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    Entity& entity = entities[label(labels, i)];
    entity.elements.push_back(i);
    for (const std::uint32_t v : elements[i]) entity.box.extend(points[v]);
  }
  return entities;
}

class Msh41Writer {
 public:
  Msh41Writer(const MeshData& data, bool binary)
      : data_(data),
        out_(binary),
        surfaces_(entities_of(data.triangles, data.triangle_stroke, data.soup.points)),
        volumes_(entities_of(data.soup.tets, data.soup.regions, data.soup.points)),
        has_groups_(has_label(surfaces_) || has_label(volumes_)) {}

  std::string run() {
    add_format();
    add_names();
    add_entities();
    add_nodes();
    add_elements();
    add_order();
    add_all_data(out_, data_, false, order_);
    return out_.take();
  }

 private:
  using Entities = std::map<std::int32_t, Entity>;

  static bool has_label(const Entities& entities) {
    return entities.size() > 1 || (entities.size() == 1 && entities.begin()->first != 0);
  }

  void add_format() {
    out_.begin_section("MeshFormat");
    out_.text(out_.is_binary() ? "4.1 1 8\n" : "4.1 0 8\n");
    if (out_.is_binary()) out_.integer(1);
    out_.end_section("MeshFormat");
  }

  // Names for groups of positive labels: Gmsh takes the sign for an orientation.
  void add_names() {
    std::string lines;
    std::size_t count = 0;
    const auto add = [&](int dimension, const Entities& entities, const auto& name_of) {
      for (const auto& [label, entity] : entities) {
        if (label <= 0) continue;
        ++count;
        lines += std::to_string(dimension) + " " + std::to_string(label) + " \"" + name_of(label) + "\"\n";
      }
    };
    const std::string face = has_strokes(data_) ? "stroke_" : "face_";
    add(kSurfaceDimension, surfaces_, [&](std::int32_t label) { return face + std::to_string(label); });
    add(kVolumeDimension, volumes_, [&](std::int32_t label) { return written_name(data_.region_names, label); });
    if (count == 0) return;
    out_.text("$PhysicalNames\n").text(std::to_string(count)).text("\n").text(lines).text("$EndPhysicalNames\n");
  }

  // Either every entity has a physical group or none: meshio reads no other files.
  void add_entities() {
    out_.begin_section("Entities");
    out_.size(0).size(0).size(surfaces_.size()).size(volumes_.size()).end_row();
    for (const Entities* entities : {&surfaces_, &volumes_}) {
      std::int32_t tag = 0;
      for (const auto& [label, entity] : *entities) {
        out_.integer(++tag).point(entity.box.lo).point(entity.box.hi).size(has_groups_ ? 1 : 0);
        if (has_groups_) out_.integer(label);
        out_.size(0).end_row();  // no entities that bound it
      }
    }
    out_.end_section("Entities");
  }

  void add_nodes() {
    const auto& points = data_.soup.points;
    out_.begin_section("Nodes");
    out_.size(1).size(points.size()).size(1).size(points.size()).end_row();
    out_.integer(kVolumeDimension).integer(1).integer(0).size(points.size()).end_row();
    for (std::size_t i = 0; i < points.size(); ++i) out_.size(i + 1).end_row();
    for (const Vec3& p : points) out_.point(p).end_row();
    out_.end_section("Nodes");
  }

  template <std::size_t N>
  void add_blocks(const Entities& entities, int dimension, int type, std::size_t first,
                  const std::vector<std::array<std::uint32_t, N>>& elements) {
    std::int32_t tag = 0;
    for (const auto& [label, entity] : entities) {
      out_.integer(dimension).integer(++tag).integer(type).size(entity.elements.size()).end_row();
      for (const std::size_t i : entity.elements) {
        order_.push_back(first + i);
        out_.size(order_.size());
        for (const std::uint32_t v : elements[i]) out_.size(v + std::size_t{1});
        out_.end_row();
      }
    }
  }

  void add_elements() {
    const std::size_t n_tets = data_.soup.tets.size(), n = n_tets + data_.triangles.size();
    order_.reserve(n);
    out_.begin_section("Elements");
    out_.size(surfaces_.size() + volumes_.size()).size(n).size(1).size(n).end_row();
    add_blocks(volumes_, kVolumeDimension, kTetType, 0, data_.soup.tets);
    add_blocks(surfaces_, kSurfaceDimension, kTriangleType, n_tets, data_.triangles);
    out_.end_section("Elements");
  }

  void add_order() {
    if (std::is_sorted(order_.begin(), order_.end())) return;
    add_data(out_, "ElementData", kMshOrder, Labels(order_.begin(), order_.end()));
  }

  const MeshData& data_;
  MshText out_;
  Entities surfaces_, volumes_;
  bool has_groups_;
  Order order_;
};

}  // namespace

std::string write_msh(const MeshData& data, MshVariant variant) {
  if (variant == MshVariant::k22) return write_msh_22(data);
  return Msh41Writer(data, variant == MshVariant::k41Binary).run();
}

}  // namespace io
}  // namespace v0
}  // namespace incise
