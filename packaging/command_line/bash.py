"""Completion for bash: a function that only needs bash, with tables of words."""

TEMPLATE = r'''# bash completion for @NAME@                                   -*- shell-script -*-
# Made from the program's own parser.

# Commands and options of a command.
_@ID@_words() {
  case $1 in
@WORDS@
  esac
}

# What an option (or, with an empty one, a command itself) takes: words, or @files, @keys, @nothing. Flags: no word.
_@ID@_value() {
  case "$1 $2" in
@VALUES@
  esac
}

# What a setting may be; without one, all settings.
_@ID@_keys() {
  case $1 in
@KEYS@
  esac
}

_@ID@_offer() {
  local kind=$1 current=$2
  case $kind in
    @nothing) ;;
    @files)
      compopt -o filenames 2>/dev/null
      mapfile -t COMPREPLY < <(compgen -f -- "$current")
      ;;
    @keys)
      compopt -o nospace 2>/dev/null
      mapfile -t COMPREPLY < <(compgen -S = -W "$(_@ID@_keys)" -- "$current")
      ;;
    *) mapfile -t COMPREPLY < <(compgen -W "$kind" -- "$current") ;;
  esac
}

_@ID@() {
  COMPREPLY=()
  local current=${COMP_WORDS[COMP_CWORD]} last=${COMP_WORDS[COMP_CWORD - 1]} command=@NAME@ option='' word i
  # The shell takes --option=value and key=value for three words.
  local assigned=''
  if [ "$current" = = ]; then
    assigned=$last current=''
  elif [ "$last" = = ] && [ "$COMP_CWORD" -gt 1 ]; then
    assigned=${COMP_WORDS[COMP_CWORD - 2]}
  fi
  # The command that the words so far lead to, and the option whose value comes now.
  for ((i = 1; i < COMP_CWORD; ++i)); do
    word=${COMP_WORDS[i]}
    if [ "$word" = = ]; then
      i=$((i + 1))
    elif [ -n "$option" ]; then
      option=''
    elif [[ $word == -* ]]; then
      [ -z "$(_@ID@_value "$command" "$word")" ] || option=$word
    elif [ -n "$(_@ID@_words "$command $word")" ]; then
      command+=" $word"
    fi
  done
  if [[ $assigned == -* ]]; then
    _@ID@_offer "$(_@ID@_value "$command" "$assigned")" "$current"
  elif [ -n "$assigned" ]; then
    _@ID@_offer "$(_@ID@_keys "$assigned")" "$current"
  elif [ -n "$option" ]; then
    _@ID@_offer "$(_@ID@_value "$command" "$option")" "$current"
  elif [[ $current == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$(_@ID@_words "$command" | tr ' ' '\n' | grep ^-)" -- "$current")
  elif [ -n "$(_@ID@_value "$command" '')" ]; then
    _@ID@_offer "$(_@ID@_value "$command" '')" "$current"
    # Beside what it takes itself, a command may have commands.
    mapfile -O "${#COMPREPLY[@]}" -t COMPREPLY < <(compgen -W "$(_@ID@_words "$command" | tr ' ' '\n' | grep -v ^-)" -- "$current")
  else
    mapfile -t COMPREPLY < <(compgen -W "$(_@ID@_words "$command" | tr ' ' '\n' | grep -v ^-)" -- "$current")
  fi
}

complete -F _@ID@ @NAME@
'''


def kind(option):
    if not option.value:
        return ""
    if option.choices:
        return " ".join(option.choices)
    if option.long == "--set":
        return "@keys"
    return "@files" if option.takes_files() else "@nothing"


def case(pattern, words):
    return f"    '{pattern}') echo '{words}' ;;"


def script(program, keys):
    """The completion script of a program. `keys` has (full name, choices) of each setting."""
    words, values = [], []
    for command in program.everything():
        path = " ".join(command.path)
        flags = [name for option in command.flags() for name in option.names]
        words.append(case(path, " ".join([*(each.name for each in command.commands), *flags])))
        for option in command.flags():
            values += [case(f"{path} {name}", kind(option)) for name in option.names if option.value]
        if command.positionals():
            values.append(case(f"{path} ", kind(command.positionals()[0])))
    settings = [case(name, " ".join(choices)) for name, choices in keys if choices]
    settings.append(f"    '') echo '{' '.join(name for name, _ in keys)}' ;;")
    made = TEMPLATE
    for mark, value in (("@WORDS@", "\n".join(words)), ("@VALUES@", "\n".join(values)), ("@KEYS@", "\n".join(settings)),
                        ("@NAME@", program.name), ("@ID@", program.name.replace("-", "_"))):
        made = made.replace(mark, value)
    return made
