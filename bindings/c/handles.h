// SPDX-License-Identifier: Apache-2.0
// What is behind the handles of include/incise/c/incise.h, and how its calls begin and end: null handles, other
// threads, sizes of structs, errors, exceptions.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstring>
#include <exception>
#include <memory>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>
#ifdef __GLIBCXX__
#include <cxxabi.h>
#endif

#include "incise/c/incise.h"
#include "incise/core/result.h"
#include "incise/engine/engine.h"
#include "incise/io/mesh_data.h"

namespace incise::c {

/// Keeps the error for `incise_last_error` and returns its code.
incise_status fail(const Error& error);
incise_status refuse(const std::string& message);
/// Of a call that another thread, or a callback's own caller, is in.
incise_status busy();
/// Fails where a status has failed.
incise_status finish(const Status& status);

/// Whose turn it is: the thread that is within a call on a handle.
class Turn {
 public:
  /// Takes the turn; a thread that has it already may look again where `lets_look` was called.
  bool begin(bool only_looks);
  void end();
  /// Until the call ends, callbacks of it may look.
  void lets_look() { lets_look_ = true; }

 private:
  std::atomic<const void*> thread_{nullptr};
  unsigned depth_ = 0;  // these two are the owner's
  bool lets_look_ = false;
};

/// Nothing leaves by exception: bad_alloc is the one that the library's containers may throw. But a thread that is
/// ended within a callback (pthread_exit, as Python ends those of daemons) unwinds by something that looks like one.
template <class Call>
incise_status guarded(const Call& call) {
  try {
    return call();
  } catch (const std::bad_alloc&) {
    return fail({ErrorCode::kOutOfMemory, "out of memory; use a smaller mesh or free other engines", {}});
  } catch (const std::length_error&) {
    return refuse("a number of elements is above what memory can hold; was it negative?");
  } catch (const std::exception& thrown) {
    return fail({ErrorCode::kInternal, thrown.what(), {}});
#ifdef __GLIBCXX__
  } catch (const abi::__forced_unwind&) {
    throw;
#endif
  } catch (...) {
    return fail({ErrorCode::kInternal, "an exception of an unknown kind", {}});
  }
}

/// Makes a call while the thread has its turn.
template <class Call>
incise_status in_turn(Turn& turn, bool only_looks, const Call& call) {
  if (!turn.begin(only_looks)) return busy();
  struct End {
    Turn& turn;
    ~End() { turn.end(); }
  } const end{turn};
  return guarded(call);
}

/// Whether the `size` that a program set in a struct is one that this library can serve; `name` is the struct's.
/// No version of a struct ends within one of its members.
incise_status check_size(std::uint32_t size, std::size_t known, std::size_t alignment, const char* name);
template <class T>
incise_status check_size(std::uint32_t size, const char* name) {
  return check_size(size, sizeof(T), alignof(T), name);
}

/// For structs that the library fills; null ones are not wanted.
template <class T>
incise_status check_out(const T* out, const char* name) {
  return out == nullptr ? INCISE_OK : check_size<T>(out->size, name);
}
template <class T>
incise_status give(T full, T* out) {
  if (out == nullptr) return INCISE_OK;
  full.size = out->size;
  std::memcpy(out, &full, out->size);
  return INCISE_OK;
}

/// For structs that the program fills: what it does not know of stays as `full` has it.
template <class T>
incise_status take(const T* given, T& full, const char* name) {
  if (given == nullptr) return INCISE_OK;
  if (const incise_status bad = check_size<T>(given->size, name)) return bad;
  std::memcpy(&full, given, given->size);
  return INCISE_OK;
}

/// Fills a struct of default options of which the program knows `size` bytes.
template <class T>
incise_status give_default(T full, T* out, std::uint32_t size, const char* name) {
  if (out == nullptr) return refuse(std::string(name) + ": the struct is null");
  if (const incise_status bad = check_size<T>(size, name)) return bad;
  full.size = size;
  std::memcpy(out, &full, size);
  return INCISE_OK;
}

/// The first `room` records, and how many there are.
template <class From, class To, class Convert>
incise_status give_list(const From& from, To* to, std::uint64_t room, std::uint64_t* count, const Convert& convert) {
  if (to == nullptr && room > 0) return refuse("the buffer is null, and its room is not 0");
  if (count != nullptr) *count = from.size();
  std::uint64_t written = 0;
  for (const auto& record : from) {
    if (written == room) break;
    to[written++] = convert(record);
  }
  return INCISE_OK;
}
template <class T>
incise_status give_list(const std::vector<T>& from, T* to, std::uint64_t room, std::uint64_t* count) {
  return give_list(from, to, room, count, [](const T& value) { return value; });
}

/// A text with a closing 0 as far as it goes, and how many bytes the whole takes.
incise_status give_text(const std::string& from, char* text, std::uint64_t room, std::uint64_t* count);

inline Vec3 to_vec(const double* xyz) {
  return {xyz[0], xyz[1], xyz[2]};
}
inline void from_vec(const Vec3& v, double* xyz) {
  for (int k = 0; k < 3; ++k) xyz[k] = v[k];
}
/// An edge of `n` points that cuts along `direction`, which may be null.
BladePose pose_of(const double* edge, std::uint64_t n, const double* direction);

/// What a program listens with; null: nobody listens.
LogSink log_to(incise_log log, void* user);
Result<EngineOptions> engine_options(const incise_engine_options* given, EngineOptions otherwise = {});
/// A mesh of arrays, checked as far as it takes to read them.
/// `notes`: in words, what is wrong with them and was left so.
Result<TetMesh> mesh_of(const incise_mesh_arrays* given, std::vector<std::string>& notes);

void fill(incise_report& report, const CutStatistics& cut);
void fill(incise_report& report, const MaintainStatistics& maintain);
void fill(incise_report& report, const StageTimes& times);

/// Tells an engine from all others, also from those that take its place in memory later: its followers keep a copy.
using Identity = std::shared_ptr<const char>;

}  // namespace incise::c

// NOLINTBEGIN(readability-identifier-naming): C names

/// An engine of its own, or one to look at that a simulation has.
struct incise_engine {
  std::optional<incise::Engine> own;
  const incise::Engine* engine = nullptr;
  incise::c::Identity identity = std::make_shared<const char>('\0');
  mutable incise::c::Turn own_turn;
  incise::c::Turn* turn = &own_turn;
  std::uint64_t version = 1;  // of addresses, rows and values
  std::vector<std::string> notes;
  std::vector<std::uint32_t> file_vertex;  // as in `LoadedMesh`
  incise::io::RegionNames region_names;    // likewise
};

// NOLINTEND(readability-identifier-naming)

namespace incise::c {

/// Looks at an engine in the thread's turn: `call(const Engine&)`.
template <class Call>
incise_status look(const incise_engine* handle, const Call& call) {
  if (handle == nullptr) return refuse("the engine is null");
  return in_turn(*handle->turn, true, [&] { return call(*handle->engine); });
}

/// The same for a follower of one engine, which another one would lead astray.
template <class Call>
incise_status look_as(const Identity& of, const incise_engine* handle, const Call& call) {
  if (handle != nullptr && handle->identity != of) {
    return refuse("this cursor, or these attributes, were made for another engine; make new ones for this one");
  }
  return look(handle, call);
}

/// Changes an engine in the thread's turn: `call(Engine&)`.
template <class Call>
incise_status change(incise_engine* handle, const Call& call) {
  if (handle == nullptr) return refuse("the engine is null");
  if (!handle->own) return refuse("this engine belongs to a simulation and is to be read: change the simulation");
  return in_turn(*handle->turn, false, [&] {
    ++handle->version;
    return call(*handle->own);
  });
}

}  // namespace incise::c
