// SPDX-License-Identifier: MIT
#include "view/watch.hpp"

#include "base/error.hpp"
#include "view/local_server.hpp"
#include "view/page.hpp"
#include "view/picture.hpp"
#include "view/report.hpp"

#include <signal.h>

#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>

namespace tribo {
namespace {

using Json = nlohmann::json;

httplib::Server* running_server = nullptr;
void stop_server(int) {
  if (running_server) running_server->stop();
}

// The process that writes the run, if it is a running process of this user; else 0.
pid_t process_of(const Json& record) {
  const auto status = record.find("status"), process = record.find("process");
  if (status == record.end() || *status != "running" || process == record.end() || !process->is_number_integer())
    return 0;
  const auto pid = process->get<pid_t>();
  if (pid <= 1) return 0;
  std::error_code none;
  const auto program = std::filesystem::read_symlink("/proc/" + std::to_string(pid) + "/exe", none);
  return program.filename().string().rfind("tribo", 0) == 0 ? pid : 0;
}

void answer(httplib::Response& response, const Json& json) {
  response.set_content(json.dump(-1, ' ', false, Json::error_handler_t::replace), "application/json");
}

/// Numbers of four bytes each.
struct Numbers {
  std::string bytes;

  template <class T>
  void add(T value) {
    static_assert(sizeof value == 4);
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    bytes.append(raw, sizeof value);
  }
  template <class Iterator>
  void floats(Iterator begin, Iterator end) {
    for (; begin != end; ++begin) add(static_cast<float>(*begin));
  }
  void places(const std::vector<std::array<double, 3>>& list) {
    for (const auto& x : list) floats(x.begin(), x.end());
  }
  void cells(const CellFrame& frame) {
    for (const auto& cell : frame.cells) {
      add(static_cast<std::uint32_t>(cell.size()));
      for (const std::uint32_t k : cell) add(k);
    }
  }
};

// Faces of contacts whose bond broke: 1 in tension, 2 in shear.
CellFrame broken(const CellFrame& contacts, double how) {
  CellFrame out;
  const auto* broke = contacts.field("broke");
  for (std::size_t c = 0; broke && c < contacts.count(); ++c) {
    if (broke->values[c] != how) continue;
    out.cells.emplace_back();
    for (const auto k : contacts.cells[c]) {
      out.cells.back().push_back(static_cast<std::uint32_t>(out.position.size()));
      out.position.push_back(contacts.position[k]);
    }
  }
  return out;
}

// Fields for the colours of particles or blocks.
std::vector<std::string> field_names(const Scene& scene) {
  std::vector<std::string> out;
  const auto take = [&](const std::vector<ParticleFrame::Field>& fields) {
    for (const auto& f : fields) {
      std::vector<std::string> names;
      if (f.components <= 3) names.push_back(f.name);
      if (f.components == 3)
        for (const char* c : {".x", ".y", ".z"}) names.push_back(f.name + c);
      if (f.components == 6)
        for (const char* c : {".xx", ".yy", ".zz", ".xy", ".yz", ".xz"}) names.push_back(f.name + c);
      for (const auto& name : names)
        if (std::find(out.begin(), out.end(), name) == out.end()) out.push_back(name);
    }
  };
  take(scene.particles.fields), take(scene.blocks.fields);
  return out;
}

/// Requests of the page.
class Answers {
 public:
  explicit Answers(const RunFolder& run) : run_(run) {}

  Json state() const {
    Json state = Json::parse(run_.provenance(), nullptr, false);
    if (!state.is_object()) state = Json::object();
    if (state.contains("status") && state["status"] == "running" && process_of(state) == 0) state["status"] = "lost";
    state["folder"] = run_.path().string();
    for (const auto& frame : run_.frames()) state["times"].push_back(frame.time);
    return state;
  }

  // A line of JSON, then what it counts as 32-bit numbers: places and values of particles, nine components of their
  // half axes if the file has domains, places of the corners of blocks, their values, and for each block the number of
  // its corners and which; the same of faces whose bonds broke.
  std::string frame(std::size_t k, const std::string& field) const {
    const Scene scene = run_.scene(entry(k));
    const Shade shade = shade_of(scene, field.empty() ? default_field(scene) : field);
    const auto box = box_of(scene);
    const Legend legend = run_.legend();
    const CellFrame &blocks = scene.blocks, torn = broken(scene.contacts, 1), sheared = broken(scene.contacts, 2);
    const auto count = static_cast<std::ptrdiff_t>(scene.particles.count());
    Numbers body;
    body.places(scene.particles.position);
    body.floats(shade.values.begin(), shade.values.begin() + count);
    for (const HalfAxes& axes : scene.particles.domains) body.places({axes.begin(), axes.end()});
    body.places(blocks.position);
    body.floats(shade.values.begin() + count, shade.values.end());
    body.cells(blocks);
    for (const CellFrame* faces : {&torn, &sheared}) body.places(faces->position), body.cells(*faces);
    const auto sizes = [](const CellFrame& f) {
      std::size_t length = f.count();
      for (const auto& c : f.cells) length += c.size();
      return Json{{"corners", f.position.size()}, {"cells", f.count()}, {"length", length}};
    };
    const Json head{{"time", scene.time},
                    {"count", count},
                    {"domains", !scene.particles.domains.empty()},
                    {"blocks", sizes(blocks)},
                    {"torn", sizes(torn)},
                    {"sheared", sizes(sheared)},
                    {"spacing", spacing_of(scene.particles.position)},
                    {"range", range_of(shade.values)},
                    {"integers", shade.integers},
                    {"flat", box[1][2] - box[0][2] <= 0},
                    {"field", shade.name},
                    {"unit", legend.unit_of(shade.name)},
                    {"names", shade.name == "material" ? legend.materials : std::vector<std::string>()},
                    {"fields", field_names(scene)}};
    std::string out = head.dump(-1, ' ', false, Json::error_handler_t::replace);
    out += std::string((4 - (out.size() + 1) % 4) % 4, ' ') + "\n";  // numbers begin at a multiple of four
    return out + body.bytes;
  }

  std::string image(std::size_t k, const std::string& field) const {
    const Scene scene = run_.scene(entry(k));
    const Legend legend = run_.legend();
    PictureOptions options;
    options.field = field.empty() ? default_field(scene) : field;
    options.unit = legend.unit_of(options.field), options.time_unit = legend.time, options.length_unit = legend.length;
    options.materials = legend.materials;
    return picture(scene, options);
  }

  std::string charts() const { return report_charts(run_); }

  // Sends a signal to the run; false if it does not run.
  bool tell(int signal) const {
    const Json record = Json::parse(run_.provenance(), nullptr, false);
    const pid_t pid = record.is_object() ? process_of(record) : 0;
    return pid > 0 && ::kill(pid, signal) == 0;
  }

 private:
  CollectionEntry entry(std::size_t k) const {
    const auto frames = run_.frames();
    if (k >= frames.size()) throw FileError("there is no such file yet");
    return frames[k];
  }
  const RunFolder& run_;
};

}  // namespace

void watch(const RunFolder& run, const WatchOptions& options) {
  const Answers answers(run);
  LocalServer server;
  const std::string base = "/" + server.token();
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
  server.Get(base + "/", [](const httplib::Request&, httplib::Response& response) {
    const std::string nonce = random_word(), plain = "<script>";
    std::string page(watch_page());
    if (const auto at = page.find(plain); at != std::string::npos)
      page.replace(at, plain.size(), "<script nonce=\"" + nonce + "\">");
    for (const auto& [name, value] : LocalServer::page_headers(nonce)) response.set_header(name, value);
    response.set_content(page, "text/html; charset=utf-8");
  });
  server.Get(base + "/vtk.js", [](const httplib::Request&, httplib::Response& response) {
    const auto script = vtk_js();
    response.set_content(script.data(), script.size(), "text/javascript");
  });
  server.Get(base + "/state", [&](const httplib::Request&, httplib::Response& r) { answer(r, answers.state()); });
  server.Get(base + "/charts",
             [&](const httplib::Request&, httplib::Response& r) { r.set_content(answers.charts(), "text/html"); });
  const auto field = [](const httplib::Request& q) {
    return q.has_param("field") ? q.get_param_value("field") : std::string();
  };
  server.Get(base + R"(/frame/(\d{1,9}))", [&](const httplib::Request& q, httplib::Response& r) {
    r.set_content(answers.frame(std::stoul(q.matches[1]), field(q)), "application/octet-stream");
  });
  server.Get(base + R"(/picture/(\d{1,9}))", [&](const httplib::Request& q, httplib::Response& r) {
    r.set_content(answers.image(std::stoul(q.matches[1]), field(q)), "image/png");
  });
  // A header that forms and links of other pages cannot send
  const auto command = [&](int signal) {
    return [&answers, signal](const httplib::Request& q, httplib::Response& r) {
      if (!q.has_header("X-Tribo")) {
        r.status = 403;
        return;
      }
      answer(r, {{"sent", answers.tell(signal)}});
    };
  };
  server.Post(base + "/stop", command(SIGTERM));
  server.Post(base + "/checkpoint", command(SIGUSR1));

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
  if (options.ready) options.ready("http://" + here + ":" + std::to_string(port) + base + "/");
  server.listen_after_bind();
  std::signal(SIGINT, old_interrupt), std::signal(SIGTERM, old_terminate);
  running_server = nullptr;
}

}  // namespace tribo
