// SPDX-License-Identifier: Apache-2.0
// The service's end of a WebSocket (RFC 6455), for one client at a time: enough of it for tests, and no more. The
// library beside it is Boost.Beast, which takes half a minute to compile and would be at both ends.
#pragma once

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <string>
#include <string_view>

namespace incise::test {

class WebSocketServer {
 public:
  /// Listens on a free port of this machine; the sockets of its clients take few bytes that are not read.
  WebSocketServer();
  ~WebSocketServer();
  WebSocketServer(const WebSocketServer&) = delete;
  WebSocketServer& operator=(const WebSocketServer&) = delete;

  [[nodiscard]] std::uint16_t port() const { return port_; }
  /// Ends what waits now, and whatever is begun later; of any thread.
  void stop();

  // Of one thread. All but `close` and `drop` throw std::runtime_error where the client has gone.

  /// Waits for a client and agrees with it.
  void accept();
  /// The next message; answers a closing handshake.
  std::string read();
  void write(std::string_view text);
  /// Bytes as they are.
  void write_raw(const char* bytes, std::size_t count);
  /// Says that it goes away, and waits for the answer.
  void close();
  /// Breaks off.
  void drop();

 private:
  void fill(char* bytes, std::size_t count);

  int listener_ = -1;
  std::uint16_t port_ = 0;
  std::mutex mutex_;  // of what `stop` shares with the one thread
  int client_ = -1;
  bool is_stopped_ = false;
};

}  // namespace incise::test
