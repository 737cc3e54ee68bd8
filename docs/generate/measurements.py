"""Tables, deviations and verdicts of the page "Beside measurements", from the data.

    python docs/generate/measurements.py             # all: some minutes
    python docs/generate/measurements.py hertz films # these
    python docs/generate/measurements.py --kept      # none: the page from the kept numbers

What is computed is kept in `beside/computed.json`, and text between the marks `<!-- NAME -->` and `<!-- end NAME -->`
of docs/measurements.md is made of that; the rest is written by hand. Both tables at the top are made of the texts of
all comparisons, also of those that are not computed again. One test compares the page with the kept numbers, and
another computes them again.
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
KIND, ANSWERS, SUMMARY = "kinds", "answers", "summary"
DEVIATION = "**Deviation:** "


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
    """The text between the marks of a comparison."""
    said = (
        f"**Kind of data:** {one.kind}.",
        f"**Conditions:** {one.conditions}",
        f"{DEVIATION}{found.deviation}.",
        f"**Fitted or chosen:** {' '.join(filter(None, (one.free, found.told)))}",
        f"**Not known and assumed:** {one.assumed}",
        f"**Not reproduced:** {one.missed}",
        f"**Verdict:** {one.sentence}",
    )
    return "\n\n".join((found.table, "\\\n".join(said)))


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


def deviation_of(page: str, name: str) -> str:
    """The deviation that the page states; "-" where the comparison was never computed."""
    found = re.search(rf"^{re.escape(DEVIATION)}(.*)\.\\?$", shown(page, name), flags=re.MULTILINE)
    return "-" if found is None else found[1]


def summary(page: str, comparisons: Mapping[str, Comparison]) -> str:
    """The table of all comparisons."""
    lines = ["| quantity | data | kind | deviation | believe to | verdict |", "|---|---|---|---|---|---|"]
    lines += [
        f"| [{one.quantity}](#{anchor(page, name)}) | {one.data} | {one.kind} | {deviation_of(page, name)} | "
        f"{one.believed}{one.beyond} | "
        f"{one.sentence if deviation_of(page, name) != '-' else 'not computed yet'} |"
        for name, one in comparisons.items()
    ]
    return "\n".join(lines)


def answers(page: str, comparisons: Mapping[str, Comparison]) -> str:
    """The table at the top: what to believe of each quantity that a user may want."""
    lines = ["| quantity | for which bearing, oil and range | believe | grounds | section |", "|---|---|---|---|---|"]
    places = {name: anchor(page, name) for name in comparisons} | {guide.NOWHERE: guide.UNCHECKED}
    for row in guide.ROWS:
        link = f"[{'not checked' if row.comparison == guide.NOWHERE else 'data'}](#{places[row.comparison]})"
        grounds = "no data" if row.comparison == guide.NOWHERE else comparisons[row.comparison].kind
        belief = row.belief.format(**{name: one.believed for name, one in comparisons.items()})
        lines.append(f"| {row.quantity} | {row.case} | {belief} | {grounds} | {link} |")
    return "\n".join(lines)


def kinds() -> str:
    """The kinds of data and their meaning."""
    return "\n".join(f"* **{name}**: {meaning}" for name, meaning in KINDS.items())


def anchor(page: str, name: str) -> str:
    """Anchor of the heading that stands above the marks of a name."""
    before = page.partition(f"<!-- {name} -->")[0]
    heading = re.findall(r"^## (.+)$", before, flags=re.MULTILINE)[-1]
    return re.sub(r"[\s-]+", "-", re.sub(r"[^\w\s-]", "", heading).strip().lower())


def show(page: str, name: str, found: Found) -> str:
    """The page with this comparison, and with the summary of all."""
    page = written(page, name, block(COMPARISONS[name], found))
    page = written(written(page, KIND, kinds()), ANSWERS, answers(page, COMPARISONS))
    return written(page, SUMMARY, summary(page, COMPARISONS))


def main(names: Sequence[str]) -> None:
    """Computes the comparisons of these names, of all if there is none, and writes the page after each."""
    anew = list(names) != ["--kept"]
    unknown = [name for name in names if anew and name not in COMPARISONS]
    if unknown:
        raise SystemExit(f"found {', '.join(unknown)}; expected names among {', '.join(COMPARISONS)}")
    for name in names if anew and names else COMPARISONS:
        begin = time.monotonic()
        if anew:
            keep(name, COMPARISONS[name].compute())
        PAGE.write_text(show(PAGE.read_text(encoding="utf-8"), name, kept()[name]), encoding="utf-8")
        print(f"{name}: {time.monotonic() - begin:.1f} s", flush=True)
    pictures.draw(COMPARISONS, kept())


if __name__ == "__main__":
    main(sys.argv[1:])
