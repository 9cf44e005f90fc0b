// SPDX-License-Identifier: Apache-2.0
// A stand-in for Haply's service, with faults on demand. It answers each force with a state, as the service does, in
// the time of the clock, with a simulated hand at the arm.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "incise/sim/haptic_device.h"

namespace incise::test {

class FakeHaply {
 public:
  enum class Fault : std::uint8_t {
    kNone,
    kBadJson,    ///< answers are cut off in the middle of a number
    kNoArm,      ///< answers tell of no arm
    kSilence,    ///< it hears, and does not answer
    kFragments,  ///< each answer comes as frames of 16 bytes, and each frame's bytes in two pieces
    kClose,      ///< closes the connection, once
    kDrop,       ///< breaks it off without a word, once
    kSpeed,      ///< answers tell of 50 m/s, and of places as they are
    kHuge,       ///< answers are 2 MiB long
    kNoText,     ///< answers are bytes that are no text
    kDeaf,       ///< it tells of states, and hears no more
    kDeep,       ///< answers are 100,000 brackets deep
  };

  /// Listens on a free port of this machine. The hand wants to be at `wants(time)`, m, time in s since the first
  /// message.
  explicit FakeHaply(std::function<Vec3(double)> wants);
  ~FakeHaply();
  FakeHaply(const FakeHaply&) = delete;
  FakeHaply& operator=(const FakeHaply&) = delete;

  [[nodiscard]] std::uint16_t port() const { return port_; }
  void set_fault(Fault fault) { fault_ = fault; }
  /// The arm has another id from now on, as JSON: a text in quotation marks, or a number. Forces for another id act on
  /// nothing.
  void set_id(const std::string& id);
  /// Moves the arm at once by this much, m, along y, once.
  void jump(double by) { jump_ = by; }

  [[nodiscard]] Vec3 force() const;          ///< N, that acts: what was asked for last; none without a client
  [[nodiscard]] Vec3 parting_force() const;  ///< N, that the last client to go asked for last
  [[nodiscard]] Vec3 position() const;       ///< m, of the arm
  [[nodiscard]] double strongest() const { return strongest_; }  ///< N, of all forces, or since `forget_strongest`
  void forget_strongest() { strongest_ = 0; }
  [[nodiscard]] std::uint64_t forces() const { return forces_; }  ///< that were asked for
  [[nodiscard]] std::uint64_t sessions() const { return sessions_; }
  [[nodiscard]] bool is_connected() const { return is_connected_; }
  /// µs between forces, of the newest million.
  [[nodiscard]] std::vector<double> gaps() const;

 private:
  struct Socket;
  void run();
  void serve(Socket& socket);
  void hear(const std::string& text);
  [[nodiscard]] std::string state(bool is_full);
  void move_hand();

  std::function<Vec3(double)> wants_;
  std::unique_ptr<Socket> socket_;
  std::uint16_t port_ = 0;
  std::atomic<Fault> fault_{Fault::kNone};
  std::atomic<double> jump_{0}, strongest_{0};
  std::atomic<std::uint64_t> forces_{0}, sessions_{0};
  std::atomic<bool> is_connected_{false}, quits_{false};
  mutable std::mutex mutex_;
  Vec3 force_ = Vec3::Zero(), parting_force_ = Vec3::Zero(), position_ = Vec3::Zero(), velocity_ = Vec3::Zero();
  double began_ = 0, moved_ = 0;  // s
  std::string id_ = "\"0478\"";
  std::vector<double> gaps_;
  double heard_ = 0;
  struct Thread;
  std::unique_ptr<Thread> thread_;
};

}  // namespace incise::test
