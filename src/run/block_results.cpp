// SPDX-License-Identifier: MIT
#include "run/block_results.hpp"

#include "model/block_quantities.hpp"
#include "output/number.hpp"
#include "run/block_history_source.hpp"
#include "run/joint_columns.hpp"
#include "run/result_folder.hpp"

#include <cmath>
#include <numbers>

namespace tribo {
namespace {

std::vector<std::string> energy_columns(const Model& model) {
  std::vector<std::string> columns{"time",    "kinetic",  "strain",     "potential",     "slip",    "dashpot",
                                   "damping", "released", "outer_work", "boundary_work", "residual"};
  if (model.stage.count > 0 && model.only_blocks()) columns.emplace_back("stages");
  return columns;
}
std::vector<std::string> event_columns() {
  std::vector<std::string> columns{"time", "contact", "block1", "block2", "x", "y", "z"};
  for (const auto& name : joint_event_columns()) columns.push_back(name);
  return columns;
}

/// Polygons of a block at its present position: its faces, or polygons that approximate a ball.
std::vector<std::vector<Vec3>> outlines(const BlockShape& shape, const BlockMotion& m, bool plane) {
  constexpr double pi = std::numbers::pi;
  std::vector<std::vector<Vec3>> out;
  const auto at = [&](const Vec3& x) { return Vec3(m.x + m.R * x); };
  if (shape.ball() && plane) {
    constexpr int corners = 32;
    out.emplace_back();
    for (int k = 0; k < corners; ++k)
      out[0].push_back(at(shape.radius * Vec3(std::cos(2 * pi * k / corners), std::sin(2 * pi * k / corners), 0)));
  } else if (shape.ball()) {
    constexpr int rings = 8, sectors = 16;
    const auto point = [&](int i, int j) {
      const double a = pi * i / rings, b = 2 * pi * j / sectors;
      return at(shape.radius * Vec3(std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a)));
    };
    for (int i = 0; i < rings; ++i)
      for (int j = 0; j < sectors; ++j)
        out.push_back({point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)});
  } else if (plane) {
    out.emplace_back();
    for (const Vec3& x : shape.corners) out[0].push_back(at(x));
  } else {
    for (std::size_t f = 0; f < shape.faces.size(); ++f) {
      out.push_back(shape.face(f));
      for (Vec3& x : out.back()) x = at(x);
    }
  }
  return out;
}

/// Cells with their corners and fields, ready to be written.
struct Cells {
  Columns points, fields;
  std::vector<std::uint32_t> corners;
  std::vector<std::size_t> ends;
  void add(const std::vector<Vec3>& outline) {
    for (const Vec3& x : outline) {
      corners.push_back(static_cast<std::uint32_t>(corners.size()));
      points.vector("position", x);
    }
    ends.push_back(corners.size());
  }
  std::size_t bytes() const {
    return points.bytes() + fields.bytes() + corners.size() * sizeof(corners[0]) + ends.size() * sizeof(ends[0]);
  }
  void check() const {
    check_numbers(points.size(), points.positions(), {});
    check_numbers(ends.size(), {}, fields.fields());
  }
  void write(const std::filesystem::path& path, double time) const {
    write_cells(path, points.size(), points.positions(), corners, ends, fields.fields(), time);
  }
};

}  // namespace

BlockResults::BlockResults(const Model& model, Assembly& blocks, std::filesystem::path folder,
                           std::optional<double> resume_time, OutputQueue& queue)
    : model_(model),
      blocks_(blocks),
      folder_(std::move(folder)),
      queue_(queue),
      cells_(folder_ / "blocks.pvd"),
      contacts_(folder_ / "contacts.pvd") {
  const bool alone = !model.blocks->in_grid;
  const auto open = [&](std::optional<History>& file, const std::string& name, const std::vector<std::string>& names) {
    if (resume_time)
      file.emplace(History::resume(folder_ / name, names, *resume_time, &queue));
    else
      file.emplace(folder_ / name, names, &queue);
  };
  std::vector<std::string> columns_of_history{"time"};
  for (const auto& name : columns(model)) columns_of_history.push_back(name);
  if (alone) open(history_, "history.csv", columns_of_history);
  open(energy_, alone ? "energy.csv" : "block_energy.csv", energy_columns(model));
  open(events_, alone ? "events.csv" : "block_events.csv", event_columns());
  if (resume_time)
    cells_.resume(*resume_time), contacts_.resume(*resume_time);
  else
    initial_energy = blocks.ledger().content();
}

ResultNames BlockResults::names(const Model& model) {
  ResultNames out{{"blocks.pvd", "contacts.pvd"}, {"blocks", "contacts"}};
  if (model.blocks->in_grid)
    out.add({{"block_energy.csv", "block_events.csv"}, {}});
  else
    out.add({{"events.csv"}, {}});
  return out;
}

std::vector<std::string> BlockResults::columns(const Model& model) {
  std::vector<std::string> out;
  for (const auto& q : model.blocks->histories) out.push_back(q.column);
  return out;
}

std::vector<double> BlockResults::values(double dt) const {
  std::vector<double> out;
  for (const auto& q : model_.blocks->histories) {
    using Of = BlockQuantityInfo::Of;
    const auto* info = find_block_quantity(q.name, q.group >= 0 ? Of::block : q.platen >= 0 ? Of::platen : Of::run);
    if (!info) throw std::logic_error("no such quantity: " + q.name);
    out.push_back(info->value(AssemblyHistorySource(blocks_, q, dt)));
  }
  return out;
}

void BlockResults::write_files(std::int64_t number) {
  if (!model_.blocks->in_grid) queue_.begin(blocks_.step);
  write_blocks(number);
  write_contacts(number);
}

void BlockResults::write_blocks(std::int64_t number) {
  const auto all = std::make_shared<Cells>();
  Cells& out = *all;
  std::vector<double> strain(blocks_.bodies.size(), 0.0);
  for (std::size_t c = 0; c < blocks_.contacts.size(); ++c)
    for (const auto body : {blocks_.contacts[c].a, blocks_.contacts[c].b})
      strain[body] += 0.5 * blocks_.joints[c].strain;
  for (std::size_t k = 0; k < blocks_.block_count(); ++k) {
    const BlockMotion& m = blocks_.motion[k];
    const BlockBody& body = blocks_.bodies[k];
    const Mat3 stress = blocks_.stress_of(k), axes = m.R * body.axes;
    const Vec3 spin = axes.transpose() * m.w;
    const double kinetic = 0.5 * (body.mass * m.v.squaredNorm() + spin.cwiseAbs2().dot(body.inertia));
    for (const auto& outline : outlines(blocks_.shapes[k], m, blocks_.plane())) {
      out.add(outline);
      out.fields.integer("block", static_cast<std::int64_t>(k) + 1);
      out.fields.integer("group", body.group + 1);
      out.fields.vector("displacement", Vec3(m.x - body.start));
      out.fields.vector("velocity", m.v);
      out.fields.vector("rotation", blocks_.rotation(k));
      out.fields.vector("spin", m.w);
      out.fields.tensor("stress", stress);
      out.fields.number("pressure", -stress.trace() / 3);
      out.fields.number("von_mises", std::sqrt(1.5) * (stress - stress.trace() / 3 * Mat3::Identity()).norm());
      out.fields.number("kinetic_energy", kinetic);
      out.fields.number("strain_energy", strain[k]);
    }
  }
  const std::string file = "blocks/" + numbered(number, ".vtp");
  all->check();
  queue_.add(all->bytes(), [all, path = folder_ / file, time = blocks_.time] { all->write(path, time); });
  cells_.add(blocks_.time, file, &queue_);
}

// Facets move with body 1. Tractions act on body 2.
void BlockResults::write_contacts(std::int64_t number) {
  const auto all = std::make_shared<Cells>();
  Cells& out = *all;
  std::vector<const JointLaw*> laws;
  for (const ContactGroup& group : blocks_.groups) laws.push_back(group.law);
  const JointColumns columns(laws);
  for (const ContactGroup& group : blocks_.groups)
    for (std::size_t c = group.begin; c < group.end; ++c) {
      const BlockContact& contact = blocks_.contacts[c];
      const Joint& j = blocks_.joints[c];
      const BlockMotion& a = blocks_.motion[contact.a];
      std::vector<Vec3> outline = blocks_.outlines[c].corners;
      for (Vec3& x : outline) x = a.x + a.R * x;
      if (outline.empty()) {  // balls: the line between their centres
        outline = {a.x, blocks_.motion[contact.b].x};
        if (!blocks_.plane()) outline.push_back(outline.back());
      }
      out.add(outline);
      out.fields.integer("contact", static_cast<std::int64_t>(c) + 1);
      out.fields.integer("block1", static_cast<std::int64_t>(contact.a) + 1);
      out.fields.integer("block2", static_cast<std::int64_t>(contact.b) + 1);
      out.fields.integer("platen", group.platen ? 1 : 0);
      out.fields.integer("state", j.state);
      out.fields.integer("bonded", group.law->is_bonded(j) ? 1 : 0);
      out.fields.integer("broke", static_cast<std::int64_t>(blocks_.failure_mode[c]));
      out.fields.vector("normal", contact.axes.n);
      out.fields.number("area", j.area);
      out.fields.number("gap", j.gap);
      out.fields.number("opening", j.opening);
      out.fields.vector("shear", contact.axes.vector(j.shear));
      out.fields.number("slip", j.slip);
      out.fields.number("normal_stress", j.area > 0 ? j.Fn / j.area : 0.0);
      out.fields.number("shear_stress", j.area > 0 ? j.Fs.norm() / j.area : 0.0);
      out.fields.vector("force", blocks_.contact_forces[c].all);
      out.fields.vector("moment", blocks_.contact_forces[c].moment);
      out.fields.number("lost_energy", j.released() - j.slid + blocks_.dashpot_work[c]);
      columns.add(out.fields, *group.law, j, contact.axes, blocks_.dashpot_work[c]);
    }
  const std::string file = "contacts/" + numbered(number, ".vtp");
  all->check();
  queue_.add(all->bytes(), [all, path = folder_ / file, time = blocks_.time] { all->write(path, time); });
  contacts_.add(blocks_.time, file, &queue_);
}

void BlockResults::write_events() {
  for (const BlockEvent& e : blocks_.take_events()) {
    const auto text = [](double x) { return number_text(x); };
    const BlockContact& c = blocks_.contacts[e.contact];
    std::vector<std::string> row{std::to_string(e.contact + 1),
                                 std::to_string(c.a + 1),
                                 std::to_string(c.b + 1),
                                 text(e.x[0]),
                                 text(e.x[1]),
                                 text(e.x[2])};
    for (auto& value : joint_event_texts(e.event)) row.push_back(std::move(value));
    events_->add(e.time, row);
    breaks += e.event.kind == JointEvent::Kind::bond_break;
  }
}

void BlockResults::write_history(double dt) {
  if (history_) {
    std::vector<double> row{blocks_.time};
    for (const double value : values(dt)) row.push_back(value);
    history_->add(row);
    row_ = row;
  }
  const BlockLedger l = blocks_.ledger();
  std::vector<double> row{blocks_.time, l.kinetic, l.strain,   l.potential,  l.slip,
                          l.dashpot,    l.damping, l.released, l.outer_work, l.boundary_work};
  row.push_back(l.content() - initial_energy - l.outer_work - l.boundary_work - stages);
  if (model_.stage.count > 0 && model_.only_blocks()) row.push_back(stages);
  energy_->add(row);
}

}  // namespace tribo
