// SPDX-License-Identifier: MIT
/// The web server of the live page: one request per connection, with limits on its size and time, and headers that keep
/// other pages out.
#pragma once

#include <httplib.h>

#include <string>

namespace tribo {

class LocalServer : public httplib::Server {
 public:
  LocalServer();
  /// A random word of the address, without which nothing is answered: other users of the machine do not know it.
  const std::string& token() const { return token_; }
  /// The headers of the page, on which only scripts of this server run.
  static httplib::Headers page_headers();

 private:
  bool process_and_close_socket(socket_t socket) override;

  std::string token_;
};

/// 32 random hexadecimal digits of the operating system.
std::string random_word();

}  // namespace tribo
