#include "base/expression.hpp"

#include "base/schema.hpp"

namespace tribo {

struct Expression::Compiled {};

Expression::Expression(const std::string& text, const Origin& origin) : text_(text) {
  const auto number = to_number(text);
  if (!number) throw InputError(origin, "'" + text + "' is not a number");
  constant_ = *number;
}

double Expression::operator()(const Variables&) const { return constant_; }

}  // namespace tribo
