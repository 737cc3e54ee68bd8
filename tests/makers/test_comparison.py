"""Makers' formulas beside a solution: what they take, what they say is missing, assumed or out of range; the solution
stays as it is."""

import dataclasses
import math

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from filled_results import filled, solution_of, structure_of

import jaxbearing as jb
from jaxbearing.catalogue import known_designations, parse
from jaxbearing.makers import Catalogue, compared
from jaxbearing.makers.designation import Said, read_designation
from jaxbearing.report.makers_table import comparison_listing, comparison_rows, comparison_to_dict
from jaxbearing.scenes.bearing.catalogue import load_catalogue

BALL = {"operation.inner_speed": "3000 rpm", "operation.radial_load": "1000 N", "operation.axial_load": "none"}
DRY = {"contact": "none", "drag": "none"}
"""What makers' formulas do not ask for."""
SIZES_6205 = {"outside_diameter": 52e-3, "kinematic_viscosity": 20e-6}


def beside(name, changes=None, **catalogue):
    scene = jb.load_scene(name, changes)
    return compared(scene, solution_of(scene), Catalogue(**catalogue))


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("6205", Said("deep_groove", "62", 25e-3)),
        ("6205-2RSH", Said("deep_groove", "62", 25e-3, "RSH", 2)),
        ("6205-RS1", Said("deep_groove", "62", 25e-3, "RS1", 1)),
        ("6203-2Z", Said("deep_groove", "62", 17e-3, "Z", 2)),
        ("6205-2RS", Said("deep_groove", "62", 25e-3, "RS", 2)),
        ("6205 2RSR C3", Said("deep_groove", "62", 25e-3, "RSR", 2)),
        ("6205LLU", Said("deep_groove", "62", 25e-3, "LLU", 2)),
        ("6205 DU", Said("deep_groove", "62", 25e-3, "DU", 1)),
        ("6205ZZ", Said("deep_groove", "62", 25e-3, "Z", 2)),
        ("608-2RS", Said("deep_groove", "60", 8e-3, "RS", 2)),
        ("618/8", Said("deep_groove", "618", 8e-3)),
        ("7205 C3", Said("angular_contact", "72", 25e-3)),
        ("NF 210", Said("cylindrical", "2", 50e-3)),
        ("16005", Said("deep_groove", "160", 25e-3)),
        ("61805", Said("deep_groove", "618", 25e-3)),
        ("7205 BEP", Said("angular_contact", "72B", 25e-3)),
        ("7205 ACD", Said("angular_contact", "72AC", 25e-3)),
        ("3205 A", Said("angular_contact", "32A", 25e-3)),
        ("QJ 208 MA", Said("four_point", "QJ2", 40e-3)),
        ("NU 210 ECP", Said("cylindrical", "2", 50e-3)),
        ("NUP2311", Said("cylindrical", "23", 55e-3)),
        ("NU 1010", Said("cylindrical", "10", 50e-3)),
        ("NCF 3010 CV", Said("cylindrical_full", "30", 50e-3)),
        ("SL18 3010", Said("cylindrical_full", "30", 50e-3)),
        ("SL183010", Said("cylindrical_full", "30", 50e-3)),
        ("30206", Said("tapered", "302", 30e-3)),
        ("32008 X", Said("tapered", "320X", 40e-3)),
        ("32206 B", Said("tapered", "322B", 30e-3)),
        ("LM12749", Said("tapered", "LM")),
        # no guess
        ("", Said()),
        ("bearing", Said()),
        ("22205 E", Said()),
        ("51105", Said()),
        ("AXK 2542", Said()),
    ],
)
def test_designations(text, said):
    found = read_designation(text)
    assert found[:2] + found[3:] == said[:2] + said[3:]
    assert (found.bore is None) == (said.bore is None)
    if said.bore is not None:
        np.testing.assert_allclose(found.bore, said.bore, rtol=1e-12)


def test_catalogue_and_formulas_read_alike():
    """One grammar: family and bore of every designation whose dimensions are known."""
    for text in known_designations():
        found, said = parse(text), read_designation(text)
        assert said.family == {"spindle": "angular_contact"}.get(found.kind, found.kind)
        assert (said.series, said.seal) == (found.series, "")
        np.testing.assert_allclose(said.bore, 1e-3 * found.bore, rtol=1e-12)


def test_6205_is_that_of_the_check_row():
    found = beside("deep_groove_6205", BALL, designation="6205", **SIZES_6205)
    skf, ina = found["skf"], found["palmgren_ina"]
    np.testing.assert_allclose(skf.parts["rolling"], 14.76867e-3, rtol=1e-6)
    np.testing.assert_allclose(skf.parts["sliding"], 6.344513e-3, rtol=1e-6)
    np.testing.assert_allclose(skf.total, 21.11318e-3, rtol=1e-6)
    np.testing.assert_allclose(skf.power, skf.total * 100.0 * math.pi, rtol=1e-12)
    assert skf.parts["drag"] is None
    assert any("drag: give" in text for text in skf.missing)
    assert any("bore by the designation" in text for text in skf.assumed)
    assert skf.inside_range
    # INA's f1 has the static rating
    assert ina.total is None
    assert ina.inside_range is None
    assert ina.missing == ("give catalogue.static_capacity",)
    np.testing.assert_allclose(
        beside("deep_groove_6205", BALL, designation="6205", static_capacity=7800.0, **SIZES_6205)[
            "palmgren_ina"
        ].parts["viscous"],
        17.49228e-3,
        rtol=1e-6,
    )
    assert found["palmgren_timken"].total is not None


def test_parts_that_are_given():
    sizes = {"oil_level": 5e-3, "seal_diameter": 30e-3}
    found = beside("deep_groove_6205", BALL, designation="6205-2RSH", **SIZES_6205, **sizes)["skf"]
    np.testing.assert_allclose(found.parts["drag"], 0.6893624e-3, rtol=1e-6)
    np.testing.assert_allclose(found.parts["seal"], 60.97675e-3, rtol=1e-6)
    np.testing.assert_allclose(found.total, sum(found.parts.values()), rtol=1e-12)
    assert not found.missing
    half = beside("deep_groove_6205", BALL, designation="6205-RSH", **SIZES_6205, **sizes)["skf"]
    np.testing.assert_allclose(half.parts["seal"], 0.5 * found.parts["seal"], rtol=1e-12)
    other = beside("deep_groove_6205", BALL, designation="6205-2RZ", **SIZES_6205)["skf"]
    assert other.parts["seal"] == 0.0
    shielded = beside("deep_groove_6205", BALL, designation="6205-2Z", **SIZES_6205)["skf"]
    assert shielded.parts["seal"] == 0.0
    greased = beside("deep_groove_6205", BALL, designation="6205", lubrication="grease", **SIZES_6205)["skf"]
    assert greased.parts["drag"] == 0.0
    assert any("fresh grease has 2 to 4 times the sliding moment" in text for text in greased.assumed)
    other_maker = beside("deep_groove_6205", BALL, designation="6205-2RS", **SIZES_6205)["skf"]
    assert other_maker.parts["seal"] is None
    assert any("seal: no constants of RS" in text for text in other_maker.missing)


def test_two_rows_have_twice_the_static_factors():
    """P0 = Fr + 2 * 0.26 Fa of two rows at 40 degrees, P1 = 1.4 Fa - 0.1 Fr."""
    loads = {"operation.axial_load": "5 kN", "operation.radial_load": "4 kN"}
    sizes = {"bore": 90e-3, "outside_diameter": 160e-3, "static_capacity": 100e3, "kinematic_viscosity": 20e-6}
    found = beside("angular_contact_218", loads, family="angular_contact", series="32B", **sizes)["palmgren_ina"]
    np.testing.assert_allclose(found.parts["load"], 1e-3 * (6600.0 / 100e3) ** 0.33 * 6600.0 * 0.125, rtol=1e-9)


def test_a_jet_is_twice_a_bath_to_half_a_roller():
    given = {"series": "10", "bore": 119e-3, "outside_diameter": 165e-3, "width": 28e-3}
    jet = beside("turbine_roller", lubrication="oil_jet", **given)["skf"]
    bath = beside("turbine_roller", oil_level=6e-3, **given)["skf"]
    np.testing.assert_allclose(jet.parts["drag"], 2.0 * bath.parts["drag"], rtol=1e-12)
    assert any("jet" in text for text in jet.assumed)


def test_tapered_is_that_of_the_check_row():
    loads = {"operation.axial_load": "6 kN", "operation.radial_load": "0 N"}
    changes = {**DRY, **loads, "operation.inner_speed": "2000 rpm"}
    given = {"designation": "32216", "outside_diameter": 140e-3, "kinematic_viscosity": 60.5913e-6}
    found = beside("tapered_example", changes, axial_factor=1.4, **given)
    np.testing.assert_allclose(found["skf"].parts["rolling"], 5.402227, rtol=1e-6)
    np.testing.assert_allclose(found["skf"].parts["sliding"], 28.54656e-3, rtol=1e-6)
    assert found["palmgren_ina"].total is not None
    assert found["timken_tapered"].missing == ("give catalogue.timken_g1", "give catalogue.timken_k")
    starved = beside("tapered_example", changes, axial_factor=1.4, starvation_constant=3e-8, **given)
    ratio = starved["skf"].parts["rolling"] / found["skf"].parts["rolling"]
    np.testing.assert_allclose(ratio, 0.84, atol=5e-3)
    # 0.4 cot(14.036 deg) where Y is not given
    assumed = beside("tapered_example", changes, **given)
    assert any("0.4 cot" in text for text in assumed["skf"].assumed)


def test_timken_tapered_takes_graphs_from_the_user():
    given = {"designation": "30206", "timken_g1": 20.0, "timken_k": 1.6}
    between = beside("tapered_example", DRY, **given)["timken_tapered"]
    assert between.total is None
    assert "timken_f3" in between.missing[0]
    found = beside("tapered_example", DRY, timken_f3=1.1, **given)["timken_tapered"]
    assert found.total > 0.0
    assert any("timken_g2" in text for text in found.missing)
    slow = beside("tapered_example", DRY, timken_f3=1.1, timken_g2=1e-3, timken_f2=1.0, **given)["timken_tapered"]
    assert any("least speed" in text for text in slow.flags)
    # at K Fa/Fr above 2 the load is Fa
    thrust = {"operation.radial_load": "0 N"} | DRY
    pushed = beside("tapered_example", thrust, **given)["timken_tapered"]
    assert pushed.total is not None


# what a formula does not cover, it says


def test_nothing_is_guessed_for_balls():
    found = beside("deep_groove_6205", BALL, **SIZES_6205)
    for one in found.laws:
        assert one.total is None
        assert any("catalogue.family" in text for text in one.missing)


@pytest.mark.parametrize(
    ("name", "catalogue", "law"),
    [
        ("deep_groove_6205", {"designation": "6205"}, "palmgren_timken"),
        ("deep_groove_6205", {"family": "deep_groove", "series": "99"}, "skf"),
        ("deep_groove_6205", {"designation": "7005 C"}, "skf"),
        ("deep_groove_6205", {"designation": "6005"}, "palmgren_timken"),
        ("turbine_roller", {"series": "30"}, "skf"),
        ("tapered_example", {"series": "HM"}, "palmgren_ina"),
    ],
)
def test_a_series_that_is_not_covered(name, catalogue, law):
    changes = {"deep_groove_6205": BALL, "tapered_example": DRY}.get(name)
    viscosity = {"kinematic_viscosity": 20e-6, "outside_diameter": 0.165, "bore": 0.119}
    found = beside(name, changes, **{**viscosity, **catalogue})[law]
    if law == "palmgren_timken" and catalogue == {"designation": "6205"}:
        assert found.total is not None
    else:
        assert found.total is None
        assert "no constants of the series" in found.missing[0]


def test_a_seal_that_is_not_covered():
    found = beside("deep_groove_6205", BALL, designation="6210-2RSH", outside_diameter=90e-3, kinematic_viscosity=2e-5)
    assert found["skf"].parts["seal"] is None
    assert any("no constants of RSH at D = 90 mm" in text for text in found["skf"].missing)


def test_contradictions_are_said():
    other = beside("turbine_roller", designation="6205")
    assert any("is no bearing of the kind" in text for text in other.notes)
    unknown = beside("turbine_roller", designation="ABC")
    assert any("has no form that is known" in text for text in unknown.notes)
    bore = beside("deep_groove_6205", BALL, designation="6205", bore=30e-3, **SIZES_6205)
    assert any("has a bore of 25 mm" in text for text in bore.notes)


# ranges


def test_turbine_roller_is_above_all_speeds():
    found = beside("turbine_roller", series="10", bore=119e-3, outside_diameter=165e-3)
    for one in (found["skf"], found["palmgren_ina"], found["palmgren_timken"]):
        assert not one.inside_range
        assert "1.49e6" in one.flags[0]
        assert one.ratio is not None
    # of other constants for the same formula
    assert found.spread > 1.05
    assert any("differ by a factor" in text for text in found.notes)


def test_range_of_skf():
    few = {"operation.radial_load": "10 N", "rating.dynamic_capacity": "14 kN"}
    found = beside("deep_groove_6205", BALL | few, designation="6205", **SIZES_6205)["skf"]
    assert any("minimum load" in text for text in found.flags)
    tilted = {"operation.moment": "1 N*m"}
    found = beside("deep_groove_6205", BALL | tilted, designation="6205", **SIZES_6205)["skf"]
    assert any("moment acts" in text for text in found.flags)
    flooded = beside("deep_groove_6205", BALL, designation="6205", oil_level=60e-3, **SIZES_6205)["skf"]
    assert any("oil level" in text for text in flooded.flags)


def test_axial_load_on_ribs_is_left_out_and_flagged():
    scene = jb.load_scene("turbine_roller")
    loaded = solution_of(scene)
    operation = dataclasses.replace(loaded.operation, axial_load=100.0)
    found = compared(scene, dataclasses.replace(loaded, operation=operation), Catalogue(series="10"))
    assert any("ribs" in text for text in found["palmgren_ina"].flags)
    assert found["skf"].parts["sliding"] > 0.0


# the physical side


def test_physical_parts_add_up():
    scene = jb.load_scene("turbine_roller", {"contact.rolling_resistance": "ertel_grubin"})
    solution = solution_of(scene)
    found = compared(scene, solution, Catalogue(series="10"))
    speed, physical = 10500.0 * math.pi / 30.0, found.physical
    np.testing.assert_allclose(physical.total * speed, float(solution.power_loss.total), rtol=1e-12)
    np.testing.assert_allclose(physical.parts["drag"] * speed, float(solution.power_loss.drag), rtol=1e-12)
    rolling = float(solution.power_loss.rolling_resistance)
    np.testing.assert_allclose(physical.parts["rolling"] * speed, rolling, rtol=1e-12)
    parts = sum(value for value in physical.parts.values() if value is not None)
    np.testing.assert_allclose(parts * speed, sum(physical.locations.values()), rtol=1e-12)
    without = beside("turbine_roller", series="10")
    assert without.physical.parts["rolling"] is None
    assert any("rolling resistance out" in text for text in without.notes)


def test_a_scene_without_losses_stands_beside_nothing():
    found = beside("deep_groove_6205", BALL, designation="6205", **SIZES_6205)
    assert found.physical.total is None
    assert found["skf"].ratio is None
    assert any("models no loss" in text for text in found.notes)


def test_refusals():
    scene = jb.load_scene("deep_groove_6205", BALL)
    solution = solution_of(scene)
    with pytest.raises(TypeError, match="makers' formulas are of bearings"):
        jb.compare("two_disk_etm")
    failed = dataclasses.replace(solution, status=jnp.asarray(2))
    with pytest.raises(ValueError, match="has no results"):
        compared(scene, failed)
    with pytest.raises(ValueError, match="found a batch"):
        compared(scene, filled(structure_of(scene), (3,)))
    with pytest.raises(ValueError, match=r"catalogue\.bore"):
        Catalogue(bore=-1.0)


# nothing of it enters a result


def leaves(tree):
    return [np.asarray(leaf).tobytes() for leaf in jax.tree.leaves(tree)]


def test_the_table_is_no_part_of_a_scene():
    changes = {"catalogue.designation": "6205-2RSH", "catalogue.oil_level": "5 mm"}
    with_table, without = jb.load_scene("deep_groove_6205", changes), jb.load_scene("deep_groove_6205")
    assert jax.tree.structure(with_table) == jax.tree.structure(without)
    assert leaves(with_table) == leaves(without)
    catalogue = load_catalogue("deep_groove_6205", changes)
    assert catalogue.designation == "6205-2RSH"
    assert float(catalogue.oil_level) == 5e-3
    assert load_catalogue("deep_groove_6205").designation == "6205"
    assert load_catalogue("turbine_ball") is None
    assert load_catalogue("two_disk_etm") is None


def test_a_solution_stays_as_it_is():
    scene = jb.load_scene("deep_groove_6205", BALL)
    solution = solution_of(scene)
    kept = leaves(solution)
    given = jb.Catalogue(designation="6205", static_capacity=7800.0, **SIZES_6205)
    found = jb.compare(scene, solution, catalogue=given)
    assert found["skf"].total > 0.0
    assert leaves(solution) == kept


# outputs


def test_outputs_have_every_number():
    found = beside("turbine_roller", series="10", bore=119e-3, outside_diameter=165e-3)
    said = comparison_to_dict(found)
    assert [one["law"] for one in said["laws"]] == ["skf", "palmgren_ina", "palmgren_timken"]
    for one in said["laws"]:
        assert {"law", "total", "parts", "inside_range", "flags", "assumed", "missing", "power", "ratio"} == set(one)
    assert said["physical"]["power"] == found.physical.power
    assert said["laws"][0]["inside_range"] is False
    rows = comparison_rows(found)
    assert [row[0] for row in rows] == ["physical model", "SKF", "Palmgren, INA", "Palmgren, Timken"]
    listing = comparison_listing(found)
    assert all(len(row) == len(listing.headings) for row in listing.rows)
    assert "no result of the package" in listing.remarks[0]
