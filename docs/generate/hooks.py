"""What `mkdocs build` asks of this project: pages made from code, notebooks and top-level files, and formulas."""

from pathlib import Path

import api_pages
import command_line
import gfm_lists
import links
import maths
import notebook_pages
from mkdocs.structure.files import File

TOP = Path(__file__).parents[2]
MADE = {
    "changelog.md": lambda: links.of_top_level((TOP / "CHANGELOG.md").read_text(encoding="utf-8")),
    "command_line.md": command_line.page,
}


def on_config(config):
    config.markdown_extensions.append(gfm_lists.GfmLists())
    return config


def on_files(files, config):
    """Adds the pages that no file holds, and to the navigation what is there to be found."""

    def add(uri, content):
        files.append(File.generated(config, uri, content=content))

    for uri, make in MADE.items():
        add(uri, make())
    add("generated/site.css", (Path(__file__).parent / "site.css").read_text(encoding="utf-8"))
    add("generated/math.ttf", maths.font())
    found = []
    for path in sorted((TOP / "notebooks").glob("*.ipynb")):
        text, pictures = notebook_pages.page(path)
        add(f"notebooks/{path.stem}.md", text)
        found.append(f"notebooks/{path.stem}.md")
        for name, data in pictures.items():
            add(f"notebooks/{name}", data)
    if (TOP / "docs" / "gallery.md").exists():
        found.insert(0, "gallery.md")
    config.nav.append({"Notebooks": found})
    _list_the_rest(config.nav, found)
    pages = api_pages.pages(TOP)
    for uri, content in pages.items():
        add(uri, content)
    config.nav.append({"API": list(pages)})
    return files


def _list_the_rest(nav, named):
    """Pages of docs/ that the navigation does not name yet go to the end of the guide."""
    written = (TOP / "mkdocs.yml").read_text(encoding="utf-8").split("\nnav:")[1].split()
    rest = (path.name for path in sorted((TOP / "docs").glob("*.md")) if path.name not in (*written, *named))
    next(section["Guide"] for section in nav if "Guide" in section).extend(rest)


def on_page_markdown(markdown, page, config, files):
    return links.with_files(links.of_page(markdown, page.file.src_uri), TOP / "docs")


def on_page_content(html, page, config, files):
    return maths.to_mathml(html)
