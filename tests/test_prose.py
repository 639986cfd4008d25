"""The project's English by numbers: short sentences, and docstrings that say what is returned."""

import prose
import pytest
from repo import ROOT

CODE = prose.files([prose.PACKAGE], ".py")
PAGES = prose.files([prose.PACKAGE / "manual", ROOT / "README.md"], ".md")
MEAN, NINE_TENTHS = 15.0, 25  # words a sentence
LONGEST = {"docstrings": 45, "messages": 33, "pages": 37}  # of messages: a citation
PAGE_MEAN = 18.0
POOR = 0.02  # fraction of docstrings that may begin with a word of POOR_STARTS


def sentences(kind):
    if kind == "pages":
        return [s for path in PAGES for s in prose.page_sentences(path)]
    if kind == "messages":
        return [s for path in CODE for s in prose.texts(path)[1]]
    return [s for path in CODE for d in prose.texts(path)[0] for s in prose.docstring_sentences(d)]


@pytest.mark.parametrize("kind", ["docstrings", "messages", "pages"])
def test_sentences_are_short(kind):
    found = sentences(kind)
    measures = prose.Measures.of(found)
    assert measures.total > 1000
    assert measures.mean <= MEAN and measures.nine_tenths <= NINE_TENTHS
    assert not [f"{s.where}: {s.text}" for s in found if s.words > LONGEST[kind]]


def test_no_page_is_long_winded():
    for path in PAGES:
        found = prose.page_sentences(path)
        assert not found or prose.Measures.of(found).mean <= PAGE_MEAN, path


def test_docstrings_begin_with_what_is_returned_or_done():
    docs = [doc for path in CODE for doc in prose.texts(path)[0]]
    poor = [f"{doc.where}: {doc.text.splitlines()[0]}" for doc in docs if doc.poor_start]
    assert len(poor) <= POOR * len(docs), poor
