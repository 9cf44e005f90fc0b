// SPDX-License-Identifier: Apache-2.0
#include "app/hands/fake_haply.h"

#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>

namespace incise::test {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
using asio::ip::tcp;
using Code = boost::system::error_code;

constexpr double kMass = 0.3, kStiffness = 150, kDamping = 12;  // of the hand: kg, N/m, N·s/m
constexpr double kLongestStep = 5e-3;                           // s
constexpr std::size_t kFragment = 16;                           // bytes, below 126: a header of two

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

nlohmann::json xyz(const Vec3& v) {
  return {{"x", v.x()}, {"y", v.y()}, {"z", v.z()}};
}

}  // namespace

struct FakeHaply::Socket {
  asio::io_context io;
  tcp::acceptor acceptor{io, tcp::endpoint(asio::ip::address_v4::loopback(), 0)};
  std::optional<beast::websocket::stream<tcp::socket>> peer;  // the thread's own
  int line = -1;                                              // the same connection, for whoever breaks it off

  /// A message as frames of a few bytes, each of which arrives in two pieces: the first within its header, or just
  /// behind.
  void send_in_pieces(const std::string& text) {
    tcp::socket& raw = peer->next_layer();
    for (std::size_t at = 0; at < text.size(); at += kFragment) {
      const std::string part = text.substr(at, kFragment);
      const bool is_last = at + part.size() == text.size();
      std::string frame;
      frame += static_cast<char>((is_last ? 0x80 : 0) | (at == 0 ? 1 : 0));
      frame += static_cast<char>(part.size());
      frame += part;
      const std::size_t cut = 1 + at / kFragment % 3;
      asio::write(raw, asio::buffer(frame.data(), cut));
      if (at < 3 * kFragment) std::this_thread::sleep_for(std::chrono::microseconds(100));
      asio::write(raw, asio::buffer(frame.data() + cut, frame.size() - cut));
    }
  }
};

struct FakeHaply::Thread {
  std::thread thread;
};

FakeHaply::FakeHaply(std::function<Vec3(double)> wants)
    : wants_(std::move(wants)), socket_(std::make_unique<Socket>()), thread_(std::make_unique<Thread>()) {
  socket_->acceptor.set_option(tcp::socket::receive_buffer_size(4096));  // full of forces that are not heard in no time
  port_ = socket_->acceptor.local_endpoint().port();
  position_ = wants_(0);
  thread_->thread = std::thread([this] { run(); });
}

FakeHaply::~FakeHaply() {
  quits_ = true;
  {
    // Wakes the thread wherever it waits.
    Code ignored;
    asio::io_context io;
    tcp::socket waker(io);
    waker.connect({asio::ip::address_v4::loopback(), port_}, ignored);
    const std::lock_guard lock(mutex_);
    if (socket_->line >= 0) ::shutdown(socket_->line, SHUT_RDWR);
  }
  thread_->thread.join();
}

void FakeHaply::run() {
  while (!quits_) {
    Code error;
    tcp::socket accepted(socket_->io);
    socket_->acceptor.accept(accepted, error);
    if (error || quits_) continue;
    accepted.set_option(tcp::no_delay(true));
    {
      const std::lock_guard lock(mutex_);
      socket_->line = ::dup(accepted.native_handle());
    }
    socket_->peer.emplace(std::move(accepted));
    try {
      serve(*socket_);
    } catch (const std::exception&) {  // the client went away
    }
    is_connected_ = false;
    const std::lock_guard lock(mutex_);
    parting_force_ = force_;
    force_ = Vec3::Zero();  // as the service does for a client that is gone
    socket_->peer.reset();
    ::close(socket_->line);
    socket_->line = -1;
  }
}

void FakeHaply::serve(Socket& socket) {
  socket.peer->accept();
  socket.peer->text(true);
  ++sessions_;
  is_connected_ = true;
  began_ = moved_ = heard_ = seconds();
  socket.peer->write(asio::buffer(fault_ == Fault::kNoArm ? std::string(R"({"inverse3":[]})") : state(true)));
  beast::flat_buffer heard;
  while (!quits_) {
    socket.peer->read(heard);
    hear(beast::buffers_to_string(heard.data()));
    heard.consume(heard.size());
    move_hand();
    const std::string answer = state(false);
    switch (fault_.load()) {
      case Fault::kNone:
        socket.peer->write(asio::buffer(answer));
        break;
      case Fault::kBadJson:
        socket.peer->write(asio::buffer(answer.substr(0, answer.find("cursor_position") + 22)));
        break;
      case Fault::kNoArm:
        socket.peer->write(asio::buffer(std::string(R"({"inverse3":[],"wireless_verse_grip":[]})")));
        break;
      case Fault::kSilence:
        break;
      case Fault::kFragments:
        socket.send_in_pieces(answer);
        break;
      case Fault::kSpeed: {
        nlohmann::json fast = nlohmann::json::parse(answer);
        fast["inverse3"][0]["state"]["cursor_velocity"] = xyz(Vec3(0, 50, 0));
        socket.peer->write(asio::buffer(fast.dump()));
        break;
      }
      case Fault::kHuge:
        socket.peer->write(asio::buffer(answer + std::string(1U << 21U, ' ')));
        break;
      case Fault::kNoText:
        socket.peer->write(asio::buffer(std::string(64, '\xff')));
        break;
      case Fault::kDeaf:
        while (fault_ == Fault::kDeaf && !quits_) {
          socket.peer->write(asio::buffer(state(false)));
          std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        break;
      case Fault::kDeep:
        socket.peer->write(asio::buffer(std::string(100'000, '[')));
        break;
      case Fault::kClose:
        fault_ = Fault::kNone;
        socket.peer->close(beast::websocket::close_code::going_away);
        return;
      case Fault::kDrop:
        fault_ = Fault::kNone;
        socket.peer->next_layer().close();
        return;
    }
  }
}

void FakeHaply::hear(const std::string& text) {
  const nlohmann::json arm = nlohmann::json::parse(text).at("inverse3").at(0);
  const nlohmann::json& values = arm.at("commands").at("set_cursor_force").at("values");
  const Vec3 force(values.at("x"), values.at("y"), values.at("z"));
  const double now = seconds();
  const std::lock_guard lock(mutex_);
  if (arm.at("device_id") != nlohmann::json::parse(id_)) return;
  if (gaps_.size() < 1'000'000) gaps_.push_back(1e6 * (now - heard_));
  heard_ = now;
  force_ = force;
  strongest_ = std::max(strongest_.load(), force.norm());
  ++forces_;
}

/// The hand: a mass on a spring and a damper to where it wants to be, and the arm's force.
void FakeHaply::move_hand() {
  const double now = seconds();
  const double dt = std::min(now - moved_, kLongestStep);
  moved_ = now;
  const std::lock_guard lock(mutex_);
  const Vec3 pull = kStiffness * (wants_(now - began_) - position_) - kDamping * velocity_ + force_;
  velocity_ += dt / kMass * pull;
  position_ += dt * velocity_;
  position_.y() += jump_.exchange(0);
}

std::string FakeHaply::state(bool is_full) {
  const std::lock_guard lock(mutex_);
  nlohmann::json arm = {
      {"device_id", nlohmann::json::parse(id_)},
      {"state", {{"cursor_position", xyz(position_)}, {"cursor_velocity", xyz(velocity_)}, {"mode", "force"}}}};
  const nlohmann::json grip = {{"device_id", "9A01"},
                               {"state",
                                {{"orientation", {{"x", 0}, {"y", 0}, {"z", 0}, {"w", 1}}},
                                 {"buttons", {{"a", false}, {"b", false}, {"c", false}}}}}};
  if (is_full) {
    arm["config"] = {{"device_info", {{"major_version", 3}, {"id", 478}}}, {"type", "inverse3"}};
    arm["status"] = {{"calibrated", true}};
  }
  nlohmann::json all = {{"inverse3", nlohmann::json::array({arm})},
                        {"wireless_verse_grip", nlohmann::json::array({grip})},
                        {"verse_grip", nlohmann::json::array()}};
  if (is_full) all["session_id"] = 1;
  return all.dump();
}

void FakeHaply::set_id(const std::string& id) {
  const std::lock_guard lock(mutex_);
  id_ = id;
  force_ = Vec3::Zero();  // of the arm that is gone
}

Vec3 FakeHaply::force() const {
  const std::lock_guard lock(mutex_);
  return force_;
}

Vec3 FakeHaply::parting_force() const {
  const std::lock_guard lock(mutex_);
  return parting_force_;
}

Vec3 FakeHaply::position() const {
  const std::lock_guard lock(mutex_);
  return position_;
}

std::vector<double> FakeHaply::gaps() const {
  const std::lock_guard lock(mutex_);
  return gaps_;
}

}  // namespace incise::test
