// SPDX-License-Identifier: MIT
#include "base/error.hpp"

#include "base/read_file.hpp"

#include <algorithm>
#include <cctype>
#include <numeric>

namespace tribo {

std::string Origin::text() const {
  std::string out = file ? *file : std::string();
  if (line > 0) out += (out.empty() ? "line " : ":") + std::to_string(line);
  if (line > 0 && column > 0) out += ":" + std::to_string(column);
  return out;
}

namespace {

constexpr std::size_t most_reported = 100;     // problems
constexpr std::size_t longest_quote = 60;      // characters of the input in a message
constexpr std::size_t longest_message = 8000;  // bytes

std::string report(const std::vector<Problem>& problems) {
  std::string out;
  for (const auto& p : problems) {
    if (!out.empty()) out += '\n';
    const std::string where = p.origin.text();
    out += (where.empty() ? "error: " : where + ": error: ") + p.message;
  }
  return out;
}

// The length to which bytes of UTF-8 can be cut.
std::size_t cut_at(std::string_view text, std::size_t length) {
  while (length > 0 && (static_cast<unsigned char>(text[length]) & 0xC0U) == 0x80U) --length;
  return length;
}

// What is quoted of the input is cut.
void shorten(Problem& problem) {
  std::string& message = problem.message;
  if (message.size() > 2 * longest_quote) {
    std::string out;
    for (std::size_t at = 0; at < message.size();) {
      const bool opens = message[at] == '\'' && (at == 0 || std::string_view(" (=:").find(message[at - 1]) < 4);
      const std::size_t end = opens ? message.find('\'', at + 1) : std::string::npos;
      if (end == std::string::npos) {
        out += message[at++];
        continue;
      }
      const std::string_view quoted = std::string_view(message).substr(at + 1, end - at - 1);
      out += '\'';
      if (quoted.size() > 3 * longest_quote)
        out.append(quoted.substr(0, cut_at(quoted, longest_quote))).append("...");
      else
        out += quoted;
      out += '\'', at = end + 1;
    }
    message = std::move(out);
  }
  message = printable(message, longest_message, true);
}

std::vector<Problem> shortened(std::vector<Problem> problems) {
  if (problems.size() > most_reported) {
    const auto more = problems.size() - most_reported;
    problems.resize(most_reported);
    problems.back().message += "\nand " + std::to_string(more) + " more problems";
  }
  for (Problem& p : problems) shorten(p);
  return problems;
}

// Number of letters that are replaced, inserted, removed or exchanged with their neighbour, ignoring case (distance of
// Damerau and Levenshtein, without edits between exchanged letters).
std::size_t distance(std::string_view a, std::string_view b) {
  const auto same = [&](std::size_t i, std::size_t j) {
    return std::tolower(static_cast<unsigned char>(a[i])) == std::tolower(static_cast<unsigned char>(b[j]));
  };
  std::vector<std::size_t> row(b.size() + 1), before(row), last(row);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    before.swap(last), last.swap(row);
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      row[j + 1] = std::min({last[j] + (same(i, j) ? 0 : 1), last[j + 1] + 1, row[j] + 1});
      if (i > 0 && j > 0 && same(i, j - 1) && same(i - 1, j)) row[j + 1] = std::min(row[j + 1], before[j - 1] + 1);
    }
  }
  return row.back();
}

bool same_letter(char a, char b) {
  return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
}

// The longest candidate of some length that stands in a word, ignoring case; empty if there is none.
std::string part_of(std::string_view word, const std::vector<std::string>& candidates) {
  constexpr std::size_t shortest = 4;
  std::string best;
  for (const auto& candidate : candidates)
    if (candidate.size() >= std::max(shortest, best.size() + 1) &&
        std::search(word.begin(), word.end(), candidate.begin(), candidate.end(), same_letter) != word.end())
      best = candidate;
  return best;
}

// The shortest candidate that begins with a word of some length, ignoring case; empty if there is none.
std::string completion_of(std::string_view word, const std::vector<std::string>& candidates) {
  constexpr std::size_t shortest = 3;
  std::string best;
  for (const auto& candidate : candidates)
    if (word.size() >= shortest && candidate.size() > word.size() && (best.empty() || candidate.size() < best.size()) &&
        std::equal(word.begin(), word.end(), candidate.begin(), same_letter))
      best = candidate;
  return best;
}

}  // namespace

InputError::InputError(std::vector<Problem> problems) : InputError(Shortened{shortened(std::move(problems))}) {}

InputError::InputError(Shortened problems)
    : std::runtime_error(report(problems.list)), problems_(std::move(problems.list)) {}

InputError::InputError(Origin origin, std::string message)
    : InputError(std::vector<Problem>{{std::move(origin), std::move(message)}}) {}

void Problems::raise() const {
  if (list_.empty()) return;
  auto sorted = list_;
  std::stable_sort(sorted.begin(), sorted.end(), [](const Problem& a, const Problem& b) {
    return std::pair(a.origin.line, a.origin.column) < std::pair(b.origin.line, b.origin.column);
  });
  throw InputError(std::move(sorted));
}

std::string similar_word(std::string_view word, const std::vector<std::string>& candidates) {
  const std::string* best = nullptr;
  if (word.empty()) return {};
  std::size_t least = word.size() == 1 ? 1 : std::max<std::size_t>(1, word.size() / 3) + 1;  // a letter: its case only
  for (const auto& candidate : candidates) {
    const std::size_t longer = std::max(word.size(), candidate.size()),
                      shorter = std::min(word.size(), candidate.size());
    if (longer - shorter >= least) continue;  // the distance is at least this
    const std::size_t d = distance(word, candidate);
    if (d < least) least = d, best = &candidate;
  }
  return best ? *best : std::string();
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates) {
  std::string best = similar_word(word, candidates);
  if (best.empty()) best = part_of(word, candidates);
  if (best.empty()) best = completion_of(word, candidates);
  return best.empty() ? best : " (did you mean '" + best + "'?)";
}

std::string join(const std::vector<std::string>& words, std::string_view separator) {
  std::string out;
  for (const auto& word : words) {
    if (!out.empty()) out += separator;
    out += word;
  }
  return out;
}

}  // namespace tribo
