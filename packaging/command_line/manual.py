"""Makes manual pages: one for each command and one for each kind of file whose keys a program prints."""

import re

import mdoc

VALUES = {"PATH": "file", "TEXT": "text", "INT": "number", "UINT": "number", "FLOAT": "number"}


def value(option):
    words = "|".join(option.choices)
    return f"Ar {mdoc.word(words if words and len(words) < 40 else VALUES.get(option.value, option.value))}"


def item(option):
    if not option.names:
        return f"Ar {mdoc.word(option.positional)}" + (" ..." if option.repeats else "")
    names = " , ".join(f"Fl {mdoc.word(name[1:])}" for name in option.names)
    return f"{names} {value(option)}" if option.value else names


def about(option):
    words = option.about.rstrip(".") + "."
    if len("|".join(option.choices)) >= 40:
        words += f" One of {', '.join(option.choices)}."
    if option.limits:
        words += f" Allowed: {re.sub(r'^[A-Z]+ in ', '', option.limits)}."
    if option.default:
        words += f" Default: {option.default}."
    return mdoc.text(words)


def synopsis(command):
    text = f".Nm {' '.join(command.path)}\n"
    if command.commands:
        return text + ".Ar command\n.Op Ar option ...\n"
    needed = [option for option in command.flags() if option.required]
    text += "".join(f".{item(option)}\n" for option in needed) + ".Op Ar option ...\n"
    for option in command.positionals():
        dots = " ..." if option.repeats else ""
        text += f".Ar {mdoc.word(option.positional)}{dots}\n" if option.required else f".Op Ar {mdoc.word(option.positional)}{dots}\n"
    return text


def page_name(path):
    return "-".join(path)


def command_page(command, date, supplement, others):
    """The page of a command. `supplement` is handwritten mdoc; `others` are (name, section) of the pages in SEE
    ALSO."""
    title = page_name(command.path)
    text = mdoc.head(title, 1, date, first_sentence(command.about))
    text += ".Sh SYNOPSIS\n" + synopsis(command) + ".Sh DESCRIPTION\n" + mdoc.text(command.about.rstrip(".") + ".")
    if command.commands:
        text += "The commands are:\n" + mdoc.items([(f"Cm {each.name}", mdoc.text(each.about.rstrip(".") + ".") + see(each)) for each in command.commands])
        text += "Options:\n"
    text += mdoc.items([(item(option), about(option)) for option in [*command.positionals(), *command.flags()]])
    if command.footer:
        text += ".Pp\n" + mdoc.text(command.footer)
    return text + supplement + see_also(sorted(others, key=lambda page: (page[1], page[0])))


def see(command):
    return f"See\n.Xr {page_name(command.path)} 1 .\n"


def first_sentence(words):
    return re.split(r"[;:.] |\.$", words)[0]


def see_also(pages):
    if not pages:
        return ""
    return ".Sh SEE ALSO\n" + " ,\n".join(f".Xr {name} {section}" for name, section in pages) + "\n"


def key_text(key):
    words = key.about if key.about.endswith((".", "!", "?")) else key.about + "."
    if key.choices:
        words += f" One of {', '.join(key.choices)}."
    if key.limits:
        words += f" Allowed: {key.limits}."
    return mdoc.text(words)


def table_text(table):
    heading = f"[[{table.name}]]" if table.is_list else f"[{table.name}]"
    text = f".Ss {heading}\n" if table.name else ""
    text += mdoc.text(table.about) if table.about else ""
    return text + mdoc.items([(f"Va {mdoc.word(key.name)}" + (f" = Li {mdoc.word(key.value)}" if key.value else ""), key_text(key))
                              for key in table.keys])


def settings_page(title, date, summary, introduction, tables, others, ending=""):
    return (mdoc.head(title, 5, date, summary) + ".Sh DESCRIPTION\n" + introduction + ".Sh KEYS\n"
            + "".join(table_text(table) for table in tables) + ending + see_also(others))
