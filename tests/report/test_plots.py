"""The page of plots and the drawing: what is on them is what the solution says, and files appear whole."""

import dataclasses

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest
from matplotlib.figure import Figure
from pictures import outside, overlapping
from roller_cases import HARD_CASES, changed, dry_roller, reference_roller, turbine_roller

import jaxbearing as jb
from jaxbearing.bearings.cylindrical.solution import PowerLoss
from jaxbearing.numerics.status import Status
from jaxbearing.report.backends.matplotlib.panels import draw
from jaxbearing.report.bearing.panels import power_losses
from jaxbearing.report.display import axis_unit
from jaxbearing.report.drawing import draw_bearing
from jaxbearing.report.panels import Bars
from jaxbearing.report.plots import plot_solution, save_plot

FIRST_BYTES = {"png": b"\x89PNG", "svg": b"<?xml", "pdf": b"%PDF"}


@pytest.fixture(scope="module")
def solution():
    return jb.solve(turbine_roller())


@pytest.fixture(scope="module")
def dry():
    return jb.solve(dry_roller())


def panel(figure, title):
    (found,) = [axes for axes in figure.axes if axes.get_title().startswith(title)]
    return found


def lines(axes):
    return {line.get_label(): np.asarray(line.get_ydata()) for line in axes.lines}


def words(figure):
    return "\n".join(text.get_text() for text in figure.findobj(lambda artist: hasattr(artist, "get_text")))


def test_bars_are_the_power_losses(solution):
    axes = panel(plot_solution(solution, "a scene"), "Power loss")
    names = [label.get_text().replace(" ", "_") for label in axes.get_yticklabels()]
    widths = [bar.get_width() for bar in axes.patches]
    assert dict(zip(names, widths, strict=True)) == power_losses(solution)
    assert widths == sorted(widths, reverse=True)
    assert f"total {float(solution.power_loss.total):.1f} W" in axes.get_title()
    np.testing.assert_allclose(sum(widths), solution.power_loss.total, rtol=1e-12)
    largest = axes.texts[0].get_text()
    assert f"{widths[0]:.1f} W" in largest
    assert f"{100 * widths[0] / sum(widths):.1f} %" in largest


@pytest.mark.parametrize(("count", "places"), [(1, 4), (4, 4), (6, 6)])
def test_few_bars_are_no_thicker_than_four(count, places):
    names = [f"loss {number}" for number in range(count)]
    panel = Bars("loss", "Loss", "", "loss", "W", names, [1.0] * count, ["-"] * count, float(count), "#56789b")
    axes = Figure().add_subplot()
    draw(axes, panel)
    bottom, top = axes.get_ylim()
    assert (bottom, top) == (places - 0.5, -0.5)  # the first bar stands above
    assert len({bar.get_height() for bar in axes.patches}) == 1


def test_curves_are_those_of_the_elements(solution):
    figure = plot_solution(solution, "a scene")
    elements = solution.elements
    loads = lines(panel(figure, "Load"))
    np.testing.assert_allclose(loads["inner race"][:-1], 1e-3 * np.asarray(elements.load_inner), rtol=1e-14)
    assert loads["outer race"][0] == loads["outer race"][-1]
    for title, values, factor in (
        ("Central film, µm", elements.film_outer, 1e6),
        ("Hertz (peak) pressure, GPa", elements.pressure_outer, 1e-9),
        ("Sliding speed, m/s", elements.sliding_outer, 1.0),
    ):
        axes = panel(figure, title)
        curve = {line.get_label(): line for line in axes.lines}["outer race"]
        at = dict(zip(np.round(curve.get_xdata() % 360.0, 6), curve.get_ydata(), strict=True))
        for azimuth, value in zip(np.degrees(np.asarray(elements.azimuth)), np.asarray(values), strict=True):
            np.testing.assert_allclose(at[round(azimuth % 360.0, 6)], factor * value, rtol=1e-14)


def test_what_is_not_modelled_is_not_on_the_page(solution, dry):
    titles = lambda figure: [axes.get_title().split(",")[0] for axes in figure.axes]
    assert titles(plot_solution(dry, "dry")) == ["Load on each roller", "Hertz (peak) pressure"]
    assert len(titles(plot_solution(solution, "full"))) == 5
    absent = lambda s: (s.power_loss.flange, s.elements.sliding_inner, s.elements.sliding_outer)
    without = eqx.tree_at(absent, solution, (None,) * 3)
    figure = plot_solution(without, "less")
    assert "flange" not in words(figure)
    assert "Sliding" not in words(figure)


def test_head_and_foot_of_the_page(solution):
    title = "a$b_^{ --set cage=none " + "x" * 300
    text = words(plot_solution(dataclasses.replace(solution, notes=("a note",) * 9), title))
    assert "inner ring speed 10500 rpm" in text
    assert "radial load 25 kN" in text
    assert "oil temperature 100 °C" in text
    assert "a note" in text
    assert "and more" in text
    assert "a$b_^{" in text
    assert "x" * 150 not in text


@pytest.mark.parametrize("watts", [0.0, -3.0, 1e-9, 3e4])
def test_any_power_is_drawn(solution, watts, tmp_path):
    loss = PowerLoss(total=jnp.asarray(watts), drag=jnp.asarray(watts), pocket=jnp.asarray(0.0))
    figure = plot_solution(eqx.tree_at(lambda s: s.power_loss, solution, loss), "a scene")
    save_plot(figure, tmp_path / "page.png")


@pytest.mark.parametrize("value", [0.0, 1e-3, 1e6])
def test_flat_curves_are_numbers(dry, value, tmp_path):
    flat = jax.tree.map(lambda leaf: jnp.full_like(leaf, value), dry.elements)
    flat = eqx.tree_at(lambda e: e.azimuth, flat, dry.elements.azimuth)
    figure = plot_solution(eqx.tree_at(lambda s: s.elements, dry, flat), "flat")
    save_plot(figure, tmp_path / "page.svg")
    (axes,) = figure.axes
    assert axes.get_title() == "The same at every roller"
    load = [text.get_text() for text in axes.texts if text.get_text().endswith("N")]
    expected = {0.0: "0 N", 1e-3: "0.001000 N", 1e6: "1000 kN"}[value]
    assert load == [expected] * 2
    assert overlapping(figure) == []


def test_one_flat_curve_among_others(dry):
    """The pressure alone is the same: it is a number beside the loads' picture."""
    same = lambda s: (s.elements.pressure_inner, s.elements.pressure_outer)
    values = [jnp.full_like(one, 1.234e9) for one in same(dry)]
    figure = plot_solution(eqx.tree_at(same, dry, values), "dry")
    assert [axes.name for axes in figure.axes] == ["polar", "rectilinear"]
    assert [text.get_text() for text in figure.axes[1].texts].count("1.234 GPa") == 2


def test_contact_angles_of_balls():
    solution = jb.solve(jb.load_scene("deep_groove_6205", {"contact": "none"}))
    figure = plot_solution(solution, "a ball bearing")
    axes = panel(figure, "Contact angle, deg")
    angles = np.degrees(np.asarray(solution.elements.contact_angle_inner))
    np.testing.assert_allclose(np.sort(lines(axes)["inner race"]), np.sort(angles), rtol=1e-13)
    assert overlapping(figure) == []


def test_no_text_lies_on_another(solution, dry):
    for one in (solution, dry):
        figure = plot_solution(one, "a scene")
        assert overlapping(figure) == []
        assert outside(figure) == []


def test_failures_and_batches_are_refused(dry):
    with pytest.raises(ValueError, match="diverged"):
        plot_solution(eqx.tree_at(lambda s: s.status, dry, jnp.asarray(int(Status.DIVERGED))), "a scene")
    with pytest.raises(ValueError, match="batch"):
        plot_solution(eqx.tree_at(lambda s: s.status, dry, jnp.zeros(3, dtype=int)), "a scene")


@pytest.mark.parametrize("suffix", ["png", "svg", "pdf", "PNG"])
def test_files_by_suffix(dry, suffix, tmp_path):
    path = tmp_path / f"page.{suffix}"
    save_plot(plot_solution(dry, "dry"), path)
    assert path.read_bytes().startswith(FIRST_BYTES[suffix.lower()])
    assert [file.name for file in tmp_path.iterdir()] == [path.name]


def test_a_notebook_shows_a_page_by_itself(dry):
    assert plot_solution(dry, "dry")._repr_png_().startswith(FIRST_BYTES["png"])


@pytest.mark.parametrize("name", ["page.jpg", "page", "png", "page.png.gz"])
def test_other_suffixes_write_nothing(dry, name, tmp_path):
    with pytest.raises(ValueError, match=r"\.png, \.svg or \.pdf"):
        save_plot(plot_solution(dry, "dry"), tmp_path / name)
    assert list(tmp_path.iterdir()) == []


def test_a_missing_folder_is_an_os_error(dry, tmp_path):
    with pytest.raises(OSError, match="No such file"):
        save_plot(plot_solution(dry, "dry"), tmp_path / "missing" / "page.png")


@pytest.mark.parametrize(
    ("unit", "largest", "expected"),
    [("N", 999.0, "N"), ("N", 1000.0, "kN"), ("m", 5e-8, "nm"), ("m", 2e-6, "µm"), ("Pa", 5e7, "MPa"), ("1", 3.0, "1")],
)
def test_axis_units(unit, largest, expected):
    assert axis_unit(unit, largest)[0] == expected


SCENES = {
    "full": turbine_roller(),
    "dry": dry_roller(),
    "no cage sizes": reference_roller().replace(
        {"cage.inner_diameter": None, "cage.outer_diameter": None, "cage.pocket_axial_clearance": None}
    ),
    "no flange": reference_roller().replace({"flange": None}),
    "few rollers": reference_roller().replace({"geometry.n_rollers": 3}),
    "preload": changed(reference_roller(), HARD_CASES["preload 20 um"]),
    "one length": reference_roller().replace({"geometry.contact_length": None}),
}


@pytest.mark.parametrize("name", list(SCENES))
def test_drawing_names_every_dimension(name, tmp_path):
    scene = SCENES[name]
    figure = draw_bearing(scene)
    text = words(figure)
    save_plot(figure, tmp_path / "drawing.svg")
    expected = {"pitch_diameter", "roller_diameter", "roller_length", "diametral_clearance", "operation.radial_load"}
    if scene.geometry.contact_length is not None:
        expected.add("contact_length")
    for table in ("cage", "flange"):
        part = getattr(scene, table)
        named = [] if part is None else [n for n in vars(part) if isinstance(getattr(part, n), np.ndarray)]
        expected |= {f"{table}.{field}" for field in named}
        assert part is not None or f"{table}." not in text
    assert {field for field in expected if field not in text} == set()


def test_drawing_says_values_and_assumptions():
    text = words(draw_bearing(SCENES["no cage sizes"]))
    assert "pitch_diameter 142 mm" in text
    assert "cage.inner_diameter 135 mm (assumed)" in text
    assert "diametral_clearance 30 µm" in text
    assert "diametral_clearance -20 µm" in words(draw_bearing(SCENES["preload"]))


def test_drawing_refuses_other_things():
    with pytest.raises(TypeError, match="draws a bearing, got a RollerGeometry"):
        draw_bearing(reference_roller().geometry)


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("turbine_ball", ["n_balls 20", "contact_angle 30 deg", "ball_diameter 20.638 mm", "cage.n_lands 2"]),
        ("deep_groove_6205", ["diametral_clearance 12 µm", "1.5 kN, on the inner ring"]),
        ("tapered_example", ["roller_half_angle 2 deg", "end_radius 108 mm", "n_rollers 17"]),
    ],
)
def test_drawings_of_the_other_families(name, said, tmp_path):
    """Each number of geometry and cage stands once on the page."""
    scene = jb.load_scene(name)
    figure = draw_bearing(scene)
    save_plot(figure, tmp_path / "drawing.svg")
    text = words(figure)
    assert all(one in text for one in said)
    for table in ("geometry", "cage"):
        part = getattr(scene, table, None)
        numbers = [] if part is None else [n for n, v in vars(part).items() if isinstance(v, int | np.ndarray)]
        for field in numbers:
            label = field if table == "geometry" else f"{table}.{field}"
            assert text.count(f"{label} ") == 1, label
