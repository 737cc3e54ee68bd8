"""Table of the page "Beside measurements", and the comparisons with data on which it rests.

    python docs/generate/measurements.py             # computes all: some minutes
    python docs/generate/measurements.py hertz films # these
    python docs/generate/measurements.py --kept      # none: the page from the kept numbers
    python docs/generate/measurements.py --show hertz # prints a comparison as it was last computed

What is computed is kept in `beside/computed.json`. Text between the marks `<!-- NAME -->` and `<!-- end NAME -->` of
docs/measurements.md is made of the comparisons. One test compares the page with them, and another computes them again.
"""

import json
import re
import sys
import time
from collections.abc import Mapping, Sequence
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))

from beside import catalogues, contacts, guide, heat, pictures, prediction, source, torque
from beside.common import DOCS, KINDS, Comparison, Found

PAGE = DOCS / "measurements.md"
KEPT = Path(__file__).parent / "beside" / "computed.json"
COMPARISONS: dict[str, Comparison] = {
    one.name: one for module in (heat, torque, catalogues, contacts, source, prediction) for one in module.COMPARISONS
}
KIND, ANSWERS = "kinds", "answers"
OPTIONS = ("--kept", "--show")


def kept() -> dict[str, Found]:
    """The results that were computed last, by the names of the comparisons."""
    whole = json.loads(KEPT.read_text(encoding="utf-8")) if KEPT.exists() else {}
    return {name: Found(**one) for name, one in whole.items()}


def keep(name: str, found: Found) -> None:
    """Replaces one of the kept comparisons."""
    whole = kept() | {name: found}
    ordered = {one: whole[one]._asdict() for one in COMPARISONS if one in whole}
    KEPT.write_text(json.dumps(ordered, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")


def block(one: Comparison, found: Found) -> str:
    """A comparison in words, with the table of its points."""
    said = (
        f"{one.quantity}: {one.data}",
        f"Kind of data: {one.kind}.",
        f"Conditions: {one.conditions}",
        f"Deviation: {found.deviation}.",
        f"Fitted or chosen: {' '.join(filter(None, (one.free, found.told)))}",
        f"Not known and assumed: {one.assumed}",
        f"Not reproduced: {one.missed}",
        f"Verdict: {one.sentence}",
    )
    return "\n".join((*said, "", found.table))


def place(name: str) -> re.Pattern[str]:
    """Finds the marks of a name and what stands between them."""
    return re.compile(rf"(<!-- {name} -->\n)(.*?)(<!-- end {name} -->)", flags=re.DOTALL)


def shown(page: str, name: str) -> str:
    """The text of a page between the marks of a name."""
    found = place(name).search(page)
    if found is None:
        raise ValueError(f"{PAGE.name}: found no marks of {name}")
    return found[2].strip()


def written(page: str, name: str, text: str) -> str:
    """The page with another text there."""
    shown(page, name)
    return place(name).sub(lambda found: f"{found[1]}\n{text}\n\n{found[3]}", page)


def answers(comparisons: Mapping[str, Comparison]) -> str:
    """The table: what to believe of each quantity that a user may want."""
    lines = ["| result | bearing, oil and range | believe | data | comparison |", "|---|---|---|---|---|"]
    for row in guide.ROWS:
        kind, name = (
            ("-", "-") if row.comparison == guide.NOWHERE else (comparisons[row.comparison].kind, row.comparison)
        )
        belief = row.belief.format(**{name: one.believed for name, one in comparisons.items()})
        lines.append(f"| {row.quantity} | {row.case} | {belief} | {kind} | {name} |")
    return "\n".join(lines)


def kinds() -> str:
    """The kinds of data and their meaning."""
    return "\n".join(f"* **{name}**: {meaning}" for name, meaning in KINDS.items())


def show(page: str) -> str:
    """The page with the texts of the comparisons."""
    return written(written(page, KIND, kinds()), ANSWERS, answers(COMPARISONS))


def main(names: Sequence[str]) -> None:
    """Computes the comparisons of these names, of all if there is none, and writes the page."""
    options, names = [name for name in names if name.startswith("--")], [name for name in names if name[:2] != "--"]
    unknown = [name for name in names if name not in COMPARISONS] + [one for one in options if one not in OPTIONS]
    if unknown:
        raise SystemExit(
            f"found {', '.join(unknown)}; expected {', '.join(OPTIONS)} or names among {', '.join(COMPARISONS)}"
        )
    if "--show" in options:
        print("\n\n".join(block(COMPARISONS[name], kept()[name]) for name in names or COMPARISONS))
        return
    for name in () if "--kept" in options else names or COMPARISONS:
        begin = time.monotonic()
        keep(name, COMPARISONS[name].compute())
        print(f"{name}: {time.monotonic() - begin:.1f} s", flush=True)
    PAGE.write_text(show(PAGE.read_text(encoding="utf-8")), encoding="utf-8")
    pictures.draw(COMPARISONS, kept())


if __name__ == "__main__":
    main(sys.argv[1:])
