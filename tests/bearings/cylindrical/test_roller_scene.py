"""What a scene refuses, assumes and warns of."""

import jax.numpy as jnp
import numpy as np
import pytest
from roller_cases import RPM, reference_roller, turbine_roller

import jaxbearing as jb


@pytest.mark.parametrize(
    ("change", "field"),
    [
        ({"cage.inner_diameter": 160e-3}, "cage.inner_diameter"),
        ({"cage.inner_diameter": 20e-3}, "cage.inner_diameter"),
        ({"cage.outer_diameter": 400e-3}, "cage.outer_diameter"),
        ({"cage.pocket_clearance": 0.1}, "cage.pocket_clearance"),
        ({"cage.guiding_clearance": 0.2}, "cage.guiding_clearance"),
        ({"flange.height": 0.2}, "flange.height"),
        ({"flange.ring": "both", "flange.height": 7e-3}, "flange.height"),
        ({"geometry.roller_diameter": 15e-3}, "geometry.n_rollers"),
        ({"geometry.pitch_diameter": -1.0}, "geometry.pitch_diameter"),
        ({"operation.radial_load": 0.0}, "operation.radial_load"),
        ({"operation.inner_speed": 0.0}, "operation.inner_speed"),
        ({"operation.outer_speed": 10500 * RPM}, "operation.inner_speed"),
        ({"drag.coefficient": -1.0}, "drag.coefficient"),
        ({"oil": None}, "oil"),
    ],
    ids=str,
)
def test_impossible_scenes_are_refused_by_name(change, field):
    with pytest.raises(ValueError, match=rf"^{field}"):
        reference_roller().replace(change)


def test_guiding_clearance_is_limited_by_the_land_that_guides():
    """5 % of the bore of the cage if the inner ring guides it, of its outside if the outer ring does."""
    scene = reference_roller()
    bore, outside = (float(of(scene.geometry)) for of in (scene.cage.bore, scene.cage.outside))
    for ring, land in (("inner_ring", bore), ("outer_ring", outside)):
        guided = scene.replace({"cage.guidance": ring})
        guided.replace({"cage.guiding_clearance": 0.0499 * land})
        with pytest.raises(ValueError, match=r"^cage\.guiding_clearance.*land diameter"):
            guided.replace({"cage.guiding_clearance": 0.0501 * land})


def test_unknown_path_says_what_there_is():
    with pytest.raises(AttributeError, match=r"cage.colour.*guidance"):
        reference_roller().replace({"cage.colour": 1.0})


@pytest.mark.slow
def test_assumed_dimensions_are_announced():
    scene = reference_roller().replace(
        {
            "cage.inner_diameter": None,
            "cage.outer_diameter": None,
            "flange.height": None,
            "geometry.contact_length": None,
        }
    )
    text = " ".join(jb.solve(scene).warnings)
    for name in ("cage.inner_diameter", "cage.outer_diameter", "cage.n_lands", "flange.height", "contact_length"):
        assert name in text
    # the proportions are those of the source's bearing, so only the contact length changes its result
    same = jb.solve(scene.replace({"geometry.contact_length": 12.4e-3}))
    np.testing.assert_allclose(same.power_loss.total, jb.solve(reference_roller()).power_loss.total, rtol=1e-12)


def test_leaving_the_range_of_a_law_warns_and_stays_a_result():
    nominal = jb.solve(turbine_roller())
    assert not [text for text in nominal.warnings if "extrapolated" in text]
    slow = jb.solve(turbine_roller().at_operation(inner_speed=20 * RPM))
    assert any("100 rpm" in text for text in slow.warnings)
    cold = jb.solve(turbine_roller().at_operation(oil_temperature=250.0), throw=False)
    assert any("-20 degC" in text for text in cold.warnings)
    hot = jb.solve(turbine_roller().at_operation(oil_temperature=473.0, inner_speed=20000 * RPM))
    assert any("200 degC" in text for text in hot.warnings)


def test_changes_are_validated_together():
    """Neither the pitch circle nor the rollers fit the other's old value; in any order the result is what counts."""
    change = {"geometry.pitch_diameter": 0.71, "geometry.roller_diameter": 60e-3, "cage.pocket_clearance": 1e-3}
    change |= {"cage.inner_diameter": 0.68, "cage.outer_diameter": 0.73, "flange.height": 10e-3}
    one = reference_roller().replace(change)
    two = reference_roller().replace(dict(reversed(change.items())))
    assert float(one.geometry.roller_diameter) == float(two.geometry.roller_diameter) == 60e-3


def test_concrete_jax_numbers_are_checked_too():
    with pytest.raises(ValueError, match=r"operation.radial_load must be > 0"):
        reference_roller().at_operation(radial_load=jnp.asarray(-5.0))
    with pytest.raises(ValueError, match=r"operation.inner_speed must be one number"):
        reference_roller().at_operation(inner_speed=np.asarray([900.0, 1000.0]))


@pytest.mark.parametrize("freedom", [(), ("lateral",), ("radial", "tilt")])
def test_ring_freedoms_that_the_family_does_not_have(freedom):
    with pytest.raises(ValueError, match="ring_freedom"):
        reference_roller().replace({"ring_freedom": freedom})
