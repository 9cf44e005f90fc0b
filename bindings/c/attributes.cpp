// SPDX-License-Identifier: Apache-2.0
// Values that follow the mesh of an engine.
#include "incise/mesh/attributes.h"

#include <memory>

#include "handles.h"

// NOLINTBEGIN(readability-identifier-naming): a C name
struct incise_attributes {
  incise::Attributes attributes;
  incise::c::Identity engine;
  mutable incise::c::Turn turn;

  explicit incise_attributes(const incise_engine& of)
      : attributes(of.engine->mesh(), of.engine->journal()), engine(of.identity) {}
};
// NOLINTEND(readability-identifier-naming)

namespace incise::c {
namespace {

/// Changes attributes in the thread's turn.
template <class Call>
incise_status change_values(incise_attributes* handle, const Call& call) {
  if (handle == nullptr) return refuse("the attributes are null");
  return in_turn(handle->turn, false, [&] { return call(handle->attributes); });
}

/// The same beside an engine that is looked at; callbacks may look at it too.
template <class Call>
incise_status change_beside(incise_attributes* handle, const incise_engine* engine, const Call& call) {
  return change_values(handle, [&](Attributes& attributes) {
    return look_as(handle->engine, engine, [&](const Engine& looked) {
      engine->turn->lets_look();
      return call(attributes, looked);
    });
  });
}

Result<AttributeSpec> spec_of(const incise_attribute_spec* given) {
  incise_attribute_spec c{};
  if (take(given, c, "incise_attribute_spec") != INCISE_OK) {
    return Error{ErrorCode::kBadArgument, incise_last_error(), {}};
  }
  if (c.domain < INCISE_AT_VERTICES || c.domain > INCISE_AT_TETS || c.transfer < INCISE_INTERPOLATE ||
      c.transfer > INCISE_RECOMPUTE) {
    return Error{ErrorCode::kBadArgument, "domain is 0 (vertices) or 1 (tets), transfer 0 to 3", {}};
  }
  AttributeSpec spec;
  if (c.name != nullptr) spec.name = c.name;
  spec.domain = c.domain == INCISE_AT_VERTICES ? Domain::kVertex : Domain::kTet;
  spec.width = c.width;
  spec.transfer = static_cast<Transfer>(c.transfer);
  if (c.initial != nullptr && c.width <= 64) spec.initial.assign(c.initial, c.initial + c.width);
  if (c.recompute != nullptr) {
    spec.recompute = [recompute = c.recompute, user = c.user](const TetMesh&, std::uint32_t slot,
                                                              std::span<double> value) {
      recompute(user, slot, value.data(), static_cast<std::uint32_t>(value.size()));
    };
  }
  return spec;
}

}  // namespace
}  // namespace incise::c

using namespace incise;

incise_status incise_attributes_create(const incise_engine* engine, incise_attributes** attributes) {
  if (attributes == nullptr) return c::refuse("there is no place for the attributes: the last argument is null");
  *attributes = nullptr;
  return c::look(engine, [&](const Engine&) {
    *attributes = std::make_unique<incise_attributes>(*engine).release();
    return INCISE_OK;
  });
}

incise_status incise_attributes_add(incise_attributes* attributes, const incise_engine* engine,
                                    const incise_attribute_spec* spec, uint32_t* id) {
  if (spec == nullptr || id == nullptr)
    return c::refuse("the attribute's description, or the place for its id, is null");
  return c::change_beside(attributes, engine, [&](Attributes& changed, const Engine& looked) -> incise_status {
    Result<AttributeSpec> taken = c::spec_of(spec);
    if (!taken.ok()) return c::fail(taken.error());
    const Result<AttributeId> added = changed.add(looked.mesh(), std::move(taken).value());
    if (!added.ok()) return c::fail(added.error());
    *id = added->value;
    return INCISE_OK;
  });
}

incise_status incise_attributes_find(const incise_attributes* attributes, const char* name, uint32_t* id) {
  if (attributes == nullptr || name == nullptr || id == nullptr) return c::refuse("an argument is null");
  return c::in_turn(attributes->turn, true, [&] {
    *id = attributes->attributes.find(name).value;
    return INCISE_OK;
  });
}

incise_status incise_attributes_follow(incise_attributes* attributes, const incise_engine* engine) {
  return c::change_beside(attributes, engine, [](Attributes& changed, const Engine& looked) {
    return c::finish(changed.follow(looked.journal(), looked.mesh()));
  });
}

incise_status incise_attributes_values(incise_attributes* attributes, uint32_t id, double** values,
                                       uint64_t* n_values) {
  if (values == nullptr || n_values == nullptr) return c::refuse("there is no place for the values or their number");
  return c::change_values(attributes, [&](Attributes& changed) {
    if (id >= changed.size()) return c::refuse("there is no attribute " + std::to_string(id));
    const std::span<double> all = changed.values(AttributeId(id));
    *values = all.data();
    *n_values = all.size();
    return INCISE_OK;
  });
}

incise_status incise_attributes_free(incise_attributes* attributes) {
  if (attributes == nullptr) return INCISE_OK;
  if (!attributes->turn.begin(false)) return c::busy();
  delete attributes;
  return INCISE_OK;
}
