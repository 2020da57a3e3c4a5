// SPDX-License-Identifier: MIT
#include "completion.hpp"

namespace tribo {
namespace {

std::string options_of(const CLI::App& command) {
  std::string out;
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames()) out += (out.empty() ? "--" : " --") + name;
  return out;
}

}  // namespace

// zsh understands scripts for bash with its bashcompinit.
std::string completion(const CLI::App& app, const std::string& shell) {
  std::string commands, cases;
  for (const CLI::App* command : app.get_subcommands({})) {
    const std::string& name = command->get_name();
    commands += (commands.empty() ? "" : " ") + name;
    cases += "    " + name + ") options=\"" + options_of(*command) + "\" ;;\n";
  }
  std::string out;
  if (shell == "zsh") out += "autoload -U +X bashcompinit && bashcompinit\n";
  return out + R"sh(_tribo() {
  local word=${COMP_WORDS[COMP_CWORD]} command=${COMP_WORDS[1]} options
  if [ "$COMP_CWORD" -eq 1 ]; then
    COMPREPLY=($(compgen -W ")sh" +
         commands + R"sh(" -- "$word"))
    return
  fi
  case $command in
)sh" + cases +
         R"sh(  esac
  if [ "${word#-}" != "$word" ]; then
    COMPREPLY=($(compgen -W "$options" -- "$word"))
    return
  fi
  case $command in
    doc|list) COMPREPLY=($(compgen -W "$(tribo list --names)" -- "$word")) ;;
    completion) COMPREPLY=($(compgen -W "bash zsh" -- "$word")) ;;
    resume|report|render|watch) COMPREPLY=($(compgen -d -- "$word")) ;;
    *) COMPREPLY=($(compgen -f -X '!*.@(xml|fmcmd)' -- "$word") $(compgen -d -- "$word")) ;;
  esac
}
complete -o filenames -F _tribo tribo
)sh";
}

}  // namespace tribo
