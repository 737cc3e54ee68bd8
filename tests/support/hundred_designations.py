"""A hundred designations across all series."""

from jaxbearing.catalogue.designation import known_designations


def hundred():
    """Every series at several bores; of cylindrical roller bearings the type NU."""
    series = {}
    for text in known_designations():
        if not text.startswith(("NUP", "NJ", "NF", "N ")):
            series.setdefault((text[:-2], len(text)), []).append(text)
    spread = [names[i] for names in series.values() for i in sorted({0, len(names) // 3, 2 * len(names) // 3, -1})]
    names = list(dict.fromkeys(spread))
    return [names[round(i * (len(names) - 1) / 99)] for i in range(100)]
