// SPDX-License-Identifier: Apache-2.0
// Engines: made, read, written, freed.
#include <algorithm>
#include <cstdint>
#include <memory>

#include "handles.h"
#include "incise/geom/predicates.h"
#include "incise/io/mesh_export.h"
#include "incise/io/mesh_file.h"
#include "incise/io/mesh_loader.h"
#include "incise/io/surface_file.h"
#include "incise/mesh/shapes.h"

namespace incise::c {
namespace {

incise_status make(TetMesh mesh, const incise_engine_options* options, std::unique_ptr<incise_engine> handle,
                   incise_engine** out) {
  Result<EngineOptions> taken = engine_options(options);
  if (!taken.ok()) return fail(taken.error());
  Result<Engine> engine = Engine::create(std::move(mesh), std::move(taken).value());
  if (!engine.ok()) return fail(engine.error());
  handle->own.emplace(std::move(engine).value());
  handle->engine = &*handle->own;
  *out = handle.release();
  return INCISE_OK;
}

incise_status make(Result<TetMesh> mesh, const incise_engine_options* options, incise_engine** out) {
  if (!mesh.ok()) return fail(mesh.error());
  return make(std::move(mesh).value(), options, std::make_unique<incise_engine>(), out);
}

incise_status make(Result<io::LoadedMesh> loaded, const incise_engine_options* options, incise_engine** out) {
  if (!loaded.ok()) return fail(loaded.error());
  auto handle = std::make_unique<incise_engine>();
  handle->notes = std::move(loaded->source.notes);
  handle->file_vertex = std::move(loaded->file_vertex);
  handle->region_names = std::move(loaded->region_names);
  return make(std::move(loaded->mesh), options, std::move(handle), out);
}

/// Creation: an engine goes to `out`, which is null until then.
template <class Call>
incise_status create(incise_engine** out, const Call& call) {
  if (out == nullptr) return refuse("there is no place for the engine: the last argument is null");
  *out = nullptr;
  return guarded(call);
}

Result<TetMesh> box_of(const double* low, const double* high, const std::uint32_t* cells) {
  if (low == nullptr || high == nullptr || cells == nullptr) {
    return Error{ErrorCode::kBadArgument, "a corner of the box or its cells are null", {}};
  }
  TetSoup soup = kuhn_box(to_vec(low), to_vec(high), {cells[0], cells[1], cells[2]});
  if (soup.tets.empty()) {
    return Error{
        ErrorCode::kBadArgument, "a box needs finite corners, low < high on every axis, and 1 to 2^28 / 6 cells", {}};
  }
  const auto& p = soup.points;
  const bool is_wide = std::all_of(soup.tets.begin(), soup.tets.end(),
                                   [&](const auto& t) { return orient3d(p[t[0]], p[t[1]], p[t[2]], p[t[3]]) > 0; });
  if (!is_wide) {
    return Error{
        ErrorCode::kBadArgument, "the box's cells are too small for so far from the origin: move it there", {}};
  }
  return TetMesh::build(std::move(soup));
}

io::MeshData data_of(const incise_engine& handle, std::int32_t pose) {
  const TetMesh& mesh = handle.engine->mesh();
  return io::to_mesh_data(mesh, find_components(mesh), handle.file_vertex,
                          pose == INCISE_AT_REST ? io::MeshPose::kAtRest : io::MeshPose::kAsItStands);
}

incise_status check_pose(std::int32_t pose) {
  if (pose == INCISE_AT_REST || pose == INCISE_AS_IT_STANDS) return INCISE_OK;
  return refuse("pose is " + std::to_string(pose) + "; 0 is at rest, 1 as it stands");
}

std::string lines_of(const std::vector<std::string>& notes) {
  std::string lines;
  for (const std::string& note : notes) lines += note + "\n";
  return lines;
}

/// A name of a file, not null.
incise_status check_path(const char* path) {
  return path == nullptr ? refuse("the name of the file is null") : INCISE_OK;
}

}  // namespace
}  // namespace incise::c

using namespace incise;

incise_status incise_engine_create(const incise_mesh_arrays* mesh, const incise_engine_options* options,
                                   incise_engine** engine) {
  return c::create(engine, [&]() -> incise_status {
    auto handle = std::make_unique<incise_engine>();
    Result<TetMesh> made = c::mesh_of(mesh, handle->notes);
    return made.ok() ? c::make(std::move(made).value(), options, std::move(handle), engine) : c::fail(made.error());
  });
}

incise_status incise_engine_create_box(const double* low, const double* high, const uint32_t* cells,
                                       const incise_engine_options* options, incise_engine** engine) {
  return c::create(engine, [&] { return c::make(c::box_of(low, high, cells), options, engine); });
}

incise_status incise_engine_read(const char* path, const incise_engine_options* options, incise_engine** engine) {
  return c::create(engine, [&]() -> incise_status {
    if (const incise_status bad = c::check_path(path)) return bad;
    return c::make(io::load_mesh(path), options, engine);
  });
}

incise_status incise_engine_read_bytes(const void* bytes, uint64_t n_bytes, const char* name,
                                       const incise_engine_options* options, incise_engine** engine) {
  return c::create(engine, [&]() -> incise_status {
    if (bytes == nullptr && n_bytes > 0) return c::refuse("the bytes of the file are null");
    if (n_bytes > PTRDIFF_MAX) return c::refuse("the number of bytes is above what memory can hold; was it negative?");
    const std::string file = name == nullptr ? "mesh" : name;
    Result<io::MeshFile> read = io::read_mesh_bytes({static_cast<const char*>(bytes), n_bytes}, file);
    if (!read.ok()) return c::fail(read.error());
    return c::make(io::build_mesh(std::move(read).value(), file), options, engine);
  });
}

incise_status incise_engine_free(incise_engine* engine) {
  if (engine == nullptr) return INCISE_OK;
  if (!engine->own) return c::refuse("this engine belongs to a simulation: free that");
  if (!engine->turn->begin(false)) return c::busy();
  delete engine;
  return INCISE_OK;
}

incise_status incise_engine_notes(const incise_engine* engine, char* text, uint64_t room, uint64_t* count) {
  return c::look(engine, [&](const Engine&) -> incise_status {
    return c::give_text(c::lines_of(engine->notes), text, room, count);
  });
}

incise_status incise_engine_write(const incise_engine* engine, const char* path, int32_t pose) {
  if (const incise_status bad = c::check_path(path)) return bad;
  if (const incise_status bad = c::check_pose(pose)) return bad;
  return c::look(engine, [&](const Engine&) { return c::finish(io::write_mesh(path, c::data_of(*engine, pose))); });
}

incise_status incise_engine_write_bytes(const incise_engine* engine, const char* extension, int32_t pose, void* bytes,
                                        uint64_t room, uint64_t* count) {
  if (extension == nullptr) return c::refuse("the extension is null; give for instance \".msh\"");
  if (const incise_status bad = c::check_pose(pose)) return bad;
  return c::look(engine, [&](const Engine&) -> incise_status {
    const Result<std::string> file = io::write_mesh_bytes(extension, c::data_of(*engine, pose));
    if (!file.ok()) return c::fail(file.error());
    return c::give_list(*file, static_cast<char*>(bytes), room, count, [](char byte) { return byte; });
  });
}

incise_status incise_engine_write_surface(const incise_engine* engine, const char* path) {
  if (const incise_status bad = c::check_path(path)) return bad;
  return c::look(
      engine, [&](const Engine& looked) { return c::finish(io::write_surface(path, io::to_surface(looked.mesh()))); });
}
