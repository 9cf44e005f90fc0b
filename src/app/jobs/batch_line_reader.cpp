// SPDX-License-Identifier: Apache-2.0
// Tables of fields and their types, against which a line is held. Lines that a full disk or an editor spoiled are told
// from results by them.
#include "app/jobs/batch_line_reader.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "app/jobs/batch_item.h"
#include "app/text/json_write.h"
#include "app/text/line_reader.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace {

using Kind = JsonValue::Kind;

constexpr std::size_t kMaxListedInLine = 16;  // pieces and strokes, in a line

enum class FieldType : std::uint8_t { kWhole, kFigure, kFlag, kText };

/// A field that an object must have. A figure is a number, or null where it is not finite.
struct Field {
  const char* key;
  FieldType type;
};
using Fields = std::vector<Field>;

const Fields& cut_fields() {
  static const Fields kFields = {{"valid", FieldType::kFlag},     {"strokes", FieldType::kWhole},
                                 {"missed", FieldType::kWhole},   {"vertices", FieldType::kWhole},
                                 {"tets", FieldType::kWhole},     {"pieces", FieldType::kWhole},
                                 {"cut_tets", FieldType::kWhole}, {"incision_faces", FieldType::kWhole}};
  return kFields;
}

const Fields& quality_fields() {
  static const Fields kFields = {{"tets", FieldType::kWhole},
                                 {"flat_tets", FieldType::kWhole},
                                 {"lr_min", FieldType::kFigure},
                                 {"lr_mean", FieldType::kFigure},
                                 {"lr_p99", FieldType::kFigure},
                                 {"lr_max", FieldType::kFigure},
                                 {"lr_over_200_pct", FieldType::kFigure},
                                 {"dihedral_min_deg", FieldType::kFigure},
                                 {"dihedral_max_deg", FieldType::kFigure}};
  return kFields;
}

const Fields& force_fields() {
  static const Fields kFields = {{"peak_force", FieldType::kFigure},     {"engaged_length", FieldType::kFigure},
                                 {"fracture_work", FieldType::kFigure},  {"friction_work", FieldType::kFigure},
                                 {"tool_work", FieldType::kFigure},      {"touching_frames", FieldType::kWhole},
                                 {"yielding_frames", FieldType::kWhole}, {"peak_hook_force", FieldType::kFigure}};
  return kFields;
}

bool has_type(RangeReader& read, const JsonValue& value, const std::string& path, FieldType type) {
  std::uint64_t whole = 0;
  double number = 0;
  bool flag = false;
  std::string text;
  switch (type) {
    case FieldType::kWhole:
      return read.whole(value, path, whole);
    case FieldType::kFigure:
      return value.kind == Kind::kNull || read.number(value, path, number);
    case FieldType::kFlag:
      return read.boolean(value, path, flag);
    case FieldType::kText:
      break;
  }
  return read.text(value, path, text);
}

/// Whether an object has all of the fields; others are not looked at.
bool has_fields(RangeReader& read, const JsonValue& object, const std::string& path, const Fields& fields) {
  for (const Field& field : fields) {
    const JsonValue* value = read.member(object, path, field.key);
    if (value == nullptr || !has_type(read, *value, under(path, field.key), field.type)) return false;
  }
  return true;
}

/// The same of a member, which has no other fields.
bool has_object(RangeReader& read, const JsonValue& root, const std::string& path, const char* key,
                const Fields& fields) {
  const JsonValue* object = read.member(root, path, key);
  std::vector<std::string_view> keys;
  for (const Field& field : fields) keys.emplace_back(field.key);
  const std::string place = under(path, key);
  return object != nullptr && read.is_object(*object, place, keys) && has_fields(read, *object, place, fields);
}

bool has_list(RangeReader& read, const JsonValue& root, const char* key, FieldType type) {
  const JsonValue* list = read.member(root, "", key);
  if (list == nullptr || !read.is_array(*list, key, 0, kMaxListedInLine)) return false;
  for (std::size_t i = 0; i < list->items.size(); ++i) {
    if (!has_type(read, list->items[i], at(key, i), type)) return false;
  }
  return true;
}

/// One volume for each of the first pieces.
bool has_volumes(RangeReader& read, const JsonValue& root) {
  if (!has_list(read, root, "volumes", FieldType::kFigure)) return false;
  const JsonValue& volumes = *root.find("volumes");
  const std::uint64_t wanted = std::min<std::uint64_t>(root.find("pieces")->whole, kMaxListedInLine);
  return volumes.items.size() == wanted ||
         read.fail(volumes, "volumes", "must have one entry for each piece, of the first 16");
}

/// Figures are null where no tet was measured, and there alone; none is below zero.
bool has_measures(RangeReader& read, const JsonValue& quality, const std::string& path) {
  const bool is_measured = quality.find("tets")->whole > quality.find("flat_tets")->whole;
  for (const Field& field : quality_fields()) {
    const JsonValue& value = *quality.find(field.key);
    const bool is_missing = value.kind == Kind::kNull && is_measured;
    if (is_missing || value.number < 0) return read.fail(value, under(path, field.key), "must be a number from 0 on");
  }
  return true;
}

bool has_quality(RangeReader& read, const JsonValue& root) {
  const JsonValue* quality = read.member(root, "", "quality");
  if (quality == nullptr || !read.is_object(*quality, "quality", {"before", "after", "incision"})) return false;
  for (const char* key : {"before", "after", "incision"}) {
    if (!has_object(read, *quality, "quality", key, quality_fields()) ||
        !has_measures(read, *quality->find(key), under("quality", key))) {
      return false;
    }
  }
  return true;
}

/// All fields that the line of an item may have.
std::vector<std::string_view> known_keys(const BatchPlan& plan, const BatchItem& item, bool has_failed) {
  std::vector<std::string_view> keys = {"item", "name", "key", "program"};
  if (!item.label.empty()) keys.emplace_back("label");
  if (has_failed) {
    keys.emplace_back("error");
    return keys;
  }
  for (const Field& field : cut_fields()) keys.emplace_back(field.key);
  for (const char* key : {"input", "hash", "kept_strokes", "volumes", "quality", "stroke_names"})
    keys.emplace_back(key);
  if (item.scene) keys.insert(keys.end(), {"state_hash", "forces"});
  if (plan.output.strokes) keys.emplace_back("strokes_file");
  if (!plan.output.format.empty()) keys.insert(keys.end(), {"file", "file_bytes", "file_hash"});
  return keys;
}

}  // namespace

bool BatchLineReader::run(const JsonValue& root, BatchLine& line) {
  if (root.kind != Kind::kObject) return read_.fail(root, "", "must be an object");
  if (!read_item(root, line) || !read_head(root, line)) return false;
  return line.has_failed ? read_failure(root) : read_figures(root, line);
}

bool BatchLineReader::read_item(const JsonValue& root, BatchLine& line) {
  const JsonValue* item = read_.member(root, "", "item");
  const JsonValue* key = item ? read_.member(root, "", "key") : nullptr;
  std::uint64_t found = 0;
  if (key == nullptr || !read_.whole(*item, "item", line.item) || !read_hash(*key, "key", found)) return false;
  const bool is_there = line.item < plan_.items.size();
  if (is_there) item_ = &plan_.items[static_cast<std::size_t>(line.item)];
  if (is_there && item_->key == found) return true;
  is_of_another_plan_ = true;
  const std::string here =
      is_there ? "key " + hash_text(item_->key) : "no such item among its " + std::to_string(plan_.items.size());
  return read_.fail(root, "item " + std::to_string(line.item),
                    "is of another plan, or of this plan before it was changed: it has the key " + hash_text(found) +
                        ", this plan has " + here + "; use another folder, or that plan");
}

bool BatchLineReader::read_head(const JsonValue& root, BatchLine& line) {
  const JsonValue* program = read_.member(root, "", "program");
  if (program == nullptr || !read_.text(*program, "program", line.program)) return false;
  line.has_failed = root.find("error") != nullptr;
  is_own_ = line.program == kBatchProgram;
  return !is_own_ || (read_.is_object(root, "", known_keys(plan_, *item_, line.has_failed)) && read_words(root));
}

/// Its name and label, as the plan has them.
bool BatchLineReader::read_words(const JsonValue& root) {
  for (const auto& [key, wanted] : {std::pair<const char*, const std::string&>("name", item_->name),
                                    std::pair<const char*, const std::string&>("label", item_->label)}) {
    if (wanted.empty()) continue;
    const JsonValue* value = read_.member(root, "", key);
    std::string text;
    if (value == nullptr || !read_.text(*value, key, text)) return false;
    if (text != wanted) return read_.fail(*value, key, "is \"" + text + "\"; the plan has \"" + wanted + "\"");
  }
  return true;
}

bool BatchLineReader::read_failure(const JsonValue& root) {
  if (!is_own_) return true;
  if (!has_object(read_, root, "", "error", {{"code", FieldType::kText}, {"message", FieldType::kText}})) return false;
  const JsonValue& code = *root.find("error")->find("code");
  for (int i = 0; i <= static_cast<int>(ErrorCode::kInternal); ++i) {
    if (code.text == name_of(static_cast<ErrorCode>(i))) return true;
  }
  return read_.fail(code, "error.code", "must be the name of an error, not \"" + code.text + "\"");
}

bool BatchLineReader::read_figures(const JsonValue& root, BatchLine& line) {
  const JsonValue* hash = read_.member(root, "", "hash");
  const JsonValue* state = root.find("state_hash");
  if (hash == nullptr || !read_hash(*hash, "hash", line.hash)) return false;
  if (state == nullptr && is_own_ && item_->scene) return read_.member(root, "", "state_hash") != nullptr;
  return (state == nullptr || read_hash(*state, "state_hash", line.state_hash)) && read_input(root, line) &&
         read_files(root, line) && (!is_own_ || has_fields_of_a_cut(root));
}

bool BatchLineReader::has_fields_of_a_cut(const JsonValue& root) {
  const JsonValue* kept = root.find("kept_strokes");
  return has_fields(read_, root, "", cut_fields()) &&
         (kept == nullptr || has_type(read_, *kept, "kept_strokes", FieldType::kWhole)) && has_volumes(read_, root) &&
         has_list(read_, root, "stroke_names", FieldType::kText) && has_quality(read_, root) &&
         (!item_->scene || has_object(read_, root, "", "forces", force_fields()));
}

bool BatchLineReader::read_input(const JsonValue& root, BatchLine& line) {
  const JsonValue* input = read_.member(root, "", "input");
  if (input == nullptr) return false;
  const bool has_file = !plan_.output.format.empty() && plan_.output.before;
  std::vector<std::string_view> keys = {"hash", "key", "vertices", "tets"};
  if (has_file) keys.emplace_back("file");
  if (is_own_ && !read_.is_object(*input, "input", keys)) return false;
  const JsonValue* hash = read_.member(*input, "input", "hash");
  const JsonValue* key = hash ? read_.member(*input, "input", "key") : nullptr;
  const JsonValue* vertices = key ? read_.member(*input, "input", "vertices") : nullptr;
  const JsonValue* tets = vertices ? read_.member(*input, "input", "tets") : nullptr;
  std::uint64_t of_mesh = 0;
  return tets != nullptr && read_hash(*hash, "input.hash", of_mesh) && read_hash(*key, "input.key", line.input_key) &&
         read_.whole(*vertices, "input.vertices", line.input_vertices) &&
         read_.whole(*tets, "input.tets", line.input_tets) &&
         read_file_name(*input, "input", "file", has_file ? before_file(plan_, of_mesh) : "", line.input_file);
}

bool BatchLineReader::read_files(const JsonValue& root, BatchLine& line) {
  const bool has_mesh = !plan_.output.format.empty();
  if (!read_file_name(root, "", "strokes_file", plan_.output.strokes ? strokes_file(*item_) : "", line.strokes_file) ||
      !read_file_name(root, "", "file", has_mesh ? after_file(plan_, *item_) : "", line.file)) {
    return false;
  }
  if (line.file.empty()) return true;
  const JsonValue* bytes = read_.member(root, "", "file_bytes");
  const JsonValue* hash = bytes ? read_.member(root, "", "file_hash") : nullptr;
  return hash != nullptr && read_.whole(*bytes, "file_bytes", line.file_bytes) &&
         read_hash(*hash, "file_hash", line.file_hash);
}

/// The one that the plan and the item's name say, since broken ones are removed; none where they say none.
bool BatchLineReader::read_file_name(const JsonValue& object, const std::string& path, const char* key,
                                     const std::string& wanted, std::string& out) {
  const JsonValue* value = object.find(key);
  if (value == nullptr) return wanted.empty() || read_.member(object, path, key) != nullptr;
  if (!read_.text(*value, under(path, key), out)) return false;
  if (out == wanted) return true;
  return read_.fail(*value, under(path, key),
                    wanted.empty() ? "must not be there: the plan asks for no such file"
                                   : "must name a file in the batch's folder as the plan has it, \"" + wanted + "\"");
}

bool BatchLineReader::read_hash(const JsonValue& value, const std::string& path, std::uint64_t& out) {
  std::string text;
  if (!read_.text(value, path, text)) return false;
  if (text.size() != 16 || text.find_first_not_of("0123456789abcdef") != std::string::npos) {
    return read_.fail(value, path, "must be 16 hexadecimal digits in lower case");
  }
  out = std::stoull(text, nullptr, 16);
  return true;
}

}  // namespace app
}  // namespace v0
}  // namespace incise
