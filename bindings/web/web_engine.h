// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "incise/engine/engine.h"
#include "values.h"

namespace incise_web {

/// `Engine` for JavaScript: cuts a mesh at rest. Calls that fail return an `Error`, see `to_error`.
class WebEngine {
 public:
  WebEngine(incise::Engine engine, std::vector<std::uint32_t> file_vertex)
      : engine_(std::move(engine)), file_vertex_(std::move(file_vertex)) {}

  /// A mesh file of any format that `io` reads; the name is for messages and, where the bytes do not tell, the format.
  static val open(const val& bytes, const std::string& name);

  /// Cuts by all strokes of a blade file. Returns what was cut.
  val cut(const std::string& blade);
  val cut_plane(const val& normal, double offset);
  val improve();
  bool undo() { return engine_.undo(); }
  bool redo() { return engine_.redo(); }
  /// The file that `extension` names, as bytes.
  [[nodiscard]] val write(const std::string& extension) const;
  /// Live points and tets, compact.
  [[nodiscard]] val points() const;
  [[nodiscard]] val tets() const;
  [[nodiscard]] val quality() const;
  [[nodiscard]] unsigned tet_count() const { return static_cast<unsigned>(engine_.mesh().tet_count()); }
  [[nodiscard]] unsigned vertex_count() const { return static_cast<unsigned>(engine_.mesh().vertex_count()); }
  [[nodiscard]] unsigned pieces() const;
  [[nodiscard]] std::string hash() const { return to_hex(engine_.mesh().hash()); }

 private:
  incise::Engine engine_;
  std::vector<std::uint32_t> file_vertex_;
};

}  // namespace incise_web
