"""Decodes status_t with its definition in lcmtypes, so that the tests know new fields."""

import re

LETTERS = {"int64_t": "q", "int32_t": "i", "int8_t": "b", "double": "d", "boolean": "b"}
FIELD = re.compile(r"^\s*(\w+)\s+(\w+)\s*;")


def status_decoder(definition):
    """Returns a function that decodes a status from a Reader to a dictionary; `definition` is the text of
    status_t.lcm."""
    fields = []
    for line in definition.splitlines():
        match = FIELD.match(line.split("//")[0])
        if match and match[1] != "package":
            fields.append((match[1], match[2]))
    unknown = {kind for kind, _ in fields} - LETTERS.keys() - {"string"}
    if unknown:
        raise SystemExit(f"messages.py: status_t has fields of unknown type {unknown}")

    def decode(reader):
        return {name: reader.text() if kind == "string" else reader.take(LETTERS[kind]) for kind, name in fields}

    return decode
