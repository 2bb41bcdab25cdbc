#!/usr/bin/env python3
"""Checks the page's modules: each import names an export of the other file, no top-level name is defined twice in the
files that are joined into one, and, if node is installed, the syntax is valid.

usage: modules_test.py FOLDER      exit code 0: clean, 1: not, 77: clean, but node is missing
"""

import json
import re
import shutil
import subprocess
import sys
from pathlib import Path

IMPORT = re.compile(r"^import \{ ([^}]+) \} from '\./(\w+\.js)';$", re.M)
TOP = re.compile(r"^(?:export )?(?:async )?(?:class|function\*?|const|let) (\w+)|^const (\w+) = [^,;]+?, (\w+) = ", re.M)
EXPORT = re.compile(r"^export (?:async )?(?:class|function\*?|const) (\w+)", re.M)


def problems(modules):
    owner = {}
    for name, text in modules.items():
        imports = IMPORT.findall(text)
        if len(imports) != len(re.findall(r"^import\b", text, re.M)):
            yield f"{name}: an import that the page's joining does not know"
        for words, other in imports:
            for word in words.split(", "):
                if word not in EXPORT.findall(modules.get(other, "")):
                    yield f"{name}: {other} exports no {word}"
                elif len(re.findall(rf"\b{word}\b", text)) < 2:
                    yield f"{name}: {word} is imported for nothing"
        for word in {found for names in TOP.findall(text) for found in names if found}:
            if word in owner:
                yield f"{name}: {word} stands in {owner[word]} already"
            owner[word] = name


def joined(modules):
    return "\n".join(re.sub(r"^export ", "", IMPORT.sub("", text), flags=re.M) for text in modules.values())


# One process of node reads all modules.
READER = """
const vm = require('node:vm');
let text = '';
process.stdin.on('data', (part) => { text += part; }).on('end', () => {
  for (const [name, module] of Object.entries(JSON.parse(text))) {
    try {
      new vm.SourceTextModule(module, { identifier: name });
    } catch (error) {
      console.log(`${name}: ${error.stack.split('\\n').slice(0, 5).join(' ')}`);
    }
  }
});"""


def grammar_problems(node, modules):
    read = subprocess.run([node, "--no-warnings", "--experimental-vm-modules", "-e", READER], input=json.dumps(modules), text=True,
                          capture_output=True)
    if read.returncode:
        yield read.stderr.strip()
    yield from read.stdout.splitlines()


def main():
    modules = {file.name: file.read_text(encoding="utf-8") for file in sorted(Path(sys.argv[1]).glob("*.js"))}
    found = list(problems(modules)) or ([] if modules else ["no module"])
    node = shutil.which("node")
    if node:
        found += grammar_problems(node, {**modules, "the joined modules": joined(modules)})
    print("\n".join(found) or ("clean" if node else "clean, but node is not here to read them"))
    return 1 if found else 0 if node else 77


if __name__ == "__main__":
    sys.exit(main())
