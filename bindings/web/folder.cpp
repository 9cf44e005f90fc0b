// SPDX-License-Identifier: Apache-2.0
#include "folder.h"

#include <fstream>
#include <iterator>
#include <system_error>

namespace incise_web {

namespace fs = std::filesystem;
using incise::Error;
using incise::ErrorCode;
using incise::Result;
using incise::Status;

Folder::Folder() {
  std::error_code code;
  for (unsigned number = 1; path_.empty(); ++number) {
    const fs::path free = "/incise-" + std::to_string(number);
    if (fs::create_directory(free, code) || code) path_ = free;
  }
}

Folder::~Folder() {
  std::error_code code;
  fs::remove_all(path_, code);
}

fs::path Folder::place_of(const std::string& name) const {
  const fs::path last = fs::path(name).filename();
  return path_ / (last.empty() || last == "." || last == ".." ? fs::path("unnamed") : last);
}

Error Folder::named(Error error) const {
  const std::string own = path_.string();
  for (std::size_t at = 0; (at = error.message.find(own, at)) != std::string::npos;) {
    const bool leads = error.message.compare(at + own.size(), 1, "/") == 0;  // to a file in it
    error.message.replace(at, own.size() + (leads ? 1 : 0), leads ? "" : ".");
  }
  return error;
}

Status Folder::named(const Status& status) const {
  return status.ok() ? status : named(status.error());
}

Status Folder::write(const std::string& name, std::string_view bytes) const {
  const fs::path place = place_of(name);
  std::ofstream file(place, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (file) return {};
  return Error{ErrorCode::kIo, name + ": no memory is left to hold it; use a smaller file", {}};
}

Result<std::string> Folder::read(const std::string& name) const {
  std::ifstream file(place_of(name), std::ios::binary);
  if (!file) return Error{ErrorCode::kIo, name + ": is not there", {}};
  return std::string(std::istreambuf_iterator<char>(file), {});
}

}  // namespace incise_web
