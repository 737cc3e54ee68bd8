"""Constants of Palmgren's formula: those of INA and those of Timken.

**Sources:** Schaeffler/INA catalogue HR1, pages 55 to 61 (read in its text), which says that its values follow test
series and ISO 15312; Timken Engineering Manual, pages 179 to 184 (read in its text).
"""

from typing import NamedTuple


class Frictions(NamedTuple):
    r"""Constants of one series: f0 with grease or oil mist, f0 with an oil bath, and those of
    $f_1 = $ `size` $(P_0/C_0)^{exponent}$."""

    grease: float
    bath: float
    size: float
    exponent: float = 0.0


INA = {
    "deep_groove": {
        ("60", "619"): Frictions(1.1, 1.7, 0.0009, 0.5),
        ("62",): Frictions(1.3, 2.0, 0.0009, 0.5),
        ("63", "64"): Frictions(1.5, 2.3, 0.0009, 0.5),
        ("618",): Frictions(1.1, 1.7, 0.0005, 0.5),
        ("160",): Frictions(1.1, 1.7, 0.0007, 0.5),
    },
    "angular_contact": {
        ("70B", "718B", "72B"): Frictions(1.3, 2.0, 0.001, 0.33),
        ("73B",): Frictions(2.0, 3.0, 0.001, 0.33),
        ("32B",): Frictions(2.3, 3.5, 0.001, 0.33),
        ("33B",): Frictions(4.0, 6.0, 0.001, 0.33),
    },
    "four_point": {("QJ2", "QJ3"): Frictions(2.7, 4.0, 0.001, 0.33)},
    "cylindrical": {
        ("2",): Frictions(1.3, 2.0, 0.0003),
        ("3",): Frictions(1.3, 2.0, 0.00035),
        ("4",): Frictions(1.3, 2.0, 0.0004),
        ("10", "19"): Frictions(1.3, 2.0, 0.0002),
        ("22",): Frictions(2.0, 3.0, 0.0004),
        ("23",): Frictions(2.7, 4.0, 0.0004),
        ("30",): Frictions(1.7, 2.5, 0.0004),
    },
    "cylindrical_full": {
        ("18",): Frictions(3.0, 5.0, 0.00055),
        ("29",): Frictions(4.0, 6.0, 0.00055),
        ("30",): Frictions(5.0, 7.0, 0.00055),
        ("22",): Frictions(5.0, 8.0, 0.00055),
    },
    "tapered": {
        ("302", "303", "313"): Frictions(2.0, 3.0, 0.0004),
        ("329", "320", "320X", "322", "322B", "323", "323B"): Frictions(3.0, 4.5, 0.0004),
        ("330", "331", "332"): Frictions(4.0, 6.0, 0.0004),
    },
}
"""Constants of INA by family and series."""
REINFORCED = ("2", "3", "22", "23")
"""Series of cylindrical roller bearings whose constants are those of INA's reinforced design (E)."""
TIMKEN = {
    "deep_groove": {
        ("618", "628", "638"): (1.7, 0.0001),
        ("639", "160"): (1.7, 0.00015),
        ("62",): (2.0, 0.0002),
        ("63",): (2.3, 0.0002),
        ("64",): (2.3, 0.0002),
    },
    "angular_contact": {
        ("72B", "72AC", "72C"): (2.0, 0.00025),
        ("73B", "73AC", "73C"): (3.0, 0.00035),
        ("32A", "32B"): (5.0, 0.00035),
        ("33A", "33B"): (7.0, 0.00035),
    },
    "four_point": {("QJ2",): (2.0, 0.00037), ("QJ3",): (3.0, 0.00037)},
    "cylindrical": {
        ("10",): (2.0, 0.0002),
        ("2",): (2.0, 0.0003),
        ("22",): (3.0, 0.0004),
        ("3",): (2.0, 0.00035),
        ("23",): (4.0, 0.0004),
        ("4",): (2.0, 0.0004),
    },
    "cylindrical_full": {
        ("18",): (5.0, 0.00055),
        ("29",): (6.0, 0.00055),
        ("30",): (7.0, 0.00055),
        ("22",): (8.0, 0.00055),
        ("23",): (12.0, 0.00055),
    },
}
"""Constants f0, f1 of Timken by family and series. The manual lists dimension series of ISO 15 (02 is 62, 72, NU 2); QJ
stands for its gothic-arch bearings. It does not list dimension series 10 of deep groove bearings (60)."""
