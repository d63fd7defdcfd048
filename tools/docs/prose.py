#!/usr/bin/env python3
"""Words of the pages and sentences that are too long.

    tools/prose [PAGE…]      a line for each page, README.md and all of docs/ if none is named; below it its long sentences

Code in blocks, links' targets and the program's own tables, between <!-- reference --> and <!-- end of reference -->, are no words; a
formula, or code within a line, is one.
"""

import re
import sys
from pathlib import Path

from pages import FENCE, REFERENCE, ROOT, USER_PAGES, pages

#: Most words of a sentence in a page for users, and of all pages.
MOST_WORDS = 40
MOST_OF_ALL = 35_000

#: Sentences in pages for users that may be longer, by their first words.
EXCEPTIONS = ()

ABBREVIATION = re.compile(
    r"(?:(?:^|[,&(;] ?|[A-Z]\. )[A-Z]|\b(?:al|Phys|Rev|Lett|Acad|Sci|Natl|Proc|Math|Comp|Comput|Commun|Biophys|Biol|Cell|Curr|Dev|Soc|Symp|Faraday|"
    r"Discuss|Neurol|Neurosci|Figs?|Sec|e\.g|i\.e))\.$"
)


def paragraphs(text):
    """The pieces of a page's Markdown that hold sentences of their own: paragraphs, items, headings, cells."""
    text = re.sub(r"<!-- reference -->.*?<!-- end of reference -->", "", text, flags=re.S)
    text = re.sub(r"<!--.*?-->", "", FENCE.sub("\n\n", text), flags=re.S)
    text = re.sub(r"\n*^\$\$.*?\$\$\n*", " formula ", text, flags=re.S | re.M)
    text = re.sub(r"^ {4,}(?=(?:build/|mpirun|endoflow |make |python3 |OPENBLAS))[^\n]*$", "", text, flags=re.M)
    text = re.sub(r"\$[^$\n]+\$|`[^`]*`", "Code", text)
    text = re.sub(r"!?\[((?:[^\[\]]|\[[^\]]*\])*)\]\([^)\s]*\)", r"\1", text)
    pieces = []
    for block in re.split(r"\n\s*\n|\n(?=\s*(?:[*-]|\d+\.) )|\n(?=#)|(?<=\|)\n", text):
        pieces += re.split(r"(?<!\\)\|", block) if block.lstrip().startswith("|") else [block]
    return [re.sub(r"\s+", " ", re.sub(r"^\s*(?:[*-]|\d+\.|#+) ", "", piece)).strip() for piece in pieces]


def words(text):
    """How many words a text of a paragraph has."""
    return sum(1 for token in text.split() if re.search(r"[^\W\d_]", token))


def sentences(paragraph):
    """The sentences of a paragraph."""
    found, start = [], 0
    for end in re.finditer(r"(?:[.!?]|\bformula)[)\"”*]*(?= +[\"“(*]*(?:[A-ZΑ-Ω0-9∂∇∫]|[b-zα-ω𝒢][ _]))", paragraph):
        if not ABBREVIATION.search(paragraph[start : end.end()]):
            found.append(paragraph[start : end.end()].strip())
            start = end.end()
    return [*found, paragraph[start:].strip()]


def count(page):
    """The words of a page (Path)."""
    return sum(words(piece) for piece in paragraphs(page.read_text("utf-8")))


def long_sentences(page):
    """The sentences of a page (Path) with more words than they may have."""
    found = [one for piece in paragraphs(page.read_text("utf-8")) for one in sentences(piece) if words(one) > MOST_WORDS]
    return [one for one in found if not one.startswith(EXCEPTIONS)] if EXCEPTIONS else found


def counted():
    """The pages whose words count together, and those that users read among them."""
    ours = [page for page in pages() if page.relative_to(ROOT / "docs").with_suffix("").as_posix() not in REFERENCE]
    users = [ROOT / "README.md"] + [ROOT / "docs" / f"{name}.md" for name in USER_PAGES]
    return [ROOT / "README.md", *ours], [page for page in users if page.exists()]


def main(names):
    """Print them."""
    ours, _ = counted()
    found = [Path(name).resolve() for name in names] or ours
    for page in found:
        print(f"{count(page):6d} {len(long_sentences(page)):3d}  {page.relative_to(ROOT) if page.is_relative_to(ROOT) else page}")
        for one in long_sentences(page) if names else []:
            print(f"        {words(one)}: {one}")
    if not names:
        print(f"{sum(map(count, found)):6d}      all")


if __name__ == "__main__":
    main(sys.argv[1:])
