"""Notebooks as pages, with the outputs that they are stored with; nothing is executed."""

import links


def page(path):
    """Markdown of a notebook, and its pictures by file name."""
    import nbformat
    from nbconvert import MarkdownExporter

    notebook = nbformat.read(path, as_version=4)
    for cell in notebook.cells:
        if cell.cell_type == "code":
            for output in cell.outputs:
                _without_scripts(output)
            cell.outputs = [output for output in cell.outputs if output.get("data", True)]
        cell.source = cell.source.replace("](../", "](../../") if cell.cell_type == "markdown" else cell.source
    text, resources = MarkdownExporter().from_notebook_node(
        notebook, resources={"unique_key": path.stem, "output_files_dir": f"{path.stem}_files"}
    )
    pictures = resources["outputs"]
    return links.of_page(text, f"notebooks/{path.stem}.md"), pictures


def _without_scripts(output):
    """Widgets and scripts need a kernel or a network: what stands beside them is shown instead."""
    data = output.get("data", {})
    data.pop("application/vnd.jupyter.widget-view+json", None)
    for kind in [kind for kind, content in data.items() if "javascript" in kind or "<script" in str(content)]:
        del data[kind]
