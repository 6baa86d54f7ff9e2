#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws which folders of each domain include which: docs/includes.svg.

    tools/draw_includes.py             writes it
    tools/draw_includes.py --check     says whether it is true

An arrow goes from a folder to one that it includes. All point downwards: a circle has no place in the picture.
"""

import html
import sys
from pathlib import Path

import check_layers
import repository

PICTURE = Path("docs") / "includes.svg"
DOORS = "kinds, reproductions"
# Sizes of a box, of the gaps between boxes and rows, and of a card.
WIDTH, HEIGHT, GAP, ROW, MARGIN, TITLE = 156, 34, 18, 84, 24, 44


def arrows(root, domain):
    """Pairs (folder, included folder) of a domain; None stands for what is above its studies."""
    source = root / "src" / "linkwright" / domain
    found = set()
    for path in repository.files(root):
        if source not in path.parents or path.suffix not in (".h", ".cpp"):
            continue
        user = check_layers.folder_of(path.relative_to(source).parts, domain)
        for _, _, name in repository.includes(path):
            parts = name.removeprefix("linkwright/").split("/")
            if name.startswith("linkwright/") and parts[0] == domain and len(parts) > 1:
                used = check_layers.folder_of(parts[1:], domain)
                if used != user:
                    found.add((user, used))
    return found


def places(domain, pairs):
    """Where the box of each folder stands in a card: rows bottom up, as wide as the widest; and the size of the card."""
    rows = [*check_layers.FOLDERS[domain], [check_layers.STUDIES], [None]]
    rows = [[f for f in row if any(f in pair for pair in pairs)] for row in rows]
    rows = [row for row in rows if row]
    widest = max(len(row) for row in rows)
    width = max(2, widest) * (WIDTH + GAP) - GAP + 2 * MARGIN
    height = TITLE + (len(rows) - 1) * ROW + HEIGHT + MARGIN
    at = {}
    for level, row in enumerate(rows):
        left = (width - len(row) * (WIDTH + GAP) + GAP) / 2
        for k, folder in enumerate(row):
            # Single boxes above each other would hide the arrows that pass them.
            aside = (-1) ** level * WIDTH / 4 if len(row) == 1 else 0
            at[folder] = (left + k * (WIDTH + GAP) + aside, TITLE + (len(rows) - 1 - level) * ROW)
    return at, width, height


def name_of(folder):
    return {None: DOORS, check_layers.BASE: "base"}.get(folder, folder)


def card(domain, pairs, x, y):
    at, width, height = places(domain, pairs)
    yield f'<g transform="translate({x:g} {y:g})"><rect class="card" width="{width:g}" height="{height:g}" rx="10"/>'
    yield f'<text class="title" x="{MARGIN}" y="28">{domain}</text>'
    for user, used in sorted(pairs, key=lambda pair: (name_of(pair[0]), name_of(pair[1]))):
        (x0, y0), (x1, y1) = at[user], at[used]
        x0, y0, x1 = x0 + WIDTH / 2, y0 + HEIGHT, x1 + WIDTH / 2
        bend = (y1 - y0) / 2
        yield f'<path class="arrow" marker-end="url(#tip)" d="M{x0:g} {y0:g}C{x0:g} {y0 + bend:g} {x1:g} {y1 - bend:g} {x1:g} {y1 - 4:g}"/>'
    for folder, (left, top) in at.items():
        yield f'<rect class="box" x="{left:g}" y="{top:g}" width="{WIDTH}" height="{HEIGHT}" rx="6"/>'
        yield f'<text x="{left + WIDTH / 2:g}" y="{top + 22:g}" text-anchor="middle">{html.escape(name_of(folder))}</text>'
    yield "</g>"


def picture(root):
    shown = {domain: arrows(root, domain) for domain in check_layers.FOLDERS}
    cards, x, y, tallest, wide = [], 0, 0, 0, 0
    for domain, pairs in sorted(shown.items(), key=lambda item: -len(item[1])):
        _, width, height = places(domain, pairs)
        if x and x + width > 1120:
            x, y, tallest = 0, y + tallest + 20, 0
        cards += card(domain, pairs, x, y)
        x, tallest = x + width + 20, max(tallest, height)
        wide = max(wide, x - 20)
    return "\n".join([
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="-10 -10 {wide + 20:g} {y + tallest + 20:g}" role="img" '
        'aria-label="Which folders of each domain include which" '
        'font-family="\'Source Sans 3\',\'Segoe UI\',Helvetica,Arial,sans-serif" font-size="14">',
        '<defs><marker id="tip" viewBox="0 0 8 8" refX="4" refY="4" markerWidth="7" markerHeight="7" orient="auto">'
        '<path d="M0 0 8 4 0 8Z" fill="#5b6b7b"/></marker></defs>',
        "<style>.card{fill:#f6f8fa;stroke:#d0d7de}.box{fill:#fff;stroke:#0b5cad;stroke-width:1.4}"
        ".arrow{fill:none;stroke:#5b6b7b;stroke-width:1.2}.title{font-weight:700;font-size:16px}text{fill:#1b2733}</style>",
        *cards, "</svg>", ""])


if __name__ == "__main__":
    repo = Path(__file__).resolve().parent.parent
    drawn = picture(repo)
    if sys.argv[1:] == ["--check"]:
        if not (repo / PICTURE).exists() or (repo / PICTURE).read_text(encoding="utf-8") != drawn:
            sys.exit(f"{PICTURE} is not what the includes are: run tools/draw_includes.py")
    else:
        (repo / PICTURE).write_text(drawn, encoding="utf-8")
