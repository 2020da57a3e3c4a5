// SPDX-License-Identifier: MIT
#include "view/frame_answer.hpp"

#include "view/arrows.hpp"
#include "view/shade.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>

namespace tribo {

const std::string contact_arrows = "contact forces";

namespace {

using Json = nlohmann::json;

/// Numbers of four bytes each, in parts with names.
class Parts {
 public:
  void begin(const char* name, char kind) {
    end();
    list_.push_back({{"name", name}, {"kind", std::string(1, kind)}});
    begun_ = bytes_.size();
  }
  template <class T>
  void add(T value) {
    static_assert(sizeof value == 4);
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    bytes_.append(raw, sizeof value);
  }
  void add_floats(const std::array<double, 3>& x) {
    for (const double v : x) add(static_cast<float>(v));
  }
  void cells(const std::string& name, const CellFrame& frame) {
    begin((name + "_corners").c_str(), 'f');
    for (const auto& x : frame.position) add_floats(x);
    begin((name + "_cells").c_str(), 'u');
    for (const auto& cell : frame.cells) {
      add(static_cast<std::uint32_t>(cell.size()));
      for (const std::uint32_t k : cell) add(k);
    }
  }
  const Json& list() {
    end();
    return list_;
  }
  const std::string& bytes() const { return bytes_; }

 private:
  void end() {
    if (!list_.empty()) list_.back()["length"] = (bytes_.size() - begun_) / 4;
  }
  std::string bytes_;
  std::size_t begun_ = 0;
  Json list_ = Json::array();
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

// The parts of the particles: positions, values, half axes of domains if the file has them, and indices in the file.
void add_particles(Parts& parts, const ParticleFrame& frame, const Drawn& shown, const Shade& shade) {
  parts.begin("positions", 'f');
  for (const auto i : shown.particles) parts.add_floats(frame.position[i]);
  parts.begin("values", 'f');
  for (const auto i : shown.particles) parts.add(static_cast<float>(shade.values[i]));
  parts.begin("axes", 'f');
  if (!frame.domains.empty())
    for (const auto i : shown.particles)
      for (const auto& axis : frame.domains[i])
        for (const double v : axis) parts.add(static_cast<float>(shown.growth * v));
  parts.begin("indices", 'u');
  for (const auto i : shown.particles) parts.add(i);
}

void add_blocks(Parts& parts, const Scene& scene, const CellFrame& blocks, const Wanted& wanted,
                const std::string& field) {
  parts.cells("block", blocks);
  parts.begin("block_values", 'f');
  Scene only;
  only.blocks = blocks;
  const auto* of_blocks = blocks.field(field.substr(0, field.find('.')));
  const Shade shade = of_blocks ? shade_of(only, field) : Shade{field, std::vector<double>(blocks.count(), NAN), false};
  for (const double v : shade.values) parts.add(static_cast<float>(v));
  parts.begin("block_names", 'u');
  const auto* name = blocks.field("block");
  for (std::size_t c = 0; c < blocks.count(); ++c)
    parts.add(static_cast<std::uint32_t>(name ? name->values[c] : static_cast<double>(c + 1)));
  parts.cells("crack", visible_cells(scene.cracks, wanted));
  parts.cells("torn", visible_cells(broken(scene.contacts, 1), wanted));
  parts.cells("sheared", visible_cells(broken(scene.contacts, 2), wanted));
}

// The numbers in a field of integers; none without the field.
Json numbers_in(const ParticleFrame::Field* field) {
  std::set<int> out;
  for (std::size_t i = 0; field && i < field->values.size(); ++i) out.insert(static_cast<int>(field->values[i]));
  return out;
}

// The material of each body, by their numbers.
Json bodies_in(const ParticleFrame& particles) {
  const auto *body = particles.field("body"), *material = particles.field("material");
  std::map<int, int> found;
  for (std::size_t i = 0; body && material && i < body->values.size(); ++i)
    found.emplace(static_cast<int>(body->values[i]), static_cast<int>(material->values[i]));
  Json out = Json::array();
  for (const auto& [number, of] : found)
    if (number > 0) out.push_back({{"number", number}, {"material", of}});
  return out;
}

}  // namespace

std::string frame_answer(const KnownScene& known, const Legend& legend, const FrameRequest& request,
                         const Drawn& shown) {
  const Scene& scene = known.scene;
  const std::string field = request.field.empty() ? default_field(scene) : request.field;
  const Shade shade = shade_of(scene, field);
  Parts parts;
  add_particles(parts, scene.particles, shown, shade);
  add_blocks(parts, scene, visible_cells(scene.blocks, request.wanted), request.wanted, field);
  const Arrows arrows = arrows_of(scene, request.arrows, shown, request.wanted, request.most_arrows);
  parts.begin("arrow_places", 'f');
  for (const auto& x : arrows.places) parts.add_floats(x);
  parts.begin("arrow_vectors", 'f');
  for (const auto& v : arrows.vectors) parts.add_floats(v);
  const Json head{{"time", scene.time},
                  {"count", shown.particles.size()},
                  {"total", scene.particles.count()},
                  {"visible", shown.visible},
                  {"inside", shown.inside},
                  {"growth", shown.growth},
                  {"domains", !scene.particles.domains.empty()},
                  {"box", known.box},
                  {"spacing", known.spacing},
                  {"flat", known.flat},
                  {"range", range_of(shade.values)},
                  {"integers", shade.integers},
                  {"field", shade.name},
                  {"unit", legend.unit_of(shade.name)},
                  {"fields", field_names(scene)},
                  {"vectors", arrow_names(scene)},
                  {"materials", numbers_in(scene.particles.field("material"))},
                  {"bodies", bodies_in(scene.particles)},
                  {"groups", numbers_in(scene.blocks.field("group"))},
                  {"blocks", scene.blocks.count()},
                  {"arrow_unit", legend.unit_of(arrows.field)},
                  {"arrow_largest", arrows.largest},
                  {"arrow_total", arrows.total},
                  {"parts", parts.list()}};
  std::string out = head.dump(-1, ' ', false, Json::error_handler_t::replace);
  out += std::string((4 - (out.size() + 1) % 4) % 4, ' ') + "\n";  // numbers begin at a multiple of four
  return out + parts.bytes();
}

}  // namespace tribo
