// SPDX-License-Identifier: MIT
#include "man_page.hpp"

namespace tribo {
namespace {

// Text as `man` takes it: backslashes and hyphens are marked, and a line does not begin with a request.
std::string roff(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (out.empty() && (c == '.' || c == '\'')) out += "\\&";
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else
      out += c;
  }
  return out;
}

std::string bold(const std::string& text) { return "\\fB" + roff(text) + "\\fR"; }
std::string italic(const std::string& text) { return "\\fI" + roff(text) + "\\fR"; }

// The names of an option with the kind of its value, such as `-o, --output TEXT`.
std::string option_heading(const CLI::Option& option) {
  std::string out;
  for (const auto& [names, dashes] : {std::pair{option.get_snames(), "-"}, {option.get_lnames(), "--"}})
    for (const std::string& name : names) out += (out.empty() ? "" : ", ") + bold(dashes + name);
  const std::string kind = option.get_type_name();  // with the names of its checks
  if (option.get_items_expected_max() > 0 && !kind.empty()) out += " " + italic(kind.substr(0, kind.find(':')));
  return out;
}

std::string command_section(const CLI::App& command) {
  std::string heading = bold("tribo " + command.get_name());
  std::string options;
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_positional()) {
      heading += " " + italic(option->get_required() ? option->get_name() : "[" + option->get_name() + "]");
    } else if (!option->check_lname("help")) {
      options += ".TP\n" + option_heading(*option) + "\n" + roff(option->get_description()) + "\n";
    }
  }
  std::string out = ".SS " + heading + "\n" + roff(command.get_description()) + ".\n";
  return out + options;
}

}  // namespace

std::string man_page(const CLI::App& app, const std::string& version) {
  std::string out = ".TH TRIBO 1 \"\" \"" + version + "\" \"User commands\"\n";
  out += ".SH NAME\ntribo \\- material point method with contact\n";
  out += ".SH SYNOPSIS\n" + bold("tribo") + " " + italic("COMMAND") + " [" + italic("OPTION") + " ...] [" +
         italic("FILE") + " | " + italic("DIR") + "]\n";
  out +=
      ".SH DESCRIPTION\n"
      "Tribo is a solver for solids, soils, rocks and liquids that touch, slip and break. A command file (XML or a "
      "script) "
      "describes a model;\n" +
      bold("tribo check") + " shows what it contains, " + bold("tribo run") +
      " writes results for ParaView, tables and a checkpoint to a folder.\n";
  out += ".SH COMMANDS\n";
  for (const CLI::App* command : app.get_subcommands({})) out += command_section(*command);
  out +=
      ".SH EXIT STATUS\n"
      ".TP\n0\nThe command has succeeded.\n"
      ".TP\n2\nThe command line is wrong.\n"
      ".TP\n3\nThe command file is wrong; all errors are listed with their places.\n"
      ".TP\n4\nThe run cannot continue for a numerical reason.\n"
      ".TP\n5\nA file cannot be read or written.\n"
      ".TP\n6\nThe run was stopped; it continues with " +
      bold("tribo resume") + ".\n";
  out +=
      ".SH EXAMPLES\n"
      ".EX\ntribo check two_disks.fmcmd\n"
      "tribo run \\-\\-set speed=10 \\-\\-output slow two_disks.fmcmd\n"
      "tribo render slow\n.EE\n";
  return out;
}

}  // namespace tribo
