// SPDX-License-Identifier: MIT
/// Header, MPMHeader and Mesh.

#include "input/builder.hpp"
#include "materials/material.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>

namespace tribo {

void Builder::header() {
  const Statement& h = *root_.child("Header");
  if (const auto* d = h.child("Description")) {
    constexpr std::string_view label = "Title: ";
    model_.title = d->text.rfind(label, 0) == 0 ? d->text.substr(label.size()) : d->text;
  }
  const std::string analysis = h.child("Analysis")->text;
  model_.analysis = analysis == "10"   ? Analysis::plane_strain
                    : analysis == "11" ? Analysis::plane_stress
                    : analysis == "12" ? Analysis::solid
                                       : Analysis::axisymmetric;
  const auto* units = h.child("ConsistentUnits");
  model_.units.legacy = units == nullptr;
  if (units) {
    model_.units.length = word(*units, "length", "L");
    model_.units.mass = word(*units, "mass", "M");
    model_.units.time = word(*units, "time", "T");
  }
  if (const auto* seed = h.child("RandSeed"))
    model_.random_seed = static_cast<unsigned>(std::abs(text_number(*seed, Dimension::none)));
}

void Builder::reference_temperature(const Statement& header) {
  if (const auto* t = header.child("StressFreeTemp")) model_.heat.reference = text_number(*t, Dimension::temperature);
}

// See Scheme::strains_follow_update().
void Builder::unstable_with_linear_functions(const Statement& header) {
  const Scheme& scheme = model_.scheme;
  if (scheme.kernel != Kernel::linear || !scheme.strains_follow_update()) return;
  const bool apic = scheme.transfer == Transfer::apic;
  const Statement* cause = header.child(apic ? "Transfer" : "SkipPostExtrapolation");
  warn((cause ? cause : header.child("MPMMethod"))->origin,
       std::string("the shape functions are linear") + (header.child("GIMP") ? "" : ", as there is no <GIMP>") +
           ". With " + (apic ? "APIC" : "stresses from velocities that are not extrapolated again") +
           ", bodies then fall apart even in free flight. Add <GIMP type='uGIMP'/> or <GIMP type='quadratic'/>, or " +
           (apic ? "use another <Transfer>"
                 : "extrapolate again: leave <SkipPostExtrapolation> or the minus of <MPMMethod> out"));
}

void Builder::mpm_header() {
  const Statement& h = *root_.child("MPMHeader");
  Scheme& scheme = model_.scheme;
  const bool skips = h.child("SkipPostExtrapolation") != nullptr;
  scheme.extrapolate_again = !skips;
  if (const auto* m = h.child("MPMMethod")) {
    scheme.order = m->text == "0" || m->text == "USF"             ? UpdateOrder::usf
                   : m->text == "3" || m->text.starts_with("USL") ? UpdateOrder::usl
                                                                  : UpdateOrder::usavg;
    must(!(skips && m->text.ends_with('+')), m->origin, m->text + " contradicts <SkipPostExtrapolation/>");
    if (m->text.ends_with('-')) scheme.extrapolate_again = false;
  }
  if (const auto* g = h.child("GIMP")) {
    const std::string type = word(*g, "type", "uGIMP");
    scheme.kernel = kernel_of(type).value_or(Kernel::gimp);
  }
  if (const auto* t = h.child("Transfer")) {
    const std::string type = word(*t, "type");
    scheme.transfer = type == "FLIP"    ? Transfer::flip
                      : type == "PIC"   ? Transfer::pic
                      : type == "blend" ? Transfer::blend
                      : type == "XPIC"  ? Transfer::xpic
                      : type == "FMPM"  ? Transfer::fmpm
                                        : Transfer::apic;
    scheme.flip_fraction = number(*t, "fraction", Dimension::none, 0.99);
    must(scheme.flip_fraction >= 0 && scheme.flip_fraction <= 1, t->origin, "the fraction of FLIP must be in [0, 1]");
    must(!has(*t, "fraction") || type == "blend", t->origin, "'fraction' belongs to type blend");
    scheme.filter_order = static_cast<int>(number(*t, "order", Dimension::none, 2));
    must(scheme.filter_order >= 1 && scheme.filter_order <= 100, t->origin, "the order must be in 1 ... 100");
    must(!has(*t, "order") || type == "XPIC" || type == "FMPM", t->origin, "'order' belongs to types XPIC and FMPM");
  }
  unstable_with_linear_functions(h);
  if (const auto* d = h.child("DefGradTerms")) {
    const auto terms = text_number(*d, Dimension::none, 1);
    must(terms == 1 || terms == 2, d->origin,
         "the number of terms must be 1 or 2; further terms are smaller than (L dt)^3/6 per step");
    scheme.exponential_deformation = terms == 2;
  }
  model_.whole_particles = h.child("WholeParticles") != nullptr;
  const Statement *exact = h.child("DoublePrecision"), *rounded = h.child("SinglePrecision");
  must(!exact || !rounded, exact ? exact->origin : h.origin,
       "<DoublePrecision> and <SinglePrecision> exclude each other; the default is <SinglePrecision>");
  model_.output.double_precision = exact != nullptr;
  if (const auto* split = h.child("SplitParticles")) {
    SplittingSpec& spec = model_.splitting.emplace();
    spec.longest = number(*split, "longest", Dimension::none, spec.longest);
    spec.generations = static_cast<int>(number(*split, "generations", Dimension::none, spec.generations));
    spec.merge = yes(word(*split, "merge", "yes"));
    must(spec.longest >= 0.25 && spec.longest <= 4, split->origin, "'longest' must be in [0.25, 4] cells");
    must(spec.generations >= 1 && spec.generations <= 30, split->origin, "'generations' must be in 1 ... 30");
  }
  if (const auto* f = h.child("BBar")) {
    must(model_.analysis != Analysis::plane_stress, f->origin,
         "<BBar> is of no use in plane stress, where the free thickness prevents volumetric locking");
    must(scheme.kernel == Kernel::linear || scheme.kernel == Kernel::cpdi, f->origin,
         "<BBar> needs shape functions that are linear within a cell: <GIMP type='lCPDI'/> or 'Classic'. Quadratic "
         "splines, 'B2SPLINE', show hardly any locking without it");
    scheme.b_bar = true;
  }
  if (const auto* c = h.child("CPDIrcrit")) {
    scheme.cpdi_limit = text_number(*c, Dimension::none, 1);
    must(scheme.cpdi_limit > 0 && scheme.cpdi_limit <= 1, c->origin, "<CPDIrcrit> must be in (0, 1] cells");
  }

  time_control(h);

  if (const auto* n = h.child("MatlPtsPerElement")) {
    model_.points_per_cell = static_cast<int>(text_number(*n, Dimension::none, 4));
    const double root = model_.dimension() == 2 ? std::sqrt(model_.points_per_cell) : std::cbrt(model_.points_per_cell);
    must(model_.points_per_cell > 0 && root <= 5.001 && std::abs(root - std::round(root)) < 1e-9, n->text_origin,
         model_.dimension() == 2 ? "particles per cell must be 1, 4, 9, 16 or 25"
                                 : "particles per cell must be 1, 8, 27, 64 or 125");
  }
  reference_temperature(h);
  if (const auto* t = h.child("TransTimeFactor")) {
    model_.time.transport_courant = text_number(*t, Dimension::none);
    must(model_.time.transport_courant > 0 && model_.time.transport_courant <= 1, t->origin,
         "<TransTimeFactor> must be in (0, 1]: conduction is stable up to 1");
  }
  if (const auto* l = h.child("LeaveLimit")) {
    const auto limit = static_cast<long>(text_number(*l, Dimension::none, 0));
    model_.leave_limit = limit == 0 ? 100000 : std::abs(limit);
    model_.delete_leaving = limit < 0;
  }
  archive(h);
  history(h);
  damping(h);
  strength_reduction(h);
}

void Builder::time_control(const Statement& h) {
  TimeControl& time = model_.time;
  const auto positive_time = [&](const Statement& s, double value) {
    must(value > 0, s.origin, "<" + s.name + "> must be positive");
    return value;
  };
  if (const auto* t = h.child("Timing")) {
    time.max_step = number(*t, "step", Dimension::time, 1.0);
    time.end = number(*t, "max", Dimension::time, 1.0);
    time.courant = number(*t, "CFL", Dimension::none, 0.5);
    positive_time(*t, std::min({time.max_step, time.end, time.courant}));
    must(time.courant <= 1, t->origin, "'CFL' must be in (0, 1]");
    time.transport_courant = number(*t, "TransCFL", Dimension::none, time.transport_courant);
    must(time.transport_courant > 0 && time.transport_courant <= 1, t->origin, "'TransCFL' must be in (0, 1]");
  }
  if (const auto* t = h.child("TimeStep")) time.max_step = positive_time(*t, text_number(*t, Dimension::time, 1.0));
  if (const auto* t = h.child("MaxTime")) time.end = positive_time(*t, text_number(*t, Dimension::time, 1.0));
  if (const auto* t = h.child("TimeFactor")) {
    time.courant = text_number(*t, Dimension::none, 0.5);
    must(time.courant > 0 && time.courant <= 1, t->origin, "<TimeFactor> must be in (0, 1]");
  }
  const Statement* s = h.child("TimeStep") ? h.child("TimeStep") : h.child("Timing");
  if (s && time.max_step > 0) check_steps(s->origin, time.max_step, "");
}

// A run must end.
void Builder::check_steps(const Origin& origin, double step, const std::string& why) {
  const double steps = model_.time.end / step;
  std::ostringstream message;
  message << std::setprecision(3) << "the run would need " << steps << " time steps of " << step << why
          << "; at most 1e12 are possible";
  must(steps <= 1e12, origin, message.str());
}

// The steps that the waves in the materials allow, as far as they are known before the run.
void Builder::check_wave_steps() {
  if (!problems_.empty()) return;
  double h = std::numeric_limits<double>::infinity();
  for (std::size_t d = 0; d < static_cast<std::size_t>(model_.dimension()); ++d)
    h = std::min(h, (model_.grid.high[d] - model_.grid.low[d]) / model_.grid.cells[d]);
  for (const auto& m : model_.materials) {
    if (!m.law || m.law->rigid() || !(m.law->wave_modulus() > 0)) continue;
    const double speed = std::sqrt(m.law->wave_modulus() / m.law->density()), step = model_.time.courant * h / speed;
    must(speed > 0 && std::isfinite(speed), m.origin, "the waves in '" + m.name + "' have no finite speed");
    if (step < model_.time.max_step)
      check_steps(m.origin, step, ", which the waves in '" + m.name + "' allow; are its units right?");
  }
}

void Builder::strength_reduction(const Statement& h) {
  const auto* s = h.child("StrengthReduction");
  if (!s) return;
  StrengthReduction& search = model_.strength_reduction;
  search.low = number(*s, "low", Dimension::none, search.low);
  search.high = number(*s, "high", Dimension::none, search.high);
  search.tolerance = number(*s, "tolerance", Dimension::none, search.tolerance);
  search.growth = number(*s, "growth", Dimension::none, search.growth);
  if (has(*s, "displacement")) {
    search.displacement = number(*s, "displacement", Dimension::length);
    must(*search.displacement > 0, s->attribute("displacement")->origin, "'displacement' must be positive");
  }
  must(search.low > 0 && search.high > search.low, s->origin, "'low' must be positive and below 'high'");
  must(search.tolerance > 0 && search.growth > 0, s->origin, "'tolerance' and 'growth' must be positive");
}

void Builder::damping(const Statement& h) {
  Damping& d = model_.damping;
  d.function_time = model_.units.alternative_time();
  const auto constant = [&](const char* name, std::optional<Expression>& to) {
    const auto* s = h.child(name);
    if (!s) return;
    if (s->attribute("function"))
      to = function(*s, "function");
    else
      to = Expression(text_number(*s, Dimension::rate));
    if (to->is_constant() && (*to)(Variables{}) < 0)
      problems_.warn(s->origin, std::string("a negative <") + name + "> adds energy in every step");
  };
  constant("Damping", d.grid);
  constant("PDamping", d.particle);
  const auto feedback = [&](const char* name, std::optional<double>& gain) {
    const auto* s = h.child(name);
    if (!s) return;
    gain = text_number(*s, Dimension::none);
    must(*gain >= 0, s->origin, "a gain must not be negative");
    if (s->attribute("target")) d.target_energy = function(*s, "target");
    d.max_alpha = number(*s, "max", Dimension::rate);
  };
  feedback("FeedbackDamping", d.grid_gain);
  feedback("PFeedbackDamping", d.particle_gain);
}

void Builder::mesh() {
  const Statement& grid = *root_.child("Mesh")->child("Grid");
  GridSpec& g = model_.grid;
  g.origin = grid.origin;
  constexpr std::array names{"x", "y", "z"};
  for (int d = 0; d < model_.dimension(); ++d) {
    const std::string low = std::string(names[static_cast<std::size_t>(d)]) + "min",
                      high = std::string(names[static_cast<std::size_t>(d)]) + "max";
    g.low[static_cast<std::size_t>(d)] = number(grid, low, Dimension::length);
    g.high[static_cast<std::size_t>(d)] = number(grid, high, Dimension::length);
    if (!has(grid, low) || !has(grid, high))
      problems_.add(grid.origin, "<Grid> needs " + low + " and " + high);
    else if (!(g.low[static_cast<std::size_t>(d)] < g.high[static_cast<std::size_t>(d)]))
      problems_.add(grid.attribute(high)->origin, high + " must be larger than " + low);
  }
  must(model_.dimension() == 3 || !grid.child("Depth"), grid.origin, "<Depth> belongs to three-dimensional models");
  g.thickness = number(grid, "thickness", Dimension::length, 1.0);
  must(g.thickness > 0, grid.origin, "the thickness must be positive");
  constexpr std::array elements{"Horiz", "Vert", "Depth"}, counts{"nx", "ny", "nz"};
  for (int d = 0; d < model_.dimension(); ++d)
    axis(grid, d, elements[static_cast<std::size_t>(d)], counts[static_cast<std::size_t>(d)]);
  double nodes = 1;
  for (const int n : g.cells) nodes *= n + 1.0;
  must(nodes < 2e11, grid.origin, "the grid has more than 2e11 nodes; use larger cells");
  if (model_.analysis == Analysis::axisymmetric) {
    const double h = (g.high[0] - g.low[0]) / g.cells[0], below = -g.low[0] / h;
    const auto cut = static_cast<int>(std::lround(below));
    if (below > 1e-9 && std::abs(below - cut) < 1e-6 && cut < g.cells[0]) {
      g.low[0] = 0.0, g.cells[0] -= cut;  // no body lies at r < 0: the axis is a symmetry plane
    } else {
      must(g.low[0] >= 0, grid.origin, "an axisymmetric grid needs a grid line at r = 0 if it reaches below");
    }
    if (g.low[0] <= 0) g.symmetry[0][0] = 0.0;
    must(!g.periodic[0], grid.origin, "the radius of an axisymmetric grid cannot be periodic");
  }
}

void Builder::axis(const Statement& grid, int axis, std::string_view element, std::string_view count) {
  const auto k = static_cast<std::size_t>(axis);
  GridSpec& g = model_.grid;
  const auto* s = grid.child(element);
  if (!s) {
    problems_.add(grid.origin, "<Grid> needs <" + std::string(element) + "> with the number of cells '" +
                                   std::string(count) + "' or their 'cellsize'");
    return;
  }
  for (const auto* other : {"nx", "ny", "nz"})
    must(other == count || !has(*s, other), s->origin,
         "<" + std::string(element) + "> takes " + std::string(count) + ", not " + other);
  for (const auto& [ratio, mine] : {std::pair("rx", 0), std::pair("ry", 1), std::pair("rz", 2)}) {
    if (!has(*s, ratio)) continue;
    must(mine == axis, s->attribute(ratio)->origin, "<" + std::string(element) + "> does not take " + ratio);
    must(number(*s, ratio, Dimension::none) == 1, s->attribute(ratio)->origin,
         std::string(ratio) + " must be 1: grids with unequal cells are not implemented");
  }
  if (has(*s, "cellsize")) {
    must(!has(*s, count), s->origin, "give either the number of cells or their size");
    const double size = number(*s, "cellsize", Dimension::length);
    if (!(size > 0)) {
      problems_.add(s->attribute("cellsize")->origin, "the cell size must be positive");
      return;
    }
    const double cells = std::ceil((g.high[k] - g.low[k]) / size - 1e-9);
    must(cells < 1e9, s->origin, "more than 1e9 cells along one axis");
    g.cells[k] = std::max(1, static_cast<int>(std::min(cells, 1e9)));
    g.high[k] = g.low[k] + g.cells[k] * size;
  } else if (has(*s, count)) {
    const double cells = number(*s, count, Dimension::none);
    must(cells >= 1 && cells < 1e9, s->attribute(count)->origin, "the number of cells must be positive");
    g.cells[k] = std::max(1, static_cast<int>(std::min(cells, 1e9)));
  } else {
    problems_.add(s->origin, "<" + std::string(element) + "> needs '" + std::string(count) + "' or 'cellsize'");
  }
  const auto plane = [&](const char* name, std::optional<double>& to) {
    if (!has(*s, name)) return;
    to = number(*s, name, Dimension::length);
    const double h = (g.high[k] - g.low[k]) / g.cells[k], at = (*to - g.low[k]) / h;
    must(std::abs(at - std::round(at)) < 1e-6 && at > -0.5 && at < g.cells[k] + 0.5, s->attribute(name)->origin,
         std::string(name) + " must be the coordinate of a grid line inside the grid");
  };
  plane("symmin", g.symmetry[k][0]), plane("symmax", g.symmetry[k][1]);
  plane("wallmin", g.wall[k][0]), plane("wallmax", g.wall[k][1]);
  for (const auto& [lower, low] : {std::pair("symmin", g.symmetry[k][0]), std::pair("wallmin", g.wall[k][0])})
    for (const auto& [upper, high] : {std::pair("symmax", g.symmetry[k][1]), std::pair("wallmax", g.wall[k][1])})
      must(!low || !high || *low < *high, s->origin, std::string(lower) + " must be below " + upper);
  if (const Attribute* a = s->attribute("periodic")) {
    const double periodic = number(*s, "periodic", Dimension::none);
    must(periodic == 0 || periodic == 1, a->origin, "'periodic' must be 0 or 1, not '" + a->text + "'");
    g.periodic[k] = periodic != 0;
  }
  for (const auto* other : {"symmin", "symmax", "wallmin", "wallmax"})
    must(!g.periodic[k] || !has(*s, other), s->origin, std::string("a periodic axis has no '") + other + "'");
}

}  // namespace tribo
