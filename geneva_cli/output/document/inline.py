"""An SVG within a page, with ids and styles of its own."""

from __future__ import annotations

import re
from collections.abc import Iterable


def inline(chunks: Iterable[str], name: str) -> str:
    """The element with ids that begin with ``name``, and styles for it alone."""
    text = "".join(chunks)
    text = text[text.index("<svg") :]
    text = re.sub(r' id="([^"]+)"', rf' id="{name}-\1"', text)
    text = text.replace("url(#", f"url(#{name}-")
    style_element = re.compile(r"<style>\n(.*?)</style>\n", re.DOTALL)
    text = style_element.sub(lambda m: f"<style>\n{_scoped(m[1], name)}</style>\n", text)
    return text.replace("<svg ", f'<svg id="{name}" ', 1)


def _scoped(style: str, name: str) -> str:
    style = style.replace("[id='", f"[id='{name}-")
    style = re.sub(r"#(?=[A-Z])", f"#{name}-", style)  # an id; colours have small letters
    # a file's styles hold on any medium; a printed page is light
    dark_mode = re.compile(r"@media (?:screen and )?\(prefers-color-scheme: dark\)")
    style = dark_mode.sub("@media screen and (prefers-color-scheme: dark)", style)
    lines = style.splitlines(keepends=True)
    rule = re.compile(r"([^{}\n]+?) \{")
    return "".join(
        line if line.startswith("@") else rule.sub(lambda m: f"{_all(m[1], name)} {{", line)
        for line in lines
    )


def _all(selectors: str, name: str) -> str:
    return ", ".join(f"#{name} {one.strip()}" for one in selectors.split(","))
