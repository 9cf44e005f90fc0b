// SPDX-License-Identifier: Apache-2.0
// The mesh of an engine, to look at: counts, arrays by slot, boundary, pieces, quality, validity.
#include <algorithm>
#include <functional>
#include <span>

#include "handles.h"
#include "incise/mesh/components.h"
#include "incise/mesh/quality_stats.h"
#include "incise/mesh/validate.h"

namespace incise::c {
namespace {

template <class T>
incise_view rows_of(std::span<const T> array) {
  incise_view view{};
  view.stride = sizeof(T);
  view.rows = array.size();
  view.data = array.data();
  return view;
}

Result<incise_view> view_of(const MeshArrays& arrays, std::int32_t which) {
  switch (which) {
    case INCISE_TETS:
      return rows_of(arrays.tets);
    case INCISE_REST:
      return rows_of(arrays.rest);
    case INCISE_CURRENT:
      return rows_of(arrays.current);
    case INCISE_LINKS:
      return rows_of(arrays.links);
    case INCISE_REGIONS:
      return rows_of(arrays.regions);
    case INCISE_TET_GENERATIONS:
      return rows_of(arrays.tet_generations);
    case INCISE_VERTEX_GENERATIONS:
      return rows_of(arrays.vertex_generations);
    case INCISE_SHAPES:
      return rows_of(arrays.shapes);
    case INCISE_ORIGINS:
      return rows_of(arrays.origins);
    default:
      break;
  }
  return Error{ErrorCode::kBadArgument,
               "there is no array " + std::to_string(which) + "; see INCISE_TETS to INCISE_ORIGINS",
               {}};
}

/// Where the boundary goes, as far as there is room.
struct SurfaceBuffers {
  std::uint32_t *triangles, *tags, *sides;
  std::uint64_t room, count = 0;

  void add(const TetMesh& mesh, Side side) {
    if (count < room) {
      if (triangles != nullptr) {
        std::uint32_t* corner = triangles + 3 * count;
        for (const VertexId v : mesh.vertices(side)) *corner++ = v.value;
      }
      if (tags != nullptr) tags[count] = mesh.link(side).tag();
      if (sides != nullptr) sides[count] = side.value;
    }
    ++count;
  }
};

/// Between counting and this call another thread may have had its turn.
incise_status check_room(const TetMesh& mesh, const incise_compact& out) {
  const auto fits = [](std::uint64_t room, std::uint64_t count) { return room == 0 || count <= room; };
  if (fits(out.vertex_room, mesh.vertex_count()) && fits(out.tet_room, mesh.tet_count())) return INCISE_OK;
  return refuse("the arrays have room for " + std::to_string(out.vertex_room) + " vertices and " +
                std::to_string(out.tet_room) + " tets; the mesh has " + std::to_string(mesh.vertex_count()) + " and " +
                std::to_string(mesh.tet_count()) + ": count them again");
}

void compact_vertices(const TetMesh& mesh, const incise_compact& out, std::vector<std::uint32_t>& number) {
  std::uint32_t n = 0;
  mesh.for_each_vertex([&](VertexId v) {
    if (out.points != nullptr)
      from_vec(out.pose == INCISE_AT_REST ? mesh.rest(v) : mesh.current(v), out.points + 3 * n);
    if (out.vertex_slots != nullptr) out.vertex_slots[n] = v.value;
    number[v.value] = n++;
  });
}

void compact_tets(const TetMesh& mesh, const incise_compact& out, const std::vector<std::uint32_t>& number) {
  const Components pieces = out.pieces == nullptr ? Components() : find_components(mesh);
  std::size_t n = 0;
  mesh.for_each_tet([&](TetId t) {
    if (out.tets != nullptr) {
      for (unsigned k = 0; k < 4; ++k) out.tets[4 * n + k] = number[mesh.vertices(t)[k].value];
    }
    if (out.regions != nullptr) out.regions[n] = mesh.region(t);
    if (out.pieces != nullptr) out.pieces[n] = pieces.label[t.value];
    if (out.tet_slots != nullptr) out.tet_slots[n] = t.value;
    ++n;
  });
}

incise_quality to_c(const QualityStats& stats) {
  incise_quality c{};
  c.tets = stats.tets;
  c.flat_tets = stats.flat_tets;
  c.lr_min = stats.lr_min;
  c.lr_mean = stats.lr_mean;
  c.lr_p99 = stats.lr_p99;
  c.lr_max = stats.lr_max;
  c.lr_over_200_pct = stats.lr_over_200_pct;
  c.dihedral_min_deg = stats.dihedral_min_deg;
  c.dihedral_max_deg = stats.dihedral_max_deg;
  return c;
}

incise_violation to_c(const Violation& violation) {
  return {{violation.ids[0], violation.ids[1]}, static_cast<std::int32_t>(violation.kind), 0};
}

}  // namespace
}  // namespace incise::c

using namespace incise;

incise_status incise_engine_counts(const incise_engine* engine, incise_counts* counts) {
  if (counts == nullptr) return c::refuse("there is no place for the counts: the last argument is null");
  if (const incise_status bad = c::check_out(counts, "incise_counts")) return bad;
  return c::look(engine, [&](const Engine& looked) {
    const TetMesh& mesh = looked.mesh();
    incise_counts all{};
    all.strokes = looked.stroke_count();
    all.vertices = mesh.vertex_count();
    all.tets = mesh.tet_count();
    all.vertex_slots = mesh.vertex_slots();
    all.tet_slots = mesh.tet_slots();
    all.memory_bytes = mesh.memory_bytes();
    all.version = engine->version;
    all.next_stroke = looked.next_stroke();
    all.is_in_stroke = looked.is_in_stroke() ? 1 : 0;
    all.has_maintenance = looked.has_maintenance() ? 1 : 0;
    return c::give(all, counts);
  });
}

incise_status incise_engine_view(const incise_engine* engine, int32_t which, incise_view* view) {
  if (view == nullptr) return c::refuse("there is no place for the view: the last argument is null");
  if (const incise_status bad = c::check_out(view, "incise_view")) return bad;
  return c::look(engine, [&](const Engine& looked) -> incise_status {
    Result<incise_view> rows = c::view_of(looked.mesh().arrays(), which);
    if (!rows.ok()) return c::fail(rows.error());
    rows->version = engine->version;
    rows->is_stable = looked.mesh().has_stable_addresses() ? 1 : 0;
    return c::give(*rows, view);
  });
}

incise_status incise_engine_surface(const incise_engine* engine, uint32_t* triangles, uint32_t* tags, uint32_t* sides,
                                    uint64_t room, uint64_t* count) {
  return c::look(engine, [&](const Engine& looked) {
    const TetMesh& mesh = looked.mesh();
    c::SurfaceBuffers buffers{triangles, tags, sides, room};
    mesh.for_each_tet([&](TetId tet) {
      for (unsigned s = 0; s < 4; ++s) {
        if (mesh.links(tet)[s].is_boundary()) buffers.add(mesh, Side(tet, s));
      }
    });
    if (count != nullptr) *count = buffers.count;
    return INCISE_OK;
  });
}

incise_status incise_engine_compact(const incise_engine* engine, incise_compact* arrays) {
  if (arrays == nullptr) return c::refuse("the struct of arrays is null");
  incise_compact all{};
  if (const incise_status bad = c::take(arrays, all, "incise_compact")) return bad;
  return c::look(engine, [&](const Engine& looked) -> incise_status {
    const TetMesh& mesh = looked.mesh();
    if (const incise_status bad = c::check_room(mesh, all)) return bad;
    std::vector<std::uint32_t> number(mesh.vertex_slots(), kInvalidIndex);
    c::compact_vertices(mesh, all, number);
    c::compact_tets(mesh, all, number);
    all.vertices = mesh.vertex_count();
    all.tet_count = mesh.tet_count();
    return c::give(all, arrays);
  });
}

incise_status incise_engine_pieces(const incise_engine* engine, uint32_t* labels, uint64_t label_room, uint64_t* tets,
                                   double* volumes, uint64_t piece_room, uint64_t* count) {
  return c::look(engine, [&](const Engine& looked) {
    const Components pieces = find_components(looked.mesh());
    if (count != nullptr) *count = pieces.count();
    const auto copy = [](const auto& from, auto* to, std::uint64_t room) {
      if (to != nullptr) std::copy_n(from.begin(), std::min<std::uint64_t>(room, from.size()), to);
    };
    copy(pieces.label, labels, label_room);
    copy(pieces.tet_count, tets, piece_room);
    copy(pieces.volume, volumes, piece_room);
    return INCISE_OK;
  });
}

incise_status incise_engine_hash(const incise_engine* engine, uint64_t* hash) {
  if (hash == nullptr) return c::refuse("there is no place for the hash: the last argument is null");
  return c::look(engine, [&](const Engine& looked) {
    *hash = looked.mesh().hash();
    return INCISE_OK;
  });
}

incise_status incise_engine_quality(const incise_engine* engine, int32_t only_at_cuts, incise_quality* quality) {
  if (quality == nullptr) return c::refuse("there is no place for the quality: the last argument is null");
  if (const incise_status bad = c::check_out(quality, "incise_quality")) return bad;
  return c::look(engine, [&](const Engine& looked) {
    const TetMesh& mesh = looked.mesh();
    std::function<bool(TetId)> is_counted;
    if (only_at_cuts != 0) is_counted = [&mesh](TetId tet) { return touches_cut(mesh, tet); };
    return c::give(c::to_c(measure_quality(mesh, is_counted)), quality);
  });
}

incise_status incise_engine_validate(const incise_engine* engine, int32_t level, incise_validity* validity,
                                     incise_violation* violations, uint64_t room, uint64_t* count) {
  if (level < INCISE_VALIDATE_COUNTS || level > INCISE_VALIDATE_GEOMETRY) {
    return c::refuse("level is " + std::to_string(level) + "; 0 counts, 1 topology, 2 geometry");
  }
  if (const incise_status bad = c::check_out(validity, "incise_validity")) return bad;
  return c::look(engine, [&](const Engine& looked) -> incise_status {
    ValidateOptions options;
    options.max_listed = std::max<std::size_t>(options.max_listed, room);
    const ValidityReport report = validate(looked.mesh(), static_cast<ValidateLevel>(level), options);
    incise_validity all{};
    all.ok = report.ok ? 1 : 0;
    static_assert(INCISE_VIOLATION_KINDS == kViolationKinds && sizeof all.counts == sizeof report.counts);
    std::copy(report.counts.begin(), report.counts.end(), all.counts);
    all.volume = report.volume;
    c::give(all, validity);
    return c::give_list(report.first, violations, room, count, [](const Violation& v) { return c::to_c(v); });
  });
}

const char* incise_violation_name(int32_t kind) {
  if (kind < 0 || kind >= INCISE_VIOLATION_KINDS) return nullptr;
  return name_of(static_cast<ViolationKind>(kind)).data();  // of literals, which end in 0
}
