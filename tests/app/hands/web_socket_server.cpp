// SPDX-License-Identifier: Apache-2.0
#include "app/hands/web_socket_server.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <stdexcept>

namespace incise::test {
namespace {

constexpr int kReceiveBuffer = 4096;  // bytes: full of messages that are not read in no time
constexpr std::size_t kMostHeader = 8192, kMostBytes = 1U << 24U;
constexpr unsigned kContinuation = 0, kText = 1, kClose = 8, kPing = 9, kPong = 10;  // kinds of frames

using Words = std::array<std::uint32_t, 5>;

/// One block of SHA-1 (FIPS 180-4).
void add_block(const std::string& text, std::size_t at, Words& sum) {
  std::array<std::uint32_t, 80> w{};
  for (std::size_t i = 0; i < 64; ++i) w[i / 4] = w[i / 4] << 8U | static_cast<unsigned char>(text[at + i]);
  for (std::size_t i = 16; i < 80; ++i) w[i] = std::rotl(w[i - 3] ^ w[i - 8] ^ w[i - 14] ^ w[i - 16], 1);
  auto [a, b, c, d, e] = sum;
  for (std::size_t i = 0; i < 80; ++i) {
    std::uint32_t f = b ^ c ^ d, k = i < 40 ? 0x6ed9eba1U : 0xca62c1d6U;
    if (i < 20) {
      f = (b & c) | (~b & d);
      k = 0x5a827999U;
    } else if (i >= 40 && i < 60) {
      f = (b & c) | (b & d) | (c & d);
      k = 0x8f1bbcdcU;
    }
    const std::uint32_t next = std::rotl(a, 5) + f + e + k + w[i];
    e = d;
    d = c;
    c = std::rotl(b, 30);
    b = a;
    a = next;
  }
  const Words more = {a, b, c, d, e};
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += more[i];
}

std::string sha1(std::string text) {
  const std::uint64_t bits = 8 * text.size();
  text += '\x80';
  while (text.size() % 64 != 56) text += '\0';
  for (unsigned i = 0; i < 8; ++i) text += static_cast<char>(bits >> (56U - 8U * i));
  Words sum = {0x67452301U, 0xefcdab89U, 0x98badcfeU, 0x10325476U, 0xc3d2e1f0U};
  for (std::size_t at = 0; at < text.size(); at += 64) add_block(text, at, sum);
  std::string bytes;
  for (const std::uint32_t word : sum) {
    for (unsigned i = 0; i < 4; ++i) bytes += static_cast<char>(word >> (24U - 8U * i));
  }
  return bytes;
}

std::string base64(const std::string& bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t at = 0; at < bytes.size(); at += 3) {
    std::uint32_t three = 0;
    for (std::size_t i = at; i < at + 3; ++i) {
      three = three << 8U | (i < bytes.size() ? static_cast<unsigned char>(bytes[i]) : 0U);
    }
    for (std::size_t i = 0; i < 4; ++i) {
      text += at + i <= bytes.size() ? kDigits[three >> (18U - 6U * static_cast<unsigned>(i)) & 63U] : '=';
    }
  }
  return text;
}

/// The value of the key in a client's request.
std::string key_of(std::string request) {
  constexpr std::string_view kName = "\nsec-websocket-key:";
  const std::string as_is = request;
  std::transform(request.begin(), request.end(), request.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  const std::size_t found = request.find(kName);
  if (found == std::string::npos) throw std::runtime_error("a request without a key");
  const std::size_t first = request.find_first_not_of(' ', found + kName.size());
  return as_is.substr(first, request.find_first_of(" \r", first) - first);
}

std::string header_of(unsigned kind, std::size_t size) {
  std::string header(1, static_cast<char>(0x80U | kind));
  const unsigned more = size < 126 ? 0 : size < 65536 ? 2 : 8;  // bytes of the length
  header += static_cast<char>(more == 0 ? size : more == 2 ? 126 : 127);
  for (unsigned i = more; i-- > 0;) header += static_cast<char>(std::uint64_t{size} >> (8U * i));
  return header;
}

}  // namespace

WebSocketServer::WebSocketServer() : listener_(::socket(AF_INET, SOCK_STREAM, 0)) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof(address);
  auto* place = reinterpret_cast<sockaddr*>(&address);
  ::setsockopt(listener_, SOL_SOCKET, SO_RCVBUF, &kReceiveBuffer, sizeof(kReceiveBuffer));
  if (listener_ < 0 || ::bind(listener_, place, size) != 0 || ::listen(listener_, 8) != 0 ||
      ::getsockname(listener_, place, &size) != 0) {
    throw std::runtime_error("no port to listen on");
  }
  port_ = ntohs(address.sin_port);
}

WebSocketServer::~WebSocketServer() {
  drop();
  ::close(listener_);
}

void WebSocketServer::stop() {
  const std::lock_guard lock(mutex_);
  is_stopped_ = true;
  ::shutdown(listener_, SHUT_RDWR);
  if (client_ >= 0) ::shutdown(client_, SHUT_RDWR);
}

void WebSocketServer::accept() {
  drop();
  const int client = ::accept(listener_, nullptr, nullptr);
  {
    const std::lock_guard lock(mutex_);
    client_ = client;
    if (is_stopped_ || client < 0) throw std::runtime_error("nobody came");
  }
  const int is_on = 1;
  ::setsockopt(client_, IPPROTO_TCP, TCP_NODELAY, &is_on, sizeof(is_on));
  std::string request;
  while (request.size() < 4 || request.compare(request.size() - 4, 4, "\r\n\r\n") != 0) {
    if (request.size() > kMostHeader) throw std::runtime_error("a request without an end");
    char next = 0;
    fill(&next, 1);
    request += next;
  }
  const std::string answer =
      "HTTP/1.1 101 Switching Protocols\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Accept: " +
      base64(sha1(key_of(request) + "258EAFA5-E914-47DA-95CA-C5AB0DC85B11")) + "\r\n\r\n";
  write_raw(answer.data(), answer.size());
}

void WebSocketServer::fill(char* bytes, std::size_t count) {
  while (count > 0) {
    const ssize_t got = ::recv(client_, bytes, count, 0);
    if (got <= 0) throw std::runtime_error("the client has gone");
    bytes += got;
    count -= static_cast<std::size_t>(got);
  }
}

void WebSocketServer::write_raw(const char* bytes, std::size_t count) {
  while (count > 0) {
    const ssize_t sent = ::send(client_, bytes, count, MSG_NOSIGNAL);
    if (sent <= 0) throw std::runtime_error("the client has gone");
    bytes += sent;
    count -= static_cast<std::size_t>(sent);
  }
}

void WebSocketServer::write(std::string_view text) {
  const std::string frame = header_of(kText, text.size()) + std::string(text);
  write_raw(frame.data(), frame.size());
}

std::string WebSocketServer::read() {
  std::string message;
  for (;;) {
    std::array<char, 8> bytes{};
    fill(bytes.data(), 2);
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(bytes[i]); };
    const unsigned kind = byte(0) & 15U;
    const bool is_last = (byte(0) & 128U) != 0;
    std::size_t size = byte(1) & 127U;
    if ((byte(1) & 128U) == 0) throw std::runtime_error("a client's frame without a mask");
    if (size >= 126) {
      const std::size_t more = size == 126 ? 2 : 8;
      fill(bytes.data(), more);
      size = 0;
      for (std::size_t i = 0; i < more; ++i) size = size << 8U | byte(i);
    }
    if (size > kMostBytes) throw std::runtime_error("a frame that is too long");
    std::array<char, 4> mask{};
    fill(mask.data(), mask.size());
    std::string part(size, '\0');
    fill(part.data(), size);
    for (std::size_t i = 0; i < size; ++i) part[i] = static_cast<char>(part[i] ^ mask[i % 4]);
    if (kind == kClose || kind == kPing) {
      const std::string answer = header_of(kind == kPing ? kPong : kClose, size) + part;
      write_raw(answer.data(), answer.size());
      if (kind == kClose) throw std::runtime_error("the client has gone");
    } else if (kind == kText || kind == kContinuation) {
      message += part;
      if (is_last) return message;
    }
  }
}

void WebSocketServer::close() {
  const std::string frame = header_of(kClose, 2) + "\x03\xe9";  // 1001: going away
  try {
    write_raw(frame.data(), frame.size());
    for (;;) read();
  } catch (const std::runtime_error&) {  // the answer, or the client has gone before
  }
}

void WebSocketServer::drop() {
  const std::lock_guard lock(mutex_);
  if (client_ >= 0) ::close(client_);
  client_ = -1;
}

}  // namespace incise::test
