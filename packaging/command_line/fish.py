"""Completion for fish: one line for each command and option."""

import re

TEMPLATE = '''# fish completion for @NAME@. Made from the program's own parser.

# Whether the words so far lead to the command that is given, or to one of its own.
function __@ID@_in
    set -l words (commandline -opc | string match -v -- '-*')
    set -e words[1]
    set -l length (count $argv)
    test $length -eq 0; and return 0
    test (count $words) -ge $length; and test "$words[1..$length]" = "$argv"
end

# Whether they lead to that command and no further.
function __@ID@_at
    set -l words (commandline -opc | string match -v -- '-*')
    set -e words[1]
    test "$words" = "$argv"
end

# Settings, or what the one that is being typed may be.
function __@ID@_keys
    switch (commandline -ct | string replace -r '^--set=' '')
@KEYS@
        case '*'
            printf '%s=\\n' @NAMES@
    end
end

complete -c @NAME@ -f
'''


def quoted(words):
    return "'" + words.replace("\\", "\\\\").replace("'", "\\'") + "'"


def explained(about):
    return quoted(re.split(r"[;.:] |\.$", about)[0])


def values(option, keys):
    if option.choices:
        return f" -x -a {quoted(' '.join(option.choices))}"
    if option.long == "--set":
        return f" -x -a '({keys})'"
    return (" -r -F" if option.takes_files() else " -x") if option.value else ""


def option_line(program, condition, option, keys):
    names = " ".join(f"-l {name[2:]}" if name.startswith("--") else f"-s {name[1:]}" for name in option.names)
    return f"complete -c {program.name} -n '{condition}' {names}{values(option, keys)} -d {explained(option.about)}"


def command_lines(program, command, identifier):
    words = " ".join(command.path[1:])
    here = f"__{identifier}_{'at' if command.commands else 'in'} {words}".strip()
    lines = [f"complete -c {program.name} -n '{here}' -a {each.name} -d {explained(each.about)}" for each in command.commands]
    lines += [option_line(program, here, option, f"__{identifier}_keys") for option in command.flags()]
    lines += [f"complete -c {program.name} -n '{here}' -F" for option in command.positionals()[:1] if option.takes_files()]
    return lines


def script(program, keys):
    identifier = program.name.replace("-", "_")
    cases = [f"        case '{name}=*'\n            printf '%s\\n' {' '.join(f'{name}={choice}' for choice in choices)}"
             for name, choices in keys if choices]
    made = TEMPLATE
    for mark, value in (("@KEYS@", "\n".join(cases)), ("@NAMES@", " ".join(name for name, _ in keys) or "''"), ("@NAME@", program.name),
                        ("@ID@", identifier)):
        made = made.replace(mark, value)
    return made + "\n".join(line for command in program.everything() for line in command_lines(program, command, identifier)) + "\n"
