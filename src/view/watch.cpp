// SPDX-License-Identifier: MIT
#include "view/watch.hpp"

#include "base/error.hpp"
#include "view/local_server.hpp"
#include "view/page.hpp"
#include "view/page_answers.hpp"

#include <signal.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace tribo {
namespace {

httplib::Server* running_server = nullptr;
void stop_server(int) {
  if (running_server) running_server->stop();
}

std::string text_in(const httplib::Request& q, const char* name) {
  return q.has_param(name) ? q.get_param_value(name) : std::string();
}

double number_in(const std::string& text, const char* name) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !std::isfinite(value))
    throw UsageError(std::string("'") + name + "' is not a number");
  return value;
}

std::vector<std::string> list_in(const httplib::Request& q, const char* name, char between) {
  std::vector<std::string> out;
  std::string text = text_in(q, name);
  while (!text.empty()) {
    const auto at = std::min(text.find(between), text.size());
    out.push_back(text.substr(0, at));
    text.erase(0, at + 1);
  }
  return out;
}

std::set<int> numbers_in(const httplib::Request& q, const char* name) {
  std::set<int> out;
  for (const auto& one : list_in(q, name, ','))
    out.insert(static_cast<int>(std::clamp(number_in(one, name), 0.0, 1e9)));
  return out;
}

// `x<1.5,y>2`: what lies above 1.5 in x and below 2 in y is left out.
std::vector<Section> sections_in(const httplib::Request& q) {
  std::vector<Section> out;
  for (const auto& one : list_in(q, "sections", ',')) {
    const auto axis = std::string("xyz").find(one.substr(0, 1));
    if (one.size() < 3 || axis == std::string::npos || (one[1] != '<' && one[1] != '>'))
      throw UsageError("a section is written as 'x<1.5'");
    out.push_back({axis, number_in(one.substr(2), "sections"), one[1] == '<'});
  }
  return out;
}

FrameRequest frame_in(const httplib::Request& q) {
  FrameRequest out;
  out.field = text_in(q, "field"), out.arrows = text_in(q, "arrows");
  out.wanted.hidden = numbers_in(q, "hidden"), out.wanted.hidden_bodies = numbers_in(q, "bodies");
  out.wanted.hidden_groups = numbers_in(q, "groups");
  out.wanted.sections = sections_in(q);
  const auto count = [&](const char* name, std::size_t otherwise) {
    return q.has_param(name) ? static_cast<std::size_t>(std::clamp(number_in(text_in(q, name), name), 1.0, 1e9))
                             : otherwise;
  };
  out.wanted.most = count("most", out.wanted.most), out.most_arrows = count("most_arrows", out.most_arrows);
  return out;
}

std::array<double, 3> place_in(const httplib::Request& q) {
  return {number_in(text_in(q, "x"), "x"), number_in(text_in(q, "y"), "y"), number_in(text_in(q, "z"), "z")};
}

Picked picked_in(const httplib::Request& q) {
  Picked out;
  const std::string kind = text_in(q, "kind");
  if (kind == "block")
    out.kind = Picked::Kind::block;
  else if (kind == "contact")
    out.kind = Picked::Kind::contact;
  else if (kind != "particle")
    throw UsageError("'kind' is particle, block or contact");
  out.numbers[0] = number_in(text_in(q, "number"), "number");
  if (out.kind == Picked::Kind::contact) out.numbers[1] = number_in(text_in(q, "other"), "other");
  return out;
}

void refuse_strangers(LocalServer& server) {
  // Names of other machines that lead here are refused, so that no page from elsewhere reads a run through a browser.
  server.set_pre_routing_handler([](const httplib::Request& request, httplib::Response& response) {
    const std::string host = request.get_header_value("Host"), name = host.substr(0, host.rfind(':'));
    if (name == "127.0.0.1" || name == "localhost") return httplib::Server::HandlerResponse::Unhandled;
    response.status = 403;
    return httplib::Server::HandlerResponse::Handled;
  });
  server.set_exception_handler(
      [](const httplib::Request&, httplib::Response& response, const std::exception_ptr& thrown) {
        response.status = 400;
        try {
          std::rethrow_exception(thrown);
        } catch (const std::exception& error) {
          response.set_content(error.what(), "text/plain");
        }
      });
}

void serve_page(LocalServer& server, const std::string& base) {
  for (const PageFile& file : page_files())
    server.Get(base + "/" + std::string(file.name == "page.html" ? "" : file.name),
               [file](const httplib::Request&, httplib::Response& response) {
                 for (const auto& [name, value] : LocalServer::page_headers()) response.set_header(name, value);
                 response.set_content(file.text.data(), file.text.size(), std::string(file.type));
               });
}

void serve_answers(LocalServer& server, const std::string& base, PageAnswers& answers) {
  using Q = httplib::Request;
  const auto json = [&](const std::string& path, auto answer) {
    server.Get(base + path,
               [answer](const Q& q, httplib::Response& r) { r.set_content(answer(q), "application/json"); });
  };
  const auto number = [](const Q& q, int k) { return std::stoul(q.matches[k]); };
  json("/state", [&](const Q&) { return answers.state(); });
  json("/tables", [&](const Q&) { return answers.tables(); });
  json("/layers", [&](const Q&) { return answers.layers(); });
  json("/range", [&](const Q& q) { return answers.range(text_in(q, "field")); });
  json(R"(/particle/(\d{1,9})/(\d{1,9}))",
       [&answers, number](const Q& q) { return answers.particle(number(q, 1), number(q, 2)); });
  json(R"(/block/(\d{1,9})/(\d{1,9}))", [&answers, number](const Q& q) {
    return answers.block(number(q, 1), static_cast<double>(number(q, 2)), place_in(q));
  });
  json(R"(/values/(\d{1,9}))", [&answers, number](const Q& q) { return answers.values(number(q, 1), picked_in(q)); });
  json("/history", [&](const Q& q) { return answers.history(picked_in(q)); });
  server.Get(base + "/charts", [&](const Q&, httplib::Response& r) { r.set_content(answers.charts(), "text/html"); });
  server.Get(base + R"(/frame/(\d{1,9}))", [&answers, number](const Q& q, httplib::Response& r) {
    r.set_content(answers.frame(number(q, 1), frame_in(q)), "application/octet-stream");
  });
  server.Get(base + R"(/picture/(\d{1,9}))", [&answers, number](const Q& q, httplib::Response& r) {
    r.set_content(answers.image(number(q, 1), text_in(q, "field")), "image/png");
  });
}

void serve_commands(LocalServer& server, const std::string& base, const PageAnswers& answers) {
  // A header that forms and links of other pages cannot send
  const auto command = [&](int signal) {
    return [&answers, signal](const httplib::Request& q, httplib::Response& r) {
      if (!q.has_header("X-Tribo")) {
        r.status = 403;
        return;
      }
      r.set_content(answers.tell(signal) ? R"({"sent":true})" : R"({"sent":false})", "application/json");
    };
  };
  server.Post(base + "/stop", command(SIGTERM));
  server.Post(base + "/checkpoint", command(SIGUSR1));
}

}  // namespace

void watch(const RunFolder& run, const WatchOptions& options) {
  PageAnswers answers(run);
  LocalServer server;
  const std::string base = "/" + server.token();
  refuse_strangers(server);
  serve_page(server, base), serve_answers(server, base, answers), serve_commands(server, base, answers);

  const std::string here = "127.0.0.1";
  int port = options.port;
  if (port == 0)
    port = server.bind_to_any_port(here);
  else if (!server.bind_to_port(here, port))
    port = -1;
  if (port <= 0)
    throw FileError("port " + std::to_string(options.port) + " of this machine is taken; --port names another");
  running_server = &server;
  const auto old_interrupt = std::signal(SIGINT, stop_server), old_terminate = std::signal(SIGTERM, stop_server);
  const auto old_hangup = std::signal(SIGHUP, SIG_IGN);  // which stays so under nohup
  if (old_hangup != SIG_IGN) std::signal(SIGHUP, stop_server);
  if (options.ready) options.ready("http://" + here + ":" + std::to_string(port) + base + "/");
  server.listen_after_bind();
  std::signal(SIGINT, old_interrupt), std::signal(SIGTERM, old_terminate), std::signal(SIGHUP, old_hangup);
  running_server = nullptr;
}

}  // namespace tribo
