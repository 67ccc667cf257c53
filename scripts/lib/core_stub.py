#!/usr/bin/env python3
"""Writes python/mems_stiction/_core.pyi, the types of the compiled part, from the compiled part
itself.

usage: core_stub.py [--check]    --check: changes nothing, exit status 1 if the file is out of date

Figures are there with what they are, as their tables in C++ declare them.
"""

import argparse
import inspect
import pathlib
import re
import sys

from mems_stiction import _core

STUB = pathlib.Path(__file__).resolve().parents[2] / "python" / "mems_stiction" / "_core.pyi"
HEAD = '''"""Types of the compiled part, written by scripts/lib/core_stub.py. Users import mems_stiction, which checks what it hands over."""

from typing import Any, Dict, List, Optional, Sequence, Tuple

import numpy as np
'''  # noqa: E501
FIGURES = (
    "figures: Dict[str, Dict[str, Tuple[str, str, str]]]  # {class: {name: (type, unit, meaning)}}"
)
WORDS = {
    "dict": "Dict[str, Any]",
    "list": "List[Dict[str, Any]]",
    "buffer": "np.ndarray",
}  # what pybind11 says of them is less


def python_type(text):
    """As an annotation, a type that pybind11 names."""
    return re.sub(
        r"(?<![\w.])(?:dict|list|buffer)(?!\w)",
        lambda word: WORDS[word.group()],
        text.replace("mems_stiction._core.", ""),
    )


def signature(function):
    """("name: type, ...", type of the answer) of a function of pybind11, by the first line of its
    text."""
    arguments, answer = re.match(r"\w*\((.*)\) -> (.*)", function.__doc__).groups()
    arguments = re.sub(
        r"^(self|arg0): [^,]*(, )?", lambda first: "self" + (first.group(2) or ""), arguments
    )
    return python_type(arguments).replace(": List[", ": Sequence["), python_type(answer)


def method(name, function, indent=""):
    arguments, answer = signature(function)
    return "%sdef %s(%s) -> %s: ..." % (indent, name, arguments, answer)


def class_lines(kind):
    if issubclass(kind, Exception):
        return [
            "class %s(%s): ..."
            % (kind.__name__, ", ".join(base.__name__ for base in kind.__bases__))
        ]
    lines = ["class %s:" % kind.__name__]
    for name, (type_name, unit, meaning) in _core.figures.get(kind.__name__, {}).items():
        lines += [
            "    %s: %s" % (name, type_name),
            '    """%s%s"""' % ("[%s] " % unit if unit else "", meaning),
        ]
    for name, member in vars(kind).items():
        if isinstance(member, property):
            lines.append("    %s: %s" % (name, signature(member.fget)[1]))
        elif inspect.isroutine(member) and (
            name == "__init__"
            and not member.__doc__.startswith("Initialize self")
            or name[0] != "_"
        ):
            lines.append(method(name, member, "    "))
    return lines if len(lines) > 1 else [lines[0] + " ..."]


def stub():
    members = [getattr(_core, name) for name in sorted(vars(_core)) if not name.startswith("_")]
    classes = sorted(
        (member for member in members if inspect.isclass(member)),
        key=lambda kind: (len(kind.__mro__), kind.__name__),
    )
    lines = [HEAD]
    for kind in classes:
        lines += class_lines(kind) + [""]
    lines += [method(member.__name__, member) for member in members if inspect.isroutine(member)]
    return "\n".join(lines + [FIGURES]) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--check", action="store_true")
    arguments = parser.parse_args()
    text = stub()
    if STUB.read_text() == text:
        return 0
    if arguments.check:
        print(
            "%s is out of date; scripts/lib/core_stub.py writes it anew" % STUB.name,
            file=sys.stderr,
        )
        return 1
    STUB.write_text(text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
