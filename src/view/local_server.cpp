// SPDX-License-Identifier: MIT
#include "view/local_server.hpp"

#include "base/error.hpp"

#include <poll.h>
#include <sys/random.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>

namespace tribo {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t most_read = 16384;  // bytes of a request
constexpr auto time_to_read = std::chrono::seconds(5), time_to_write = std::chrono::seconds(60);

/// A connection that must bring its whole request, and take its whole answer, within a limited time.
class LimitedStream final : public httplib::Stream {
 public:
  explicit LimitedStream(socket_t socket) : socket_(socket) {}

  bool is_readable() const override { return waits(POLLIN, read_until_); }
  bool is_writable() const override { return waits(POLLOUT, write_until_); }
  ssize_t read(char* to, std::size_t size) override {
    if (used_ >= most_read || !is_readable()) return -1;
    const ssize_t n = ::recv(socket_, to, std::min(size, most_read - used_), 0);
    if (n > 0) used_ += static_cast<std::size_t>(n);
    return n;
  }
  ssize_t write(const char* from, std::size_t size) override {
    return is_writable() ? ::send(socket_, from, size, MSG_NOSIGNAL) : -1;
  }
  void get_remote_ip_and_port(std::string& ip, int& port) const override { ip = "127.0.0.1", port = 0; }
  void get_local_ip_and_port(std::string& ip, int& port) const override { ip = "127.0.0.1", port = 0; }
  socket_t socket() const override { return socket_; }

 private:
  bool waits(short what, Clock::time_point until) const {
    while (true) {
      const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(until - Clock::now()).count();
      if (left <= 0) return false;
      pollfd one{socket_, what, 0};
      const int n = ::poll(&one, 1, static_cast<int>(left));
      if (n > 0) return true;
      if (n == 0 || errno != EINTR) return false;
    }
  }

  socket_t socket_;
  std::size_t used_ = 0;
  Clock::time_point read_until_ = Clock::now() + time_to_read, write_until_ = Clock::now() + time_to_write;
};

}  // namespace

std::string random_word() {
  unsigned char bytes[16];
  if (::getrandom(bytes, sizeof bytes, 0) != static_cast<ssize_t>(sizeof bytes))
    throw FileError("the operating system gives no random numbers");
  std::string out;
  for (const unsigned char byte : bytes)
    for (const int digit : {byte / 16, byte % 16}) out += "0123456789abcdef"[digit];
  return out;
}

LocalServer::LocalServer() : token_(random_word()) {
  set_payload_max_length(1024);
  set_default_headers({{"X-Frame-Options", "DENY"},
                       {"X-Content-Type-Options", "nosniff"},
                       {"Referrer-Policy", "no-referrer"},
                       {"Cache-Control", "no-store"}});
}

httplib::Headers LocalServer::page_headers() {
  return {{"Content-Security-Policy",
           "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; "
           "connect-src 'self'; worker-src blob:; "
           "base-uri 'none'; form-action 'none'; frame-ancestors 'none'"}};
}

bool LocalServer::process_and_close_socket(socket_t socket) {
  LimitedStream stream(socket);
  bool closed = false;
  const bool answered = process_request(stream, true, closed, nullptr);
  ::shutdown(socket, SHUT_RDWR);
  ::close(socket);
  return answered;
}

}  // namespace tribo
