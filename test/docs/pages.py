"""The code blocks of Markdown pages, and what the comments ahead of them say.

A comment on the line ahead of a block says how it is covered:

    <!-- file: PATH -->          the block is in that file, line for line
    <!-- prints -->              a ```text block: what the ```sh block before it prints
    <!-- tested by: NAME -->     that test runs it
    <!-- not run: REASON -->     nothing does
"""

import glob
import os
import re
from dataclasses import dataclass

# Where pages are: each name is a pattern for folders, and a page is any .md file in one of them.
FOLDERS = ["", ".github/**", "apps/**", "ceres_ed/**", "cost_functions/**", "data/**", "scripts/**",
           "test/**"]
MARK = re.compile(r"^<!-- (file|prints|tested by|not run)(?:: (.*?))? -->$")
# Fences whose content is no code.
PROSE = {"text", "json", "csv", "markdown"}
# What gives an indented block away as code that ought to be fenced.
CODE = re.compile(
    r"^(?:\$ )?(?:ed_[a-z]+|scripts/|cmake|cd|export|apt|sudo|git|python3?|bash|import|#include|make)\b"
    r"|[;{]$",
    re.M)


@dataclass
class Block:
    """A code block: page and line of its first line, language, text, and the comment ahead."""

    page: str
    line: int
    language: str
    text: str
    mark: str = ""
    value: str = ""

    def place(self):
        """What messages begin with."""
        return f"{self.page}:{self.line}"


def find_pages(root):
    """Returns all pages, as paths relative to the root of the repository."""
    found = {path for folder in FOLDERS
             for path in glob.glob(os.path.join(root, folder, "*.md"), recursive=True)}
    return sorted(os.path.relpath(path, root) for path in found)


def is_blank(line):
    """Whether nothing is on the line."""
    return line.strip() == ""


def read_blocks(text, page):
    """Returns the fenced blocks of a page, and those that are set in as ones without language."""
    blocks = []
    lines = text.split("\n")
    mark, value = "", ""
    i = 0
    while i < len(lines):
        line = lines[i]
        fence = re.match(r"^(\s*)```(\w*)\s*$", line)
        set_in = re.match(r"^    \S", line) and (i == 0 or is_blank(lines[i - 1]))
        if fence:
            end = i + 1
            while end < len(lines) and lines[end].strip() != "```":
                end += 1
            depth = len(fence[1])
            body = [content[depth:] for content in lines[i + 1 : end]]
            blocks.append(Block(page, i + 2, fence[2], "\n".join(body) + "\n", mark, value))
            i = end
        elif set_in:
            end = i
            while end < len(lines) and re.match(r"^    \S|^    +$|^$|^     ", lines[end]):
                end += 1
            body = [content[4:] for content in lines[i:end]]
            blocks.append(Block(page, i + 1, "", "\n".join(body).rstrip() + "\n", mark, value))
            i = end - 1
        found = MARK.match(line)
        if found:
            mark, value = found[1], found[2] or ""
        elif not is_blank(line):
            mark, value = "", ""
        i += 1
    return blocks
