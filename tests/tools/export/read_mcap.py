#!/usr/bin/env python3
"""Reads an MCAP file according to its specification, checks every checksum, length and index, decodes the messages with
the schemas in the file, and prints everything as JSON. It shares no code with the writer.

usage: read_mcap.py FILE      exit code 0: the file is sound, 1: it is not
"""

import json
import math
import re
import struct
import sys
import zlib

MAGIC = b"\x89MCAP0\r\n"
HEADER, FOOTER, SCHEMA, CHANNEL, MESSAGE, CHUNK, MESSAGE_INDEX, CHUNK_INDEX = range(1, 9)
STATISTICS, SUMMARY_OFFSET, DATA_END = 0x0B, 0x0E, 0x0F


def require(condition, complaint):
    if not condition:
        sys.exit(f"not sound: {complaint}")


class Fields:
    """Reads the fields of a record one after the other."""

    def __init__(self, data):
        self.data, self.at = data, 0

    def number(self, form):
        value = struct.unpack_from("<" + form, self.data, self.at)[0]
        self.at += struct.calcsize("<" + form)
        return value

    def raw(self, size):
        require(self.at + size <= len(self.data), "a length beyond its record")
        self.at += size
        return self.data[self.at - size:self.at]

    def text(self):
        return self.raw(self.number("I")).decode()

    def pairs(self, read_key, read_value):
        inner = Fields(self.raw(self.number("I")))
        found = []
        while inner.at < len(inner.data):
            found.append((read_key(inner), read_value(inner)))
        return found

    def rest(self):
        return self.raw(len(self.data) - self.at)

    def end(self):
        require(self.at == len(self.data), "bytes are left over in a record")


def records(data, begin, end):
    """Yields (op, content, begin, end) of each record between `begin` and `end`."""
    at = begin
    while at < end:
        op, size = struct.unpack_from("<BQ", data, at)
        require(at + 9 + size <= end, f"record {op} goes beyond its section")
        yield op, data[at + 9:at + 9 + size], at, at + 9 + size
        at += 9 + size
    require(at == end, "a section ends amid a record")


# Scalar types of schemas in the encoding ros2msg, with their codes for struct.
SCALARS = {"bool": "?", "byte": "B", "uint8": "B", "int32": "i", "uint32": "I", "float32": "f", "float64": "d"}


def parse_schema(name, text):
    types, current = {}, name
    for line in text.splitlines():
        if line.startswith("===="):
            current = None
        elif line.startswith("MSG: "):
            current = line[5:]
        elif "=" not in line and line.strip():
            types.setdefault(current, []).append(line.split())
    require(None not in types, f"{name}: a type without a name")
    return types


class Cdr:
    def __init__(self, data):
        require(data[:4] == b"\0\1\0\0", "not CDR of little-endian bytes")
        self.data, self.at = data[4:], 0

    def scalar(self, form):
        size = struct.calcsize("<" + form)
        self.at += -self.at % size
        value = struct.unpack_from("<" + form, self.data, self.at)[0]
        self.at += size
        return value

    def value(self, types, kind):
        if kind == "string":
            size = self.scalar("I")
            text = self.data[self.at:self.at + size]
            require(len(text) == size and text.endswith(b"\0"), "a text that is cut")
            self.at += size
            return text[:-1].decode()
        if kind in SCALARS:
            value = self.scalar(SCALARS[kind])
            return None if isinstance(value, float) and math.isnan(value) else value
        return {field: self.field(types, declared) for declared, field in types[kind]}

    def field(self, types, declared):
        array = re.fullmatch(r"(\S+)\[(\d*)\]", declared)
        if not array:
            return self.value(types, declared)
        count = int(array[2]) if array[2] else self.scalar("I")
        return [self.value(types, array[1]) for _ in range(count)]

    def message(self, types, name):
        value = self.value(types, name)
        require(self.at == len(self.data), f"{name}: {len(self.data) - self.at} bytes are left over")
        return value


def read(data):
    require(data.startswith(MAGIC) and data.endswith(MAGIC), "magic")
    footer_at = len(data) - len(MAGIC) - 9 - 20
    op, size = struct.unpack_from("<BQ", data, footer_at)
    require((op, size) == (FOOTER, 20), "footer")
    summary, offsets, summary_crc = struct.unpack_from("<QQI", data, footer_at + 9)
    require(zlib.crc32(data[summary:len(data) - len(MAGIC) - 4]) == summary_crc, "checksum of the summary")

    file = {"schemas": {}, "channels": {}, "messages": [], "chunks": []}
    chunks, counts, data_end = {}, {}, None
    last_chunk = None
    for op, content, begin, end in records(data, len(MAGIC), summary):
        fields = Fields(content)
        require(data_end is None, "a record behind the end of the data")
        if op == HEADER:
            require(begin == len(MAGIC), "a header amid the file")
            file["profile"], file["library"] = fields.text(), fields.text()
        elif op == SCHEMA:
            identity = fields.number("H")
            require(identity > 0, "a schema without a number")
            file["schemas"][identity] = {"name": fields.text(), "encoding": fields.text(), "text": fields.text()}
        elif op == CHANNEL:
            identity, schema = fields.number("H"), fields.number("H")
            require(schema in file["schemas"], "a channel before its schema")
            file["channels"][identity] = {"schema": schema, "topic": fields.text(), "encoding": fields.text(),
                                          "metadata": dict(fields.pairs(Fields.text, Fields.text))}
        elif op == CHUNK:
            first, last, size, crc = (fields.number(form) for form in "QQQI")
            require(fields.text() == "", "a chunk that is compressed")
            inner = fields.raw(fields.number("Q"))
            require(len(inner) == size and zlib.crc32(inner) == crc, "size or checksum of a chunk")
            last_chunk = chunks[begin] = {"first": first, "last": last, "size": size, "length": end - begin, "at": {},
                                          "index": {}, "index_size": 0}
            times = []
            for inner_op, message, at, _ in records(inner, 0, len(inner)):
                require(inner_op == MESSAGE, "other records than messages in a chunk")
                part = Fields(message)
                channel, sequence, logged, published = (part.number(form) for form in "HIQQ")
                require(channel in file["channels"], "a message before its channel")
                require(sequence == counts.get(channel, 0), "messages that are not counted in their order")
                counts[channel] = sequence + 1
                last_chunk["at"].setdefault(channel, []).append((logged, at))
                times.append(logged)
                file["messages"].append((channel, logged, published, part.rest()))
            require((min(times), max(times)) == (first, last), "the times of a chunk")
        elif op == MESSAGE_INDEX:
            channel = fields.number("H")
            require(channel not in last_chunk["index"], "two indices of one channel")
            entries = fields.pairs(lambda each: each.number("Q"), lambda each: each.number("Q"))
            require(entries == last_chunk["at"].get(channel), "an index that leads elsewhere")
            last_chunk["index"][channel] = begin
            last_chunk["index_size"] += end - begin
        elif op == DATA_END:
            require(fields.number("I") == zlib.crc32(data[:begin]), "checksum of the data")
            data_end = end
        else:
            require(False, f"record {op} in the data")
        fields.end()
    require(data_end == summary, "no end of the data")
    for chunk in chunks.values():
        require(set(chunk["index"]) == set(chunk["at"]), "a channel of a chunk without an index")

    groups, previous, indexed = {}, None, set()
    for op, content, begin, end in records(data, summary, offsets):
        require(op == previous or op not in groups, "a group in two parts")
        previous = op
        first = groups.setdefault(op, [begin, end])
        first[1] = end
        fields = Fields(content)
        if op == SCHEMA:
            require(fields.number("H") in file["schemas"], "a schema in the summary alone")
        elif op == CHANNEL:
            require(fields.number("H") in file["channels"], "a channel in the summary alone")
        elif op == STATISTICS:
            said = [fields.number(form) for form in "QHIIIIQQ"]
            times = [logged for _, logged, _, _ in file["messages"]] or [0]
            require(said == [len(file["messages"]), len(file["schemas"]), len(file["channels"]), 0, 0, len(chunks),
                             min(times), max(times)], f"statistics {said}")
            require(dict(fields.pairs(lambda each: each.number("H"), lambda each: each.number("Q"))) == counts,
                    "statistics of the channels")
            fields.end()
        elif op == CHUNK_INDEX:
            first, last, at, length = (fields.number("Q") for _ in range(4))
            chunk = chunks.get(at)
            require(chunk is not None and (first, last, length) == (chunk["first"], chunk["last"], chunk["length"]),
                    "an index of a chunk that is none")
            require(dict(fields.pairs(lambda each: each.number("H"), lambda each: each.number("Q"))) == chunk["index"],
                    "where the indices of a chunk are")
            require(fields.number("Q") == chunk["index_size"], "the size of the indices of a chunk")
            require((fields.text(), fields.number("Q"), fields.number("Q")) == ("", chunk["size"], chunk["size"]),
                    "the sizes of a chunk")
            indexed.add(at)
            fields.end()
        else:
            require(False, f"record {op} in the summary")
    require(indexed == set(chunks), "a chunk without an index")
    said = {}
    for op, content, begin, end in records(data, offsets, footer_at):
        require(op == SUMMARY_OFFSET, "a record among the offsets")
        group, start, length = struct.unpack("<BQQ", content)
        said[group] = [start, start + length]
    require(said == groups, "offsets of the summary")
    file["chunks"] = len(chunks)
    return file


def main(path):
    with open(path, "rb") as stream:
        file = read(stream.read())
    types = {identity: parse_schema(schema["name"].replace("/msg/", "/"), schema["text"])
             for identity, schema in file["schemas"].items()}
    topics = {}
    for channel in file["channels"].values():
        schema = file["schemas"][channel["schema"]]
        topics[channel["topic"]] = {"type": schema["name"], "schema_encoding": schema["encoding"],
                                    "encoding": channel["encoding"], "metadata": channel["metadata"], "messages": []}
    for channel, logged, published, content in file["messages"]:
        channel = file["channels"][channel]
        name = file["schemas"][channel["schema"]]["name"].replace("/msg/", "/")
        value = Cdr(content).message(types[channel["schema"]], name)
        topics[channel["topic"]]["messages"].append({"time_ns": logged, "published_ns": published, "message": value})
    json.dump({"profile": file["profile"], "library": file["library"], "chunks": file["chunks"], "topics": topics},
              sys.stdout)


if __name__ == "__main__":
    main(sys.argv[1])
