"""Makes documentation of the plain `//` comments of a header.

A comment that stands ahead of a declaration becomes `///`, one behind a member `///<`, the one at the
head of the file its description. Comments in function bodies stay what they are. Lines keep their
numbers, so warnings point at the header itself.
"""

import re

COMMENT = re.compile(r"^(\s*)//(?: (.*)| ?$)")
TRAILING = re.compile(r"^(\s*[^\s/].*?[;,])(\s+)// (.*)$")
NO_DOC = re.compile(r"clang-format|NOLINT|^-{3}")
# What opens a scope whose members are declarations.
SCOPE = re.compile(r'^(?:namespace|class|struct|enum|union|extern "C")\b')
ACCESS = re.compile(r"\b(?:public|private|protected):")
LIST_ITEM = re.compile(r"\s*(?:[-*]|\d+\.) ")


class Scopes:
    """Follows braces, and knows whether the next line is among declarations or in a body."""

    def __init__(self):
        self._stack = []
        self._statement = ""
        self._in_macro = False

    def among_declarations(self):
        """Whether a comment here belongs to what follows."""
        return all(self._stack)

    def follow(self, line):
        """Takes in one line of code."""
        if line.startswith("#") or self._in_macro:
            self._in_macro = line.endswith("\\")
            return
        code = re.sub(r'"(?:\\.|[^"\\])*"|\'(?:\\.|[^\'\\])\'', '""', line)
        code = re.sub(r"//.*", "", code)
        for character in code:
            if character == "{":
                self._stack.append(self._opens_scope())
                self._statement = ""
            elif character == "}":
                if self._stack:
                    self._stack.pop()
                self._statement = ""
            elif character == ";":
                self._statement = ""
            else:
                self._statement += character
        self._statement += " "

    def _opens_scope(self):
        statement = ACCESS.sub(" ", self._statement).strip()
        statement = re.sub(r"^template\s*<.*?>\s+(?=class|struct)", "", statement)
        return bool(SCOPE.match(statement))


def escape(text):
    """What Doxygen would take for commands and tags, outside of `code`."""
    pieces = text.split("`")
    for i in range(0, len(pieces), 2):
        pieces[i] = re.sub(r"([\\@<>#&])", r"\\\1", pieces[i])
    return re.sub(r"\bEq\. ", r"Eq.\\ ", "`".join(pieces))


def document(block, indent, head=""):
    """Returns a block of comment lines as documentation; lines set in from the rest are code."""
    lines = []
    in_list = False
    is_code = []
    for text in block:
        set_in = text.startswith("  ")
        if LIST_ITEM.match(text):
            in_list = True
        elif text and not set_in:
            in_list = False
        is_code.append(set_in and not in_list)
    for i, text in enumerate(block):
        if not is_code[i]:
            lines.append(escape(text))
            continue
        first = i == 0 or not is_code[i - 1]
        last = i + 1 == len(block) or not is_code[i + 1]
        lines.append(("@code{.cpp} " if first else "") + text + (" @endcode" if last else ""))
    if head:
        lines[0] = f"{head} {lines[0]}"
    return [f"{indent}/// {line}".rstrip() for line in lines]


def is_declaration(line):
    """Whether `line`, which follows a comment, is something to document."""
    if line.strip() == "" or ACCESS.match(line.strip()) or line.strip().startswith("}"):
        return False
    return not line.startswith("#") or line.startswith("#define")


def convert(source, name):
    """Returns the lines of the header `name` as Doxygen is to see them."""
    result = []
    scopes = Scopes()
    at_head = True
    i = 0
    while i < len(source):
        match = COMMENT.match(source[i])
        if not match:
            at_head = False
            trailing = TRAILING.match(source[i])
            scopes.follow(source[i])
            if trailing and scopes.among_declarations() and not NO_DOC.search(trailing[3]):
                result.append(f"{trailing[1]}{trailing[2]}///< {escape(trailing[3])}")
            else:
                result.append(source[i])
            i += 1
            continue
        end = i
        block = []
        while end < len(source) and COMMENT.match(source[end]):
            block.append(COMMENT.match(source[end])[2] or "")
            end += 1
        follower = source[end] if end < len(source) else ""
        if NO_DOC.search(block[0]):
            result += source[i:end]
        elif at_head:
            result += document(block, "", f"@file {name}\n///")
        elif scopes.among_declarations() and is_declaration(follower):
            result += document(block, match[1])
        else:
            result += source[i:end]
        at_head = False
        i = end
    return result


def drop_guard(lines):
    """Takes the include guard out, which makes room for the line that `@file` takes."""
    for i, line in enumerate(lines):
        guard = re.match(r"#ifndef (\w+_H_)$", line)
        if guard and lines[i + 1] == f"#define {guard[1]}":
            lines[i : i + 2] = ["#pragma once"]
            lines[-1] = re.sub(r"^#endif.*", "", lines[-1])
            return


def convert_header(text, name):
    """The text of the header `name` (its path from the root) as Doxygen is to see it."""
    lines = text.splitlines()
    drop_guard(lines)
    return "\n".join(convert(lines, name)) + "\n"
