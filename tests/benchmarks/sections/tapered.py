"""Tapered roller bearing: laminae of the tilted contacts against the closed form."""

from benchmark_report import HERE, load
from section_shape import Section, Table


def section(quick=False):
    script = load(HERE / "misaligned_roller.py")
    rows = script.solve_rows()
    closed = rows[0][0]
    contacts = script.laminae_errors()
    table = tuple(
        (
            n or "closed form",
            None if n == 0 else float(max(contacts[n])),
            error,
            1e3 * seconds,
            seconds / closed,
        )
        for n, (seconds, error) in rows.items()
    )
    return Section(
        "Misaligned tapered roller bearing",
        "`tapered_example` with 2 mrad between its rings, without friction. Straight rollers have closed forms of load "
        "and moment; laminae, which profiles need, converge to them.",
        (
            Table(
                "Errors of a contact's load and moment, and of the largest load of the bearing:",
                ("laminae", "of the contact", "of the bearing", "ms a solve", "times the closed form"),
                table,
            ),
        ),
        {"error with 30 laminae": rows[30][1], "cost of 30 laminae": rows[30][0] / closed},
    )
