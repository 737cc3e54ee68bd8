"""Links of files that are read at their place in the repository, as they are on the site."""

import re

_FILE = re.compile(r"^<!-- FILE: (.+?) -->$", flags=re.MULTILINE)
_LINK = re.compile(r"\]\(([^)\s:]+?)(#[^)\s]*)?\)")


def with_files(markdown, folder):
    """A page with `<!-- FILE: path -->` replaced by that Python file as code; the path is relative to `folder`."""
    return _FILE.sub(lambda found: f"```python\n{(folder / found[1]).read_text(encoding='utf-8')}```", markdown)


def of_top_level(markdown):
    """Links of a file at the top of the repository, as links of a page at the top of the site."""
    return _LINK.sub(lambda found: f"]({_page(found[1])}{found[2] or ''})", markdown)


def of_page(markdown, uri):
    """Links of a page of docs/ that leave docs/, "../notebooks/x.ipynb"."""
    up = "../" * (uri.count("/") + 1)

    def one(found):
        target = found[1]
        if not target.startswith(up):
            return found[0].replace(".ipynb", ".md")
        return f"](/{_page(target.removeprefix(up))}{found[2] or ''})".replace("](/", "](" + up.removeprefix("../"))

    return _LINK.sub(one, markdown)


def _page(path):
    """Path in the repository -> page of the site."""
    if path == "CHANGELOG.md":
        return "changelog.md"
    if path == "README.md":
        return "index.md"
    return path.removeprefix("docs/").replace(".ipynb", ".md")
