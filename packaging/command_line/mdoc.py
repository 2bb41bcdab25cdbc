"""Writes text in mdoc, the language of manual pages."""

import re


def text(words):
    """Formats words as text lines, one sentence per line."""
    escaped = words.replace("\\", "\\e")
    escaped = re.sub(r"(?<![\w-])(--?)(?=[a-zA-Z])", lambda dashes: "\\-" * len(dashes[1]), escaped)
    lines = [line.strip() for line in re.sub(r"([.:;!?]) (?=[A-Z\[])", r"\1\n", escaped).splitlines()]
    return "".join(("\\&" + line if line[0] in ".'" else line) + "\n" for line in lines if line)


def word(argument):
    """Escapes one argument of a macro, so that it is no other macro and no punctuation."""
    escaped = argument.replace("\\", "\\e").replace('"', "\\(dq")
    return f'"{escaped}"' if " " in escaped or not escaped else "\\&" + escaped


def head(title, section, date, about):
    return (f".Dd {date}\n.Dt {title.upper()} {section}\n.Os Azimuth\n"
            f".Sh NAME\n.Nm {title}\n.Nd {about[0].lower() + about[1:]}\n")


def items(entries):
    """Formats a list of (macro line, text)."""
    if not entries:
        return ""
    return ".Bl -tag -width Ds\n" + "".join(f".It {item}\n{about}" for item, about in entries) + ".El\n"
