"""The command line's page, from the command itself."""

import re


def page():
    """Markdown: what each verb does, its arguments and options."""
    import typer

    from jaxbearing.cli.main import app

    root = typer.main.get_command(app)
    parts = ["# The command line", root.help or ""]
    for name, command in root.commands.items():
        parts += _verb(name, command)
    parts += ["## Exit codes and environment", f"```text\n{root.epilog.replace(chr(8), '').strip()}\n```"]
    return "\n\n".join(part for part in parts if part) + "\n"


def _verb(name, command):
    context = command.make_context(name, [], resilient_parsing=True)
    rows = [_row(one, context) for one in command.params]
    usage = " ".join(command.collect_usage_pieces(context))
    table = ["| option | what it does |", "|---|---|", *filter(None, rows)]
    text = re.sub(r"^[ \t]+", "", (command.help or "").replace("\b", ""), flags=re.MULTILINE)
    return [f"## jaxbearing {name}", f"```text\njaxbearing {name} {usage}\n```", text, "\n".join(table)]


def _row(one, context):
    record = one.get_help_record(context)
    if record is None:
        record = (one.make_metavar(context), getattr(one, "help", "") or "")
    left, right = (" ".join(text.split()).replace("|", "\\|") for text in record)
    return f"| `{left}` | {right} |"
