// SPDX-License-Identifier: Apache-2.0
// Remembers the first program, and the first key of each mesh, with the line that named them: whoever differs is told
// of both.
#include "app/jobs/batch_origins.h"

#include "app/text/json_write.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace {

/// The mesh that an item begins with, for messages.
std::string input_name(const BatchItem& item) {
  const std::string& file = item.mesh.empty() && item.scene ? item.scene->model.file : item.mesh;
  return file.empty() ? "the model of the scene" : "the mesh \"" + file + "\"";
}

}  // namespace

Status BatchOrigins::add_program(const std::string& program, const std::string& where) {
  if (program_.first.empty()) program_ = {program, where};
  if (program_.first == program) return {};
  return Error{ErrorCode::kBadFile,
               where + ": was made by " + program + ", and " + program_.second + " by " + program_.first +
                   "; results of two versions may differ: use one of them for the whole batch, in a folder of its own",
               {}};
}

Status BatchOrigins::add_input(std::uint64_t item, std::uint64_t key, const std::string& where) {
  const BatchItem& one = plan_.items[static_cast<std::size_t>(item)];
  const auto& [first_key, first] = inputs_.try_emplace(one.source, key, where).first->second;
  if (first_key == key) return {};
  return Error{ErrorCode::kBadFile,
               where + ": " + input_name(one) + " of item \"" + one.name + "\" has the key " + hash_text(key) +
                   ", and that of " + first + " " + hash_text(first_key) +
                   ": they are two meshes; use one of them for the whole batch, in a folder of its own",
               {}};
}

Status BatchOrigins::add(const BatchLine& line) {
  if (Status status = add_program(line.program, line.where); !status.ok()) return status;
  return line.has_failed ? Status() : add_input(line.item, line.input_key, line.where);
}

}  // namespace app
}  // namespace v0
}  // namespace incise
