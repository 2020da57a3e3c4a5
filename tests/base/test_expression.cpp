// SPDX-License-Identifier: MIT
#include "base/expression.hpp"

#include <catch2/catch.hpp>

#include <clocale>
#include <cmath>
#include <numbers>
#include <random>
#include <thread>

using namespace tribo;

namespace {

double value(const std::string& text, const Variables& at = {}) { return Expression(text, {})(at); }

// Column and message of the complaint about an expression that starts at deck.xml:3:10.
Problem complaint(const std::string& text) {
  try {
    const Expression expression(text, Origin{std::make_shared<const std::string>("deck.xml"), 3, 10});
  } catch (const InputError& error) {
    return error.problems().at(0);
  }
  return {{}, "no complaint"};
}

struct Bad {
  std::string text;
  int column;
  std::string says;
};

}  // namespace

TEST_CASE("powers are evaluated from left to right and before a leading sign", "[base][expression]") {
  Variables at;
  at.x = 3;
  CHECK(value("-x^2", at) == -9.0);
  CHECK(value("(-x)^2", at) == 9.0);
  CHECK(value("2^3^2") == 64.0);
  CHECK(value("2^-3") == 0.125);
  CHECK(value("2^-3*16") == 2.0);
  CHECK(value("2*-3") == -6.0);
  CHECK(value("-2*-3") == 6.0);
  CHECK(value("-x*2^2", at) == -12.0);
  CHECK(value("8/4/2") == 1.0);
  CHECK(value("8-4-2") == 2.0);
  CHECK(value("1+2*3^2") == 19.0);
  CHECK(value("5--3") == 8.0);
  CHECK(value("5-+-+3") == 8.0);
  CHECK(value("+4") == 4.0);
  CHECK(value("sin(pi/2)^2") == Approx(1.0).epsilon(1e-15));
  // products before a parenthesis, as in NairnMPM
  CHECK(value("2(x+1)", at) == 8.0);
  CHECK(value("-2.5(x-1)(x+1)", at) == -20.0);
  CHECK(value("2(x+1)^2", at) == 32.0);
}

TEST_CASE("comparisons give 1 or 0 and control conditional expressions", "[base][expression]") {
  Variables at;
  at.t = 2;
  CHECK(value("t<3", at) == 1.0);
  CHECK(value("t>=3", at) == 0.0);
  CHECK(value("t==2 && x!=1", at) == 1.0);
  CHECK(value("t>2 || x<0", at) == 0.0);
  CHECK(value("t<1 ? 10 : t<3 ? 20 : 30", at) == 20.0);
  CHECK(value("max(t<1 ? 10 : 20, 15)", at) == 20.0);
  CHECK(value("(t>1 ? 2 : 3)*5", at) == 10.0);
}

TEST_CASE("every function has the meaning of NairnMPM", "[base][expression]") {
  const double e = std::numbers::e;
  const std::vector<std::pair<std::string, double>> table{
      {"sin(0.5)", std::sin(0.5)},
      {"cos(0.5)", std::cos(0.5)},
      {"tan(0.5)", std::tan(0.5)},
      {"asin(0.5)", std::numbers::pi / 6},
      {"acos(0.5)", std::numbers::pi / 3},
      {"atan(1)", std::numbers::pi / 4},
      {"sinh(1)", (e - 1 / e) / 2},
      {"cosh(1)", (e + 1 / e) / 2},
      {"tanh(1)", (e * e - 1) / (e * e + 1)},
      {"log(10)", std::numbers::ln10},
      {"ln(2)", std::numbers::ln2},
      {"log10(1000)", 3},
      {"exp(1)", e},
      {"sqrt(2)", std::numbers::sqrt2},
      {"abs(-2.5)", 2.5},
      {"int(2.9)", 2},
      {"int(-2.9)", -2},
      {"erf(1)", 0.8427007929497149},
      {"erfc(1)", 0.15729920705028513},
      {"sign(2)", 1},
      {"sign(0)", 0},
      {"sign(-2)", 0},
      {"sgn(2)", 1},
      {"sgn(0)", 0},
      {"sgn(-2)", -1},
      {"mod(7,3)", 1},
      {"mod(-7,3)", -1},
      {"mod(5.5;2)", 1.5},
      {"ramp(4,-1)", 0},
      {"ramp(4,0.25)", 1},
      {"ramp(4,2)", 4},
      {"cosramp(4,-1)", 0},
      {"cosramp(4,0.5)", 2},
      {"cosramp(4,1/3)", 1},
      {"cosramp(4,2)", 4},
      {"box(3,-0.1)", 0},
      {"box(3,0.5)", 3},
      {"box(3,1.1)", 0},
      {"sinbox(3,-0.5)", 0},
      {"sinbox(3,0.5)", 3},
      {"sinbox(3,1/6)", 1.5},
      {"sinbox(3,1.5)", 0},
      {"min(3,1,2)", 1},
      {"max(3,1,2)", 3},
      {"2*pi", 2 * std::numbers::pi},
      {"SIN(0.5)", std::sin(0.5)},
      {"Sinh(1)", (e - 1 / e) / 2},
      {"PI", std::numbers::pi},
      {"1.5e-3", 0.0015},
      {".5", 0.5},
      {"5.", 5},
      {"2E3", 2000},
      {"1e-300*1e-10", 1e-310},
  };
  for (const auto& [text, expected] : table) {
    CAPTURE(text);
    CHECK(value(text) == Approx(expected).epsilon(1e-14).margin(1e-300));
  }
}

TEST_CASE("variables are case-sensitive", "[base][expression]") {
  Variables at;
  at.t = 1, at.T = 2, at.z = 3, at.Z = 4, at.x = 5, at.y = 6, at.dt = 7, at.q = 8, at.R = 9, at.D = 10;
  CHECK(value("t+10*T", at) == 21.0);
  CHECK(value("z+10*Z", at) == 43.0);
  CHECK(value("x+10*y", at) == 65.0);
  CHECK(value("dt+10*q", at) == 87.0);
  CHECK(value("R+10*D", at) == 109.0);
}

TEST_CASE("the polar variables of a position are its distance and angle in the x-y plane", "[base][expression]") {
  const auto at = Variables::at(Vec3(-3, 4, 7), 2.5);
  CHECK(at.D == 5.0);
  CHECK(at.T == Approx(std::numbers::pi - std::atan(4.0 / 3.0)).epsilon(1e-15));
  CHECK(at.R == -3.0);
  CHECK(at.Z == 4.0);
  CHECK(at.z == 7.0);
  CHECK(at.t == 2.5);
}

TEST_CASE("an expression without variables is a constant", "[base][expression]") {
  CHECK(Expression("2*sin(pi/4)^2", {}).is_constant());
  CHECK_FALSE(Expression("0*x", {}).is_constant());
  CHECK(Expression(0.1)({}) == 0.1);
  CHECK(Expression(0.1).text() == "0.1");
  CHECK(Expression()({}) == 0.0);
  CHECK(Expression(" x + 1 ", {}).text() == " x + 1 ");
}

TEST_CASE("an invalid expression is reported at the offending character", "[base][expression]") {
  const std::vector<Bad> table{
      {"", 10, "the expression is empty"},
      {"  ", 12, "the expression is empty"},
      {"2x", 11, "an operator is missing before 'x' (products are written with *)"},
      {"x(2)", 11, "an operator is missing before '('"},
      {"x y", 12, "an operator is missing before 'y'"},
      {"1+", 12, "ends where a value is expected"},
      {"1+*2", 12, "a value is expected, not '*'"},
      {"(1+2", 10, "this '(' is never closed"},
      {"1+2)", 13, "this ')' was never opened"},
      {"sin()", 14, "a value is missing before ')'"},
      {"2+sin x", 12, "the function 'sin' needs its arguments in parentheses"},
      {"1+sinn(x)", 12, "unknown function 'sinn' (did you mean 'sin'?); valid: sin cos"},
      {"1+sqr(x)", 12, "did you mean 'sqrt'?"},
      {"3*X", 12, "unknown variable 'X' (did you mean 'x'?)"},
      {"ramp(x)", 10, "ramp takes 2 arguments, not 1"},
      {"1+sin(x,y)", 12, "sin takes 1 argument, not 2"},
      {"max(x)", 10, "max takes at least 2 arguments, not 1"},
      {"rand(1)", 10, "rand is not supported: a run must give the same result every time"},
      {"cdfinv(x)", 10, "cdfinv is not supported"},
      {"tri(x)", 10, "tri is not supported"},
      {"1,5", 11, "decimals are written with '.'"},
      {"x**2", 11, "powers are written with ^"},
      {"x=2", 11, "equality is written =="},
      {"7%2", 11, "remainders are written mod(x,y)"},
      {"x?1", 11, "'?' without ':'"},
      {"x:1", 11, "':' without '?'"},
      {"(x?1):2", 12, "'?' without ':'"},
      {"x $ 2", 12, "an operator is expected, not '$'"},
      {"1e999", 10, "the number is out of range"},
      {"1+.", 12, "'.' is not a number"},
      {"0x10", 11, "an operator is missing before 'x'"},
      {"x\xE2\x88\x92"
       "1",
       11, "not '\xE2\x88\x92'"},
      {"nan", 10, "unknown variable 'nan'"},
      {"inf", 10, "unknown variable 'inf'"},
      {"1/0", 10, "has no finite value"},
      {"sqrt(-1)", 10, "has no finite value"},
      {std::string("x\0y", 3), 11, "an operator is expected"},
      {std::string(300, '(') + "x" + std::string(300, ')'), 210, "more than 200 parentheses"},
      {std::string(20000, '1'), 10010, "longer than 10000 characters"},
  };
  for (const auto& [text, column, says] : table) {
    CAPTURE(text);
    const Problem problem = complaint(text);
    CAPTURE(problem.message);
    CHECK(problem.origin.line == 3);
    CHECK(problem.origin.column == column);
    CHECK(problem.message.find(says) != std::string::npos);
  }
}

TEST_CASE("the place of an error follows the lines of the text", "[base][expression]") {
  const auto problem = complaint("x +\n  $");
  CHECK(problem.origin.line == 4);
  CHECK(problem.origin.column == 3);
}

TEST_CASE("random formulas have the value of their tree", "[base][expression]") {
  std::mt19937 random(7);
  Variables at;
  at.x = 1.25, at.y = -0.75, at.t = 0.5;
  using Node = std::pair<std::string, double>;
  const std::function<Node(int)> grow = [&](int depth) -> Node {
    const auto kind = depth == 0 ? random() % 4 : 4 + random() % 8;
    if (kind == 0) return {"x", at.x};
    if (kind == 1) return {"y", at.y};
    if (kind == 2) return {"t", at.t};
    if (kind == 3) return {"0.375", 0.375};
    const auto [a, u] = grow(depth - 1);
    const auto [b, v] = grow(depth - 1);
    switch (kind) {
      case 4:
        return {"(" + a + "+" + b + ")", u + v};
      case 5:
        return {"(" + a + "-" + b + ")", u - v};
      case 6:
        return {"(" + a + ")*(" + b + ")", u * v};
      case 7:
        return {"sin(" + a + ")/(2+cos(" + b + "))", std::sin(u) / (2 + std::cos(v))};
      case 8:
        return {"(-(" + a + ")^2)", -std::pow(u, 2)};
      case 9:
        return {"(" + a + "<" + b + "?" + a + ":" + b + ")", u < v ? u : v};
      case 10:
        return {"max(" + a + "," + b + ",ramp(2," + a + "))", std::max({u, v, u <= 0 ? 0.0 : (u >= 1 ? 2.0 : 2 * u)})};
      default:
        return {"(2^-abs(" + a + ")+" + b + ")", std::pow(2, -std::abs(u)) + v};
    }
  };
  for (int k = 0; k < 400; ++k) {
    const auto [text, expected] = grow(1 + k % 5);
    if (text.size() > Expression::longest) continue;
    CAPTURE(text);
    CHECK(value(text, at) == Approx(expected).epsilon(1e-9).margin(1e-12));
  }
}

TEST_CASE("no text makes the compiler of expressions fail", "[base][expression]") {
  std::mt19937 random(11);
  const std::vector<std::string> words{"x", "t", "pi", "sin(", "ramp(", "max(", "(",    ")",   ",",  ";", "+",     "-",
                                       "*", "/", "^",  "?",    ":",     "<",    "==",   "&&",  "||", "1", "2.5e3", ".",
                                       " ", "#", "\n", "dt",   "=",     "\"",   "\xFF", "abs", "_",  "e", "if"};
  int accepted = 0;
  for (int k = 0; k < 30000; ++k) {
    std::string text;
    const auto length = 1 + random() % 12;
    for (unsigned i = 0; i < length; ++i) text += words[random() % words.size()];
    try {
      const Expression expression(text, {});
      Variables at;
      at.x = 0.5;
      (void)expression(at);
      ++accepted;
    } catch (const InputError& error) {
      CAPTURE(text);
      REQUIRE(std::string(error.what()).find("cannot be compiled") == std::string::npos);
    } catch (const SimulationError&) {  // it compiles, but has no finite value here
      ++accepted;
    }
  }
  CHECK(accepted > 100);
}

TEST_CASE("one expression may be evaluated by several threads at once", "[base][expression]") {
  const Expression f("sin(x)+y*t^2", {});
  std::vector<std::thread> team;
  std::array<int, 8> wrong{};
  for (std::size_t k = 0; k < wrong.size(); ++k)
    team.emplace_back([&, k] {
      for (int i = 0; i < 20000; ++i) {
        Variables at;
        at.x = i, at.y = static_cast<double>(k), at.t = 0.5 * i;
        if (f(at) != std::sin(at.x) + at.y * std::pow(at.t, 2)) ++wrong[k];
      }
    });
  for (auto& thread : team) thread.join();
  for (const int count : wrong) CHECK(count == 0);
}

TEST_CASE("the decimal point does not depend on the locale", "[base][expression]") {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  for (const char* name : {"de_DE.UTF-8", "fr_FR.UTF-8", "C.UTF-8"}) std::setlocale(LC_ALL, name);
  CHECK(value("1.5*2") == 3.0);
  std::setlocale(LC_ALL, before.c_str());
}

TEST_CASE("a function without a value says where it is written", "[base][expression]") {
  const Expression f("log(1-t)", Origin{std::make_shared<const std::string>("deck.xml"), 3, 10}, "<DisplacementX>");
  Variables at;
  at.t = 0.5;
  CHECK(f(at) == std::log(0.5));
  for (const double t : {1.0, 2.0}) {  // infinite, not a number
    at.t = t;
    CHECK_THROWS_AS(f(at), SimulationError);
    CHECK_THROWS_WITH(f(at),
                      Catch::StartsWith("deck.xml:3:10: the function 'log(1-t)' of <DisplacementX> has no finite "
                                        "value at t = " +
                                        std::to_string(int(t))));
  }
}
