// SPDX-License-Identifier: Apache-2.0
// zlib with bounds on how far a stream may grow, since a small file can claim any size; without zlib every call says
// so.
#include "io/gzip.h"

#if INCISE_WITH_GZIP
#include <zlib.h>

#include <algorithm>
#include <limits>

#include "io/text.h"
#endif

namespace incise {
inline namespace v0 {
namespace io {

bool is_gzip(std::string_view bytes) {
  return bytes.size() >= 2 && bytes[0] == '\x1f' && bytes[1] == '\x8b';
}

#if INCISE_WITH_GZIP
namespace {

constexpr int kGzipWindow = 15 + 16;
constexpr std::size_t kMaxChunk = std::size_t{1} << 30U;
/// Meshes shrink to a tenth, in regular boxes to a fiftieth. What grows further than this, and beyond 64 MiB, is none.
constexpr std::uint64_t kMostGrowth = 64, kSmall = std::uint64_t{64} << 20U;
/// Bytes of what is unpacked to be counted alone.
constexpr std::size_t kCountedAtOnce = std::size_t{1} << 18U;

Bytef* as_bytes(const char* p) {
  return reinterpret_cast<Bytef*>(const_cast<char*>(p));
}  // zlib never writes to it

class Inflater {
 public:
  Inflater(std::string_view bytes, int window) : bytes_(bytes) { ready_ = inflateInit2(&z_, window) == Z_OK; }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;
  ~Inflater() { inflateEnd(&z_); }

  [[nodiscard]] bool ready() const { return ready_; }
  [[nodiscard]] bool at_end() const { return used_ == bytes_.size(); }

  // Fills up to `size` bytes; returns zlib's code and how many came.
  int step(char* out, std::size_t size, std::size_t& got) {
    const std::size_t in = std::min(bytes_.size() - used_, kMaxChunk);
    const std::size_t room = std::min(size, kMaxChunk);
    z_.next_in = as_bytes(bytes_.data() + used_);
    z_.avail_in = static_cast<uInt>(in);
    z_.next_out = as_bytes(out);
    z_.avail_out = static_cast<uInt>(room);
    const int code = inflate(&z_, Z_NO_FLUSH);
    used_ += in - z_.avail_in;
    got = room - z_.avail_out;
    return code;
  }
  bool restart() { return inflateReset(&z_) == Z_OK; }
  // Whether another gzip member follows; trailing padding does not count.
  [[nodiscard]] bool has_member() const { return is_gzip(bytes_.substr(used_)); }

 private:
  std::string_view bytes_;
  z_stream z_ = {};
  std::size_t used_ = 0;
  bool ready_ = false;
};

}  // namespace

bool has_gzip() {
  return true;
}

namespace {

enum class Unpacked { kToTheEnd, kRoomIsFull, kFailed };

// Fills `room`, and says whether the members end there; `filled` counts what came.
Unpacked unpack(Inflater& inflater, char* room, std::size_t size, std::size_t& filled, std::string& why) {
  filled = 0;
  for (;;) {
    std::size_t got = 0;
    const int code = inflater.step(room + filled, size - filled, got);
    filled += got;
    if (code == Z_STREAM_END) {
      if (!inflater.has_member()) return Unpacked::kToTheEnd;
      if (!inflater.restart()) return why = "zlib cannot restart", Unpacked::kFailed;
    } else if (code != Z_OK && code != Z_BUF_ERROR) {
      return why = "the gzip stream is damaged; fetch the file again", Unpacked::kFailed;
    } else if (filled == size) {
      return Unpacked::kRoomIsFull;
    } else if (got == 0 && inflater.at_end()) {
      return why = "the gzip stream ends too early; fetch the file again", Unpacked::kFailed;
    }
  }
}

// Unpacks without keeping anything, until more than `most` bytes came.
Unpacked count(Inflater& inflater, std::uint64_t most, std::uint64_t& counted, std::string& why) {
  std::string chunk(kCountedAtOnce, '\0');
  Unpacked state = Unpacked::kRoomIsFull;
  while (state == Unpacked::kRoomIsFull && counted <= most) {
    std::size_t got = 0;
    state = unpack(inflater, chunk.data(), chunk.size(), got, why);
    counted += got;
  }
  return state;
}

// What the last member says that it unpacks to: of a file with one member its size, modulo 4 GiB.
std::uint64_t stated_size(std::string_view bytes) {
  std::uint64_t size = 0;
  for (std::size_t i = 0; i < 4 && bytes.size() >= 4; ++i) {
    size = (size << 8U) | static_cast<unsigned char>(bytes[bytes.size() - 1 - i]);
  }
  return size;
}

std::string too_large(std::uint64_t most, std::uint64_t max_bytes) {
  const std::string ratio = most < max_bytes ? ", where text grows to " + std::to_string(kMostGrowth) +
                                                   " times its gzipped size at most, or to " + size_text(kSmall)
                                             : ", the most that is read";
  return "gunzips to more than " + size_text(most) + ratio + "; if it is no damage, gunzip it yourself";
}

}  // namespace

bool gunzip(std::string_view bytes, std::uint64_t max_bytes, std::string& out, std::string& why) {
  Inflater inflater(bytes, kGzipWindow);
  if (!inflater.ready()) return why = "zlib cannot start", false;
  const std::uint64_t most = std::min(max_bytes, std::max(kSmall, kMostGrowth * bytes.size()));
  const std::uint64_t stated = stated_size(bytes);
  out.resize(stated <= most ? static_cast<std::size_t>(stated) : 0);
  std::size_t filled = 0;
  Unpacked state = unpack(inflater, out.data(), out.size(), filled, why);
  std::uint64_t whole = filled;
  // More members than one, or more than the last says: nothing is kept before all of it is known to be taken.
  if (state == Unpacked::kRoomIsFull) state = count(inflater, most, whole, why);
  if (whole > most) return why = too_large(most, max_bytes), false;
  if (state == Unpacked::kFailed) return false;
  out.resize(static_cast<std::size_t>(whole));
  if (whole == filled) return true;
  Inflater again(bytes, kGzipWindow);
  if (!again.ready()) return why = "zlib cannot start", false;
  return unpack(again, out.data(), out.size(), filled, why) != Unpacked::kFailed;
}

std::string gunzip_beginning(std::string_view bytes, std::size_t most) {
  Inflater inflater(bytes, kGzipWindow);
  std::string out(most, '\0'), why;
  std::size_t filled = 0;
  if (inflater.ready()) static_cast<void>(unpack(inflater, out.data(), out.size(), filled, why));
  out.resize(filled);
  return out;
}

bool inflate_to(std::string_view bytes, char* out, std::size_t size) {
  Inflater inflater(bytes, 15);
  if (!inflater.ready()) return false;
  std::size_t filled = 0;
  for (;;) {
    char spare = 0;  // tells a stream that is too long from one that ends here
    std::size_t got = 0;
    const bool full = filled == size;
    const int code = full ? inflater.step(&spare, 1, got) : inflater.step(out + filled, size - filled, got);
    if (full && got > 0) return false;
    filled += got;
    if (code == Z_STREAM_END) return filled == size;
    if (code != Z_OK || (got == 0 && inflater.at_end())) return false;
  }
}

std::string deflate_block(std::string_view bytes) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::string out(size, '\0');
  if (compress2(as_bytes(out.data()), &size, as_bytes(bytes.data()), static_cast<uLong>(bytes.size()), 6) != Z_OK) {
    return {};
  }
  out.resize(size);
  return out;
}

bool gzip(std::string_view bytes, std::string& out) {
  z_stream z = {};
  if (deflateInit2(&z, 6, Z_DEFLATED, kGzipWindow, 8, Z_DEFAULT_STRATEGY) != Z_OK) return false;
  std::string chunk(std::size_t{1} << 18U, '\0');
  std::size_t used = 0;
  int code = Z_OK;
  while (code == Z_OK) {
    const std::size_t in = std::min(bytes.size() - used, kMaxChunk);
    z.next_in = as_bytes(bytes.data() + used);
    z.avail_in = static_cast<uInt>(in);
    z.next_out = as_bytes(chunk.data());
    z.avail_out = static_cast<uInt>(chunk.size());
    code = deflate(&z, used + in == bytes.size() ? Z_FINISH : Z_NO_FLUSH);
    used += in - z.avail_in;
    out.append(chunk.data(), chunk.size() - z.avail_out);
  }
  deflateEnd(&z);
  return code == Z_STREAM_END;
}

#else

bool has_gzip() {
  return false;
}
bool gunzip(std::string_view, std::uint64_t, std::string&, std::string& why) {
  why = "is gzipped, which this build cannot read; gunzip it first";
  return false;
}
std::string gunzip_beginning(std::string_view, std::size_t) {
  return {};
}
bool inflate_to(std::string_view, char*, std::size_t) {
  return false;
}
std::string deflate_block(std::string_view) {
  return {};
}
bool gzip(std::string_view, std::string&) {
  return false;
}

#endif

}  // namespace io
}  // namespace v0
}  // namespace incise
