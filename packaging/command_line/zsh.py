"""Completion for zsh: one function for each command, with _arguments."""

import re


def quoted(words):
    return "'" + words.replace("'", "'\\''") + "'"


def explained(about):
    """The first clause of a description; escapes the characters that _arguments interprets."""
    return re.sub(r"([\[\]:\\])", r"\\\1", re.split(r"[;.] |\.$", about)[0])


def action(option, keys):
    if option.choices:
        return f"({' '.join(option.choices)})"
    if option.long == "--set":
        return keys
    return "_files" if option.takes_files() else " "


def specification(option, keys):
    if not option.names:
        return quoted(f"{'*' if option.repeats else ''}:{option.positional.lower()}:{action(option, keys)}")
    takes = f":{option.value.replace(':', '')}:{action(option, keys)}" if option.value else ""
    explanation = f"[{explained(option.about)}]"
    specs = []
    for name in option.names:
        others = "*" if option.repeats else f"({' '.join(option.names)})"
        ending = ("=" if name.startswith("--") else "+") if option.value else ""
        specs.append(quoted(f"{others}{name}{ending}{explanation}{takes}"))
    return " ".join(specs)


def function(path):
    return "_" + "_".join(path).replace("-", "_")


def described(command):
    return quoted(f"{command.name}:{explained(command.about)}")


def command_function(command, keys):
    specifications = [specification(option, keys) for option in command.options]
    if not command.commands:
        return f"{function(command.path)}() {{\n  _arguments -s \\\n    " + " \\\n    ".join(specifications) + "\n}\n"
    cases = "\n".join(f"        {each.name}) {function(each.path)} ;;" for each in command.commands)
    listed = "\n        ".join(described(each) for each in command.commands)
    return f"""{function(command.path)}() {{
  local context state state_descr line
  typeset -A opt_args
  _arguments -C \\
    {" ".join(specifications)} \\
    '1: :->command' '*::argument:->arguments'
  case $state in
    command)
      local -a commands=(
        {listed}
      )
      _describe command commands
      ;;
    arguments)
      case $line[1] in
{cases}
      esac
      ;;
  esac
}}
"""


def keys_function(name, keys):
    cases = "\n".join(f"    {key}) compadd -- {' '.join(choices)} ;;" for key, choices in keys if choices)
    names = "\n    ".join(key for key, _ in keys)
    return f"""{name}() {{
  local -a keys=(
    {names}
  )
  compset -P '*=' || {{ compadd -S = -a keys; return }}
  local key=${{IPREFIX##*--set=}}
  case ${{key%=}} in
{cases}
  esac
}}
"""


def script(program, keys):
    keys_name = function(program.path) + "_keys"
    functions = "\n".join(command_function(command, keys_name) for command in reversed(program.everything()))
    return (f"#compdef {program.name}\n# Made from the program's own parser.\n\n{keys_function(keys_name, keys) if keys else ''}\n{functions}\n"
            f'{function(program.path)} "$@"\n')
