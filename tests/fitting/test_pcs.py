"""Text exports of PCS machines: tab-separated, one table a step. The exports are written here, with our own numbers."""

import numpy as np
import pytest

from fitting.io import CurveError, read_curves

HEADINGS = ["SRR (%)", "Traction Coeff (-)", *[""] * 7, "Step Time (s)", "Pot RTD Temp (degC)", "Lube RTD Temp (degC)"]
HEADINGS += ["Ball Load (N)", "Wear (um)", "", "Ball Speed 1", "Disc Speed 1", "Rolling Speed (mm/s)"]
HEADINGS += ["Sliding Speed (mm/s)", "SRR (%)", "", "Traction Force (N)", "Traction Coeff (-)", "Traction Trace (-)"]
TITLE = "MTM999 Test Data File\nLubricant name:\tan oil\nNumber of steps in profile:\t4\n\n"
END = "\nAll steps completed, test completed normally at 01/02/2020 11:00:00\n"
POINTS = [(20.0, 0.05), (10.0, 0.04), (0.4, 0.01), (-0.5, -0.02)]


def row(slide, coefficient, load=100.0, speed=500.0, lube="40.0", pot="41.5"):
    """One line of a table; the machine prints the coefficient without its sign."""
    values = {
        "SRR (%)": f"{slide:.3f}",
        "Traction Coeff (-)": f"{abs(coefficient):.4f}",
        "Step Time (s)": "6",
        "Pot RTD Temp (degC)": pot,
        "Lube RTD Temp (degC)": lube,
        "Ball Load (N)": f"{load:.3f}",
        "Rolling Speed (mm/s)": f"{speed:.2f}",
        "Traction Force (N)": f"{coefficient * load:.4f}",
    }
    return "\t".join(values.get(name, "") for name in HEADINGS) + "\t"


def step(number, rows, kind="Traction", headings=HEADINGS):
    begin = f"Step {number} started at 01/02/2020 10:00:00\nStep type\t{kind}\tStep description\ta sweep\n"
    begin += "Zero traction force (N)\t0.5289\t(measured at the start of this step)\n"
    return begin + "\n".join(["\t".join(headings), *rows]) + "\n"


def mapper(number):
    return (
        f"Step {number} started at 01/02/2020 10:00:00\nStep type\tMapper\tStep description\tx\nWindow load = 9.7 N\n"
    )


SWEEP = step(2, [row(*point) for point in POINTS])
EXPORT = "\n".join([TITLE, mapper(1), SWEEP, step(3, [row(5.0, 0.03, load=200.0, speed=1000.0, lube="60.0")] * 2), END])


@pytest.fixture
def read(tmp_path):
    def read_text(content):
        path = tmp_path / "export.txt"
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return read_curves(path)

    return read_text


@pytest.mark.parametrize(
    "content",
    [EXPORT, EXPORT.replace("\n", "\r\n"), EXPORT.replace(".", ","), EXPORT.removeprefix(TITLE), "\ufeff" + EXPORT],
    ids=["plain", "crlf", "decimal_commas", "no_title", "bom"],
)
def test_each_traction_step_is_a_curve(content, read):
    table = read(content)
    assert table.curve_names == ("step 2", "step 3")
    np.testing.assert_array_equal(table.curve, [0, 0, 0, 0, 1, 1])
    close = lambda value, expected: np.testing.assert_allclose(value, expected, rtol=1e-14)
    close(table.slide_to_roll, [0.2, 0.1, 0.004, -0.005, 0.05, 0.05])
    close(table.traction_coefficient, [0.05, 0.04, 0.01, -0.02, 0.03, 0.03])
    close(table.load, [100.0] * 4 + [200.0] * 2)
    close(table.entrainment_speed, [0.5] * 4 + [1.0] * 2)
    close(table.temperature, [313.15] * 4 + [333.15] * 2)
    assert table.pressure is None
    assert table.origin == "export.txt"
    assert "Steps of other types are ignored: 1 Mapper." in table.notes
    assert "Temperature is that of 'Lube RTD Temp (degC)'." in table.notes


@pytest.mark.parametrize("kind", ["Traction", "TRACTION"])
def test_other_steps_are_left_out(kind, read):
    others = [step(4, [row(1.0, 0.9)], "STRIBECK"), step(5, [row(1.0, 0.9)], "BodTimed"), mapper(6), mapper(7)]
    table = read("\n".join([step(3, [row(*point) for point in POINTS], kind), *others, step(8, [], kind)]))
    assert table.curve_names == ("step 3",)
    assert table.point_count == 4
    assert "Steps of other types are ignored: 1 STRIBECK, 1 BodTimed, 2 Mapper." in table.notes
    assert "Traction steps without a table of points are ignored: 8." in table.notes


def test_sign_of_the_force_whatever_the_machine_calls_positive(read):
    reversed_force = step(2, [row(slide, -coefficient) for slide, coefficient in POINTS])
    np.testing.assert_allclose(read(reversed_force).traction_coefficient, [0.05, 0.04, 0.01, -0.02], rtol=1e-14)
    table = read(SWEEP.replace("Traction Force (N)", "Something (N)"))
    np.testing.assert_allclose(table.traction_coefficient, [0.05, 0.04, 0.01, 0.02], rtol=1e-14)
    assert any("no traction force" in note for note in table.notes)
    assert any("1 point has a traction coefficient of another sign" in note for note in table.notes)


def test_pot_temperature_where_the_lubricant_has_none(read):
    table = read(step(1, [row(*point, lube="") for point in POINTS]))
    np.testing.assert_allclose(table.temperature, 314.65, rtol=1e-14)
    assert "Temperature is that of 'Pot RTD Temp (degC)'." in table.notes
    table = read(step(1, [row(*point, lube="", pot="") for point in POINTS]))
    assert table.temperature is None
    assert any("temperature is not read" in note for note in table.notes)


def test_degree_signs_of_windows(read):
    content = EXPORT.replace("degC", "°C").encode("latin-1")
    np.testing.assert_allclose(read(content).temperature[0], 313.15, rtol=1e-14)


def line_of(content, text):
    return next(number for number, line in enumerate(content.split("\n"), start=1) if line.startswith(text))


# name: (content, beginning of the line that is wrong, column, words)
BROKEN = {
    "title_only": (TITLE, None, "", ["no steps", "'SRR (%)'"]),
    "no_traction": (mapper(1) + step(2, [row(1, 0.1)], "STRIBECK"), None, "", ["Mapper, STRIBECK", "'Traction'"]),
    "no_table": (mapper(1).replace("Mapper", "Traction"), None, "", ["without a table"]),
    "one_point": (step(1, [row(5.0, 0.05)]), "5.000", "", ["a single point"]),
    "no_coefficient": (SWEEP.replace("Traction Coeff", "Mu"), "SRR", "Traction Coeff (-)", ["'Mu (-)'"]),
    "no_slide": (SWEEP.replace("SRR", "Slip"), "Slip", "SRR (%)", ["'Slip (%)'"]),
    "text": (SWEEP.replace("\t0.0400", "\tfailed", 1), "10.000", "Traction Coeff (-)", ["the text 'failed'"]),
    "nan": (SWEEP.replace("\t0.0400", "\tNaN", 1), "10.000", "Traction Coeff (-)", ["not finite"]),
    "empty_cell": (SWEEP.replace("\t0.0400", "\t", 1), "10.000", "Traction Coeff (-)", ["an empty cell"]),
    "short_row": (SWEEP.replace(row(*POINTS[1]), "10.000"), "10.000", "Traction Coeff (-)", ["an empty cell"]),
    "long_row": (SWEEP.replace(row(*POINTS[1]), row(*POINTS[1]) + "3"), "10.000", "", ["25 cells", "at most 24"]),
    "empty_load": (SWEEP.replace("100.000", "", 1), "20.000", "Ball Load (N)", ["an empty cell"]),
    "load_zero": (step(1, [row(5.0, 0.05, load=0.0)] * 2), "5.000", "Ball Load (N)", ["0 N", "> 0"]),
    "wrong_unit": (SWEEP.replace("(mm/s)", "(mm)"), "SRR", "Rolling Speed (mm/s)", ["another kind"]),
    "unknown_unit": (SWEEP.replace("Load (N)", "Load (kgw)"), "SRR", "Ball Load (kgw)", ["not known"]),
    "no_sliding": (step(1, [row(0.0, 0.05)] * 3), None, "SRR (%)", ["all 0"]),
}


@pytest.mark.parametrize("name", BROKEN)
def test_broken_export(name, read, tmp_path):
    content, beginning, column, words = BROKEN[name]
    content = mapper(0) + content if not content.startswith(TITLE) else content
    with pytest.raises(CurveError) as caught:
        read(content)
    error = caught.value
    column = column.replace("mm/s", "mm") if name == "wrong_unit" else column
    line = None if beginning is None else line_of(content, beginning)
    assert (error.file, error.line, error.column) == (str(tmp_path / "export.txt"), line, column)
    for word in words:
        assert word in str(error)


def test_no_bytes_lead_to_another_error(read):
    random = np.random.default_rng(1)
    alphabet = b"\t\t\n\r0123456789.,-()%SstT \0\xff\xb0"
    for _ in range(200):
        content = bytearray(EXPORT.encode())
        for _ in range(random.integers(1, 8)):
            content[random.integers(len(content))] = alphabet[random.integers(len(alphabet))]
        try:
            read(bytes(content))
        except CurveError as error:
            assert str(error).isprintable()  # noqa: PT017
