// SPDX-License-Identifier: Apache-2.0
// One thread and one io_context: what a connection does comes in handlers of that thread alone. A handler of a
// connection that was dropped meanwhile finds that `link_` is another one, and does nothing.
#include "app/hands/haply_device.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>

#include "app/hands/haply_messages.h"
#include "incise/core/triple_buffer.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
using asio::ip::tcp;
using Code = boost::system::error_code;
using Clock = std::chrono::steady_clock;

constexpr double kIdle = 0.01;                 // s between two looks while there is no connection
constexpr double kFarewell = 0.2;              // s for the last message and the closing handshake
constexpr unsigned kMostOwed = 5;              // exchanges that were late and are made up for
constexpr std::size_t kMostBytes = 1U << 20U;  // of a message
constexpr int kSendBuffer = 4096;              // bytes: forces wait in it that a service does not take; a force has 150
constexpr double kDeaf = 0.1;                  // s that a force may wait to be taken

/// One connection.
struct Link {
  explicit Link(asio::io_context& io) : socket(io) {}
  beast::websocket::stream<beast::tcp_stream, false> socket;  // nothing is compressed
  beast::flat_buffer heard;
  std::string said;
  double since = 0;  // when it was begun, then when something was last heard, s
  double said_at = 0;
  bool is_open = false, is_writing = false;
};
using LinkPtr = std::shared_ptr<Link>;

Clock::duration to_duration(double seconds) {
  return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

}  // namespace

struct HaplyDevice::State {
  explicit State(const HaplyOptions& chosen) : options_(chosen), resolver_(io_), pace_(io_), guard_(chosen.guard) {}

  /// What the caller waits for in `open`.
  enum class News : std::uint8_t { kNothing, kConnected, kArm };

  void start();
  News wait_for_arm();
  void stop();

  // Of whoever reads and commands.
  TripleBuffer<DeviceState> states{gone()};
  TripleBuffer<Vec3> forces{Vec3::Zero()};
  DeviceState last = gone();

  [[nodiscard]] HaplyStatistics statistics() const;

 private:
  static DeviceState gone() {
    DeviceState state;
    state.is_live = false;
    return state;
  }
  [[nodiscard]] double now() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
  void run();
  void connect();
  void connected(const LinkPtr& link);
  void opened(const LinkPtr& link);
  void drop();
  void listen(const LinkPtr& link);
  void hear(std::string_view text);
  void pace();
  void watch(double time);
  void send();
  void write(const Vec3& force);
  void written(const LinkPtr& link);
  [[nodiscard]] Vec3 force_now(double time);
  void tell(News news);

  HaplyOptions options_;
  asio::io_context io_{1};
  tcp::resolver resolver_;
  asio::steady_timer pace_;
  LinkPtr link_;
  DeviceGuard guard_;
  std::string arm_;    // its id, as `HaplyReading` has it
  double arm_at_ = 0;  // when it was heard of last, s
  DeviceState state_;  // as it was heard last
  Clock::time_point start_ = Clock::now();
  double retry_at_ = 0, commanded_at_ = 0, probed_at_ = 0, stopped_at_ = 0;
  unsigned owed_ = 0;       // exchanges that are due
  bool may_speak_ = false;  // what was heard last is not answered yet
  bool is_asking_ = false;  // a force was sent, and no state came since
  bool is_silent_ = false;  // no answer came in time
  bool is_stopping_ = false, has_parted_ = false;
  std::thread thread_;

  std::mutex mutex_;
  std::condition_variable told_;
  News news_ = News::kNothing;

  std::atomic<std::uint64_t> exchanges_{0}, bad_{0}, jumps_{0}, silences_{0}, connections_{0};
  std::atomic<bool> is_connected_{false};
};

void HaplyDevice::State::start() {
  thread_ = std::thread([this] { run(); });
}

void HaplyDevice::State::run() {
  connect();
  pace();
  for (;;) {
    try {
      io_.run();
      return;
    } catch (const std::exception&) {  // no memory for a message: what is left of it goes with its connection
      drop();
      pace();
    }
  }
}

HaplyDevice::State::News HaplyDevice::State::wait_for_arm() {
  std::unique_lock lock(mutex_);
  // Looking up, connecting and the handshake, and a first message.
  told_.wait_for(lock, to_duration(2 * options_.timeout), [this] { return news_ == News::kArm; });
  return news_;
}

void HaplyDevice::State::tell(News news) {
  {
    const std::lock_guard lock(mutex_);
    news_ = std::max(news_, news);
  }
  told_.notify_one();
}

void HaplyDevice::State::stop() {
  if (!thread_.joinable()) return;
  asio::post(io_, [this] {
    is_stopping_ = true;
    stopped_at_ = now();
    send();
  });
  thread_.join();
}

// --- the connection

void HaplyDevice::State::connect() {
  const LinkPtr link = link_ = std::make_shared<Link>(io_);
  link->since = now();
  resolver_.async_resolve(options_.host, std::to_string(options_.port),
                          [this, link](const Code& error, const tcp::resolver::results_type& found) {
                            if (link != link_) return;
                            if (error) return drop();
                            beast::get_lowest_layer(link->socket)
                                .async_connect(found, [this, link](const Code& failed, const tcp::endpoint&) {
                                  if (link != link_) return;
                                  failed ? drop() : connected(link);
                                });
                          });
}

void HaplyDevice::State::connected(const LinkPtr& link) {
  Code ignored;
  beast::get_lowest_layer(link->socket).socket().set_option(tcp::no_delay(true), ignored);
  beast::get_lowest_layer(link->socket).socket().set_option(tcp::socket::send_buffer_size(kSendBuffer), ignored);
  link->socket.read_message_max(kMostBytes);
  link->socket.text(true);
  link->socket.async_handshake(options_.host + ":" + std::to_string(options_.port), "/",
                               [this, link](const Code& error) {
                                 if (link != link_) return;
                                 error ? drop() : opened(link);
                               });
}

void HaplyDevice::State::opened(const LinkPtr& link) {
  link->is_open = true;
  link->since = now();
  is_connected_ = true;
  ++connections_;
  owed_ = 0;
  may_speak_ = is_asking_ = is_silent_ = false;
  arm_.clear();  // it may be another one
  arm_at_ = now();
  tell(News::kConnected);
  listen(link);
}

void HaplyDevice::State::drop() {
  if (link_) beast::get_lowest_layer(link_->socket).close();
  resolver_.cancel();
  link_.reset();
  is_connected_ = false;
  retry_at_ = now() + options_.retry;
  guard_.lose(now());
  states.publish(gone());
  if (is_stopping_) io_.stop();
}

void HaplyDevice::State::listen(const LinkPtr& link) {
  link->socket.async_read(link->heard, [this, link](const Code& error, std::size_t) {
    if (link != link_) return;
    if (error) return drop();
    const auto data = link->heard.cdata();
    hear({static_cast<const char*>(data.data()), data.size()});
    link->heard.consume(link->heard.size());
    listen(link);
  });
}

void HaplyDevice::State::hear(std::string_view text) {
  const double time = now();
  if (std::exchange(is_asking_, false)) ++exchanges_;
  link_->since = time;
  may_speak_ = true;
  is_silent_ = false;
  const std::optional<HaplyReading> reading = parse_haply(text, arm_);
  if (!reading) {
    ++bad_;
    guard_.lose(time);
    states.publish(gone());
  } else {
    if (arm_.empty()) arm_ = reading->device;
    arm_at_ = time;
    const Eigen::Quaterniond held = state_.orientation;
    state_ = reading->state;
    if (!reading->has_grip) state_.orientation = held;
    if (!guard_.hear(time, state_.position, state_.velocity)) ++jumps_;
    state_.is_live = guard_.is_live(time);
    states.publish(state_);
    tell(News::kArm);
  }
  send();
}

// --- what is sent, and when

void HaplyDevice::State::pace() {
  const double time = now();
  const bool is_open = link_ && link_->is_open;
  if (is_open) {
    owed_ = std::min(owed_ + 1, kMostOwed);
    send();
  }
  watch(time);
  if (is_stopping_ && time - stopped_at_ > kFarewell) return io_.stop();
  const Clock::time_point next = pace_.expiry() + to_duration(is_open ? 1 / options_.rate : kIdle);
  // What was slept through for long is not made up for.
  pace_.expires_at(std::max(next, Clock::now() - to_duration(kMostOwed / options_.rate)));
  pace_.async_wait([this](const Code& error) {
    if (!error) pace();
  });
}

/// Looks for what does not happen.
void HaplyDevice::State::watch(double time) {
  if (!link_) {
    if (time >= retry_at_ && !is_stopping_) connect();
    return;
  }
  if (link_->is_writing && time - link_->said_at > kDeaf) {  // it may talk on, and does not listen
    ++silences_;
    return drop();
  }
  const double silent_for = time - link_->since;
  if (silent_for > options_.timeout) return drop();
  // It may have come back by another id: a new connection takes the arm that is there.
  if (!arm_.empty() && time - arm_at_ > options_.timeout) return drop();
  if (!link_->is_open || silent_for <= options_.guard.silence) return;
  if (!std::exchange(is_silent_, true)) {
    ++silences_;
    states.publish(gone());
  }
  if (time - probed_at_ < options_.guard.silence) return;
  // The last force acts until another comes: one that hears, but does not answer, must not go on pushing.
  probed_at_ = time;
  write(Vec3::Zero());
}

/// Answers what was heard, as soon as it is due.
void HaplyDevice::State::send() {
  if (!link_ || !link_->is_open) {
    if (is_stopping_) io_.stop();
    return;
  }
  if (is_stopping_) {
    if (link_->is_writing || std::exchange(has_parted_, true)) return;
    return write(Vec3::Zero());
  }
  if (!may_speak_ || owed_ == 0 || link_->is_writing) return;
  --owed_;
  may_speak_ = false;
  write(force_now(now()));
}

Vec3 HaplyDevice::State::force_now(double time) {
  if (forces.take()) commanded_at_ = time;
  if (time - commanded_at_ > options_.guard.silence) return Vec3::Zero();
  const Vec3 force = guard_.share(time) * forces.value();
  const double size = force.norm();
  if (!std::isfinite(size)) return Vec3::Zero();
  return size > options_.max_force ? Vec3(options_.max_force / size * force) : force;
}

void HaplyDevice::State::write(const Vec3& force) {
  if (arm_.empty() || link_->is_writing) return;
  const LinkPtr link = link_;
  link->is_writing = true;
  link->said_at = now();
  link->said = haply_force(arm_, force);
  link->socket.async_write(asio::buffer(link->said), [this, link](const Code& error, std::size_t) {
    link->is_writing = false;
    if (link != link_) return;
    is_asking_ = true;
    error ? drop() : written(link);
  });
}

void HaplyDevice::State::written(const LinkPtr& link) {
  if (!is_stopping_) return send();
  if (!has_parted_) return send();
  link->socket.async_close(beast::websocket::close_code::normal, [this](const Code&) { io_.stop(); });
}

HaplyStatistics HaplyDevice::State::statistics() const {
  return {exchanges_, bad_, jumps_, silences_, connections_, is_connected_};
}

// --- the device

Result<std::unique_ptr<HaplyDevice>> HaplyDevice::open(const HaplyOptions& options) {
  if (Status status = check(options); !status.ok()) return status.error();
  const std::string where = "ws://" + options.host + ":" + std::to_string(options.port);
  try {
    std::unique_ptr<HaplyDevice> device(new HaplyDevice(std::make_unique<State>(options)));
    device->state_->start();
    switch (device->state_->wait_for_arm()) {
      case State::News::kArm:
        return device;
      case State::News::kConnected:
        return Error{ErrorCode::kIo, where + " answers, but tells of no Inverse3; plug one in and calibrate it", {}};
      default:
        return Error{ErrorCode::kIo,
                     "no haptic device at " + where +
                         "; start Haply's Inverse Service there, or name another place "
                         "with haply=HOST:PORT",
                     {}};
    }
  } catch (const std::exception& error) {
    return Error{ErrorCode::kInternal, "no connection to " + where + " can be made: " + error.what(), {}};
  }
}

HaplyDevice::HaplyDevice(std::unique_ptr<State> state) : state_(std::move(state)) {}

HaplyDevice::~HaplyDevice() {
  state_->stop();
}

DeviceState HaplyDevice::read(double /*time*/) {
  if (state_->states.take()) state_->last = state_->states.value();
  return state_->last;
}

void HaplyDevice::command(const Vec3& force) {
  state_->forces.publish(force);
}

HaplyStatistics HaplyDevice::statistics() const {
  return state_->statistics();
}

}  // namespace app
}  // namespace v0
}  // namespace incise
