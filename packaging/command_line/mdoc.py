"""Text in the language of manual pages (mdoc)."""

import re


def text(words):
    """As lines of running text, a sentence a line."""
    escaped = words.replace("\\", "\\e")
    escaped = re.sub(r"(?<![\w-])(--?)(?=[a-zA-Z])", lambda dashes: "\\-" * len(dashes[1]), escaped)
    lines = [line.strip() for line in re.sub(r"([.:;!?]) (?=[A-Z\[])", r"\1\n", escaped).splitlines()]
    return "".join(("\\&" + line if line[0] in ".'" else line) + "\n" for line in lines if line)


def word(argument):
    """One argument of a macro, never taken for another macro or for punctuation."""
    escaped = argument.replace("\\", "\\e").replace('"', "\\(dq")
    return f'"{escaped}"' if " " in escaped or not escaped else "\\&" + escaped


def head(title, section, date, about):
    return (f".Dd {date}\n.Dt {title.upper()} {section}\n.Os Azimuth\n"
            f".Sh NAME\n.Nm {title}\n.Nd {about[0].lower() + about[1:]}\n")


def items(entries):
    """A list of (macro line, text)."""
    if not entries:
        return ""
    return ".Bl -tag -width Ds\n" + "".join(f".It {item}\n{about}" for item, about in entries) + ".El\n"
