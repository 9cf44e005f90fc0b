// SPDX-License-Identifier: Apache-2.0
// The reader of recordings on any bytes: an error that names the line, or calls that are written as they were read.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <sstream>

#include "app/recording/engine_recording.h"

namespace {

using namespace incise;

void expect_named(const Error& error) {
  if (error.message.rfind("fuzz.jsonl:", 0) != 0) std::abort();
}

void expect_stable(const app::RecordedCall& call) {
  const std::string line = to_line(call);
  const Result<app::RecordedCall> again = app::EngineCodec::parse_call(line, "again.jsonl", call.line);
  if (!again.ok() || to_line(*again) != line) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  auto text = std::make_unique<std::istringstream>(std::string(reinterpret_cast<const char*>(data), size));
  auto reader = app::RecordingReader::open(std::move(text), "fuzz.jsonl");
  if (!reader.ok()) return expect_named(reader.error()), 0;
  for (;;) {
    const auto call = reader->next();
    if (!call.ok()) return expect_named(call.error()), 0;
    if (!call->has_value()) return 0;
    expect_stable(**call);
  }
}
