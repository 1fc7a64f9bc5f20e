#!/usr/bin/env python3
"""Says where the pages of the project no longer tell the truth, and exits with 1 if they do not.

usage: tools/check_docs.py [--fix] [--duskline PATH]

  --fix            write what blocks should say into the pages
  --duskline PATH  the command; without it what it prints is not checked

Every link to a file or a heading must lead somewhere, and a block of code that follows one of these lines must say
exactly what they name:

  <!-- file: examples/hello_shadow.cpp -->   the file
  <!-- prints: duskline --help -->           what the command prints
"""

import argparse
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).parents[1]
BLOCK = re.compile(r"<!-- (file|prints): (.+?) -->\n+```(\w*)\n(.*?)```\n", re.DOTALL)
CODE = re.compile(r"^```.*?^```$", re.DOTALL | re.MULTILINE)
LINK = re.compile(r"\]\(([^)\s]+)\)")


def pages(root):
    return sorted([*root.glob("*.md"), *root.glob("docs/**/*.md"), *root.glob("data/*.md")])


def anchors(page):
    """The anchors of a page's headings, as GitHub makes them."""
    headings = re.findall(r"^#+ (.+)$", CODE.sub("", page.read_text()), re.MULTILINE)
    plain = (re.sub(r"[^\w\- ]", "", heading.strip().lower()) for heading in headings)
    return {heading.replace(" ", "-") for heading in plain}


def broken_links(page):
    for target in LINK.findall(CODE.sub("", page.read_text())):
        if re.match(r"\w+:", target):
            continue
        path, _, anchor = target.partition("#")
        file = page.parent / path if path else page
        if not file.exists():
            yield f"no file '{path}'"
        elif anchor and file.suffix == ".md" and anchor not in anchors(file):
            yield f"'{path}' has no heading '#{anchor}'"


def wanted(root, kind, name, duskline):
    """What a block should say; None when that is not known here."""
    if kind == "file":
        return (root / name).read_text()
    if not duskline:
        return None
    words = name.split()
    assert words[0] == "duskline", name
    return subprocess.run([duskline, *words[1:]], check=True, capture_output=True, text=True).stdout


def with_true_blocks(root, text, duskline):
    def replaced(match):
        kind, name, language, body = match.groups()
        says = wanted(root, kind, name, duskline)
        return match.group(0).replace(f"```{language}\n{body}```", f"```{language}\n{body if says is None else says}```")

    return BLOCK.sub(replaced, text)


def stale_blocks(root, text, duskline):
    for kind, name, _, body in BLOCK.findall(text):
        says = wanted(root, kind, name, duskline)
        if says is not None and says != body:
            yield f"the block '{kind}: {name}' is out of date (tools/check_docs.py --fix renews it)"


def problems(root, duskline):
    for page in pages(root):
        for problem in [*broken_links(page), *stale_blocks(root, page.read_text(), duskline)]:
            yield f"{page.relative_to(root)}: {problem}"


def main():
    parser = argparse.ArgumentParser(usage=__doc__.split("usage: ")[1].split("\n")[0], add_help=False)
    parser.add_argument("-h", "--help", action="store_true")
    parser.add_argument("--fix", action="store_true")
    parser.add_argument("--duskline")
    options = parser.parse_args()
    if options.help:
        print(__doc__.strip())
        return 0
    if options.fix:
        for page in pages(ROOT):
            page.write_text(with_true_blocks(ROOT, page.read_text(), options.duskline))
    found = list(problems(ROOT, options.duskline))
    print("\n".join(found), end="\n" if found else "")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
