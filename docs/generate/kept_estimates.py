"""Kept estimates of the geometries of standard bearings, `jaxbearing/catalogue/data/estimates.csv`.

    python docs/generate/kept_estimates.py

It must be run again after a change of the dimensions, of the usual proportions, of the estimate or of the formulas of
ratings; tests in tests/catalogue find a file that is out of date. It takes a minute.
"""

from pathlib import Path

from jaxbearing.catalogue import parse
from jaxbearing.catalogue.estimate import estimate
from jaxbearing.catalogue.kept import HEADING, kept_designations, kept_file, key_of, row_of
from jaxbearing.catalogue.terms import angle_of


def rows() -> list[str]:
    """The rows in their order; several types share an estimate, such as NU 311 and NJ 311."""
    found = {}
    for text in kept_designations():
        bearing = parse(text)
        angle = angle_of(bearing, None)
        key = key_of(bearing, angle)
        if key not in found:
            found[key] = row_of(bearing, angle, estimate(bearing, {}, angle))
    return list(found.values())


def main() -> None:
    """Writes the file."""
    lines = [HEADING, *rows()]
    Path(str(kept_file())).write_text("\n".join(lines) + "\n", encoding="utf-8")
    print(f"{kept_file()}: {len(lines) - 1} estimates")


if __name__ == "__main__":
    main()
