// SPDX-License-Identifier: MIT
#include "input/script/program.hpp"

#include "base/expression_text.hpp"
#include "base/text.hpp"

#include <algorithm>
#include <optional>

namespace tribo::script {
namespace {

// The line without its comment, which starts with `!` outside quotes (but not with `!=`).
std::string without_comment(const std::string& line) {
  bool quote = false;
  for (std::size_t k = 0; k < line.size(); ++k) {
    if (line[k] == '"') quote = !quote;
    if (line[k] == '!' && !quote && (k + 1 >= line.size() || line[k + 1] != '=')) return line.substr(0, k);
  }
  return line;
}

std::vector<Piece> lines_of(std::string_view text, Origin at) {
  std::vector<Piece> out;
  while (!text.empty()) {
    const auto end = text.find_first_of("\r\n");
    out.push_back({std::string(text.substr(0, end)), at});
    ++at.line, at.column = 1;
    if (end == std::string_view::npos) break;
    const bool pair = text[end] == '\r' && end + 1 < text.size() && text[end + 1] == '\n';
    text.remove_prefix(end + (pair ? 2 : 1));
  }
  return out;
}

Piece part(const Piece& piece, std::size_t begin, std::size_t count = std::string::npos) {
  return trimmed({piece.text.substr(begin, count), origin_inside(piece.origin, piece.text, begin)});
}

// `var = expression` or `var op= expression`.
std::optional<Node> assignment(const Piece& line) {
  const std::string& s = line.text;
  if (s.empty() || !name_begins(s[0])) return std::nullopt;
  std::size_t at = 1;
  while (at < s.size() && in_name(s[at])) ++at;
  if (at < s.size() && s[at] == '$') ++at;
  int open = 0;
  while (at < s.size() && (open > 0 || s[at] == '[')) {
    if (s[at] == '[') ++open;
    if (s[at] == ']') --open;
    ++at;
  }
  Node node;
  node.kind = NodeKind::assign, node.origin = line.origin;
  node.target = part(line, 0, at);
  while (at < s.size() && (s[at] == ' ' || s[at] == '\t')) ++at;
  if (at + 1 < s.size() && std::string_view("+-*/^%&").find(s[at]) != std::string_view::npos && s[at + 1] == '=')
    node.word = s[at++];
  if (at >= s.size() || s[at] != '=' || (at + 1 < s.size() && s[at + 1] == '=')) return std::nullopt;
  node.arguments.push_back(part(line, at + 1));
  return node;
}

// The first word, up to a blank or comma.
std::string first_word(const Piece& line) { return line.text.substr(0, line.text.find_first_of(" \t,(\"")); }

std::vector<Piece> arguments_after(const Piece& line, std::size_t begin) {
  Piece rest = part(line, begin);
  if (!rest.text.empty() && rest.text[0] == ',') rest = part(rest, 1);
  return rest.text.empty() ? std::vector<Piece>{} : split(rest, ",");
}

class Parser {
 public:
  Parser(std::string_view text, const Origin& begin) : lines_(lines_of(text, begin)) {
    static constexpr std::size_t longest = 20'000;
    for (const Piece& line : lines_)
      if (line.text.size() > longest)
        throw InputError(line.origin, "this line is longer than " + std::to_string(longest) + " characters");
  }

  Program run() {
    program_.body = block({}, {});
    problems_.raise();
    return std::move(program_);
  }

 private:
  struct Ends {
    std::vector<std::string> words;  // words in lower case that end the block
    std::string opened;              // the command that they close
  };
  static constexpr int deepest = 200;

  // Statements up to one of the words, which becomes the current line. The end of the file ends any block.
  Block block(const Ends& ends, const Origin& opened) {
    Block out;
    if (++depth_ > deepest) {
      problems_.add(opened, "more than 200 nested blocks");
      problems_.raise();
    }
    for (; at_ < lines_.size(); ++at_) {
      const Piece line = trimmed({without_comment(lines_[at_].text), lines_[at_].origin});
      if (line.text.empty()) continue;
      if (auto node = assignment(line)) {
        out.push_back(std::move(*node));
        continue;
      }
      const std::string word = lower(first_word(line));
      if (word == "cut") {
        out.push_back(cut(line));
        continue;
      }
      if (std::find(ends.words.begin(), ends.words.end(), word) != ends.words.end()) {
        --depth_;
        return out;
      }
      statement(line, word, out);
    }
    if (!ends.words.empty())
      problems_.add(opened, "this '" + ends.opened + "' is never closed by '" +
                                (ends.opened == "if" ? "endif" : "End" + ends.opened) + "'");
    --depth_;
    return out;
  }

  void statement(const Piece& line, const std::string& word, Block& out) {
    Node node;
    node.origin = line.origin;
    node.word = first_word(line);
    const std::size_t after = node.word.size();
    if (word.rfind("if", 0) == 0 && test_of(word.substr(2))) {
      out.push_back(choice(line, *test_of(word.substr(2)), after));
    } else if (word == "repeat") {
      node.kind = NodeKind::repeat, node.arguments = arguments_after(line, after);
      if (node.arguments.size() == 1 || node.arguments.size() > 4 || node.arguments.size() == 2)
        problems_.add(line.origin, "'Repeat' takes nothing, or a variable, its first and its last value, and a step");
      ++at_;
      node.body = block({{"endrepeat"}, "Repeat"}, line.origin);
      out.push_back(std::move(node));
    } else if (word == "sub") {
      subroutine(line, after);
    } else if (word == "gosub") {
      node.kind = NodeKind::call;
      call(line, after, node);
      out.push_back(std::move(node));
    } else if (word == "break" || word == "breakall" || word == "continue" || word == "return") {
      node.kind = word == "break"      ? NodeKind::leave_loop
                  : word == "breakall" ? NodeKind::leave_loops
                  : word == "continue" ? NodeKind::next_turn
                                       : NodeKind::leave_sub;
      out.push_back(std::move(node));
    } else if (word == "else" || word == "endif" || word == "endrepeat" || word == "endsub") {
      problems_.add(line.origin, "'" + node.word + "' without the command that it ends or continues");
    } else {
      node.arguments = arguments_after(line, after);
      if (word == "header" || word == "xmldata") raw_lines(line, "end" + word, node);
      out.push_back(std::move(node));
    }
  }

  static Node cut(Piece line) {
    Node node;
    node.origin = line.origin;
    for (; lower(first_word(line)) == "cut"; ++node.cuts) line = part(line, 3);
    node.word = first_word(line);
    node.arguments = arguments_after(line, node.word.size());
    return node;
  }

  static std::optional<Test> test_of(const std::string& kind) {
    if (kind.empty()) return Test::value;
    if (kind == "str") return Test::text;
    if (kind == "num") return Test::number;
    if (kind == "def") return Test::defined;
    if (kind == "ndef") return Test::undefined;
    return std::nullopt;
  }

  Node choice(const Piece& line, Test test, std::size_t after) {
    Node node;
    node.kind = NodeKind::choice, node.origin = line.origin;
    Piece condition = part(line, after);
    while (true) {
      if (condition.text.empty() && test != Test::always)
        problems_.add(condition.origin, "a condition is missing here");
      ++at_;
      Branch branch{test, condition, block({{"else", "elseif", "endif"}, "if"}, line.origin)};
      node.branches.push_back(std::move(branch));
      if (at_ >= lines_.size()) return node;
      const Piece here = trimmed({without_comment(lines_[at_].text), lines_[at_].origin});
      const std::string word = lower(first_word(here));
      if (word == "endif") return node;
      if (test == Test::always) problems_.add(here.origin, "another branch after 'else'");
      const Piece rest = part(here, word.size());
      const std::string next = word == "else" ? lower(first_word(rest)) : "if";
      test = Test::always, condition = rest;
      if (word == "elseif") {
        test = Test::value;
      } else if (next.rfind("if", 0) == 0 && test_of(next.substr(2))) {
        test = *test_of(next.substr(2)), condition = part(rest, next.size());
      } else if (!rest.text.empty()) {
        problems_.add(rest.origin, "'else' must be alone or followed by 'if'");
      }
    }
  }

  void subroutine(const Piece& line, std::size_t after) {
    const Piece rest = part(line, after);
    const std::string name = first_word(rest);
    if (name.empty()) problems_.add(line.origin, "a subroutine needs a name");
    if (in_subroutine_) problems_.add(line.origin, "a subroutine inside another one");
    Subroutine sub;
    for (const Piece& p : arguments_after(rest, name.size())) sub.parameters.push_back(p.text);
    ++at_;
    in_subroutine_ = true;
    sub.body = block({{"endsub"}, "Sub"}, line.origin);
    in_subroutine_ = false;
    if (!program_.subroutines.try_emplace(lower(name), std::move(sub)).second)
      problems_.add(line.origin, "the subroutine '" + name + "' already exists");
  }

  void call(const Piece& line, std::size_t after, Node& node) {
    const Piece rest = part(line, after);
    node.word = first_word(rest);
    if (node.word.empty()) problems_.add(line.origin, "'GoSub' needs the name of a subroutine");
    node.arguments = arguments_after(rest, node.word.size());
  }

  void raw_lines(const Piece& line, const std::string& end, Node& node) {
    for (++at_; at_ < lines_.size(); ++at_) {
      if (lower(trimmed(lines_[at_]).text) == end) return;
      node.lines.push_back(lines_[at_]);
    }
    problems_.add(line.origin, "this '" + node.word + "' is never closed by 'End" + node.word + "'");
  }

  std::vector<Piece> lines_;
  std::size_t at_ = 0;
  int depth_ = 0;
  bool in_subroutine_ = false;
  Program program_;
  Problems problems_;
};

}  // namespace

namespace {

void collect(const Block& block, std::set<std::string>& names) {
  for (const Node& node : block) {
    if (node.kind == NodeKind::assign && node.target.text.find('[') == std::string::npos)
      names.insert(node.target.text);
    for (const Branch& branch : node.branches) collect(branch.body, names);
    collect(node.body, names);
  }
}

}  // namespace

std::set<std::string> assigned_variables(const Program& program) {
  std::set<std::string> names;
  collect(program.body, names);
  for (const auto& [name, subroutine] : program.subroutines) collect(subroutine.body, names);
  return names;
}

Program parse(std::string_view text, const Origin& begin) { return Parser(text, begin).run(); }

}  // namespace tribo::script
