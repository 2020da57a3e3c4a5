// SPDX-License-Identifier: MIT
#include "base/expression.hpp"

#include "base/expression_text.hpp"

#include <muParser.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <charconv>
#include <cmath>
#include <numbers>

namespace tribo {

Variables Variables::at(const Vec3& position, double time) {
  Variables v;
  v.t = time;
  v.x = v.R = position[0], v.y = v.Z = position[1], v.z = position[2];
  v.D = std::hypot(v.x, v.y);
  v.T = std::atan2(v.y, v.x);
  return v;
}

namespace {

double sign(double x) { return x > 0.0 ? 1.0 : 0.0; }
double sgn(double x) { return x > 0.0 ? 1.0 : (x < 0.0 ? -1.0 : x); }
double ramp(double A, double x) { return x <= 0.0 ? 0.0 : (x >= 1.0 ? A : A * x); }
double cosramp(double A, double x) {
  return x <= 0.0 ? 0.0 : (x >= 1.0 ? A : 0.5 * A * (1.0 - std::cos(std::numbers::pi * x)));
}
double box(double A, double x) { return x >= 0.0 && x <= 1.0 ? A : 0.0; }
double sinbox(double A, double x) { return x >= 0.0 && x <= 1.0 ? A * std::sin(std::numbers::pi * x) : 0.0; }
double power(double x, double y) { return std::pow(x, y); }
double least(const double* values, int count) { return *std::min_element(values, values + count); }
double most(const double* values, int count) { return *std::max_element(values, values + count); }

// A muParser parser with the names of the expression language, and the variables it reads.
class Program {
 public:
  explicit Program(const std::string& text) {
    parser_.ClearFun();
    parser_.ClearConst();
    parser_.DefineConst("pi", std::numbers::pi);
    parser_.DefineOprt("#", power, mu::prPOW, mu::oaLEFT, true);
    define_functions();
    define_variables();
    parser_.SetExpr(text);
    parser_.Eval();  // compiles
  }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  double operator()(const Variables& at) {
    at_ = at;
    return parser_.Eval();
  }

 private:
  using One = double (*)(double);
  using Two = double (*)(double, double);

  void define_functions() {
    static constexpr std::array<std::pair<const char*, One>, 20> of_one{{
        {"sin", std::sin},   {"cos", std::cos},     {"tan", std::tan},   {"asin", std::asin}, {"acos", std::acos},
        {"atan", std::atan}, {"sinh", std::sinh},   {"cosh", std::cosh}, {"tanh", std::tanh}, {"log", std::log},
        {"ln", std::log},    {"log10", std::log10}, {"exp", std::exp},   {"sqrt", std::sqrt}, {"abs", std::fabs},
        {"int", std::trunc}, {"erf", std::erf},     {"erfc", std::erfc}, {"sign", sign},      {"sgn", sgn},
    }};
    static constexpr std::array<std::pair<const char*, Two>, 5> of_two{
        {{"mod", std::fmod}, {"ramp", ramp}, {"cosramp", cosramp}, {"box", box}, {"sinbox", sinbox}}};
    for (const auto& [name, f] : of_one) parser_.DefineFun(name, f);
    for (const auto& [name, f] : of_two) parser_.DefineFun(name, f);
    parser_.DefineFun("min", least);
    parser_.DefineFun("max", most);
  }

  void define_variables() {
    const std::array<std::pair<const char*, double*>, 13> all{{{"t", &at_.t},
                                                               {"x", &at_.x},
                                                               {"y", &at_.y},
                                                               {"z", &at_.z},
                                                               {"dt", &at_.dt},
                                                               {"q", &at_.q},
                                                               {"R", &at_.R},
                                                               {"Z", &at_.Z},
                                                               {"D", &at_.D},
                                                               {"T", &at_.T},
                                                               {"x0", &at_.x0},
                                                               {"y0", &at_.y0},
                                                               {"z0", &at_.z0}}};
    for (const auto& [name, place] : all) parser_.DefineVar(name, place);
  }

  Variables at_;
  mu::Parser parser_;
};

// A unique number of every thread.
unsigned thread_number() {
  static std::atomic<unsigned> next{0};
  thread_local const unsigned mine = next++;
  return mine;
}

}  // namespace

// muParser evaluates through pointers to variables, so each thread needs its own compiled program. A thread starts its
// search for a free program at its own index, where normally no other thread searches, so it does not have to wait.
struct Expression::Compiled {
  explicit Compiled(std::string program_text) : text(std::move(program_text)) {}

  double operator()(const Variables& at) {
    for (unsigned k = thread_number();; ++k) {
      Slot& slot = slots[k % slots.size()];
      if (slot.busy.test_and_set(std::memory_order_acquire)) continue;
      const Release release{slot.busy};
      if (!slot.program) slot.program = std::make_unique<Program>(text);
      return (*slot.program)(at);
    }
  }

  struct Slot {
    std::atomic_flag busy;
    std::unique_ptr<Program> program;
  };
  struct Release {
    std::atomic_flag& busy;
    ~Release() { busy.clear(std::memory_order_release); }
  };
  std::string text;
  std::array<Slot, 64> slots;
};

Expression::Expression(double constant) : constant_(constant) {
  std::array<char, 32> shortest{};
  const auto end = std::to_chars(shortest.data(), shortest.data() + shortest.size(), constant).ptr;
  text_.assign(shortest.data(), end);
}

Expression::Expression(const std::string& text, const Origin& origin, std::string keyword)
    : text_(text), origin_(origin), keyword_(std::move(keyword)) {
  const CheckedText checked = check_expression(text, origin);
  uses_start_ = checked.uses_start;
  try {
    if (checked.uses_variables) {
      auto compiled = std::make_shared<Compiled>(checked.program);
      (*compiled)(Variables{});
      compiled_ = std::move(compiled);
    } else {
      constant_ = Program(checked.program)(Variables{});
    }
  } catch (const mu::Parser::exception_type& error) {
    throw InputError(origin, "'" + text + "' cannot be compiled: " + error.GetMsg());
  }
  if (!std::isfinite(constant_)) throw InputError(origin, "'" + text + "' has no finite value");
}

double Expression::operator()(const Variables& at) const {
  if (!compiled_) return constant_;
  const double value = (*compiled_)(at);
  if (!std::isfinite(value)) refuse(at);
  return value;
}

void Expression::refuse(const Variables& at) const {
  std::string where;
  for (const auto& [name, number] :
       {std::pair("t", at.t), std::pair("x", at.x), std::pair("y", at.y), std::pair("z", at.z)})
    where += std::string(where.empty() ? "" : ", ") + name + " = " + Expression(number).text();
  const std::string place = origin_.text();
  throw SimulationError((place.empty() ? "" : place + ": ") + "the function '" + text_ + "'" +
                        (keyword_.empty() ? "" : " of " + keyword_) + " has no finite value at " + where);
}

}  // namespace tribo
