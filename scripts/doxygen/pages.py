"""Makes a Markdown page one of Doxygen's.

Headings get the anchors that links in the repository use, made unique by the page's folder; links to
pages and headers that Doxygen sees lead there, links to other files become their text.
"""

import os
import re

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
# A folder whose headers are no part of what is installed, and have no pages.
PRIVATE = "ceres_ed/python/"
LINK = re.compile(r"(?<!!)\[([^\]]+)\]\(([^)\s]+)\)")


def page_id(path):
    """The name of a page, by its path from the root.

    ceres_ed/slam/README.md -> ceres_ed_slam, ceres_ed/slam/decoupling.md -> ceres_ed_slam_decoupling
    """
    name = re.sub(r"(^|/)README\.md$|\.md$", "", path)
    return name.lstrip(".").replace("/", "_") or "readme"


def slug(heading):
    """The anchor that a heading has in the repository's web page."""
    text = re.sub(r"[^\w\s-]", "", heading.lower())
    return re.sub(r"\s", "-", text.strip())


def target(link, this):
    """Where Doxygen has the file of a link on the page at `this`; None where it has none."""
    path, _, anchor = link.partition("#")
    path = os.path.normpath(os.path.join(os.path.dirname(this), path)) if path else None
    if path is None or path.endswith(".md"):
        page = page_id(path or this)
        if page == "readme" and not anchor:
            return "@ref index"
        return f"@ref {page}{'--' + anchor if anchor else ''}"
    if path.endswith(".h") and not path.startswith(PRIVATE) and os.path.exists(os.path.join(ROOT, path)):
        return f"@ref {path}"
    return None


def missing_links(text, path):
    """Returns a warning for each link of a page to a file that isn't there."""
    warnings = []
    for match in LINK.finditer(text):
        link = match[2].partition("#")[0]
        if re.match(r"https?://", match[2]) or link == "":
            continue
        if not os.path.exists(os.path.join(ROOT, os.path.dirname(path), link)):
            number = text.count("\n", 0, match.start()) + 1
            warnings.append(f"{path}:{number}: warning: there is no file {link}")
    return warnings


def convert_line(line, path):
    """One line outside of code, of the page at `path`."""
    page = page_id(path)
    heading = re.match(r"^(#{1,6}) (.*)$", line)
    if heading:
        anchor = page if len(heading[1]) == 1 else f"{page}--{slug(heading[2])}"
        return f"{line} {{#{anchor}}}"

    def relink(match):
        if re.match(r"https?://", match[2]):
            return match[0]
        where = target(match[2], path)
        return f"[{match[1]}]({where})" if where else match[1]

    # Paths in images are found by their names.
    line = re.sub(r"(!\[[^\]]*\]\()(?:[^)]*/)?([^)/]+\))", r"\1\2", line)
    return LINK.sub(relink, line)


def convert_page(text, path):
    """The page at `path` as Doxygen is to see it; links may run over the end of a line."""
    result = []
    # Code is left alone.
    for piece in re.split(r"(^```.*?^```$|^(?:    [^\n]*\n)+)", text, flags=re.M | re.S):
        is_code = piece.startswith("```") or piece.startswith("    ")
        if is_code:
            result.append(piece)
            continue
        piece = re.sub(r"\[[^\]\n]*\n[^\]\n]*\]\([^)]*\)", lambda m: m[0].replace("\n", " "), piece)
        result.append("\n".join(convert_line(line, path) for line in piece.split("\n")))
    return "".join(result)
