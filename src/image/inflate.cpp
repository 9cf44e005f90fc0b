// SPDX-License-Identifier: Apache-2.0
// zlib in chunks, up to the size that the header promises and no further: a stream cannot claim more memory than its
// own length can fill.
#include "image/inflate.h"

#if INCISE_WITH_GZIP
#include <zlib.h>

#include <algorithm>
#endif

namespace incise {
inline namespace v0 {
namespace image {

bool is_gzip(std::string_view bytes) {
  return bytes.size() >= 2 && bytes[0] == '\x1f' && bytes[1] == '\x8b';
}

#if INCISE_WITH_GZIP
namespace {

constexpr int kEitherWindow = 15 + 32;  // gzip or zlib, by their headers
constexpr std::size_t kChunk = std::size_t{1} << 26U;

}  // namespace

class InflateStream::Inflater {
 public:
  explicit Inflater(std::string_view bytes) : left_(bytes) { is_ready_ = inflateInit2(&z_, kEitherWindow) == Z_OK; }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;
  ~Inflater() { inflateEnd(&z_); }

  [[nodiscard]] bool is_ready() const { return is_ready_; }
  /// Whether the stream came to its end, and no other follows.
  [[nodiscard]] bool is_done() const { return is_done_; }

  /// Appends up to `size` bytes; false where the stream is damaged or cut off.
  bool append(std::string& out, std::size_t size) {
    const std::size_t in = std::min(left_.size(), kChunk), before = out.size();
    out.resize(before + size);
    z_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(left_.data()));  // zlib never writes to it
    z_.avail_in = static_cast<uInt>(in);
    z_.next_out = reinterpret_cast<Bytef*>(out.data() + before);
    z_.avail_out = static_cast<uInt>(size);
    const int code = ::inflate(&z_, Z_NO_FLUSH);
    left_.remove_prefix(in - z_.avail_in);
    const std::size_t got = size - z_.avail_out;
    out.resize(before + got);
    if (code == Z_STREAM_END) {
      is_done_ = !is_gzip(left_);
      return is_done_ || inflateReset(&z_) == Z_OK;
    }
    return (code == Z_OK || code == Z_BUF_ERROR) && (got > 0 || !left_.empty());
  }

 private:
  std::string_view left_;
  z_stream z_ = {};
  bool is_ready_ = false, is_done_ = false;
};

InflateStream::InflateStream(std::string_view bytes) : inflater_(std::make_unique<Inflater>(bytes)) {}

bool InflateStream::read(std::size_t size, std::string& out, std::string& why) {
  out.clear();
  if (!inflater_->is_ready()) return why = "zlib cannot start", false;
  while (out.size() < size && !inflater_->is_done()) {
    if (!inflater_->append(out, std::min(size - out.size(), kChunk))) {
      return why = "the compressed voxels are damaged or cut off; fetch the file again", false;
    }
  }
  return true;
}

#else

class InflateStream::Inflater {};

InflateStream::InflateStream(std::string_view) {}

bool InflateStream::read(std::size_t, std::string&, std::string& why) {
  why = "is gzipped, which this build cannot read; gunzip it first";
  return false;
}

#endif

InflateStream::InflateStream(InflateStream&&) noexcept = default;
InflateStream::~InflateStream() = default;

}  // namespace image
}  // namespace v0
}  // namespace incise
