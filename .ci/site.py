"""Hooks of mkdocs: the contents from the manual's list of pages, a start page, links in texts."""

import re
from pathlib import Path
from typing import Any

from mkdocs.exceptions import PluginError
from mkdocs.structure.files import File, Files

from geneva_cli.cli.pages import PRINTED
from geneva_cli.manual import GROUPS, TOPICS, path

START = "index.md"
_COMMAND = re.compile(r"`geneva help ([a-z-]+)`")
_PICTURE = re.compile(r'<img src="([^"]+)"')


def _file(topic: str) -> str:
    """A topic's page, from the folder of all pages."""
    return "/".join(Path(path(topic)).parts[-2:])


def on_config(config: Any) -> Any:
    """Make the navigation: the start, then a heading for each kind of page."""
    groups = [
        {title.partition(":")[0]: [_file(topic) for topic in pages]}
        for title, pages in GROUPS.items()
    ]
    config.nav = [{"Start": START}, *groups]
    return config


def on_files(files: Files, config: Any) -> Files:
    """Add the pages that the code prints, and the start: all pages, with what each is about."""
    parts = ["# geneva\n\nDesign calculator for Geneva (Maltese-cross) mechanisms.\n"]
    for title, pages in GROUPS.items():
        lines = [f"- [{topic}]({_file(topic)}): {about}" for topic, about in pages.items()]
        parts.append("\n".join([f"## {title}\n", *lines, ""]))
    files.append(File.generated(config, START, content="\n".join(parts)))
    for topic, made in PRINTED.items():
        files.append(File.generated(config, _file(topic), content=made()))
    return files


def on_page_markdown(text: str, page: Any, config: Any, files: Files) -> str:
    """Link each `geneva help TOPIC` to its page. Raises PluginError for a missing picture."""
    folder = page.file.src_uri.rpartition("/")[0]
    for name in _PICTURE.findall(text):
        if files.get_file_from_path(name.removeprefix("../")) is None:
            raise PluginError(f"{page.file.src_uri}: no picture {name}")

    def link(found: re.Match[str]) -> str:
        if found[1] not in TOPICS:
            return found[0]
        return f"[{found[0]}]({'../' if folder else ''}{_file(found[1])})"

    return _COMMAND.sub(link, text)
